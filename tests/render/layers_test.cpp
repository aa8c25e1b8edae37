// Layers against all bodies at every pixel, without lists of tiles and without what is kept from
// frame to frame. (tests/cli/test_layers.py computes them apart from this program's geometry.)
#include <gtest/gtest.h>

#include <cmath>

#include "render/layers/layer_painter.h"
#include "render/layers/pixel_rays.h"
#include "render/painter.h"
#include "render/view/camera_motion.h"

namespace carom {
namespace {

constexpr int kLayersWidth = 123, kLayersHeight = 77;

/// One surface of each kind, and balls that fly among them; one comes close to the eye.
struct LayerSample {
    Scene scene;
    Motion motion;

    LayerSample() {
        scene.camera.emplace();
        scene.camera->from = Vec3(0.4, -4, 1.6);
        scene.camera->to = Vec3(0, 0, 0.5);
        add(PlaneShape{Vec3::UnitZ(), 0});
        add(BoxShape{Vec3(-1, 0.5, 0.3), Vec3(0.5, 0.4, 0.6)});
        add(SphereShape{Vec3(1, 0.3, 0.2), 0.3});
        add(CapsuleShape{Vec3(-1, 1, 1), Vec3(1, 1.5, 1.2), 0.1});
        add(CylinderShape{Vec3(1.4, 0, 0), Vec3(1.3, 0, 1), 0.15});
        add(RingShape{Vec3(0, 0.5, 1.1), Vec3::UnitY(), 0.4, 0.05});
        add(BowlShape{Vec3(0, 0, 0.5), 0.4, Vec3::UnitZ(), 0.3});
        add(PipeShape{Vec3(-1.5, -0.5, 0.4), Vec3(-0.4, -0.6, 0.4), 0.2, Vec3::UnitZ(), 3});
        motion.duration = 1;
        for (int i = 0; i < 6; ++i) {
            Ball ball;
            ball.radius = 0.05 + 0.03 * i;
            scene.balls.push_back(ball);
            Piece piece;
            piece.position = Vec3(-1 + 0.4 * i, -0.5 + 0.2 * i, 0.4 + 0.1 * i);
            piece.velocity = Vec3(0.5 - 0.3 * i, i == 5 ? -3.5 : 0.2, 0.3);
            piece.spin = Vec3(i, 2, -i);
            motion.balls.emplace_back().append(piece);
        }
    }
    void add(const SurfaceShape& shape) { scene.surfaces.emplace_back().shape = shape; }
};

void expect_as_by_brute_force(const LayerSample& sample, const LayerPainter& painter, double t) {
    const Scene& scene = sample.scene;
    std::vector<SurfaceShape> bodies;
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        bodies.emplace_back(
            SphereShape{sample.motion.balls[i].at(t).position, scene.balls[i].radius});
    for (const Surface& surface : scene.surfaces) bodies.push_back(surface.shape);
    for (int y = 0; y < kLayersHeight; ++y)
        for (int x = 0; x < kLayersWidth; ++x) {
            const Ray ray = pixel_ray(painter.view(), x + 0.5, y + 0.5);
            double nearest = HUGE_VAL;
            std::size_t id = 0;
            for (std::size_t i = 0; i < bodies.size(); ++i)
                if (const auto hit = first_hit(bodies[i], ray); hit && hit->distance < nearest) {
                    nearest = hit->distance;
                    id = i + 1;
                }
            const std::size_t at =
                static_cast<std::size_t>(y) * kLayersWidth + static_cast<std::size_t>(x);
            ASSERT_EQ(id, painter.ids()[at]) << x << " " << y << " at " << t;
            ASSERT_EQ(static_cast<float>(nearest), *painter.image(LayerKind::kDistance).at(x, y));
        }
}

void expect_for(const LayerSample& sample) {
    const LayerSettings settings{
        kLayersWidth,
        kLayersHeight,
        {LayerKind::kDistance, LayerKind::kSegmentation, LayerKind::kFlow, LayerKind::kBackflow},
        nullptr};
    LayerPainter painter(sample.scene, sample.motion, settings);
    for (const double t : {0.0, 0.1, 0.5, 0.9}) {
        painter.paint(t, t + 0.05, t - 0.05);
        expect_as_by_brute_force(sample, painter, t);
        LayerPainter alone(sample.scene, sample.motion, settings);
        alone.paint(t, t + 0.05, t - 0.05);
        EXPECT_EQ(alone.image(LayerKind::kFlow).values, painter.image(LayerKind::kFlow).values);
        EXPECT_EQ(alone.image(LayerKind::kBackflow).values,
                  painter.image(LayerKind::kBackflow).values);
    }
}

TEST(Layers, ListsOfTilesMissNothing) { expect_for(LayerSample()); }

TEST(Layers, UnderAMovingCamera) {
    LayerSample sample;
    sample.scene.camera->orbit_deg_per_s = 120;
    expect_for(sample);
}

TEST(Layers, UnderParallelRays) {
    LayerSample sample;
    sample.scene.camera->orthographic_m = 3;
    expect_for(sample);
}

/// In transparent pictures without planes all that is not a body is transparent.
void expect_as_drawn(LayerSample sample) {
    sample.scene.surfaces.erase(sample.scene.surfaces.begin());
    sample.scene.background = Background::kTransparent;
    sample.scene.looks.emplace_back();
    LayerPainter layers(sample.scene, sample.motion,
                        {kLayersWidth, kLayersHeight, {LayerKind::kSegmentation}, nullptr});
    Painter painter(sample.scene, sample.motion, {kLayersWidth, kLayersHeight});
    Image picture;
    for (const double t : {0.0, 0.4}) {
        layers.paint(t, {}, {});
        painter.paint(t, picture);
        int covered = 0, partly = 0;
        for (std::size_t i = 0; i < layers.ids().size(); ++i) {
            const int alpha = picture.bgra[4 * i + 3];
            covered += alpha == 255;
            partly += alpha > 0 && alpha < 255;
            const bool is_body = layers.ids()[i] != 0;
            EXPECT_FALSE(alpha == 255 && !is_body) << i;
            EXPECT_FALSE(alpha == 0 && is_body) << i;
        }
        EXPECT_GT(covered, 1000);
        EXPECT_LT(partly, covered);
    }
}

TEST(Layers, ShowWhatIsDrawn) { expect_as_drawn(LayerSample()); }

TEST(Layers, ShowWhatIsDrawnByParallelRays) {
    LayerSample sample;
    sample.scene.camera->orthographic_m = 3;
    expect_as_drawn(sample);
}

TEST(Layers, ChangedTilesAreAllThatDiffer) {
    const LayerSample sample;
    LayerPainter painter(
        sample.scene, sample.motion,
        {kLayersWidth, kLayersHeight, {LayerKind::kDepth, LayerKind::kFlow}, nullptr});
    painter.paint(0.2, 0.25, {});
    const FloatImage depth = painter.image(LayerKind::kDepth);
    const FloatImage flow = painter.image(LayerKind::kFlow);
    painter.paint(0.25, 0.3, {});
    int changed = 0;
    for (int y = 0; y < kLayersHeight; ++y)
        for (int x = 0; x < kLayersWidth; ++x) {
            const bool same = *depth.at(x, y) == *painter.image(LayerKind::kDepth).at(x, y) &&
                              *flow.at(x, y) == *painter.image(LayerKind::kFlow).at(x, y);
            if (painter.changed(PixelRect::at(x, y, 1, 1)))
                ++changed;
            else
                EXPECT_TRUE(same) << x << " " << y;
        }
    EXPECT_GT(changed, 0);
    EXPECT_LT(changed, kLayersWidth * kLayersHeight);
}

}  // namespace
}  // namespace carom
