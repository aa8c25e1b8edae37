// Measurements as CSV, and the coefficient that follows from them.
#include <cmath>

#include "core/failure.h"
#include "report/fit.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(csv) {
    const std::string path = file_with(input, ".csv");
    try {
        const Measurements measured = read_measurements(path);
        const RestitutionFit fit = fit_restitution(measured, {});
        if (!(fit.restitution >= 0 && fit.restitution <= 1))
            broken_promise("a coefficient beyond 0 to 1");
        const VirtualBodyLine line = virtual_body_line(fit.restitution, 4, 5);
        (void)fit_text(fit, line, "m");
        (void)fit_json(fit, line, "m");
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
