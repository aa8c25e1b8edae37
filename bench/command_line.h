// What the command lines of the benches have in common.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <stdexcept>

namespace carom::bench {

/// Reads the words into what the options of `line` name, and runs. Exit code 2 where the words are
/// wrong, 1 where the run throws, and else what it returns.
template <class Run>
int run_line(CLI::App& line, int argc, char** argv, const Run& run) {
    try {
        line.parse(argc, argv);
        return run();
    } catch (const CLI::Success& asked) {  // --help
        return line.exit(asked);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "{}: {}\n", line.get_name(), error.what());
        return 2;
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "{}: {}\n", line.get_name(), error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", line.get_name(), error.what());
        return 1;
    }
}

}  // namespace carom::bench
