// What is written and drawn over a picture: ruler, clock, text, labels, trails, ... as one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "render/element/element.h"
#include "render/tile/tile_mask.h"

namespace carom {

/// The elements (overlay/elements.cpp) that the scene asks for, in three layers: a ball may pass in
/// front of a ruler, but never in front of the clock.
class OverlayPainter {
  public:
    /// What a picture of two runs tells; all must outlive the overlay.
    struct Runs {
        PicturePart part = PicturePart::kWhole;
        const SecondRun* second = nullptr;
        const BothRuns* both = nullptr;
        std::vector<PixelRect> taken{};  ///< by others who draw on the picture
    };

    /// `scene` and `motion` must outlive it.
    OverlayPainter(const Scene& scene, const Motion& motion, const View& view)
        : OverlayPainter(scene, motion, view, Runs{}) {}
    OverlayPainter(const Scene& scene, const Motion& motion, const View& view, Runs runs);

    /// Another view of the same size: what lies in the scene moves, clock, text and plot stay.
    void set_view(const View& view);

    /// What is drawn at fixed places over the picture.
    const std::vector<PixelRect>& obstacles() const { return taken_; }

    /// What was asked for and is not drawn, since the picture has no room for it: names of effects.
    const std::vector<std::string>& left_out() const { return left_out_; }

    /// The ruler, drawn at each call and not kept. Empty picture if nothing is to be drawn.
    Image background_layer() const;

    /// The trails and marks of peaks at t, premultiplied on transparent, kept up to date in one
    /// picture of the film's size; returns the rectangle that changed since the last call.
    bool has_moving_layer() const { return !below_balls_.empty(); }
    PixelRect update_moving_layer(double t);
    const Image& moving_layer() const;

    /// Clock, text, plot, arrows, verdict and labels on the finished picture.
    void draw_over(double t, Image& picture) const;

    /// The same where the picture of the last call's instant is there: adds to the tiles that
    /// change below what changes here, and all of each element that has a part in either. In these
    /// tiles the picture has to be brought to what is below, for redraw_over().
    void find_changes_over(double t, TileMask& tiles);
    void redraw_over(double t, Image& picture) const;
    /// Whatever is shown next is new.
    void forget_over() { shown_.clear(); }

  private:
    /// Whether what keeps a place has one; then it is taken, else the element is left out.
    bool takes_place(const ElementKind& kind, const PixelRect& rect);
    void leave_out(const ElementKind& kind);
    std::vector<PixelRect> around() const;

    View view_;
    std::vector<PixelRect> taken_;
    std::vector<std::string> left_out_;
    std::vector<std::unique_ptr<Element>> background_, below_balls_, over_;
    struct Shown {
        Appearance appearance;
        bool redrawn = false;
    };
    std::vector<Shown> shown_;  ///< of each element over the picture, at the last instant
    Image composed_;            ///< of those below the balls, where there are several
    const Image nothing_;
};

}  // namespace carom
