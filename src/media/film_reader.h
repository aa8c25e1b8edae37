// Decoded frames of a film, for comparing.
#pragma once

#include <memory>
#include <string>

#include "core/image.h"

namespace carom {

/// Decodes a film frame by frame, converted from its tagged matrix (BT.709 for ours) to sRGB.
class FilmReader {
  public:
    explicit FilmReader(const std::string& path);  ///< Failure(kInput) if it cannot be opened
    ~FilmReader();
    FilmReader(FilmReader&&) noexcept;
    FilmReader& operator=(FilmReader&&) noexcept;
    bool next(Image& frame);  ///< false at the end
  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace carom
