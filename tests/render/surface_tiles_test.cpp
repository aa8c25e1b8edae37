// Lists of bodies for parts of the picture: they leave nothing out that would change a pixel.
#include "render/background/surface_tiles.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <future>
#include <random>
#include <utility>

#include "hand_made_scene.h"
#include "render/background/background_drawing.h"
#include "render/gl/offscreen.h"
#include "render/tile/screen_tiles.h"
#include "render/tile/tile_mask.h"

namespace carom {
namespace {

using testing::HandMadeScene;

constexpr int kSurfaceTilesWidth = 480, kSurfaceTilesHeight = 270;

const Quat kTilted(Eigen::AngleAxisd(0.5, Vec3(0.3, 0.2, 1).normalized()));

/// Low boards and a tilted box in the foreground, as most scenes have them.
HandMadeScene boxes() {
    HandMadeScene scene;
    scene.camera({0, -5, 1.8}, {0, 0, 0.5}, 30);
    scene.surface(PlaneShape{}, scene.look(LookStyle::kChecker, {0.9, 0.9, 0.9}, {0.6, 0.6, 0.6}));
    const int wood = scene.look(LookStyle::kPlain, {0.7, 0.5, 0.3});
    scene.surface(BoxShape{Vec3(0, 0.8, 0.06), Vec3(3.3, 0.05, 0.12), Quat::Identity()}, wood);
    scene.surface(BoxShape{Vec3(-1.6, 0, 0.06), Vec3(0.05, 1.6, 0.12), Quat::Identity()}, wood);
    scene.surface(BoxShape{Vec3(0.9, -0.3, 0.5), Vec3(0.5, 0.3, 0.4), kTilted}, wood);
    scene.surface(BoxShape{Vec3(0.2, 0.1, 1.1), Vec3(0.6, 0.6, 0.02), kTilted}, wood);
    return scene;
}

HandMadeScene round_bodies() {
    HandMadeScene scene = boxes();
    scene.surface(SphereShape{Vec3(-0.4, -0.2, 0.25), 0.25});
    scene.surface(SphereShape{Vec3(-0.7, 0.3, 0.9), 0.1});
    scene.surface(CapsuleShape{Vec3(-0.2, -0.6, 0.1), Vec3(0.7, -0.7, 0.4), 0.08});
    scene.surface(CylinderShape{Vec3(0.9, 0.2, 0), Vec3(0.8, 0.3, 0.5), 0.15});
    scene.surface(RingShape{Vec3(0.2, -0.3, 0.8), Vec3(0.3, -0.5, 0.8).normalized(), 0.3, 0.03});
    scene.surface(BowlShape{Vec3(-1, -0.5, 0.3), 0.3, Vec3(0.2, -0.3, 0.9).normalized(), 0.2});
    scene.surface(PipeShape{Vec3(1.1, -0.6, 0.1), Vec3(1.3, 0.6, 0.3), 0.15,
                            Vec3(0, -0.2, 1.2).normalized(), 3});
    return scene;
}

/// Two walls, one of them seen at a grazing angle, and bodies close to them.
HandMadeScene walls() {
    HandMadeScene scene = round_bodies();
    PlaneShape wall;
    wall.normal = Vec3(0, -1, 0);
    wall.offset_m = -1.2;
    scene.surface(wall);
    wall.normal = Vec3(1, 0, 0);
    wall.offset_m = -1.9;
    scene.surface(wall);
    return scene;
}

HandMadeScene mirrors() {
    HandMadeScene scene = round_bodies();
    scene.scene.looks.push_back(scene.scene.looks[0]);
    scene.scene.looks.back().reflection = 0.8;
    const int mirror = static_cast<int>(scene.scene.looks.size()) - 1;
    scene.scene.surfaces[0].look = scene.scene.surfaces[3].look = mirror;
    return scene;
}

HandMadeScene from_inside() {
    HandMadeScene scene = round_bodies();
    scene.camera({0.1, -0.9, 0.3}, {0, 0.4, 0.3}, 90);
    return scene;
}

HandMadeScene from_the_side() {
    HandMadeScene scene = round_bodies();
    scene.camera({0, -6, 0.6}, {0, 0, 0.6}, 24);
    scene.scene.camera->orthographic_m = 2.6;
    return scene;
}

/// One picture and everything that goes with it.
struct Drawn {
    Image color{kSurfaceTilesWidth, kSurfaceTilesHeight};
    std::vector<std::uint32_t> g_buffer =
        std::vector<std::uint32_t>(std::size_t{4} * kSurfaceTilesWidth * kSurfaceTilesHeight);
};

class Studio {
  public:
    Studio(const HandMadeScene& made, bool transparent)
        : view_(*made.scene.camera, kSurfaceTilesWidth, kSurfaceTilesHeight),
          lights_(choose_lights(view_)),
          table_(make_surface_table(made.scene, view_)),
          kind_{table_.can_occlude(), table_.reflection, transparent},
          picture_(contexts_.main.gl(), kSurfaceTilesWidth, kSurfaceTilesHeight, kind_) {
        scale_.ao_reach_m = 0.24;
        contexts_.main.gl().Disable(GL_DITHER);
        contexts_.main.gl().Enable(GL_FRAMEBUFFER_SRGB);
    }
    SurfaceTiles sorted() const { return sort_into_tiles(table_, view_, lights_, scale_); }
    SurfaceTiles everywhere() const { return all_bodies_everywhere(table_, view_); }

