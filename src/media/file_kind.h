// What a file is by its first bytes, whatever its name says.
#pragma once

#include <string>

namespace carom {

enum class PictureFileKind {
    kPng,           ///< one picture
    kOtherPicture,  ///< a still picture that carom does not read; `name` says which
    kLfsPointer,    ///< what Git LFS leaves in place of a file that was not fetched
    kEmpty,
    kOther,  ///< maybe a film: FFmpeg knows more kinds than we do. An animated PNG is one.
};

struct FileContent {
    PictureFileKind kind = PictureFileKind::kOther;
    const char* name = "";  ///< "JPEG", "BMP" ...: of a picture
};

/// What a person can do about a kLfsPointer.
inline constexpr const char* kLfsAdvice =
    "this is a pointer of Git LFS, not the file itself; `git lfs pull` fetches it";

/// Throws Failure(kInput) with the system's text if the file cannot be read. A pipe is left as it
/// is, and goes by its name.
FileContent file_content(const std::string& path);

}  // namespace carom
