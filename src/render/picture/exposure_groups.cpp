#include "render/picture/exposure_groups.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "core/check.h"

namespace carom {

std::vector<ExposureGroup> sort_exposure(const TileOwners& owners,
                                         const std::vector<double>& ways_px, int most) {
    CAROM_CHECK(ways_px.size(), ==, owners.bodies());
    std::vector<double> longest(owners.bodies(), 0.0);  // per body that stands for its group
    for (std::size_t body = 0; body < owners.bodies(); ++body) {
        double& way = longest[owners.group(body)];
        way = std::max(way, ways_px[body]);
    }
    const auto halved = [](int count) { return (count + 1) / 2; };
    std::map<int, ExposureGroup, std::greater<>> by_count;
    for (std::size_t body = 0; body < owners.bodies(); ++body) {
        const int enough = std::min(exposure_count(longest[owners.group(body)]), most);
        if (enough < 2) continue;
        int count = most;
        while (halved(count) >= enough) count = halved(count);
        ExposureGroup& group = by_count[count];
        group.count = count;
        group.bodies.resize(owners.bodies());
        group.bodies[body] = true;
    }
    std::vector<ExposureGroup> groups;
    for (auto& [count, group] : by_count) {
        group.parts = owners.tiles(group.bodies).parts();
        if (!group.parts.empty()) groups.push_back(std::move(group));
    }
    return groups;
}

void draw_only(const ExposureGroup& group, std::size_t balls, DrawnBalls& bodies) {
    for (BallInView& ball : bodies.balls)
        ball.drawn = group.bodies[static_cast<std::size_t>(ball.index)];
    for (BallInView& ghost : bodies.ghosts)
        ghost.drawn = group.bodies[balls + static_cast<std::size_t>(ghost.index)];
}

}  // namespace carom