    Drawn draw(const SurfaceTiles& tiles, BackgroundPrograms programs = BackgroundPrograms::kOne,
               const TileMask* detailed = nullptr) {
        BackgroundDrawing drawing(contexts_.main.gl(), kind_, programs);
        drawing.aim(picture_);
        drawing.draw(view_, lights_, table_, scale_, tiles, detailed);
        return read();
    }
    Drawn draw_in_a_thread() {
        std::promise<const BackgroundPicture*> target;
        std::future<double> drawn =
            std::async(std::launch::async, draw_in_second_context, std::ref(contexts_),
                       BackgroundContents{view_, lights_, table_, scale_, kind_},
                       target.get_future(), nullptr);
        target.set_value(&picture_);
        EXPECT_GT(drawn.get(), 0);
        return read();
    }

  private:
    Drawn read() {
        const Gl& gl = contexts_.main.gl();
        Drawn drawn;
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, picture_.color_framebuffer().name());
        gl.ReadPixels(0, 0, kSurfaceTilesWidth, kSurfaceTilesHeight, GL_BGRA, GL_UNSIGNED_BYTE,
                      drawn.color.bgra.data());
        const GlFramebuffer g_buffer = make_framebuffer(gl, "reading", {&picture_.g_buffer()});
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, g_buffer.name());
        gl.ReadPixels(0, 0, kSurfaceTilesWidth, kSurfaceTilesHeight, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, drawn.g_buffer.data());
        gl.check("reading a test's picture");
        return drawn;
    }

    View view_;
    Lights lights_;
    SurfaceTable table_;
    PictureScale scale_;
    BackgroundKind kind_;
    DrawingContexts contexts_;
    BackgroundPicture picture_;
};

struct Case {
    const char* name;
    HandMadeScene scene;
    bool transparent = false;
};

std::vector<Case> cases() {
    return {{"boxes", boxes()},
            {"round bodies", round_bodies()},
            {"walls", walls()},
            {"mirrors", mirrors()},
            {"from inside", from_inside()},
            {"from the side", from_the_side()},
            {"transparent", round_bodies(), true}};
}

float entries_in(const SurfaceTiles& tiles, std::size_t rectangle, std::size_t list) {
    const std::size_t at = SurfaceTiles::kRectangleFloats * rectangle + 4 + 4 * list;
    return tiles.rectangles[at + 3] - tiles.rectangles[at];
}

/// A hollow of many planes, from inside: each is seen somewhere.
HandMadeScene many_planes() {
    HandMadeScene scene;
    scene.camera({0.1, -0.4, 0.2}, {0, 0.5, 0}, 60);
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    for (int i = 0; i < 300; ++i) {
        PlaneShape plane;
        plane.normal = Vec3(any(random), any(random), any(random)).normalized();
        plane.offset_m = -1 - 0.1 * std::abs(any(random));
        scene.surface(plane, scene.look(LookStyle::kPlain, {0.3 + 0.002 * i, 0.6, 0.5}));
    }
    return scene;
}

