#include "render/background/surface_tiles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "render/background/plane_tiles.h"
#include "render/background/surface_bounds.h"
#include "render/background/surface_rectangles.h"
#include "render/tile/screen_tiles.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

/// Samples lie half a pixel from a pixel's middle, edges are sought a pixel from there.
constexpr double kAroundPx = 2.5;
/// As surfaces.glsl: an edge is sought so many pixels around.
constexpr double kEdgeReach = 0.8;
/// Light that grazes a plane by less than this (cosine) draws shadows without end on it.
constexpr double kGrazing = 0.02;
/// Points on a surface are lifted by this part of their depth before light is followed from them
/// (background_fragment.glsl), here with some room.
constexpr double kLift = 2e-4;

/// What is flat and takes shadows: a plane, or a face of a box.
struct Flat {
    Vec3 normal = Vec3::UnitZ();
    double offset = 0;
    bool mirrors = false;
    int body = -1;  ///< whose face it is
    /// That a face is seen in; of a plane, which is seen everywhere, those at its horizon.
    std::vector<std::size_t> tiles;
};

class Sorter {
  public:
    Sorter(const SurfaceTable& table, const View& view, const Lights& lights,
           const PictureScale& scale);
    SurfaceTiles sorted();

  private:
    using Set = SurfaceSet;

    template <class Mark>
    void mark(const std::vector<Vec3>& points, const Mark& at_tile) const {
        for (const ScreenTiles::Span& span : grid_.hull(points, grid_.whole(), kAroundPx))
            for (int column = span.first_column; column <= span.last_column; ++column)
                at_tile(grid_.index(column, span.row));
    }
    void mark_seen(std::size_t body);
    std::vector<std::size_t> horizon(const Vec3& normal) const;
    void add_faces(std::size_t body);
    void mark_shading(std::size_t body, const Flat& flat);
    std::vector<Vec3> shadow(const SurfaceBound& body, const Flat& flat, bool& endless) const;
    std::vector<Vec3> crevice(const SurfaceBound& body, const Flat& flat) const;
    void mark_mirrors();
    void mark_on_round_bodies();
    bool may_shade(const SurfaceBound& caster, const SurfaceBound& receiver) const;
    double edge_reach(const SurfaceBound& body) const;
    double blur(double distance, const Flat& flat) const;

    const SurfaceTable& table_;
    ScreenTiles grid_;
    int width_px_, height_px_;
    Vec3 to_light_;
    double tan_radius_, pixel_, reach_m_;
    bool orthographic_;
    std::vector<Flat> flats_;
    std::vector<SurfaceBound> bodies_;
    std::vector<Set> seen_, shading_;  ///< per tile
    std::vector<int> stamps_;          ///< per tile
    int stamp_ = 0;
    std::optional<PlaneTiles> planes_;  ///< where they are many
};

Sorter::Sorter(const SurfaceTable& table, const View& view, const Lights& lights,
               const PictureScale& scale)
    : table_(table),
      grid_(view),
      width_px_(view.width_px()),
      height_px_(view.height_px()),
      to_light_(view_direction(view, lights.to_light)),
      tan_radius_(lights.tan_radius),
      pixel_(pixel_width(view)),
      reach_m_(scale.ao_reach_m),
      orthographic_(view.orthographic()),
      bodies_(surface_bounds(table)),
      seen_(grid_.count(), Set(bodies_.size())),
      shading_(seen_),
      stamps_(grid_.count()) {
    std::vector<bool> shown(static_cast<std::size_t>(table.planes), true);
    if (table.planes > kFewPlanes) {
        planes_ = sort_planes_into_tiles(table, view, scale);
        shown.assign(shown.size(), false);
        for (const std::vector<int>& seen : planes_->seen)
            for (const int plane : seen) shown[static_cast<std::size_t>(plane)] = true;
    }
    if (bodies_.empty()) return;  // nothing casts a shadow on planes
    for (int i = 0; i < table.planes; ++i) {
        if (!shown[static_cast<std::size_t>(i)]) continue;
        const Eigen::Vector4d plane = table.at(i, 0);
        flats_.push_back({plane.head<3>(), plane.w(), table.at(i, 1).x() > 0, -1, {}});
        if (!orthographic_) flats_.back().tiles = horizon(flats_.back().normal);
    }
}

