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
    /// When the frame that next() gave is shown, in seconds after the first one; not a number where
    /// the film does not say.
    double time_s() const;
    double time_error_s() const;  ///< how far time_s() may be off: stamps are whole ticks
  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace carom
