// Text that stands still: title, caption, and what tells two halves of a picture apart.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"

namespace carom {

/// Breaks at spaces, at '\n', and inside words that are wider than a line.
std::vector<std::string> break_lines(const Font& font, const std::string& text, double width_px);

/// Text that stands still in the middle of the picture's upper or lower edge. It stays clear of
/// what is `taken`: beside it where there is room, else further inside. Letters shrink, and at last
/// the text is cut with an ellipsis, rather than leave the picture or cover more than a third of
/// it. Without room for the ellipsis its rect() is empty, and it must not be drawn.
class TextElement : public Element {
  public:
    struct Request {
        std::string text;
        double size_px = 22;  ///< of the letters, at a height of 720
        bool at_top = true;
        bool plate = false;  ///< else letters with a halo
    };
    TextElement(const Request& request, int width_px, int height_px,
                const std::vector<PixelRect>& taken, const Palette& palette);

    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;
    PixelRect rect() const override { return rect_; }
    const std::vector<std::string>& lines() const { return lines_; }

  private:
    PixelRect rect_;
    Image picture_;
    std::vector<std::string> lines_;
};

ElementKind title_kind();
/// Which of two runs a half of the picture shows.
ElementKind run_name_kind();
ElementKind caption_kind();

}  // namespace carom
