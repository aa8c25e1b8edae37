#include "sim/versions.h"

#include <ode/version.h>

namespace carom {

std::map<std::string, std::string> simulation_versions() { return {{"ode", dODE_VERSION}}; }

}  // namespace carom
