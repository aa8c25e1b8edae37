#include "random_air.h"

#include <memory>

#include "draw.h"
#include "random_mixture.h"

namespace carom::bench {

namespace {

Drag random_drag(Draw& draw) {
    switch (draw.integer(0, 3)) {
        case 0:
            return {};
        case 1:
            return {Drag::Over::kNothing, 0, nullptr};
        case 2:  // a drag crisis
            return {Drag::Over::kSpeed, 0,
                    std::make_shared<const MonotoneCurve>(std::vector<double>{0, 3, 4, 9},
                                                          std::vector<double>{0.5, 0.5, 0.1, 0.2})};
        default:
            return {Drag::Over::kNothing, draw.uniform(0.05, 2), nullptr};
    }
}

Lift random_lift(Draw& draw) {
    switch (draw.integer(0, 4)) {
        case 0:
            return {Lift::Over::kSpinRatio, 0, nullptr};
        case 1:
            return {Lift::Over::kTennis, 0, nullptr};
        case 2:
            return {Lift::Over::kTable, 0,
                    std::make_shared<const MonotoneCurve>(std::vector<double>{0, 0.5, 2},
                                                          std::vector<double>{0, 0.3, -0.2})};
        case 3:
            return {Lift::Over::kNothing, draw.uniform(0, 0.4), nullptr};
        default:
            return {};
    }
}

}  // namespace

Scene random_air(std::uint64_t seed) {
    Scene scene = random_mixture(seed);
    Draw draw(seed ^ 0xA17);
    scene.air = Air{};
    scene.air->density = draw.log_uniform(0.1, 30);
    scene.air->buoyancy = draw.chance(0.5);
    for (Ball& ball : scene.balls) {
        ball.flight.drag = random_drag(draw);
        ball.flight.lift = random_lift(draw);
        if (draw.chance(0.3)) ball.flight.spin_decay_s = draw.log_uniform(0.05, 30);
    }
    return scene;
}

}  // namespace carom::bench