/// Tiles in which rays meet a plane so flatly that a pixel reaches far along it.
std::vector<std::size_t> Sorter::horizon(const Vec3& normal) const {
    constexpr double kFlat = 10;  // pixels: beyond, a pixel reaches an eighth of the way and less
    std::vector<std::size_t> tiles;
    const Vec2 middle(0.5 * width_px_, 0.5 * height_px_);
    struct Sides {
        bool above, below;
    };
    // Of a row of corners, each of which up to four tiles share.
    const auto sides_along = [&](int row) {
        std::vector<Sides> sides;
        for (int column = 0; column <= grid_.columns(); ++column) {
            const Vec2 across = (ScreenTiles::kTilePx * Vec2(column, row) - middle) * pixel_;
            const Vec3 ray(across.x(), across.y(), 1);
            const double facing = normal.dot(ray), flat = kFlat * pixel_ * ray.norm();
            sides.push_back({facing > -flat, facing < flat});
        }
        return sides;
    };
    std::vector<Sides> upper = sides_along(0);
    for (int row = 0; row < grid_.rows(); ++row) {
        std::vector<Sides> lower = sides_along(row + 1);
        for (int column = 0; column < grid_.columns(); ++column) {
            bool above = false, below = false;
            for (const auto* corners : {&upper, &lower}) {
                for (const int corner : {column, column + 1}) {
                    const Sides& sides = (*corners)[static_cast<std::size_t>(corner)];
                    above = above || sides.above;
                    below = below || sides.below;
                }
            }
            if (above && below) tiles.push_back(grid_.index(column, row));
        }
        upper = std::move(lower);
    }
    return tiles;
}

/// How far around a body its edges are sought, m: a pixel where it is farthest from the eye.
double Sorter::edge_reach(const SurfaceBound& body) const {
    return kEdgeReach * pixel_ * (orthographic_ ? 1.0 : body.center.norm() + body.radius);
}

void Sorter::mark_seen(std::size_t body) {
    mark(bodies_[body].corners(edge_reach(bodies_[body])),
         [&](std::size_t tile) { seen_[tile][body] = true; });
}

/// How far a pixel reaches along the plane at this distance from the eye, m.
double Sorter::blur(double distance, const Flat& flat) const {
    if (orthographic_) return pixel_ * (1 + 1 / std::max(std::abs(flat.normal.z()), 1e-3));
    return pixel_ * distance * (1 + distance / std::max(std::abs(flat.offset), 1e-9));
}

/// Faces of a box that turn towards the eye.
void Sorter::add_faces(std::size_t body) {
    const SurfaceBound& box = bodies_[body];
    for (const Vec3& axis : box.axes) {
        double half = 0;
        for (const Vec3& corner : box.cores) half = std::max(half, axis.dot(corner - box.center));
        for (const double side : {-1.0, 1.0}) {
            Flat face{
                side * axis, side * axis.dot(box.center) + half, false, static_cast<int>(body), {}};
            const double toward = orthographic_ ? -face.normal.z() : -face.offset;
            if (toward <= 0) continue;
            std::vector<Vec3> points;
            for (const Vec3& corner : box.corners(edge_reach(box)))
                if (side * axis.dot(corner - box.center) > 0) points.push_back(corner);
            mark(points, [&](std::size_t tile) { face.tiles.push_back(tile); });
            flats_.push_back(std::move(face));
        }
    }
}

