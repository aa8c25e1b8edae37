#include "cli/array_task.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "cli/usage.h"

namespace carom {

namespace {

/// The names of a batch system's variables; null where it has none.
struct Variables {
    const char* task;
    const char* first;  ///< null: arrays begin at 0
    const char* last;   ///< null: `count` says how many there are
    const char* step;
    const char* count;
};

constexpr std::array kSystems = {
    Variables{"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX",
              "SLURM_ARRAY_TASK_STEP", "SLURM_ARRAY_TASK_COUNT"},
    Variables{"SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE", nullptr},
    Variables{"AWS_BATCH_JOB_ARRAY_INDEX", nullptr, nullptr, nullptr, "AWS_BATCH_JOB_ARRAY_SIZE"},
};

/// PBS, LSF and Kubernetes number their tasks without saying how many there are.
constexpr std::array kNumbersAlone = {"PBS_ARRAY_INDEX", "PBS_ARRAYID", "LSB_JOBINDEX",
                                      "JOB_COMPLETION_INDEX"};

/// "--chunk" of "--chunk auto".
std::string name_of(const std::string& option) { return option.substr(0, option.find(' ')); }

const char* text_of(const char* name) { return name == nullptr ? nullptr : std::getenv(name); }

/// The variable's number; `fallback` where it is not set, an error where there is none either.
std::int64_t number_of(const char* name, const std::string& option,
                       std::optional<std::int64_t> fallback = {}) {
    const char* text = text_of(name);
    if (text == nullptr && fallback) return *fallback;
    if (text == nullptr) usage(fmt::format("{}: the variable {} is not set", option, name));
    const std::string_view digits = text;
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < 0)
        usage(fmt::format("{}: {}='{}' is no whole number", option, name, text));
    return value;
}

ArrayTask place_in(const Variables& names, const std::string& option) {
    const std::int64_t task = number_of(names.task, option);
    const std::int64_t first = names.first == nullptr ? 0 : number_of(names.first, option);
    const std::int64_t step = number_of(names.step, option, 1);
    std::int64_t count = 0;
    if (names.last == nullptr) {
        count = number_of(names.count, option);
    } else {
        const std::int64_t last = number_of(names.last, option);
        count = step > 0 && last >= first ? (last - first) / step + 1 : 0;
        if (names.count != nullptr && number_of(names.count, option, count) != count)
            usage(
                fmt::format("{}: an array with gaps ({} tasks from {} to {}) does not say which "
                            "of how many parts task {} is; give {} I/N, e.g. {} ${}/N",
                            option, number_of(names.count, option), first, last, task,
                            name_of(option), name_of(option), names.task));
    }
    if (step < 1 || task < first || (task - first) % step != 0 || (task - first) / step >= count)
        usage(fmt::format("{}: {}={} is not one of the array's {} tasks", option, names.task, task,
                          count));
    return {(task - first) / step + 1, count};
}

}  // namespace

ArrayTask array_task(const std::string& option) {
    for (const Variables& names : kSystems) {
        const char* task = text_of(names.task);
        // Grid Engine sets it to this word in jobs that are no arrays.
        if (task != nullptr && std::string_view(task) != "undefined")
            return place_in(names, option);
    }
    for (const char* name : kNumbersAlone)
        if (std::getenv(name) != nullptr)
            usage(
                fmt::format("{}: {} does not say of how many tasks; give {} I/N, e.g. {} ${}/N for "
                            "an array from 1 to N",
                            option, name, name_of(option), name_of(option), name));
    usage(
        fmt::format("{}: this is no task of an array of Slurm ({}), Grid Engine ({}) or AWS "
                    "Batch ({}); give {} I/N, e.g. {} 1/4",
                    option, kSystems[0].task, kSystems[1].task, kSystems[2].task, name_of(option),
                    name_of(option)));
}

}  // namespace carom
