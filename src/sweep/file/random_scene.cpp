#include "sweep/file/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/nearest.h"
#include "scene/catalogue.h"
#include "scene/fields.h"
#include "scene/overrides.h"
#include "scene/scalar.h"

namespace carom {

namespace {

Node number(double value, const ValueOrigin& origin) {
    Node node;
    node.kind = Node::Kind::kScalar;
    node.source = origin.source;
    node.mark = origin.mark;
    node.text = number_text(value);
    return node;
}

Node vector_node(const Vec3& v, const ValueOrigin& origin) {
    Node node;
    node.kind = Node::Kind::kList;
    node.source = origin.source;
    node.mark = origin.mark;
    for (int i = 0; i < 3; ++i) node.children.push_back(number(v[i], origin));
    return node;
}

double number_drawn(const Sweep& sweep, const Draw& draw, const std::string& what,
                    std::int64_t run) {
    return node_number(draw.at(drawn_number(sweep.seed, what, run)));
}

/// m, of a ball with these values, by its own key or its preset's.
double radius_of(const RandomBalls& group, const std::vector<Node>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (group.each[i].path == "radius") return node_number(values[i]);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (group.each[i].path == "preset")
            if (const Preset* preset = find_preset(values[i].text)) return preset->radius;
    return std::numeric_limits<double>::quiet_NaN();
}

struct Placed {
    Vec3 center;
    double radius;  ///< m
};

/// The balls placed so far, in cells of a grid: a candidate asks those near it only.
class PlacedBalls {
  public:
    explicit PlacedBalls(double cell_m) : cell_m_(cell_m) {}

    void add(const Placed& ball) {
        all_.push_back(ball);
        largest_m_ = std::max(largest_m_, ball.radius);
        cells_[key(cell(ball.center))].push_back(ball);
    }
    bool is_free(const Vec3& center, double reach) const {
        const auto steps = static_cast<std::int64_t>(std::ceil((reach + largest_m_) / cell_m_));
        const auto meets = [&](const Placed& ball) {
            return (ball.center - center).norm() < ball.radius + reach;
        };
        constexpr std::int64_t kMostSteps = 3;  // beyond that there are more cells than balls
        if (steps > kMostSteps) return std::none_of(all_.begin(), all_.end(), meets);
        const Cell middle = cell(center);
        for (std::int64_t i = -steps; i <= steps; ++i)
            for (std::int64_t j = -steps; j <= steps; ++j)
                for (std::int64_t k = -steps; k <= steps; ++k) {
                    const auto found = cells_.find(key({middle.x + i, middle.y + j, middle.z + k}));
                    if (found == cells_.end()) continue;
                    const std::vector<Placed>& here = found->second;
                    if (std::any_of(here.begin(), here.end(), meets)) return false;
                }
        return true;
    }

  private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell(const Vec3& p) const {
        const auto at = [&](double v) {
            return static_cast<std::int64_t>(std::floor(v / cell_m_));
        };
        return {at(p.x()), at(p.y()), at(p.z())};
    }
    /// Cells that share a key share a list: that costs time, no truth.
    static std::uint64_t key(const Cell& c) {
        return static_cast<std::uint64_t>(c.x) * 73856093U ^
               static_cast<std::uint64_t>(c.y) * 19349663U ^
               static_cast<std::uint64_t>(c.z) * 83492791U;
    }

    double cell_m_;
    double largest_m_ = 0;
    std::vector<Placed> all_;
    std::unordered_map<std::uint64_t, std::vector<Placed>> cells_;
};

/// Finds places for one run's balls.
class Placing {
  public:
    Placing(const Sweep& sweep, std::int64_t run, const Scene& scene)
        : sweep_(sweep), run_(run), scene_(scene), placed_(cell_of(sweep)) {
        for (const Ball& ball : scene.balls) placed_.add({ball.position, ball.radius});
    }

    /// Of ball `index` of a group; none where no attempt is free.
    std::optional<Vec3> place(const RandomBalls& group, const std::string& what, std::int64_t index,
                              double radius) {
        const Vec3 low = group.low.array() + radius, high = group.high.array() - radius;
        if ((low.array() > high.array()).any()) return std::nullopt;
        for (std::int64_t attempt = 0; attempt < group.attempts; ++attempt) {
            Vec3 center;
            const std::int64_t first = (index * group.attempts + attempt) * 3;
            for (int i = 0; i < 3; ++i)
                center[i] =
                    std::lerp(low[i], high[i], drawn_number(sweep_.seed, what, run_, first + i));
            if (!is_free(center, radius, group.gap)) continue;
            placed_.add({center, radius});
            return center;
        }
        return std::nullopt;
    }

