// Runs inputs through fuzz targets, without libFuzzer: all that was ever found, and changes of it.
//   replay CORPUS [TARGET...] [--mutations N] [--seed S] [--write FOLDER]
//   replay --input TARGET FILE...
// CORPUS has a folder for each target, and NAME.dict beside them. --mutations N makes N inputs of
// each target from its corpus, by the seed: edits of bytes, words of the dictionary, pieces of
// other inputs. A finding is written into the folder (default: the working folder) as
// finding-TARGET.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "target.h"

namespace carom::fuzz {

namespace {

namespace fs = std::filesystem;

std::map<std::string, Target>& targets() {
    static std::map<std::string, Target> all;
    return all;
}

// ---- What is in work, for the handler of signals
// --------------------------------------------------
constexpr unsigned kMost_s = 120;  // of one input: a hang
std::string_view input_in_work;
std::string finding_path;

extern "C" void keep_finding(int number) {
    const int file = ::open(finding_path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
    if (file >= 0 && ::write(file, input_in_work.data(), input_in_work.size()) >= 0) {
        constexpr char kWords[] = "replay: the input is kept as finding-TARGET\n";
        [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kWords, sizeof kWords - 1);
    }
    std::signal(number, SIG_DFL);
    std::raise(number);
}

void run_one(Target target, const std::string& input) {
    input_in_work = input;
    ::alarm(kMost_s);
    target(input);
    ::alarm(0);
}

// ---- Inputs
// ---------------------------------------------------------------------------------------
std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Targets that go on with a scene have the inputs of its reader too.
bool reads_scenes(const std::string& name) { return name == "motion" || name == "frame"; }

std::vector<std::string> corpus_of(const fs::path& folder, const std::string& name) {
    std::vector<fs::path> paths;
    for (const std::string& one : {name, std::string(reads_scenes(name) ? "scene" : "")})
        if (!one.empty() && fs::is_directory(folder / one))
            for (const auto& entry : fs::directory_iterator(folder / one))
                paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());  // a folder's order is the file system's
    std::vector<std::string> inputs;
    for (const fs::path& path : paths) inputs.push_back(bytes_of(path));
    return inputs;
}

/// The words of a dictionary as libFuzzer reads it: "word" a line, with \xNN, \\ and \".
std::vector<std::string> words_of(const fs::path& path) {
    std::vector<std::string> words;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find('"'), last = line.rfind('"');
        if (line.empty() || line.front() == '#' || first == last) continue;
        std::string word;
        for (std::size_t i = first + 1; i < last; ++i) {
            if (line[i] == '\\' && line[i + 1] == 'x') {
                word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
                i += 3;
            } else {
                word += line[line[i] == '\\' ? ++i : i];
            }
        }
        words.push_back(word);
    }
    return words;
}

// ---- Changes of inputs
// ----------------------------------------------------------------------------
class Mutator {
  public:
    Mutator(std::vector<std::string> corpus, std::vector<std::string> words, std::uint64_t seed)
        : corpus_(std::move(corpus)), words_(std::move(words)), random_(seed) {}

    std::string next() {
        constexpr std::size_t kMostEdits = 6, kMostBytes = 1 << 16;
        std::string input = corpus_[below(corpus_.size())];
        for (std::size_t edits = 1 + below(kMostEdits); edits > 0; --edits) edit(input);
        if (input.size() > kMostBytes) input.resize(kMostBytes);
        return input;
    }

  private:
    std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

    void edit(std::string& input) {
        const std::size_t at = below(input.size() + 1);
        const std::size_t left = input.size() - at;
        const std::size_t length = std::min(left, 1 + below(below(4) == 0 ? 200 : 8));
        const std::string& other = corpus_[below(corpus_.size())];
        const std::size_t from = below(other.size() + 1);
        switch (below(8)) {
            case 0:
                if (left > 0) input[at] = static_cast<char>(random_());
                break;
            case 1:
                if (left > 0) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
                break;
            case 2:
                input.erase(at, length);
                break;
            case 3:
                input.insert(at, input.substr(at, length));
                break;
            case 4:
            case 5:
                if (!words_.empty())
                    input.replace(at, below(2) * length, words_[below(words_.size())]);
                break;
            case 6:
                input.insert(at, other.substr(from, 1 + below(200)));
                break;
            default:
                input = input.substr(0, at) + other.substr(from);
        }
    }

    std::vector<std::string> corpus_, words_;
    std::mt19937_64 random_;
};

// ---- The command line
// -----------------------------------------------------------------------------
struct Options {
    fs::path corpus;
    std::vector<std::string> names;
    std::uint64_t mutations = 0, seed = 1;
    fs::path findings = ".";
    bool inputs = false;
};

Options options_of(const std::vector<std::string>& words) {
    Options options;
    std::vector<std::string> plain;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto value = [&] {
            if (i + 1 == words.size()) throw std::invalid_argument(words[i] + " needs a value");
            return words[++i];
        };
        if (words[i] == "--mutations")
            options.mutations = std::stoull(value());
        else if (words[i] == "--seed")
            options.seed = std::stoull(value());
        else if (words[i] == "--write")
            options.findings = value();
        else if (words[i] == "--input")
            options.inputs = true;
        else
            plain.push_back(words[i]);
    }
    if (plain.empty()) throw std::invalid_argument("replay CORPUS [TARGET...] [--mutations N]");
    options.corpus = plain.front();
    options.names.assign(plain.begin() + 1, plain.end());
    if (options.names.empty())
        for (const auto& [name, target] : targets()) options.names.push_back(name);
    return options;
}

void replay(const Options& options, const std::string& name) {
    const Target target = targets().at(name);
    finding_path = (options.findings / ("finding-" + name)).string();
    const std::vector<std::string> corpus = corpus_of(options.corpus, name);
    if (corpus.empty())
        throw std::runtime_error("no inputs in " + (options.corpus / name).string());
    for (const std::string& input : corpus) run_one(target, input);
    run_one(target, "");
    Mutator mutator(corpus,
                    words_of(options.corpus / ((reads_scenes(name) ? "scene" : name) + ".dict")),
                    options.seed);
    for (std::uint64_t i = 0; i < options.mutations; ++i) run_one(target, mutator.next());
    std::printf("%s: %zu inputs, %llu changed ones\n", name.c_str(), corpus.size(),
                static_cast<unsigned long long>(options.mutations));
    std::fflush(stdout);
}

int run(const std::vector<std::string>& words) {
    const Options options = options_of(words);
    for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM})
        std::signal(number, keep_finding);
    if (options.inputs) {
        for (const std::string& path : options.names) {
            std::printf("%s\n", path.c_str());
            std::fflush(stdout);
            run_one(targets().at(options.corpus.string()), bytes_of(path));
        }
        return 0;
    }
    for (const std::string& name : options.names) replay(options, name);
    return 0;
}

}  // namespace

Registration::Registration(const char* name, Target target) { targets().emplace(name, target); }

}  // namespace carom::fuzz

extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "abort_on_error=1:handle_segv=0"; }

int main(int argc, char** argv) {
    try {
        return carom::fuzz::run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "replay: %s\n", error.what());
        return 2;
    }
}
