#include "render/picture/frame_changes.h"

#include <algorithm>
#include <utility>

#include "render/balls/caster_cells.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

/// A call of the driver for each costs about as much as some thousand pixels.
constexpr std::size_t kMostRects = 48;
/// Beyond this share of the picture all of it is drawn: looking for what stays costs more.
constexpr double kMostShare = 0.7;

/// Whether the casters of two tiles are the same, in the same order.
bool same_casters(const float* tile, const std::vector<int>& casters, const float* other_tile,
                  const std::vector<int>& other_casters) {
    const auto begin = casters.begin() + static_cast<std::ptrdiff_t>(tile[2]);
    const auto other = other_casters.begin() + static_cast<std::ptrdiff_t>(other_tile[2]);
    return tile[3] == other_tile[3] &&
           std::equal(begin, begin + static_cast<std::ptrdiff_t>(tile[3]), other);
}

}  // namespace

bool FrameChanges::Body::operator==(const Body& other) const {
    return there == other.there &&
           (!there || (ball.center == other.ball.center && ball.radius == other.ball.radius &&
                       ball.ball_from_view == other.ball.ball_from_view));
}

FrameChanges::FrameChanges(const View& view, const Lights& lights, std::size_t balls)
    : view_(view),
      to_light_(view_direction(view, lights.to_light)),
      light_tan_(lights.tan_radius),
      balls_(balls),
      tiles_(view.width_px(), view.height_px(), ShadowTiles::kTilePx) {}

FrameChanges::Bodies FrameChanges::gather(const DrawnBalls& bodies,
                                          const std::vector<BallInView>& images) const {
    Bodies all;
    const auto body_of = [&](const BallInView& seen, bool ghost) -> Body& {
        const std::size_t index = number(seen, ghost);
        if (all.size() <= index) all.resize(index + 1);
        return all[index];
    };
    const auto add = [&](const BallInView& seen, bool ghost) {
        Body& body = body_of(seen, ghost);
        body.there = true;
        body.ball = seen;
        if (may_be_seen(seen, view_)) body.parts.push_back(bounds_in_picture(seen, view_));
    };
    for (const BallInView& ball : bodies.balls) add(ball, false);
    for (const BallInView& ghost : bodies.ghosts) add(ghost, true);
    for (const BallInView& image : images)
        body_of(image, false).parts.push_back(bounds_in_picture(image, view_));
    return all;
}

std::vector<bool> FrameChanges::changed_bodies(const DrawnBalls& bodies) const {
    std::vector<bool> changed(std::max(before_.size(), now_.size()), true);
    for (std::size_t i = 0; i < std::min(before_.size(), now_.size()); ++i)
        changed[i] = !(before_[i] == now_[i]);
    // A ball that stays looks different where what shades it has moved.
    const std::vector<bool> moved = changed;
    if (std::find(moved.begin(), moved.end(), true) == moved.end() ||
        std::find(moved.begin(), moved.end(), false) == moved.end())
        return changed;
    for (const std::vector<BallInView>* casters : {&bodies.balls, &balls_before_}) {
        const CasterCells cells(*casters, to_light_);
        for (const BallInView& ball : bodies.balls) {
            const std::size_t index = number(ball, false);
            if (changed[index]) continue;
            for (const int near : cells.near(ball)) {
                const BallInView& other = (*casters)[static_cast<std::size_t>(near)];
                if (!moved[number(other, false)] || !may_shade(other, ball, to_light_, light_tan_))
                    continue;
                changed[index] = true;
                break;
            }
        }
    }
    return changed;
}

void FrameChanges::mark_bodies(const std::vector<bool>& changed) {
    drawn_.assign(changed.size(), false);
    for (std::size_t i = 0; i < changed.size(); ++i) {
        if (!changed[i]) continue;
        drawn_[i] = true;
        for (const Bodies* bodies : {&before_, &now_})
            if (i < bodies->size())
                for (const PixelRect& part : (*bodies)[i].parts) tiles_.add(part);
    }
}

