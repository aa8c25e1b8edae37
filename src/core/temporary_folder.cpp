#include "core/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "core/temporaries.h"

namespace carom {

TemporaryFolder::TemporaryFolder(FailureKind kind) {
    std::error_code error;
    const std::filesystem::path place = std::filesystem::temp_directory_path(error);
    if (error)
        throw Failure(kind,
                      fmt::format("no folder for temporary files (TMPDIR): {}", error.message()));
    // mkdtemp() fills in the last six letters.
    path_ = temporaries::add([&] {
        std::string name = (place / "carom-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw Failure(
                kind, fmt::format("making a temporary folder {}: {}", name, std::strerror(errno)));
        return name;
    });
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    temporaries::forget(path_.string());
}

}  // namespace carom
