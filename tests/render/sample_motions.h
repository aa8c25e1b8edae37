// Scenes with motions in closed form, for the tests of camera and overlay: no simulation is needed.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom::samples {

struct Sample {
    Scene scene;
    Motion motion;
};

/// A camera at rest with a vertical field of view.
inline Camera pinhole(const Vec3& from, const Vec3& to, double fov_deg) {
    Camera camera;
    camera.from = from;
    camera.to = to;
    camera.fov_deg = fov_deg;
    return camera;
}

/// A floor at z = 0 and no ball yet.
inline Sample empty_floor(double duration) {
    Sample sample;
    Surface floor;
    floor.name = "floor";
    floor.shape = PlaneShape{};
    sample.scene.surfaces.push_back(floor);
    sample.scene.looks.emplace_back();
    sample.motion.duration = duration;
    sample.motion.surface_names = {"floor"};
    return sample;
}

/// Adds a ball that moves as `pieces` say.
inline void add_ball(Sample& sample, const std::string& name, double radius,
                     const std::vector<Piece>& pieces, const Color& color = {0.8, 0.3, 0.1}) {
    Ball ball;
    ball.name = name;
    ball.radius = radius;
    ball.position = pieces.front().position;
    ball.velocity = pieces.front().velocity;
    ball.look = static_cast<int>(sample.scene.looks.size());
    Look look;
    look.color = color;
    sample.scene.looks.push_back(look);
    sample.scene.balls.push_back(ball);
    sample.motion.ball_names.push_back(name);
    Trajectory path;
    for (const Piece& piece : pieces) path.append(piece);
    sample.motion.balls.push_back(path);
    sample.motion.peaks.emplace_back();
}

inline void add_impact(Sample& sample, double time, int ball) {
    Event event;
    event.time = time;
    event.ball = ball;
    event.other = {true, 0};
    auto& events = sample.motion.events;
    const auto place = std::upper_bound(events.begin(), events.end(), time,
                                        [](double t, const Event& e) { return t < e.time; });
    events.insert(place, event);
}

/// A ball thrown over the floor that rebounds with e; level speed is kept.
inline void add_bouncing(Sample& sample, const std::string& name, double radius, Vec3 p, Vec3 v,
                         double e, const Color& color = {0.8, 0.3, 0.1}) {
    constexpr double kGravity = 9.81;
    std::vector<Piece> pieces;
    std::vector<double> impacts;
    double t = 0;
    for (int bounce = 0; bounce < 60; ++bounce) {
        Piece piece;
        piece.start = t;
        piece.position = p;
        piece.velocity = v;
        piece.acceleration = Vec3(0, 0, -kGravity);
        pieces.push_back(piece);
        const double height = p.z() - radius;
        const double s = (v.z() + std::sqrt(v.z() * v.z() + 2 * kGravity * height)) / kGravity;
        if (t + s >= sample.motion.duration) break;
        t += s;
        impacts.push_back(t);
        p = Vec3(p.x() + s * v.x(), p.y() + s * v.y(), radius);
        v.z() = -e * (v.z() - kGravity * s);
        if (v.z() < 1e-4) {
            Piece rolling;
            rolling.start = t;
            rolling.position = p;
            rolling.velocity = Vec3(v.x(), v.y(), 0);
            pieces.push_back(rolling);
            break;
        }
    }
    add_ball(sample, name, radius, pieces, color);
    for (const double time : impacts)
        add_impact(sample, time, static_cast<int>(sample.scene.balls.size()) - 1);
}

/// A ball that keeps its velocity.
inline Piece straight(double start, const Vec3& p, const Vec3& v) {
    Piece piece;
    piece.start = start;
    piece.position = p;
    piece.velocity = v;
    return piece;
}

inline Sample drop(double height, double radius, double duration) {
    Sample sample = empty_floor(duration);
    add_bouncing(sample, "ball", radius, Vec3(0, 0, height + radius), Vec3::Zero(), 0.85);
    return sample;
}

/// The five sport balls side by side, drifting slowly towards the middle.
inline Sample five_balls(double spacing = 0.45, double duration = 6) {
    Sample sample = empty_floor(duration);
    const char* names[] = {"basketball", "volleyball", "football", "tennis", "table_tennis"};
    const double radii[] = {0.12, 0.105, 0.11, 0.033, 0.02};
    const double restitutions[] = {0.845, 0.75, 0.76, 0.75, 0.94};
    const Color colors[] = {
        {0.85, 0.42, 0.1}, {0.95, 0.95, 0.9}, {0.95, 0.95, 0.95}, {0.8, 0.9, 0.2}, {1, 1, 1}};
    for (int i = 0; i < 5; ++i)
        add_bouncing(sample, names[i], radii[i],
                     Vec3(spacing * (i - 2), 0.05 * (i % 2), 1.8 + radii[i]),
                     Vec3(0.05 * (2 - i), 0, 0), restitutions[i], colors[i]);
    return sample;
}

/// Two small balls that roll towards each other, stop where they meet, and stay.
inline Sample meeting() {
    Sample sample = empty_floor(4);
    for (const double side : {-1.0, 1.0})
        add_ball(sample, side < 0 ? "rolling_left" : "rolling_right", 0.05,
                 {straight(0, Vec3(side, 0, 0.05), Vec3(-0.38 * side, 0, 0)),
                  straight(2.5, Vec3(0.05 * side, 0, 0.05), Vec3::Zero())});
    add_impact(sample, 2.5, 0);
    return sample;
}

}  // namespace carom::samples