TEST(SurfaceTiles, PlanesAreListedWhereTheyAreSeen) {
    for (const bool parallel : {false, true}) {
        HandMadeScene made = many_planes();
        if (parallel) made.scene.camera->orthographic_m = 1.5;
        Studio studio(made, false);
        const SurfaceTiles tiles = studio.sorted();
        const Drawn listed = studio.draw(tiles), all = studio.draw(studio.everywhere());
        // Planes that nothing is seen of may be taken for an edge: a pixel is then the mean of its
        // samples instead of their middle.
        int differing = 0, worst = 0;
        for (std::size_t i = 0; i < all.color.bgra.size(); ++i) {
            const int off = std::abs(listed.color.bgra[i] - all.color.bgra[i]);
            differing += off > 0 ? 1 : 0;
            worst = std::max(worst, off);
        }
        double visits = 0;
        for (std::size_t i = 0; i < tiles.rectangles.size(); i += SurfaceTiles::kRectangleFloats) {
            const float* rect = &tiles.rectangles[i];
            visits +=
                double(rect[2] - rect[0]) * double(rect[3] - rect[1]) * double(rect[13] - rect[12]);
        }
        const double each = visits / (double(kSurfaceTilesWidth) * kSurfaceTilesHeight);
        fmt::print("{} values differ, by at most {} of 255; {:.1f} of 300 planes looked at\n",
                   differing, worst, each);
        EXPECT_LE(worst, 2);
        EXPECT_LT(each, 20);
    }
}

TEST(SurfaceTiles, CoverThePictureOnce) {
    for (const Case& made : cases()) {
        const SurfaceTiles tiles = Studio(made.scene, made.transparent).sorted();
        std::vector<int> covered(std::size_t{kSurfaceTilesWidth} * kSurfaceTilesHeight);
        for (std::size_t i = 0; i < tiles.rectangles.size(); i += SurfaceTiles::kRectangleFloats)
            for (float y = tiles.rectangles[i + 1]; y < tiles.rectangles[i + 3]; ++y)
                for (float x = tiles.rectangles[i]; x < tiles.rectangles[i + 2]; ++x)
                    ++covered.at(static_cast<std::size_t>(y) * kSurfaceTilesWidth +
                                 static_cast<std::size_t>(x));
        EXPECT_EQ(std::count(covered.begin(), covered.end(), 1),
                  kSurfaceTilesWidth * kSurfaceTilesHeight)
            << made.name;
    }
}

TEST(SurfaceTiles, GiveThePictureThatAllBodiesEverywhereGive) {
    for (const Case& made : cases()) {
        Studio studio(made.scene, made.transparent);
        const SurfaceTiles tiles = studio.sorted();
        const Drawn listed = studio.draw(tiles), all = studio.draw(studio.everywhere());
        EXPECT_EQ(listed.color.bgra, all.color.bgra) << made.name;
        EXPECT_EQ(listed.g_buffer, all.g_buffer) << made.name;

        // So do programs that leave out what the lists do not have.
        studio.draw(SurfaceTiles{studio.everywhere().rectangles, {0, 0, 0, 0}});  // something else
        const Drawn each = studio.draw(tiles, BackgroundPrograms::kEachSetOfBodies);
        EXPECT_EQ(listed.color.bgra, each.color.bgra) << made.name;
        EXPECT_EQ(listed.g_buffer, each.g_buffer) << made.name;

        // The lists are shorter than that, and they matter.
        const std::size_t count = tiles.rectangles.size() / SurfaceTiles::kRectangleFloats;
        const float bodies = static_cast<float>(made.scene.scene.surfaces.size()) - 1;
        double visits = 0, pixels = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const float* rect = &tiles.rectangles[SurfaceTiles::kRectangleFloats * i];
            const double area = double(rect[2] - rect[0]) * double(rect[3] - rect[1]);
            visits += area * (entries_in(tiles, i, 0) + entries_in(tiles, i, 1)) / (2 * bodies);
            pixels += area;
        }
        fmt::print("{}: {} rectangles, {:.1f} % of the visits\n", made.name, count,
                   100 * visits / pixels);
        EXPECT_LT(visits, 0.7 * pixels) << made.name;
        SurfaceTiles none = studio.everywhere();
        for (std::size_t list : {4, 8}) std::fill_n(none.rectangles.begin() + list, 4, 0.0F);
        EXPECT_NE(studio.draw(none).color.bgra, all.color.bgra) << made.name;
    }
}

