// One page on one port of this machine alone, through libevent.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace carom {

/// Answers GET / with the page and GET /revision with its number, and nothing else; only requests
/// that name this machine as their host, so that no other site's page can read it. Bound to
/// 127.0.0.1.
class ViewServer {
  public:
    /// Port 0: any that is free. Failure(kRun) where the port cannot be had.
    explicit ViewServer(int port);
    ~ViewServer();
    ViewServer(const ViewServer&) = delete;
    ViewServer& operator=(const ViewServer&) = delete;

    int port() const;
    /// From any thread.
    void show(std::string page, int revision);
    /// Answers until `stops`, which is asked ten times a second.
    void serve(const std::function<bool()>& stops);

  private:
    struct Libevent;
    std::unique_ptr<Libevent> libevent_;
};

}  // namespace carom
