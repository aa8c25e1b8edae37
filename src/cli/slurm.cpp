#include "cli/slurm.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "media/output_folder.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kTasks = 100;            ///< where none are asked for
constexpr std::int64_t kSlurmsMaxArray = 1001;  ///< its default

/// For a shell: in single quotes, unless nothing in it needs them.
std::string quoted(const std::string& word) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_-./=,:+%@").find(char(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

/// An end of line in it would begin a line of the script, which bash runs.
void require_one_line(const char* what, const std::string& text) {
    if (text.find_first_of("\r\n") == std::string::npos) return;
    throw Failure(
        FailureKind::kInput,
        fmt::format("{} '{}': an end of line cannot stand in a script of Slurm", what, text));
}

/// A folder in a name of Slurm's logs, in which % begins a pattern and %% is one of it.
std::string in_pattern(const std::string& folder) {
    std::string text;
    for (const char c : folder) text += c == '%' ? std::string("%%") : std::string(1, c);
    return text;
}

/// What a program writes on standard output, and how it ended; -1 where it cannot be run.
struct Finished {
    int code = -1;
    std::string output;
};

Finished run(const std::string& command) {
    Finished finished;
    const std::unique_ptr<std::FILE, void (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"),
                                                                [](std::FILE*) {});
    if (!pipe) return finished;
    std::array<char, 4096> part{};
    for (std::size_t got = 0; (got = std::fread(part.data(), 1, part.size(), pipe.get())) > 0;)
        finished.output.append(part.data(), got);
    const int status = ::pclose(pipe.get());
    if (WIFEXITED(status)) finished.code = WEXITSTATUS(status);
    return finished;
}

/// An array's indices are below it.
std::int64_t max_array(const SlurmOptions& options) {
    if (options.max_array > 0) return options.max_array;
    const std::string config = run("scontrol show config 2>/dev/null").output;
    const std::size_t key = config.find("MaxArraySize");
    const std::size_t digits =
        key == std::string::npos ? key : config.find_first_of("0123456789", key);
    std::int64_t size = 0;
    if (digits != std::string::npos)
        std::from_chars(config.data() + digits, config.data() + config.size(), size);
    return size > 0 ? size : kSlurmsMaxArray;
}

/// Of this program, wherever a job runs.
std::string program_path() {
    std::error_code error;
    const fs::path path = fs::read_symlink("/proc/self/exe", error);
    return error ? "carom" : path.string();
}

/// The scripts, and the commands that submit them.
class SlurmJobs {
  public:
    SlurmJobs(const SweepOptions& options, std::int64_t runs)
        : options_(options),
          dir_(fs::absolute(options.dir).lexically_normal()),
          tasks_(std::min(runs, options.slurm.tasks > 0 ? options.slurm.tasks : kTasks)),
          block_(std::min(tasks_, max_array(options.slurm))) {
        if (!dir_.has_filename()) dir_ = dir_.parent_path();
        name_ = "carom-" + fs::path(options.file).stem().string();
        require_one_line("SWEEP.yaml", name_);
        require_one_line("-o", dir_.string());
        require_one_line("--partition", options.slurm.partition);
        require_one_line("--account", options.slurm.account);
        require_one_line("--time", options.slurm.time);
    }

    std::string array_script() const {
        return header("array", "%A_%a", true) +
               "# The argument says how many tasks other arrays have before this one.\n" +
               fmt::format("exec {} --jobs {} --slice \"$(($1 + SLURM_ARRAY_TASK_ID + 1))/{}\"\n",
                           command(), jobs(), tasks_);
    }
    std::string index_script() const {
        return header("index", "%A", false) + "exec " + command() + " --index\n";
    }
    fs::path folder() const { return dir_ / "slurm"; }
    fs::path array_path() const { return folder() / "array.sh"; }
    fs::path index_path() const { return folder() / "index.sh"; }

    std::vector<std::string> array_commands() const {
        std::vector<std::string> commands;
        for (std::int64_t first = 0; first < tasks_; first += block_)
            commands.push_back(fmt::format("sbatch --parsable --array=0-{} {} {}",
                                           std::min(block_, tasks_ - first) - 1,
                                           quoted(array_path().string()), first));
        return commands;
    }
    std::string index_command(const std::vector<std::string>& jobs) const {
        return fmt::format("sbatch --parsable --dependency=afterany:{} {}", fmt::join(jobs, ":"),
                           quoted(index_path().string()));
    }
    std::int64_t tasks() const { return tasks_; }