/// Where the body's shadow may fall, as points around it; `endless` if it may be anywhere.
std::vector<Vec3> Sorter::shadow(const SurfaceBound& body, const Flat& flat, bool& endless) const {
    std::vector<Vec3> points;
    const double facing = flat.normal.dot(to_light_);
    if (facing <= 0) return points;
    endless = facing - tan_radius_ < kGrazing;
    for (const Vec3& corner : body.corners(0)) {
        // From a point at height h, the rays of the lamp reach a disc around its shadow at most
        // h tan / (facing (facing - tan)) wide.
        const double height = flat.normal.dot(corner) - flat.offset;
        const Vec3 middle = corner - to_light_ * (height / facing);
        double r = std::abs(height) * tan_radius_ / (facing * (facing - tan_radius_));
        const double distance = middle.norm() + r, blurred = 2 * blur(distance, flat);
        if (!orthographic_ && blurred > 0.25 * distance) endless = true;
        r += blurred + kLift * distance / facing;
        const Vec3 u = flat.normal.unitOrthogonal() * r;
        for (const Vec3& p : octagon_around(middle, u, flat.normal.cross(u))) points.push_back(p);
    }
    return points;
}

/// A crevice is looked for in balls up to reach_m_ wide that touch the flat in the point.
std::vector<Vec3> Sorter::crevice(const SurfaceBound& body, const Flat& flat) const {
    std::vector<Vec3> points;
    const Vec3 u = flat.normal.unitOrthogonal() * reach_m_;
    for (const Vec3& corner : body.corners(0)) {
        const double height = flat.normal.dot(corner) - flat.offset;
        for (const Vec3& p : octagon_around(corner - height * flat.normal, u, flat.normal.cross(u)))
            points.push_back(p);
    }
    return points;
}

