// What ODE has to say, caught instead of printed.
#pragma once

#include <cstdarg>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom {

/// ODE called its error or debug handler, which must not return. Callers turn it into a
/// Failure(kRun) that also says what was going on.
class OdeFatal : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Collects ODE's messages of this thread while it lives; scopes nest. ODE's handlers take no
/// user data, so the innermost scope of a thread is found through a thread-local pointer.
class OdeMessages {
  public:
    OdeMessages();
    ~OdeMessages();
    OdeMessages(const OdeMessages&) = delete;
    OdeMessages& operator=(const OdeMessages&) = delete;

    bool empty() const { return count_ == 0; }
    /// "first; second; ... (and 7 more)"
    std::string text() const;

    /// Called once, when ODE is started: its handlers for the whole process. Outside of any scope
    /// a message is dropped; an error or a debug message is an OdeFatal in any case.
    static void install_handlers();

  private:
    static void receive(int number, const char* format, va_list arguments);

    static constexpr int kKept = 4;  ///< a pile that blows up says the same thing a thousand times
    std::vector<std::string> kept_;
    int count_ = 0;
    OdeMessages* outer_;
};

}  // namespace carom
