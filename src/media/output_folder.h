// Folders that files are written into.
#pragma once

#include <string>

namespace carom {

/// Makes the folder, and those above it, if need be; "" is the one that the process works in.
/// Throws Failure(kOutput) where that fails, or where no file may be made in it. Call it before the
/// work, not after.
void prepare_folder(const std::string& path);

}  // namespace carom
