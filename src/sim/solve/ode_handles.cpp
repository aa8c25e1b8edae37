#include "sim/solve/ode_handles.h"

#include <fmt/core.h>

#include "core/failure.h"
#include "sim/solve/ode_messages.h"

namespace carom {

namespace {

/// ODE's library-wide state, for as long as the process runs.
struct OdeLibrary {
    OdeLibrary() {
        dInitODE2(0);
        OdeMessages::install_handlers();
    }
    ~OdeLibrary() { dCloseODE(); }
    OdeLibrary(const OdeLibrary&) = delete;
    OdeLibrary& operator=(const OdeLibrary&) = delete;
};

}  // namespace

void start_ode() {
    static const OdeLibrary library;
    const auto all_data = static_cast<unsigned>(dAllocateMaskAll);
    thread_local const bool ready = dAllocateODEDataForThread(all_data) != 0;
    if (!ready) throw Failure(FailureKind::kRun, "cannot start ODE: no memory for this thread");
    if (dCheckConfiguration("ODE_double_precision") == 0)
        throw Failure(FailureKind::kRun,
                      fmt::format("ODE is built for single precision, carom needs double ({})",
                                  dGetConfiguration()));
}

}  // namespace carom
