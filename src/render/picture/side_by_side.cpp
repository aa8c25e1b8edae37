#include "render/picture/side_by_side.h"

#include <algorithm>
#include <cmath>

#include "render/gl/driver_clock.h"
#include "render/gl/offscreen.h"
#include "render/picture/single_picture.h"

namespace carom {

namespace {

/// Bodies and looks of the second run; everything about the picture from the first.
Scene second_half_scene(const Scene& scene, const SecondRun& run) {
    Scene half = run.scene;
    half.film = scene.film;
    half.background = scene.background;
    half.overlay = scene.overlay;
    if (half.overlay.plot) {
        std::vector<int>& plotted = half.overlay.plot->balls;
        plotted.clear();
        for (const BallPair& pair : paired_balls(scene, run.scene)) {
            const std::vector<int>& first = scene.overlay.plot->balls;
            if (std::find(first.begin(), first.end(), static_cast<int>(pair.first)) != first.end())
                plotted.push_back(static_cast<int>(pair.second));
        }
    }
    return half;
}

std::uint8_t byte_of(double part) { return static_cast<std::uint8_t>(std::lround(255 * part)); }

}  // namespace

int SideBySide::divider_px(int width_px, int height_px) {
    const int wanted = std::max(1, static_cast<int>(std::lround(overlay_px(2, height_px))));
    return wanted + (width_px - wanted) % 2;
}

PictureHalf SideBySide::half_of(PicturePart part, const Motion& motion) const {
    const double aspect = static_cast<double>(half_px_) / height_px_;
    PictureHalf half{part, &run_, &both_, choose_camera(both_.scene, both_.motion, aspect),
                     &motion};
    // Both halves stay clear of what covers either of them, and so are laid out alike.
    for (const PixelRect& rect : overlay_.obstacles()) {
        for (const int x : {rect.left, rect.left - half_px_ - divider_px_}) {
            const int left = std::max(x, 0), right = std::min(x + rect.width(), half_px_);
            if (left < right) half.taken.push_back({left, rect.top, right, rect.bottom});
        }
    }
    return half;
}

SideBySide::SideBySide(const Scene& scene, const Motion& motion, const PainterOptions& whole)
    : run_(*whole.second),
      width_px_(whole.width_px),
      height_px_(whole.height_px),
      divider_px_(divider_px(width_px_, height_px_)),
      half_px_((width_px_ - divider_px_) / 2),
      both_(both_runs(scene, motion, run_)),
      second_scene_(second_half_scene(scene, run_)),
      divider_(palette_of(scene.overlay.theme).paper),
      // Its view is only asked for its size: nothing here stands in the scene.
      overlay_(scene, motion, View(Camera{}, width_px_, height_px_),
               {PicturePart::kOverHalves, &run_, nullptr, {}}),
      first_half_(half_of(PicturePart::kFirstHalf, motion)),
      second_half_(half_of(PicturePart::kSecondHalf, motion)) {
    PainterOptions options = whole;
    options.second = nullptr;
    options.width_px = half_px_;
    // One driver for both: the second half finds its programs made.
    options.contexts = std::make_shared<DrawingContexts>();
    first_ = make_single_picture(scene, motion, options, &first_half_);
    second_ = make_single_picture(second_scene_, run_.motion, options, &second_half_);
}

void SideBySide::paint(const std::vector<double>& instants, Image& out) {
    first_->paint(instants, first_picture_);
    second_->paint(instants, second_picture_);
    const double begin = thread_cpu_s();
    if (out.width_px != width_px_ || out.height_px != height_px_)
        out = Image(width_px_, height_px_);
    const std::uint8_t divider[4] = {byte_of(divider_.b), byte_of(divider_.g), byte_of(divider_.r),
                                     255};
    const auto half_bytes = static_cast<std::ptrdiff_t>(first_picture_.stride_bytes());
    for (int y = 0; y < height_px_; ++y) {
        std::uint8_t* to = std::copy_n(first_picture_.row(y), half_bytes, out.row(y));
        for (int x = 0; x < divider_px_; ++x) to = std::copy_n(divider, 4, to);
        std::copy_n(second_picture_.row(y), half_bytes, to);
    }
    overlay_.draw_over(instants.back(), out);
    over_cpu_s_ += thread_cpu_s() - begin;
}

std::map<std::string, DrawnEffect> SideBySide::effects() const {
    std::map<std::string, DrawnEffect> effects = first_->effects();
    for (const auto& [name, effect] : second_->effects())
        if (effect.on) effects[name] = effect;
    // The halves say what has no room in them.
    for (const std::string& name : overlay_.left_out())
        effects[name] = {false, "the picture has no room for it"};
    effects["against"] = {true, "two runs side by side"};
    return effects;
}

double SideBySide::draw_cpu_s() const {
    return first_->draw_cpu_s() + second_->draw_cpu_s() + over_cpu_s_;
}

}  // namespace carom
