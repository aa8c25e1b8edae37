// What stands over a picture: one interface for all of it, and how one is made.
#pragma once

#include <memory>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/draw2d/style.h"
#include "render/runs/second_run.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// Between which parts of a picture an element lies, and so how often it is drawn.
enum class Layer {
    kBackground,  ///< below the balls, the same at all times: drawn once for each view
    kBelowBalls,  ///< below the balls, with the time: brings a picture that it keeps up to date
    kOver,        ///< on the finished picture, anew in each
};

/// Where two runs stand side by side: whether it belongs to the film or to each of them.
enum class Repeat { kOncePerFilm, kOncePerHalf };

/// Which picture an element is for.
enum class PicturePart {
    kWhole,       ///< a picture by itself
    kOverHalves,  ///< what is said once, over two halves
    kFirstHalf,
    kSecondHalf,
};

/// What an element that draws on the finished picture draws there at an instant: where equal to
/// that of another instant, the same pixels.
struct Appearance {
    std::vector<PixelRect> parts;  ///< all that it draws on; may reach beyond the picture
    std::vector<double> state;     ///< all that decides what it draws, besides the view
    bool operator==(const Appearance&) const = default;
};

/// One thing that is drawn over a picture, for as long as a film lasts. Pictures are premultiplied
/// and in the size of the view; times are seconds of the motion, in any order.
class Element {
  public:
    virtual ~Element() = default;

    /// The pixels that others stay clear of, at all times; empty where it gives way itself, or,
    /// in the background, where this view does not show it.
    virtual PixelRect rect() const { return {}; }

    /// The camera has moved; the size stays. `around`: as in ElementContext.
    virtual void set_view(const View& /*view*/, const std::vector<PixelRect>& /*around*/) {}

    /// kBackground, onto a picture that is transparent at first, and kOver, onto the finished one.
    virtual void draw(double /*t*/, Image& /*picture*/) {}

    /// kOver: what draw() draws at t. By default, something else at each instant, anywhere.
    virtual Appearance appearance(double t) {
        constexpr int kAnywhere = 1 << 28;
        return {{{0, 0, kAnywhere, kAnywhere}}, {t}};
    }

    /// kBelowBalls: brings its picture, on transparent, to the instant t. Returns what changed
    /// since the last call, which may reach beyond the picture.
    virtual PixelRect update(double /*t*/) { return {}; }
    virtual const Image& picture() const;
};

/// What an element is told when it is made. All that is referred to outlives it, but for `view`,
/// `taken` and `around`, which an element copies if it needs them later.
struct ElementContext {
    const Scene& scene;  ///< whose balls this picture shows; the overlay's keys are in it
    const Motion& motion;
    const View& view;  ///< the first; later ones come by set_view()
    PicturePart part = PicturePart::kWhole;
    const SecondRun* second = nullptr;  ///< that the film shows with the first; else null
    const BothRuns* both = nullptr;     ///< where there is a second one; null over halves
    Palette palette{};
    std::vector<PixelRect> taken{};   ///< by elements before it, and by the other part's
    std::vector<PixelRect> around{};  ///< the same, and by what stands in the background

    /// Whose paths are traced: those of ghosts as well.
    bool traces_both() const { return both != nullptr && part == PicturePart::kWhole; }
    const Scene& traced_scene() const { return traces_both() ? both->scene : scene; }
    const Motion& traced_motion() const { return traces_both() ? both->motion : motion; }
};

/// A kind of element, for the list of all (overlay/elements.cpp).
struct ElementKind {
    const char* name = nullptr;  ///< its effect in --stats; null where that has none of its own
    Layer layer = Layer::kOver;
    Repeat repeat = Repeat::kOncePerHalf;
    bool keeps_place = false;  ///< left out where its rect() is empty or not within the picture
    bool (*wanted)(const Scene&) = nullptr;   ///< whether the scene asks for it
    bool (*has_room)(const View&) = nullptr;  ///< whether such a picture may have it; null: always
    const char* why = "the scene asks for it";
    const char* why_not = "not asked for";
    /// Null where there is nothing to show. Called only where `wanted` holds.
    std::unique_ptr<Element> (*make)(const ElementContext&) = nullptr;
};

}  // namespace carom
