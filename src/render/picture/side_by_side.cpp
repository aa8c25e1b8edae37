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

constexpr int kTilePx = 16;  ///< in which changes are found

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

void SideBySide::compose(const std::vector<PixelRect>& parts, Image& picture) const {
    const std::uint8_t divider[4] = {byte_of(divider_.b), byte_of(divider_.g), byte_of(divider_.r),
                                     255};
    const int second_px = half_px_ + divider_px_;
    const auto copy = [](const Image& half, int y, int left, int right, std::uint8_t* to) {
        if (left < right)
            std::copy_n(half.row(y) + std::ptrdiff_t{4} * left, std::ptrdiff_t{4} * (right - left),
                        to);
    };
    for (const PixelRect& part : parts) {
        for (int y = part.top; y < part.bottom; ++y) {
            std::uint8_t* row = picture.row(y);
            copy(first_picture_, y, part.left, std::min(part.right, half_px_),
                 row + std::ptrdiff_t{4} * part.left);
            for (int x = std::max(part.left, half_px_); x < std::min(part.right, second_px); ++x)
                std::copy_n(divider, 4, row + std::ptrdiff_t{4} * x);
            const int left = std::max(part.left, second_px);
            copy(second_picture_, y, left - second_px, part.right - second_px,
                 row + std::ptrdiff_t{4} * left);
        }
    }
}

void SideBySide::paint(const std::vector<double>& instants, Image& out) {
    first_->paint(instants, first_picture_);
    second_->paint(instants, second_picture_);
    const double begin = thread_cpu_s();
    kept_pixels_ = nullptr;
    if (out.width_px != width_px_ || out.height_px != height_px_)
        out = Image(width_px_, height_px_);
    compose({{0, 0, width_px_, height_px_}}, out);
    overlay_.draw_over(instants.back(), out);
    over_cpu_s_ += thread_cpu_s() - begin;
}

ChangedParts SideBySide::paint_next(double t, Image& picture) {
    const ChangedParts first = first_->paint_next(t, first_picture_);
    const ChangedParts second = second_->paint_next(t, second_picture_);
    const double begin = thread_cpu_s();
    TileMask tiles(width_px_, height_px_, kTilePx);
    const bool kept = picture.width_px == width_px_ && picture.height_px == height_px_ &&
                      picture.bgra.data() == kept_pixels_;
    if (!kept) {
        if (picture.width_px != width_px_ || picture.height_px != height_px_)
            picture = Image(width_px_, height_px_);
        kept_pixels_ = picture.bgra.data();
        overlay_.forget_over();
    }
    if (!kept || first.all || second.all) tiles.add_all();
    for (const PixelRect& part : first.parts) tiles.add(part);
    const int shift = half_px_ + divider_px_;
    for (const PixelRect& part : second.parts)
        tiles.add({part.left + shift, part.top, part.right + shift, part.bottom});
    overlay_.find_changes_over(t, tiles);
    const std::vector<PixelRect> parts = tiles.rects();
    compose(parts, picture);
    overlay_.redraw_over(t, picture);
    over_cpu_s_ += thread_cpu_s() - begin;
    return kept ? ChangedParts::only(parts) : ChangedParts{};
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
