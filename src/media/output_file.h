// Output that appears under its name only when it is whole.
#pragma once

#include <string>

namespace carom {

/// Throws Failure(kOutput) if `path` exists and `overwrite` is false, if its folder does not exist
/// or cannot be written, or if it is a folder. Devices and pipes (/dev/stdout) are always allowed.
/// Call it before the work, not after.
void require_writable(const std::string& path, bool overwrite);

/// Whether the bytes must have reached the disk before the name appears.
enum class Durability {
    kSynced,    ///< fsync first: an empty file never stands under the name, even after a power cut
    kUnsynced,  ///< for thousands of small files, where waiting for the disk each time is too slow
};

/// What happens to a file that stands under the name by the time the new one is whole.
enum class Existing {
    kReplace,  ///< the new file takes its place, its mode and, where that is allowed, its owner
    kKeep,     ///< it stays: Failure(kOutput), also where two runs end at one moment
};

/// What -y says.
constexpr Existing existing_of(bool overwrite) {
    return overwrite ? Existing::kReplace : Existing::kKeep;
}

/// Throws Failure(kOutput) if something else than a folder stands under the name.
void require_folder(const std::string& path);

/// Makes a folder, and those above it, if need be. Failure(kOutput) if that cannot be.
void make_folder(const std::string& path);

/// A temporary name beside `path` (".NAME.tmpPID.EXT", created empty by the constructor, so that
/// the extension still tells the format); commit() renames it to `path`, the destructor removes it.
/// A symbolic link is followed: its target is replaced, the link stays. A device or pipe is written
/// in place. Failures are Failure(kOutput) with the path and the system's text.
class OutputFile {
  public:
    explicit OutputFile(std::string path, Existing existing = Existing::kReplace);
    ~OutputFile();
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;

    const std::string& path() const { return path_; }
    const std::string& temporary_path() const { return temporary_path_; }
    /// Renames to path(). At most one of the two commits may be called, once.
    void commit(Durability durability = Durability::kSynced);
    void commit_as(const std::string& path);  ///< the same under another name in the same folder
    /// The same under the first partial_path() that is free (the first one, where files may be
    /// replaced); returns it.
    std::string commit_partial();

  private:
    int try_publish(const std::string& target, Durability durability);
    void publish(const std::string& target, Durability durability);
    void discard() noexcept;

    std::string path_;            ///< as the user named it
    std::string target_path_;     ///< where the links lead
    std::string temporary_path_;  ///< empty: nothing to remove any more
    Existing existing_ = Existing::kReplace;
    bool in_place_ = false;  ///< the target is a device or a pipe
};

/// The name that a file would have got whose temporary one is `name`; "" where that is none. For
/// what a process has left that was killed.
std::string name_of_temporary(const std::string& name);

/// OUT.partial.EXT for OUT.EXT, OUT.partial-2.EXT ... for further ones; of OUT as much as the file
/// system takes.
std::string partial_path(const std::string& path, int number = 1);

/// Writes all of `text` to `path` through an OutputFile.
void write_text_file(const std::string& path, const std::string& text,
                     Durability durability = Durability::kSynced,
                     Existing existing = Existing::kReplace);

}  // namespace carom
