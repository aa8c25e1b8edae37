#include "render/balls/drawn_balls.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// A ball and the ghost of its name, at the same instant in the same place.
bool agree(const BallInView& ball, const BallInView& ghost, const Scene& first,
           const Scene& second) {
    constexpr double kUnseen = 1e-6;  // radii
    return ball.instant == ghost.instant && ball.radius == ghost.radius &&
           (ball.center - ghost.center).norm() < kUnseen * ball.radius &&
           first.balls[static_cast<std::size_t>(ball.index)].name ==
               second.balls[static_cast<std::size_t>(ghost.index)].name;
}

/// Where both runs agree, only the solid ball stays.
void leave_out_equal_ghosts(DrawnBalls& bodies, const Scene& scene, const Scene& second) {
    std::erase_if(bodies.ghosts, [&](const BallInView& ghost) {
        return std::any_of(bodies.balls.begin(), bodies.balls.end(), [&](const BallInView& ball) {
            return agree(ball, ghost, scene, second);
        });
    });
}

}  // namespace

DrawnBalls drawn_balls_at(const std::vector<double>& instants, const Scene& scene,
                          const Motion& motion, const SecondRun* second, const View& view) {
    DrawnBalls bodies{balls_at(instants, scene, motion, view), {}};
    if (second == nullptr) return bodies;
    bodies.ghosts = balls_at(instants, second->scene, second->motion, view);
    leave_out_equal_ghosts(bodies, scene, second->scene);
    return bodies;
}

DrawnBalls drawn_balls_during(const OpenTime& open, const Scene& scene, const Motion& motion,
                              const SecondRun* second, const View& view) {
    DrawnBalls bodies{balls_during(open, scene, motion, view), {}};
    if (second == nullptr) return bodies;
    bodies.ghosts = balls_during(open, second->scene, second->motion, view);
    leave_out_equal_ghosts(bodies, scene, second->scene);
    return bodies;
}

void mark_balls(const std::vector<BallInView>& balls, std::size_t first, const View& view,
                TileOwners& owners) {
    for (const BallInView& ball : balls) {
        const std::size_t body = first + static_cast<std::size_t>(ball.index);
        if (const std::optional<PictureBound> bound = bound_of(ball, view))
            owners.add(body, bound->left, bound->top, bound->right, bound->bottom);
        else
            owners.add_all(body);
    }
}

}  // namespace carom
