// The scene's title at the top of the picture, and a caption at its bottom.
#pragma once

#include <string>
#include <vector>

#include "render/font.h"
#include "render/overlay.h"
#include "render/overlay_style.h"

namespace carom {

/// Breaks at spaces, at '\n', and inside words that are wider than a line.
std::vector<std::string> break_lines(const Font& font, const std::string& text, double width_px);

/// Text that stands still in the middle of the picture's upper or lower edge. It stays clear of
/// what is `taken`: beside it where there is room, else further inside. Letters shrink, and at last
/// the text is cut with an ellipsis, rather than leave the picture or cover more than a third of
/// it. Without room for the ellipsis its rect() is empty, and it must not be drawn.
class OverlayText {
  public:
    struct Request {
        std::string text;
        double size_px = 22;  ///< of the letters, at a height of 720
        bool at_top = true;
        bool plate = false;  ///< else letters with a halo
    };
    OverlayText(const Request& request, int width_px, int height_px,
                const std::vector<OverlayPainter::Rect>& taken, const Palette& palette);

    void draw(Image& picture) const { lay_over(picture_, rect_.x, rect_.y, picture); }
    OverlayPainter::Rect rect() const { return rect_; }
    const std::vector<std::string>& lines() const { return lines_; }

  private:
    OverlayPainter::Rect rect_;
    Image picture_;
    std::vector<std::string> lines_;
};

}  // namespace carom
