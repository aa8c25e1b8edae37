#include "sim/solve/ode_messages.h"

#include <fmt/core.h>
#include <ode/error.h>

#include <cstdio>

namespace carom {

namespace {

thread_local OdeMessages* innermost = nullptr;

std::string formatted(int number, const char* format, va_list arguments) {
    char text[512];
    std::vsnprintf(text, sizeof text, format, arguments);
    return number == 0 ? std::string(text) : fmt::format("{} (number {})", text, number);
}

[[noreturn]] void fail(int number, const char* format, va_list arguments) {
    throw OdeFatal(formatted(number, format, arguments));
}

}  // namespace

OdeMessages::OdeMessages() : outer_(innermost) { innermost = this; }

OdeMessages::~OdeMessages() { innermost = outer_; }

std::string OdeMessages::text() const {
    std::string all;
    for (const std::string& message : kept_) all += (all.empty() ? "" : "; ") + message;
    if (count_ > kKept) all += fmt::format(" (and {} more)", count_ - kKept);
    return all;
}

void OdeMessages::receive(int number, const char* format, va_list arguments) {
    if (innermost == nullptr) return;
    ++innermost->count_;
    if (innermost->count_ <= kKept)
        innermost->kept_.push_back(formatted(number, format, arguments));
}

void OdeMessages::install_handlers() {
    dSetMessageHandler(&OdeMessages::receive);
    dSetErrorHandler(&fail);
    dSetDebugHandler(&fail);
}

}  // namespace carom
