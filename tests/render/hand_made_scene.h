// Scenes for the tests of the picture: balls that stand where they are told, without a simulation.
#pragma once

#include <cmath>
#include <string>

#include "core/image.h"
#include "motion/motion.h"
#include "render/painter.h"
#include "scene/scene.h"

namespace carom::testing {

struct HandMadeScene {
    Scene scene;
    Motion motion;

    HandMadeScene() {
        scene.looks.push_back({});
        motion.duration = 10;
    }

    int look(LookStyle style, const Color& color, const Color& second = {}) {
        Look result;
        result.style = style;
        result.color = color;
        result.second_color = second;
        scene.looks.push_back(result);
        return static_cast<int>(scene.looks.size()) - 1;
    }

    void ball(const Vec3& position, double radius, int look_index = 0,
              const Vec3& spin = Vec3::Zero(), const Vec3& velocity = Vec3::Zero()) {
        Ball ball;
        ball.name = "ball" + std::to_string(scene.balls.size());
        ball.radius = radius;
        ball.position = position;
        ball.look = look_index;
        scene.balls.push_back(ball);
        Piece piece;
        piece.position = position;
        piece.velocity = velocity;
        piece.spin = spin;
        Trajectory trajectory;
        trajectory.append(piece);
        motion.balls.push_back(trajectory);
        motion.ball_names.push_back(ball.name);
    }

    void surface(const SurfaceShape& shape, int look_index = 0) {
        Surface surface;
        surface.name = "surface" + std::to_string(scene.surfaces.size());
        surface.shape = shape;
        surface.look = look_index;
        motion.surface_names.push_back(surface.name);
        scene.surfaces.push_back(surface);
    }

    void camera(const Vec3& from, const Vec3& to, double fov_deg = 40) {
        Camera camera;
        camera.from = from;
        camera.to = to;
        camera.fov_deg = fov_deg;
        scene.camera = camera;
    }

    Image paint(int width_px, int height_px, double t = 0) const {
        Painter painter(scene, motion, PainterOptions{width_px, height_px});
        Image image;
        painter.paint(t, image);
        return image;
    }
};

inline double linear_of(std::uint8_t encoded) {
    const double e = encoded / 255.0;
    return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}

inline std::uint8_t encoded_of(double linear) {
    const double e =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(e * 255));
}

/// `factor` x `factor` pixels averaged in linear light.
inline Image averaged(const Image& large, int factor) {
    Image small(large.width_px / factor, large.height_px / factor);
    for (int y = 0; y < small.height_px; ++y) {
        for (int x = 0; x < small.width_px; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                double sum = 0;
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i)
                        sum += linear_of(large.row(y * factor + j)[4 * (x * factor + i) + channel]);
                small.row(y)[4 * x + channel] = encoded_of(sum / (factor * factor));
            }
            small.row(y)[4 * x + 3] = 255;
        }
    }
    return small;
}

}  // namespace carom::testing
