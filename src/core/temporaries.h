// The process's temporary files and folders, so that none stays behind however it ends.
#pragma once

#include <functional>
#include <string>

namespace carom {

/// One per process, as the signals that end it are. Safe from any thread.
namespace temporaries {

/// Makes one by `make`, which returns its path, and remembers it in the same moment; a path of ""
/// is none. Whoever made it still removes it.
std::string add(const std::function<std::string()>& make);

/// It has another name now, or is gone.
void forget(const std::string& path) noexcept;

/// Removes all of them, folders with what is in them. For a process that ends at once: add() and
/// forget() do not return any more.
void remove_for_good() noexcept;

}  // namespace temporaries

}  // namespace carom