  private:
    int jobs() const { return options_.jobs > 0 ? options_.jobs : 1; }

    std::string header(const char* kind, const char* log, bool array) const {
        const SlurmOptions& slurm = options_.slurm;
        std::string text = "#!/bin/bash\n";
        const auto add = [&text](const std::string& option) { text += "#SBATCH " + option + "\n"; };
        add("--job-name=" + quoted(name_ + "-" + kind));
        add("--output=" +
            quoted(fmt::format("{}/{}-{}.log", in_pattern(folder().string()), kind, log)));
        add("--open-mode=append");
        // Slurm puts a task of a node that fails into the queue again: it goes on where it was.
        add("--requeue");
        add(fmt::format("--cpus-per-task={}", array ? jobs() : 1));
        if (!slurm.partition.empty()) add("--partition=" + quoted(slurm.partition));
        if (!slurm.account.empty()) add("--account=" + quoted(slurm.account));
        if (!slurm.time.empty()) add("--time=" + quoted(slurm.time));
        return text;
    }
    std::string command() const {
        std::string text =
            fmt::format("{} sweep {} -o {} --progress none", quoted(program_path()),
                        quoted(fs::absolute(options_.file).string()), quoted(dir_.string()));
        if (options_.fail_fast) text += " --fail-fast";
        for (const std::string& set : options_.common.set) text += " --set " + quoted(set);
        return text;
    }

    const SweepOptions& options_;
    fs::path dir_;
    std::string name_;
    std::int64_t tasks_, block_;
};

void print(const SlurmJobs& jobs) {
    std::string text =
        fmt::format("# {}\n{}\n# {}\n{}\n", jobs.array_path().string(), jobs.array_script(),
                    jobs.index_path().string(), jobs.index_script());
    std::vector<std::string> names;
    for (const std::string& command : jobs.array_commands()) {
        names.push_back(fmt::format("$job{}", names.size() + 1));
        text += fmt::format("{}=$({})\n", names.back().substr(1), command);
    }
    write_standard_output(text + jobs.index_command(names) + "\n");
}

/// The job's number. `submitted` are those before it, which the user has to know of if this one is
/// refused.
std::string submit(const std::string& command, const std::vector<std::string>& submitted) {
    const Finished finished = run(command);
    std::string job = finished.output.substr(0, finished.output.find_first_of(";\n"));
    const bool number = !job.empty() && std::all_of(job.begin(), job.end(), [](unsigned char c) {
        return std::isdigit(c) != 0;
    });
    if (finished.code == 0 && number) return job;
    if (finished.code == 127)
        throw Failure(FailureKind::kRun,
                      "sbatch is not here: Slurm takes jobs on a machine that has its commands; "
                      "--print shows them");
    throw Failure(
        FailureKind::kRun,
        fmt::format("Slurm has not taken the job: {} (exit code {}, it said '{}'){}", command,
                    finished.code, job,
                    submitted.empty() ? ""
                                      : fmt::format("; submitted before it, and not taken back: {}",
                                                    fmt::join(submitted, ", "))));
}

}  // namespace

void submit_to_slurm(const SweepOptions& options, std::int64_t runs) {
    const SlurmJobs jobs(options, runs);
    if (options.slurm.print) return print(jobs);
    prepare_folder(jobs.folder().string());
    write_text_file(jobs.array_path().string(), jobs.array_script());
    write_text_file(jobs.index_path().string(), jobs.index_script());
    std::vector<std::string> submitted;
    for (const std::string& command : jobs.array_commands())
        submitted.push_back(submit(command, submitted));
    const std::string last = submit(jobs.index_command(submitted), submitted);
    if (!options.common.quiet)
        say("carom: {} runs in {} tasks of job{} {}; job {} writes the index\n", runs, jobs.tasks(),
            submitted.size() > 1 ? "s" : "", fmt::join(submitted, ", "), last);
}

}  // namespace carom
