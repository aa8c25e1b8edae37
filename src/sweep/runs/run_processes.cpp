// Runs in processes; declared in run_many.h.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>

#include "core/check.h"
#include "core/failure.h"
#include "sweep/runs/run_maker.h"
#include "sweep/runs/run_many.h"

namespace carom {

namespace {

/// Before the bytes of a reason.
struct Answer {
    std::int64_t run = 0;
    enum Kind : std::int32_t { kDone, kFailed, kFatalOutput, kFatal } kind = kDone;
    std::uint32_t size = 0;
};

/// False at the end of the other side.
bool send_all(int socket, const void* bytes, std::size_t size) {
    const char* next = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t sent = ::send(socket, next, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        next += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int socket, void* bytes, std::size_t size) {
    char* next = static_cast<char*>(bytes);
    while (size > 0) {
        const ssize_t got = ::recv(socket, next, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        next += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

bool send_answer(int socket, Answer answer, const std::string& reason) {
    constexpr std::size_t kLongest = 1 << 16;
    answer.size = static_cast<std::uint32_t>(std::min(reason.size(), kLongest));
    return send_all(socket, &answer, sizeof answer) && send_all(socket, reason.data(), answer.size);
}

/// The terminal's Ctrl-C is for the first process, which ends the others.
void set_up_worker(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    ::signal(SIGTERM, SIG_DFL);
    for (const int ignored : {SIGINT, SIGHUP, SIGPIPE}) ::signal(ignored, SIG_IGN);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    // Runs are beside one another: the driver's threads would only be in the way.
    ::setenv("LP_NUM_THREADS", "0", 0);
}

/// Makes the runs that it is told to, until there are no more.
[[noreturn]] void work(int socket, const ManyRuns& runs) {
    std::int64_t run = -1;
    try {
        RunMaker maker = runs.make_maker();
        while (receive_all(socket, &run, sizeof run)) {
            const RunRecord record = maker.make(run, {});
            const bool done = record.status == RunStatus::kDone;
            if (!send_answer(socket, {run, done ? Answer::kDone : Answer::kFailed}, record.reason))
                break;
        }
    } catch (const Failure& failure) {
        const bool output = failure.kind() == FailureKind::kOutput;
        send_answer(socket, {run, output ? Answer::kFatalOutput : Answer::kFatal}, failure.what());
    } catch (const std::exception& error) {
        send_answer(socket, {run, Answer::kFatal}, error.what());
    }
    ::_exit(0);  // the first process has its own ends to meet
}

std::string end_text(int status) {
    if (WIFSIGNALED(status))
        return fmt::format("its process was ended by signal {} ({})", WTERMSIG(status),
                           strsignal(WTERMSIG(status)));
    return fmt::format("its process ended with {}", WEXITSTATUS(status));
}

class Worker {
  public:
    explicit Worker(const ManyRuns& runs) {
        std::array<int, 2> pair{};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) fail();
        const pid_t parent = ::getpid();
        process_ = ::fork();
        if (process_ < 0) {
            const int why = errno;
            for (const int socket : pair) ::close(socket);
            errno = why;
            fail();
        }
        if (process_ == 0) {
            ::close(pair[0]);
            set_up_worker(parent);
            work(pair[1], runs);
        }
        ::close(pair[1]);
        socket_ = pair[0];
    }
    ~Worker() {
        ::shutdown(socket_, SHUT_RDWR);  // later processes hold copies of it
        ::close(socket_);
        if (process_ <= 0) return;
        if (run_) ::kill(process_, SIGKILL);
        wait();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    int socket() const { return socket_; }
    pid_t process() const { return process_; }
    const std::optional<std::int64_t>& run() const { return run_; }
    void begin(std::int64_t run) {
        run_ = run;
        send_all(socket_, &run, sizeof run);  // an end is seen when its answer does not come
    }
    /// None where the process has ended.
    std::optional<Answer> answer(std::string& reason) {
        Answer answer;
        if (!receive_all(socket_, &answer, sizeof answer)) return std::nullopt;
        reason.resize(answer.size);
        if (!receive_all(socket_, reason.data(), reason.size())) return std::nullopt;
        run_.reset();
        return answer;
    }
    /// Why it ended.
    std::string wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = 0;
        return end_text(status);
    }

  private:
    [[noreturn]] static void fail() {
        throw Failure(FailureKind::kRun,
                      fmt::format("making a process for runs: {}", std::strerror(errno)));
    }

    pid_t process_ = 0;
    int socket_ = -1;
    std::optional<std::int64_t> run_;  ///< that it is at
};

/// The first process's side.
class Pool {
  public:
    explicit Pool(const ManyRuns& runs) : runs_(runs) {}

    /// Whatever ends it, no run that is half made stays behind.
    void work() {
        try {
            make_all();
        } catch (...) {
            leave();
            throw;
        }
    }

  private:
    void make_all() {
        const int count = std::min(runs_.jobs, static_cast<int>(runs_.todo.size()));
        for (int i = 0; i < count; ++i) add_worker();
        while (!workers_.empty()) {
            if (runs_.stop.stop_requested()) return leave();
            for (const std::size_t i : readable()) take(i);
            std::erase(workers_, nullptr);
        }
    }

    bool has_more() const { return next_ < runs_.todo.size(); }

    void add_worker() {
        workers_.push_back(std::make_unique<Worker>(runs_));
        workers_.back()->begin(runs_.todo[next_++]);
    }

    /// Those that have something to say, after a short while at most.
    std::vector<std::size_t> readable() const {
        constexpr int kPatience_ms = 100;
        std::vector<pollfd> sockets;
        for (const auto& worker : workers_) sockets.push_back({worker->socket(), POLLIN, 0});
        std::vector<std::size_t> found;
        if (::poll(sockets.data(), sockets.size(), kPatience_ms) <= 0) {
            runs_.tell(nullptr);
            return found;
        }
        for (std::size_t i = 0; i < sockets.size(); ++i)
            if (sockets[i].revents != 0) found.push_back(i);
        return found;
    }

    void take(std::size_t i) {
        Worker& worker = *workers_[i];
        const std::int64_t run = *worker.run();
        std::string reason;
        const std::optional<Answer> answer = worker.answer(reason);
        if (!answer) return replace(i, run);
        if (answer->kind == Answer::kFatalOutput || answer->kind == Answer::kFatal)
            throw Failure(answer->kind == Answer::kFatal ? FailureKind::kRun : FailureKind::kOutput,
                          reason);
        tell({run, answer->kind == Answer::kDone, reason});
        if (has_more())
            worker.begin(runs_.todo[next_++]);
        else
            workers_[i].reset();
    }

    /// Of a process that has ended in the middle of a run.
    void replace(std::size_t i, std::int64_t run) {
        const pid_t process = workers_[i]->process();
        const std::string reason = workers_[i]->wait();
        workers_[i].reset();
        RunMaker maker = runs_.make_maker();
        remove_leftover(maker.dir(), run, process);
        maker.give_up(run, reason);
        tell({run, false, reason});
        if (has_more()) add_worker();
    }

    void tell(const RunOutcome& outcome) {
        if (!outcome.done && runs_.fail_fast) next_ = runs_.todo.size();
        runs_.tell(&outcome);
    }

    /// Nothing of runs that are not whole stays.
    void leave() {
        for (auto& worker : workers_) {
            if (!worker || !worker->run()) continue;
            const std::int64_t run = *worker->run();
            const pid_t process = worker->process();
            worker.reset();
            remove_leftover(runs_.make_maker().dir(), run, process);
        }
        workers_.clear();
    }

    const ManyRuns& runs_;
    std::size_t next_ = 0;
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace

void run_in_processes(const ManyRuns& runs) { Pool(runs).work(); }

}  // namespace carom
