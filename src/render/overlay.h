// What is written and drawn over the picture with cairo: ruler, clock, text, labels, trails, ...
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "motion/motion.h"
#include "render/camera.h"
#include "scene/scene.h"

namespace carom {

struct SecondRun;
struct JoinedRuns;

/// Two layers, because a ball may pass in front of a ruler but never in front of the clock:
/// `under` lies on the background and below the balls, `over` is drawn on the finished picture.
/// Fonts come from a package (see packages.txt); a missing one is Failure(kRun).
class OverlayPainter {
  public:
    struct Rect;
    /// What a picture adds that shows a second run; all must outlive the overlay.
    struct Runs {
        const SecondRun* second = nullptr;         ///< says what differs, on a plate
        const JoinedRuns* beside = nullptr;        ///< both motions: the ruler stands beside them
        bool curves = false;                       ///< trails and plot show both as well
        const std::vector<Rect>* taken = nullptr;  ///< by others who draw on the picture
    };

    /// `scene` and `motion` must outlive it.
    OverlayPainter(const Scene& scene, const Motion& motion, const View& view)
        : OverlayPainter(scene, motion, view, Runs{}) {}
    OverlayPainter(const Scene& scene, const Motion& motion, const View& view, const Runs& runs);
    ~OverlayPainter();
    OverlayPainter(OverlayPainter&&) noexcept;
    OverlayPainter& operator=(OverlayPainter&&) noexcept;

    /// Pixels, half open; empty when width or height is 0.
    struct Rect {
        int x = 0, y = 0, width = 0, height = 0;
        bool empty() const { return width <= 0 || height <= 0; }
        int right() const { return x + width; }
        int bottom() const { return y + height; }
        bool overlaps(const Rect& other) const {
            return x < other.right() && other.x < right() && y < other.bottom() &&
                   other.y < bottom();
        }
        /// The smallest rectangle that holds both.
        Rect joined(const Rect& other) const {
            if (empty()) return other;
            if (other.empty()) return *this;
            const int left = std::min(x, other.x), top = std::min(y, other.y);
            return {left, top, std::max(right(), other.right()) - left,
                    std::max(bottom(), other.bottom()) - top};
        }
    };

    /// Another view of the same size: what lies in the scene moves, clock, text and plot stay.
    void set_view(const View& view);

    /// What is drawn at fixed places over the picture.
    const std::vector<Rect>& obstacles() const;

    /// The ruler: does not change with time, so it is drawn at each call and not kept. Empty
    /// picture if nothing is to be drawn.
    Image static_under_layer() const;

    /// The trails and marks of peaks at t, premultiplied on transparent, kept up to date in one
    /// picture of the film's size; returns the rectangle that changed since the last call.
    bool has_moving_under_layer() const;
    Rect update_moving_under_layer(double t);
    const Image& moving_under_layer() const;

    /// What was asked for and is not drawn, since the picture has no room for it: ruler, clock,
    /// title, caption, plot, verdict, against.
    const std::vector<std::string>& left_out() const;

    /// Clock, text, plot, arrows, verdict and labels on the finished picture.
    void draw_over(double t, Image& picture) const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace carom
