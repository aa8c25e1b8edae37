// The clock: the instant that a frame shows, in a corner of the picture.
#pragma once

#include <array>
#include <string>

#include "render/font.h"
#include "render/overlay.h"
#include "scene/scene.h"

namespace carom {

/// A light plate with "t = 1.25 s". Its place and every digit's place are the same for the whole
/// film; what does not change is drawn once, digits are copied in.
class OverlayClock {
  public:
    /// `longest_s` is the last instant that it will show.
    OverlayClock(const ClockOptions& options, double longest_s, int width_px, int height_px,
                 const std::string& font_family);

    void draw(double t, Image& picture) const;
    OverlayPainter::Rect rect() const;

    /// The digits and the point of `t`, padded with spaces to the length of the longest instant.
    std::string text(double t) const;

  private:
    Font font_;
    int digits_ = 2;
    std::size_t length_ = 4;
    int x_ = 0, y_ = 0;  ///< top left corner of the plate
    int number_x_ = 0;   ///< first digit, from the plate's left edge
    int cell_px_ = 0;    ///< width of a digit
    int point_px_ = 0;   ///< width of the decimal point
    Image plate_;
    std::array<Image, 10> digit_;  ///< as high as the plate
    Image point_;
};

}  // namespace carom