void FrameChanges::mark_shadows(const ShadowTiles& shadows, const std::vector<bool>& changed) {
    const std::vector<float>& now = shadows.tiles();
    const std::vector<int>& casters = shadows.caster_balls();
    const auto mark = [&](const float* tile) {
        tiles_.add_tile(static_cast<int>(tile[0]), static_cast<int>(tile[1]));
    };
    const auto has_changed = [&](const float* tile) {
        const auto first = static_cast<std::size_t>(tile[2]);
        const auto count = static_cast<std::size_t>(tile[3]);
        for (std::size_t k = first; k < first + count; ++k)
            if (changed[static_cast<std::size_t>(casters[k])]) return true;
        return false;
    };
    // Both lists are in the order of rows, then columns.
    const auto is_before = [](const float* a, const float* b) {
        return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
    };
    const float* old = shadows_before_.data();
    const float* const old_end = old + shadows_before_.size();
    for (std::size_t i = 0; i < now.size(); i += 4) {
        const float* tile = &now[i];
        for (; old != old_end && is_before(old, tile); old += 4) mark(old);
        const bool was_there = old != old_end && !is_before(tile, old);
        if (!was_there || has_changed(tile) || !same_casters(tile, casters, old, casters_before_))
            mark(tile);
        if (was_there) old += 4;
    }
    for (; old != old_end; old += 4) mark(old);
}

bool FrameChanges::add_neighbours() {
    bool found = false;
    for (bool again = true; again;) {
        again = false;
        for (std::size_t i = 0; i < now_.size(); ++i) {
            if (drawn_[i] || !now_[i].there) continue;
            const std::vector<PixelRect>& parts = now_[i].parts;
            if (std::none_of(parts.begin(), parts.end(),
                             [&](const PixelRect& part) { return tiles_.touches(part); }))
                continue;
            drawn_[i] = again = found = true;
            for (const PixelRect& part : parts) tiles_.add(part);
        }
    }
    return found;
}

void FrameChanges::add_what_hangs_together() {
    do {
        add_neighbours();
        if (tiles_.share() > kMostShare) tiles_.add_all();
        rects_ = tiles_.rects();
        if (rects_.size() <= kMostRects) break;
        std::vector<PixelRect> bounds;
        for (const TileMask::Part& part : tiles_.parts()) bounds.push_back(part.bounds);
        for (const PixelRect& bound : apart(bounds, kMostRects)) tiles_.add(bound);
        rects_ = tiles_.rects();
    } while (add_neighbours());
    if (tiles_.share() == 1) std::fill(drawn_.begin(), drawn_.end(), true);
}

void FrameChanges::update(DrawnBalls& bodies, const std::vector<BallInView>& images,
                          const ShadowTiles* shadows, const std::vector<PixelRect>& others) {
    now_ = gather(bodies, images);
    tiles_ = TileMask(view_.width_px(), view_.height_px(), ShadowTiles::kTilePx);
    if (known_) {
        const std::vector<bool> changed = changed_bodies(bodies);
        mark_bodies(changed);
        if (shadows != nullptr) mark_shadows(*shadows, changed);
    } else {
        drawn_.assign(now_.size(), true);
        tiles_.add_all();
    }
    for (const PixelRect& rect : others) tiles_.add(rect);
    add_what_hangs_together();
    before_ = std::move(now_);
    balls_before_ = bodies.balls;
    if (shadows != nullptr) {
        shadows_before_ = shadows->tiles();
        casters_before_ = shadows->caster_balls();
    }
    known_ = true;
    for (BallInView& ball : bodies.balls) ball.drawn = drawn_[number(ball, false)];
    for (BallInView& ghost : bodies.ghosts) ghost.drawn = drawn_[number(ghost, true)];
}

}  // namespace carom