// Programs for the plane and the sky alone, with the G-buffer in every other tile: the pixels are
// those of one program for everything, whatever is painted on the plane.
TEST(BackgroundDrawing, PartsOfOnePlaneAreThoseOfTheWholePicture) {
    const auto check = [](const HandMadeScene& scene, bool transparent, const std::string& name) {
        SCOPED_TRACE(name);
        Studio studio(scene, transparent);
        const SurfaceTiles tiles = studio.sorted();
        const Drawn whole = studio.draw(tiles);
        const auto forget = [&] {
            studio.draw(SurfaceTiles{studio.everywhere().rectangles, {0, 0, 0, 0}});
        };
        forget();
        const Drawn parts = studio.draw(tiles, BackgroundPrograms::kEachSetOfBodies);
        EXPECT_EQ(whole.color.bgra, parts.color.bgra);
        EXPECT_EQ(whole.g_buffer, parts.g_buffer);
        forget();
        TileMask detailed(kSurfaceTilesWidth, kSurfaceTilesHeight, ScreenTiles::kTilePx);
        for (int y = 0; y < kSurfaceTilesHeight; y += ScreenTiles::kTilePx)
            for (int x = y % 32; x < kSurfaceTilesWidth; x += 32)
                detailed.add_tile(x / ScreenTiles::kTilePx, y / ScreenTiles::kTilePx);
        const Drawn some = studio.draw(tiles, BackgroundPrograms::kEachSetOfBodies, &detailed);
        EXPECT_EQ(whole.color.bgra, some.color.bgra);
        for (int y = 0; y < kSurfaceTilesHeight; ++y)
            for (int x = 0; x < kSurfaceTilesWidth; ++x) {
                if (!detailed.has_tile(x / ScreenTiles::kTilePx, y / ScreenTiles::kTilePx))
                    continue;
                const std::size_t at = 4 * (static_cast<std::size_t>(y) * kSurfaceTilesWidth +
                                            static_cast<std::size_t>(x));
                ASSERT_TRUE(
                    std::equal(&whole.g_buffer[at], &whole.g_buffer[at] + 4, &some.g_buffer[at]))
                    << x << ", " << y;
            }
    };
    for (const LookStyle style : {LookStyle::kPlain, LookStyle::kChecker, LookStyle::kGrid,
                                  LookStyle::kWood, LookStyle::kCourt}) {
        HandMadeScene scene;
        scene.camera({0.3, -5, 1.2}, {0, 0, 0.9}, 40);  // with the horizon in it
        scene.surface(PlaneShape{}, scene.look(style, {0.8, 0.7, 0.6}, {0.3, 0.4, 0.5}));
        check(scene, false, std::to_string(static_cast<int>(style)));
        check(scene, true, std::to_string(static_cast<int>(style)) + ", transparent");
    }
    HandMadeScene empty;
    empty.camera({0, -5, 1.2}, {0, 0, 0.9}, 40);
    check(empty, false, "sky");
}

TEST(BackgroundDrawing, AThreadOfItsOwnGivesTheSamePicture) {
    Studio studio(round_bodies(), false);
    const Drawn here = studio.draw(studio.sorted());
    studio.draw(SurfaceTiles{studio.everywhere().rectangles, {0, 0, 0, 0}});  // something else
    const Drawn there = studio.draw_in_a_thread();
    EXPECT_EQ(here.color.bgra, there.color.bgra);
    EXPECT_EQ(here.g_buffer, there.g_buffer);
}

TEST(BackgroundDrawing, EndsWhenItsTargetNeverComes) {
    DrawingContexts contexts;
    const Camera camera;
    const View view(camera, 64, 36);
    const Lights lights = choose_lights(view);
    const SurfaceTable table;
    const PictureScale scale;
    std::promise<const BackgroundPicture*> target;
    std::future<double> drawn = std::async(
        std::launch::async, draw_in_second_context, std::ref(contexts),
        BackgroundContents{view, lights, table, scale, {}}, target.get_future(), nullptr);
    target = {};
    EXPECT_THROW(drawn.get(), std::future_error);
}

}  // namespace
}  // namespace carom