void Sorter::mark_shading(std::size_t body, const Flat& flat) {
    const SurfaceBound& caster = bodies_[body];
    if (flat.body == static_cast<int>(body)) return;
    if (flat.body >= 0 && !may_shade(caster, bodies_[static_cast<std::size_t>(flat.body)])) return;
    double lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (const Vec3& corner : caster.corners(0)) {
        const double height = flat.normal.dot(corner) - flat.offset;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    // Of what is under the flat, only softened shadows can reach it.
    const double rounding = 1e-5 * (caster.center.norm() + caster.radius);
    if (caster.box && highest < rounding) return;
    // Marks are only made where the flat is seen.
    const auto shade = [&](std::size_t tile) { shading_[tile][body] = true; };
    const auto shade_face = [&](std::size_t tile) {
        if (stamps_[tile] == stamp_) shade(tile);
    };
    ++stamp_;
    for (const std::size_t tile : flat.tiles) stamps_[tile] = stamp_;
    const auto mark_points = [&](const std::vector<Vec3>& points) {
        flat.body < 0 ? mark(points, shade) : mark(points, shade_face);
    };
    if (lowest < 2 * reach_m_) mark_points(crevice(caster, flat));
    bool endless = false;
    const std::vector<Vec3> points = shadow(caster, flat, endless);
    if (!endless)
        mark_points(points);
    else if (flat.body < 0)
        for (std::size_t tile = 0; tile < shading_.size(); ++tile) shade(tile);
    // Shadows of round bodies are softened by as much as a pixel reaches.
    if ((endless && flat.body >= 0) || !caster.box)
        for (const std::size_t tile : flat.tiles) shade(tile);
}

/// False if the caster takes no light from the receiver's surface, neither the lamp's nor the
/// sky's.
bool Sorter::may_shade(const SurfaceBound& caster, const SurfaceBound& receiver) const {
    const Vec3 rel = caster.center - receiver.center;
    const double reach = caster.radius + receiver.radius;
    if (rel.norm() < reach + 2 * reach_m_) return true;
    // Shadows of round bodies are softened by as much as a pixel reaches, which at the receiver's
    // outline has no bound.
    const double along = rel.dot(to_light_) + receiver.radius;
    if (along < -caster.radius) return false;
    if (!caster.box) return true;
    return (rel - rel.dot(to_light_) * to_light_).norm() <
           1.01 * reach + std::max(0.0, along) * tan_radius_;
}

/// What shades round bodies, wherever they are seen: at their outline a pixel reaches far.
void Sorter::mark_on_round_bodies() {
    for (std::size_t receiver = 0; receiver < bodies_.size(); ++receiver) {
        if (bodies_[receiver].box) continue;
        Set shading(bodies_.size());
        for (std::size_t caster = 0; caster < bodies_.size(); ++caster)
            shading[caster] = caster != receiver ? may_shade(bodies_[caster], bodies_[receiver])
                                                 : bodies_[caster].shades_itself;
        for (std::size_t tile = 0; tile < seen_.size(); ++tile) {
            if (!seen_[tile][receiver]) continue;
            for (std::size_t caster = 0; caster < bodies_.size(); ++caster)
                if (shading[caster]) shading_[tile][caster] = true;
        }
    }
}

/// Where a mirror may show a body, all of them count.
void Sorter::mark_mirrors() {
    const auto all = [&](std::size_t tile) {
        seen_[tile].assign(bodies_.size(), true);
        shading_[tile].assign(bodies_.size(), true);
    };
    for (const SurfaceBound& body : bodies_)
        if (body.mirrors) mark(body.corners(edge_reach(body)), all);
    for (const Flat& flat : flats_) {
        if (!flat.mirrors) continue;
        if (table_.planes > 1)  // the other one is mirrored, with all that shades it
            for (std::size_t tile = 0; tile < seen_.size(); ++tile) all(tile);
        for (const SurfaceBound& body : bodies_) {
            const auto flip = [&](Vec3& p) {
                p -= 2 * (flat.normal.dot(p) - flat.offset) * flat.normal;
            };
            SurfaceBound image = body;
            flip(image.center);
            std::vector<Vec3> corners = body.corners(edge_reach(image));
            for (Vec3& corner : corners) flip(corner);
            mark(corners, all);
        }
    }
}

SurfaceTiles Sorter::sorted() {
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
        mark_seen(body);
        if (bodies_[body].box) add_faces(body);
    }
    for (std::size_t body = 0; body < bodies_.size(); ++body)
        for (const Flat& flat : flats_) mark_shading(body, flat);
    mark_on_round_bodies();
    if (table_.reflection) mark_mirrors();
    return joined_rectangles(table_, grid_, {width_px_, height_px_}, seen_, shading_,
                             planes_ ? &*planes_ : nullptr);
}

}  // namespace

SurfaceTiles sort_into_tiles(const SurfaceTable& table, const View& view, const Lights& lights,
                             const PictureScale& scale) {
    if (table.bodies() == 0 && table.planes <= kFewPlanes)
        return all_bodies_everywhere(table, view);
    return Sorter(table, view, lights, scale).sorted();
}

SurfaceTiles all_bodies_everywhere(const SurfaceTable& table, const View& view) {
    SurfaceTiles tiles;
    const auto f = [](int value) { return static_cast<float>(value); };
    const int boxes = table.boxes, round = boxes + table.spheres, all = table.bodies();
    tiles.rectangles = {0, 0, f(view.width_px()), f(view.height_px())};
    for (int list = 0; list < 2; ++list)
        tiles.rectangles.insert(tiles.rectangles.end(), {0, f(boxes), f(round), f(all)});
    tiles.rectangles.insert(tiles.rectangles.end(),
                            {f(all), f(all + table.planes), f(all), f(all + table.planes)});
    for (int body = 0; body < all; ++body)
        tiles.entries.insert(tiles.entries.end(), {f(table.planes + body), 0, 0, 0});
    for (int plane = 0; plane < table.planes; ++plane)
        tiles.entries.insert(tiles.entries.end(), {f(plane), 0, 0, 0});
    tiles.entries.insert(tiles.entries.end(), 4, 0.0F);
    return tiles;
}

}  // namespace carom
