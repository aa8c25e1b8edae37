#include "render/side_by_side.h"

#include <algorithm>
#include <cmath>

#include "render/driver_clock.h"
#include "render/font.h"
#include "render/offscreen.h"
#include "render/overlay_against.h"

namespace carom {

namespace {

/// What is said once for both halves.
Scene whole_scene(const Scene& scene) {
    Scene whole = scene;
    Overlay said;
    said.clock = scene.overlay.clock;
    said.title = scene.overlay.title;
    said.caption = scene.overlay.caption;
    said.theme = scene.overlay.theme;
    whole.overlay = said;
    whole.test.reset();
    return whole;
}

std::uint8_t byte_of(double part) { return static_cast<std::uint8_t>(std::lround(255 * part)); }

}  // namespace

int SideBySide::divider_px(int width_px, int height_px) {
    const int wanted = std::max(1, static_cast<int>(std::lround(overlay_px(2, height_px))));
    return wanted + (width_px - wanted) % 2;
}

Scene SideBySide::half_scene(const Scene& scene, bool second) const {
    // Bodies and looks of its own run; everything about the picture from the first.
    constexpr double kCaptionPx = 17;  // at 720
    Scene half = second ? second_.scene : scene;
    half.film = scene.film;
    half.background = scene.background;
    half.overlay = scene.overlay;
    half.overlay.clock.reset();
    half.overlay.caption.clear();
    half.overlay.title = TitleOptions{kCaptionPx};
    half.title = run_caption(second_, second);
    // Beside a clock, paths in full have room only in wide pictures.
    constexpr double kShare = 0.62;  // of the half's width
    const Font font(letters_px(kCaptionPx, height_px_));
    if (font.lay_out(half.title).width_px > kShare * half_px_)
        half.title = run_caption(second_, second, true);
    if (second && half.overlay.plot) {
        std::vector<int>& plotted = half.overlay.plot->balls;
        plotted.clear();
        for (const BallPair& pair : paired_balls(scene, second_.scene)) {
            const std::vector<int>& first = scene.overlay.plot->balls;
            if (std::find(first.begin(), first.end(), static_cast<int>(pair.first)) != first.end())
                plotted.push_back(static_cast<int>(pair.second));
        }
    }
    return half;
}

PicturePart SideBySide::part_of(const Motion& motion) const {
    PicturePart part;
    const double aspect = static_cast<double>(half_px_) / height_px_;
    part.camera = choose_camera(joined_.scene, joined_.motion, aspect);
    part.camera_motion = &motion;
    part.joined = &joined_;
    // Both halves stay clear of what covers either of them, and so are laid out alike.
    for (const OverlayPainter::Rect& rect : overlay_->obstacles()) {
        for (const int x : {rect.x, rect.x - half_px_ - divider_px_}) {
            const int left = std::max(x, 0), right = std::min(x + rect.width, half_px_);
            if (left < right) part.taken.push_back({left, rect.y, right - left, rect.height});
        }
    }
    return part;
}

SideBySide::SideBySide(const Scene& scene, const Motion& motion, const PainterOptions& whole)
    : second_(*whole.against),
      width_px_(whole.width_px),
      height_px_(whole.height_px),
      divider_px_(divider_px(width_px_, height_px_)),
      half_px_((width_px_ - divider_px_) / 2),
      joined_(join_runs(scene, motion, second_)),
      whole_scene_(whole_scene(scene)),
      left_scene_(half_scene(scene, false)),
      right_scene_(half_scene(scene, true)),
      divider_(palette_of(scene.overlay.theme).paper) {
    // The view of the whole is only asked for its size: nothing here stands in the scene.
    const View view(Camera{}, width_px_, height_px_);
    overlay_ = std::make_unique<OverlayPainter>(whole_scene_, motion, view,
                                                OverlayPainter::Runs{&second_, nullptr, false, {}});
    part_ = part_of(motion);
    // One driver for both: the second half finds its programs made.
    const auto contexts = std::make_shared<DrawingContexts>();
    const auto half = [&](const Scene& half_scene, const Motion& half_motion) {
        PainterOptions options = whole;
        options.against = nullptr;
        options.width_px = half_px_;
        options.part = &part_;
        options.contexts = contexts;
        return std::make_unique<Painter>(half_scene, half_motion, options);
    };
    left_ = half(left_scene_, motion);
    right_ = half(right_scene_, second_.motion);
}

void SideBySide::paint(const std::vector<double>& instants, Image& out) {
    left_->paint_strobe(instants, left_picture_);
    right_->paint_strobe(instants, right_picture_);
    const double begin = thread_cpu_s();
    if (out.width_px != width_px_ || out.height_px != height_px_)
        out = Image(width_px_, height_px_);
    const std::uint8_t divider[4] = {byte_of(divider_.b), byte_of(divider_.g), byte_of(divider_.r),
                                     255};
    const auto half_bytes = static_cast<std::ptrdiff_t>(left_picture_.stride_bytes());
    for (int y = 0; y < height_px_; ++y) {
        std::uint8_t* to = std::copy_n(left_picture_.row(y), half_bytes, out.row(y));
        for (int x = 0; x < divider_px_; ++x) to = std::copy_n(divider, 4, to);
        std::copy_n(right_picture_.row(y), half_bytes, to);
    }
    overlay_->draw_over(instants.back(), out);
    over_cpu_s_ += thread_cpu_s() - begin;
}

std::map<std::string, Painter::DrawnEffect> SideBySide::effects() const {
    std::map<std::string, Painter::DrawnEffect> effects = left_->effects();
    for (const auto& [name, effect] : right_->effects())
        if (effect.on) effects[name] = effect;
    const auto set = [&](const char* name, bool on) {
        effects[name] = {on, on ? "the scene asks for it" : "not asked for"};
    };
    set("clock", whole_scene_.overlay.clock.has_value());
    set("title", whole_scene_.overlay.title.has_value());
    set("caption", !whole_scene_.overlay.caption.empty());
    // The halves say what has no room in them.
    for (const std::string& name : overlay_->left_out())
        effects[name] = {false, "the picture has no room for it"};
    effects["against"] = {true, "two runs side by side"};
    return effects;
}

double SideBySide::draw_cpu_s() const {
    return left_->draw_cpu_s() + right_->draw_cpu_s() + over_cpu_s_;
}

}  // namespace carom
