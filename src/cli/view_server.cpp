#include "cli/view_server.h"

#include <arpa/inet.h>
#include <event2/buffer.h>
#include <event2/event.h>
#include <event2/http.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/failure.h"

namespace carom {

namespace {

struct Deleter {
    void operator()(event_base* base) const { event_base_free(base); }
    void operator()(evhttp* server) const { evhttp_free(server); }
    void operator()(event* timer) const { event_free(timer); }
};

int port_of(evhttp_bound_socket* socket) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(evhttp_bound_socket_get_fd(socket), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
}

void answer(evhttp_request* request, const char* type, const std::string& text) {
    evkeyvalq* headers = evhttp_request_get_output_headers(request);
    evhttp_add_header(headers, "Content-Type", type);
    evhttp_add_header(headers, "Cache-Control", "no-store");
    evhttp_add_header(headers, "X-Content-Type-Options", "nosniff");
    evbuffer_add(evhttp_request_get_output_buffer(request), text.data(), text.size());
    evhttp_send_reply(request, HTTP_OK, "OK", nullptr);
}

}  // namespace

struct ViewServer::Libevent {
    std::unique_ptr<event_base, Deleter> base{event_base_new()};
    std::unique_ptr<evhttp, Deleter> server;
    int port = 0;
    std::function<bool()> stops;
    std::mutex mutex;
    std::string page;
    int revision = 0;

    static void on_request(evhttp_request* request, void* self) {
        static_cast<Libevent*>(self)->reply(request);
    }
    static void on_time(evutil_socket_t, short, void* self) {
        auto* here = static_cast<Libevent*>(self);
        if (here->stops()) event_base_loopbreak(here->base.get());
    }

    /// Another name for this machine is how a foreign page would reach it.
    bool is_for_us(evhttp_request* request) const {
        const char* host = evhttp_find_header(evhttp_request_get_input_headers(request), "Host");
        if (host == nullptr) return false;
        constexpr int kHttp = 80;  // the port that browsers leave out
        for (const char* name : {"127.0.0.1", "localhost"})
            if (host == fmt::format("{}:{}", name, port) ||
                (port == kHttp && name == std::string(host)))
                return true;
        return false;
    }

    void reply(evhttp_request* request) {
        const std::string_view path = evhttp_request_get_uri(request);
        if (!is_for_us(request)) return evhttp_send_error(request, 403, "Forbidden");
        const std::lock_guard lock(mutex);
        if (path == "/") return answer(request, "text/html; charset=utf-8", page);
        if (path == "/revision") return answer(request, "text/plain", std::to_string(revision));
        evhttp_send_error(request, HTTP_NOTFOUND, "Not Found");
    }
};

ViewServer::ViewServer(int port) : libevent_(std::make_unique<Libevent>()) {
    Libevent& it = *libevent_;
    if (it.base) it.server.reset(evhttp_new(it.base.get()));
    if (!it.server) throw Failure(FailureKind::kRun, "libevent gives no server");
    constexpr int kMostBytes = 16 * 1024;  // of a request: it has neither long heads nor a body
    evhttp_set_max_headers_size(it.server.get(), kMostBytes);
    evhttp_set_max_body_size(it.server.get(), kMostBytes);
    evhttp_set_allowed_methods(it.server.get(), EVHTTP_REQ_GET);
    errno = 0;
    evhttp_bound_socket* socket = evhttp_bind_socket_with_handle(it.server.get(), "127.0.0.1",
                                                                 static_cast<std::uint16_t>(port));
    if (socket == nullptr)
        throw Failure(FailureKind::kRun,
                      fmt::format("--port {}: 127.0.0.1 does not give this port ({}); another, or "
                                  "none, which takes one that is free",
                                  port, std::strerror(errno)));
    it.port = port_of(socket);
    evhttp_set_gencb(it.server.get(), Libevent::on_request, &it);
}

ViewServer::~ViewServer() = default;

int ViewServer::port() const { return libevent_->port; }

void ViewServer::show(std::string page, int revision) {
    const std::lock_guard lock(libevent_->mutex);
    libevent_->page = std::move(page);
    libevent_->revision = revision;
}

void ViewServer::serve(const std::function<bool()>& stops) {
    Libevent& it = *libevent_;
    it.stops = stops;
    const std::unique_ptr<event, Deleter> timer(
        event_new(it.base.get(), -1, EV_PERSIST, Libevent::on_time, &it));
    const timeval tenth{0, 100'000};
    event_add(timer.get(), &tenth);
    event_base_dispatch(it.base.get());
}

}  // namespace carom
