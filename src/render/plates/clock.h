// The clock: the instant that a frame shows, in a corner of the picture.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "scene/scene.h"

namespace carom {

/// A light plate with "t = 1.25 s". It stays the same, and every digit in its place, until the
/// number needs one digit more. Plates are drawn once, digits are copied in.
class ClockElement : public Element {
  public:
    /// `longest_s` is the last instant that it will show.
    ClockElement(const ClockOptions& options, double longest_s, int width_px, int height_px,
                 const Palette& palette = {});

    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;
    /// Where the widest plate of the film stands.
    PixelRect rect() const override;

    /// The digits and the point of `t`.
    std::string text(double t) const;

  private:
    struct Plate {
        int x = 0;  ///< left edge in the picture
        Image picture;
    };
    const Plate& plate_for(const std::string& number) const {
        return plates_[std::min(number.size() - shortest_, plates_.size() - 1)];
    }
    Plate make_plate(const Font& font, int number_px) const;

    Palette palette_;
    int digits_ = 2;
    int picture_width_px_ = 0;
    bool at_left_ = true;
    int border_px_ = 0;         ///< between a plate and the picture's edges
    int side_px_ = 0;           ///< between text and the plate's left and right edges
    int height_px_ = 0;         ///< of a plate
    double base_px_ = 0;        ///< of the text, below the plate's upper edge
    int y_ = 0;                 ///< upper edge of the plates in the picture
    int number_px_ = 0;         ///< first digit, from a plate's left edge
    int cell_px_ = 0;           ///< width of a digit
    int point_px_ = 0;          ///< width of the decimal point
    std::size_t shortest_ = 1;  ///< length of the text on plates_[0]; each has one digit more
    std::vector<Plate> plates_;
    std::array<Image, 10> digit_;  ///< as high as the plate
    Image point_;
};

ElementKind clock_kind();

}  // namespace carom
