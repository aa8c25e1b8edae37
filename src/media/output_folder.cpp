#include "media/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/failure.h"

namespace carom {

void prepare_folder(const std::string& path) {
    const std::string folder = path.empty() ? "." : path;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Failure(FailureKind::kOutput,
                      fmt::format("cannot make the folder '{}': {}", folder, error.message()));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw Failure(FailureKind::kOutput, fmt::format("cannot write into the folder '{}': {}",
                                                        folder, std::strerror(errno)));
}

}  // namespace carom
