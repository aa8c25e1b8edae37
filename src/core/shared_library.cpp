#include "core/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <filesystem>
#include <utility>

#include "core/failure.h"

namespace carom {

namespace {

std::string loader_message() {
    const char* text = dlerror();
    return text == nullptr ? "unknown error" : text;
}

}  // namespace

SharedLibrary::SharedLibrary(std::string file, std::string need)
    : file_(std::move(file)),
      need_(std::move(need)),
      handle_(dlopen(file_.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
    if (handle_ == nullptr)
        throw Failure(FailureKind::kRun, fmt::format("{}, but its library {} cannot be loaded: {}",
                                                     need_, file_, loader_message()));
}

void* SharedLibrary::address(const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr)
        throw Failure(FailureKind::kRun, fmt::format("{}, but {} has no function {}: {}", need_,
                                                     file_, name, loader_message()));
    return found;
}

std::string SharedLibrary::folder() const {
    link_map* map = nullptr;
    if (dlinfo(handle_, RTLD_DI_LINKMAP, &map) != 0) return "";
    return std::filesystem::path(map->l_name).parent_path().string();
}

std::string SharedLibrary::try_to_load(const std::string& file) {
    return dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL) == nullptr ? loader_message() : "";
}

}  // namespace carom