  private:
    /// Some room for a ball of ordinary size; balls far larger or smaller cost time alone.
    static double cell_of(const Sweep& sweep) {
        double smallest = std::numeric_limits<double>::infinity();
        for (const RandomBalls& group : sweep.balls)
            smallest = std::min(smallest, (group.high - group.low).maxCoeff());
        constexpr double kCellsAlong = 16, kLeast_m = 1e-9;  // numbers of cells are whole
        return std::max(smallest / kCellsAlong, kLeast_m);
    }
    bool is_free(const Vec3& center, double radius, double gap) const {
        if (!placed_.is_free(center, radius + gap)) return false;
        for (const Surface& surface : scene_.surfaces)
            if (nearest_on(surface.shape, center, radius).gap < gap) return false;
        return true;
    }

    const Sweep& sweep_;
    std::int64_t run_;
    const Scene& scene_;
    PlacedBalls placed_;
};

Node& list_of_balls(Node& root, const ValueOrigin& origin) {
    if (Node* balls = root.find("balls"); balls != nullptr && balls->kind == Node::Kind::kList)
        return *balls;
    Node balls;
    balls.kind = Node::Kind::kList;
    balls.source = origin.source;
    balls.mark = balls.key_mark = origin.mark;
    balls.key = "balls";
    root.children.push_back(std::move(balls));
    return root.children.back();
}

std::vector<Node> values_of(const Sweep& sweep, const RandomBalls& group, const std::string& what,
                            std::int64_t run, std::int64_t index) {
    std::vector<Node> values;
    for (const SweepAxis& one : group.each)
        values.push_back(one.draw.at(drawn_number(sweep.seed, what + one.path, run, index)));
    return values;
}

}  // namespace

void add_ball(const Sweep& sweep, const RandomBalls& group, const std::string& name,
              const Vec3& place, const std::vector<Node>& values, Node& root, Report& report) {
    Node ball;
    ball.kind = Node::Kind::kMap;
    ball.source = group.origin.source;
    ball.mark = group.origin.mark;
    Node name_node = number(0, group.origin);
    name_node.text = name;
    name_node.key = "name";
    Node position = vector_node(place, group.origin);
    position.key = "position";
    ball.children = {std::move(name_node), std::move(position)};
    // Alone, so that the cost does not grow with the balls that are there.
    Node alone;
    alone.kind = Node::Kind::kMap;
    list_of_balls(alone, group.origin).children.push_back(std::move(ball));
    for (std::size_t i = 0; i < values.size(); ++i)
        set_value(alone, fmt::format("balls.{}.{}", name, group.each[i].path), values[i],
                  group.each[i].origin, sweep.scene_keys, report);
    list_of_balls(root, group.origin)
        .children.push_back(std::move(alone.children.front().children.front()));
}

void draw_camera(const Sweep& sweep, std::int64_t run, Node& root, Report& report) {
    if (!sweep.camera) return;
    const RandomCamera& camera = *sweep.camera;
    constexpr double kDegree = std::numbers::pi / 180;
    const auto drawn = [&](const Draw& draw, const char* what) {
        return number_drawn(sweep, draw, std::string("random.camera.") + what, run);
    };
    const double distance = drawn(camera.distance, "distance");
    const double azimuth = kDegree * drawn(camera.azimuth_deg, "azimuth_deg");
    const double elevation = kDegree * drawn(camera.elevation_deg, "elevation_deg");
    const Vec3 from =
        camera.to + distance * Vec3(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const auto set = [&](const char* path, Node value) {
        set_value(root, path, std::move(value), camera.origin, sweep.scene_keys, report);
    };
    set("camera.from", vector_node(from, camera.origin));
    set("camera.to", vector_node(camera.to, camera.origin));
    if (camera.fov_deg)
        set("camera.fov_deg", number(drawn(*camera.fov_deg, "fov_deg"), camera.origin));
}

std::string draw_balls(const Sweep& sweep, std::int64_t run, const Scene& scene, Node& root,
                       Report& report) {
    if (sweep.balls.empty()) return "";
    Placing placing(sweep, run, scene);
    for (const RandomBalls& group : sweep.balls) {
        const std::string what = fmt::format("random.balls.{}.", group.name);
        const auto count =
            static_cast<std::int64_t>(number_drawn(sweep, group.count, what + "count", run));
        for (std::int64_t index = 0; index < count; ++index) {
            const std::vector<Node> values = values_of(sweep, group, what, run, index);
            const double radius = radius_of(group, values);
            const std::string name = fmt::format("{}_{}", group.name, index);
            const std::optional<Vec3> place = placing.place(group, what + "place", index, radius);
            if (!place)
                return fmt::format("no place for ball {} of {} ({}, radius {} m) after {} attempts",
                                   index + 1, count, name, number_text(radius), group.attempts);
            add_ball(sweep, group, name, *place, values, root, report);
        }
    }
    return "";
}

}  // namespace carom
