#include "guarded.h"

#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace carom::bench {

/// In memory that a child shares with its parent.
struct Watch::Page {
    std::array<char, 40> phase{};
    volatile double reached = 0;
    bool finished = false;
    std::array<char, 60> symptom{};
    std::array<char, 500> detail{};
    Verdict numbers;  ///< its texts stay empty: they would be the child's memory
};

namespace {

constexpr std::size_t kMemory = 4ull << 30;  // bytes of address space of one child

template <std::size_t N>
void copy_text(const std::string& from, std::array<char, N>& to) {
    std::strncpy(to.data(), from.c_str(), N - 1);
}

/// The message without what differs from scene to scene.
std::string kind_of_error(const std::string& message) {
    for (const char* known : {"cannot be integrated", "more events at one instant", "not finite",
                              "LCP", "internal error"})
        if (message.find(known) != std::string::npos) return fmt::format("error: {}", known);
    return "error: other";
}

void work_in_child(const std::function<Verdict(Watch&)>& work, Watch::Page& page) {
    const rlimit memory{kMemory, kMemory}, no_core{0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &no_core);
    Watch watch(page);
    Verdict verdict;
    try {
        verdict = work(watch);
    } catch (const std::exception& error) {
        verdict.symptom = kind_of_error(error.what());
        verdict.detail = fmt::format("{} ({})", error.what(), page.phase.data());
    }
    copy_text(verdict.symptom, page.symptom);
    copy_text(verdict.detail, page.detail);
    verdict.symptom.clear();
    verdict.detail.clear();
    page.numbers.value = verdict.value;
    page.numbers.time = verdict.time;
    page.numbers.cpu_per_s = verdict.cpu_per_s;
    page.numbers.energy_rise = verdict.energy_rise;
    page.numbers.depth = verdict.depth;
    page.numbers.momentum_error = verdict.momentum_error;
    page.numbers.difference = verdict.difference;
    page.numbers.stepped = verdict.stepped;
    page.numbers.integrated = verdict.integrated;
    page.numbers.skipped = verdict.skipped;
    page.finished = true;
}

Verdict read_page(const Watch::Page& page, int status) {
    Verdict v = page.numbers;
    v.symptom = page.symptom.data();
    v.detail = page.detail.data();
    if (page.finished) return v;
    const int sign = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    v.symptom = sign == SIGPROF ? "hang" : fmt::format("crash: signal {}", sign);
    v.detail = fmt::format("in {}, past {} s of motion", page.phase.data(), double(page.reached));
    v.time = page.reached;
    return v;
}

}  // namespace

void Watch::begin(const char* phase, double cpu_s) {
    copy_text(phase, page_.phase);
    page_.reached = 0;
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(cpu_s);
    timer.it_value.tv_usec =
        static_cast<suseconds_t>(1e6 * (cpu_s - static_cast<double>(timer.it_value.tv_sec)));
    setitimer(ITIMER_PROF, &timer, nullptr);  // whose signal ends the process
}

void Watch::reached(double time) { page_.reached = time; }

Verdict run_guarded(const std::function<Verdict(Watch&)>& work) {
    void* memory = mmap(nullptr, sizeof(Watch::Page), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share with a child");
    auto* page = new (memory) Watch::Page;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start a child");
    if (child == 0) {
        work_in_child(work, *page);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    const Verdict verdict = read_page(*page, status);
    page->~Page();
    munmap(memory, sizeof(Watch::Page));
    return verdict;
}

}  // namespace carom::bench
