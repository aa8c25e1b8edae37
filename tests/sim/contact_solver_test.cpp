// Islands, CFM, friction rows, what is asked of ODE and what it says.
#include "sim/fixed/contact_solver.h"

#include <gtest/gtest.h>

#include "scenes.h"
#include "sim/fixed/contact_finder.h"
#include "sim/solve/contact_joint.h"
#include "sim/solve/ode_messages.h"

namespace carom {
namespace {

using namespace testing;

Contact touch(int ball, int other, bool surface) {
    Contact contact;
    contact.ball = ball;
    contact.other = {surface, other};
    return contact;
}

TEST(Islands, JoinByBallsNotBySurfaces) {
    ContactIslands islands(6);
    // 0 and 1 on one floor, each alone; 2 touches 3, which touches the floor; 4 touches two walls.
    std::vector<Contact> contacts = {touch(0, 0, true), touch(1, 0, true), touch(2, 3, false),
                                     touch(3, 0, true), touch(4, 1, true), touch(4, 2, true)};
    islands.mark_lonely(contacts);
    const bool expected[] = {true, true, false, false, false, false};
    for (std::size_t i = 0; i < contacts.size(); ++i)
        EXPECT_EQ(contacts[i].alone, expected[i]) << i;
    // Nothing is left over from the last step.
    contacts = {touch(2, 3, false), touch(4, 1, true)};
    islands.mark_lonely(contacts);
    EXPECT_TRUE(contacts[0].alone);
    EXPECT_TRUE(contacts[1].alone);
}

TEST(Islands, LongChainIsOne) {
    constexpr int kBalls = 1000;
    ContactIslands islands(kBalls);
    std::vector<Contact> contacts;
    for (int i = kBalls - 2; i >= 0; --i) contacts.push_back(touch(i, i + 1, false));
    islands.mark_lonely(contacts);
    for (const Contact& contact : contacts) EXPECT_FALSE(contact.alone);
}

// CFM 0 for a single contact: not even the last digits of the coefficient leak away. With CFM c an
// impact loses the fraction c m (1 + e) / (dt e): what an island of two contacts shows.
TEST(ContactSolver, CfmIsZeroForLoneContactsOnly) {
    const double mass = 1000, step = 1e-3, e = 0.8;
    Scene scene = scene_of(e, 0, 0, step);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.15}, {0, 0, -1}).mass = mass;
    const auto alone = events_of(run(scene, 0.1).motion, EventKind::kImpact);
    ASSERT_EQ(alone.size(), 1u);
    EXPECT_NEAR(alone[0].separation_speed, e, 1e-15);

    add_plane(scene);  // the same plane again: both contacts share the load
    const auto both = events_of(run(scene, 0.1).motion, EventKind::kImpact);
    ASSERT_EQ(both.size(), 2u);
    const double leak = e - both[0].separation_speed;
    // each row carries half the force m (1 + e) v / dt
    EXPECT_NEAR(leak, kIslandCfm * 0.5 * mass * (1 + e) / step, 1e-8);
    EXPECT_GT(leak, 1e-6);
}

TEST(ContactSolver, FrictionlessContactsLeaveSpinAlone) {
    Scene scene = scene_of(0.8, 0, kGravity, 1e-3);
    add_plane(scene);
    add_ball(scene, {0, 0, 0.3}, {1, 0, 0}).spin = Vec3(1, 2, 3);
    const auto result = run(scene, 2);
    EXPECT_GT(result.report.impacts, 1);
    EXPECT_EQ(result.motion.balls[0].at(2).spin, Vec3(1, 2, 3));
    for (const Event& e : result.motion.events) EXPECT_EQ(e.tangential_impulse, 0);
}

TEST(ContactFinder, SortsContactsAndPointsNormalsToTheFirstBall) {
    Scene scene = scene_of(0.8, 0, kGravity, 1e-3);
    add_plane(scene, {0, 0, 1}, -0.1);
    add_plane(scene, {1, 0, 0}, -0.1);
    add_ball(scene, {0, 0, 0});
    add_ball(scene, {0.15, 0, 0});
    OdeWorld world(scene);
    std::vector<Contact> contacts;
    find_contacts(world, PairTable(scene), contacts);
    ASSERT_EQ(contacts.size(), 4u);
    const Partner others[] = {{true, 0}, {true, 1}, {false, 1}, {true, 0}};
    const int balls[] = {0, 0, 0, 1};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(contacts[i].ball, balls[i]);
        EXPECT_EQ(contacts[i].other, others[i]);
    }
    EXPECT_NEAR(contacts[2].normal.x(), -1, 1e-15);
    EXPECT_NEAR(contacts[2].depth, 0.05, 1e-15);
    EXPECT_NEAR(contacts[2].point.x(), 0.075, 1e-15);  // the middle of the overlap
    EXPECT_NEAR(contacts[0].depth, 0, 1e-15);
    EXPECT_NEAR(contacts[0].point.z(), -0.1, 1e-15);
}

// Each shape stands where the scene puts it: a ball that comes from far along each of many
// directions meets box, sphere and capsule where geometry says.
TEST(ContactFinder, ShapesStandWhereTheSceneSays) {
    const Quat turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    const Vec3 center(1, -2, 3);
    struct Case {
        SurfaceShape shape;
        Vec3 point, normal;  // on the shape's surface
    };
    const CapsuleShape capsule{center - turn * Vec3(0.5, 0, 0), center + turn * Vec3(0.5, 0, 0),
                               0.2};
    for (const Case& c :
         {Case{BoxShape{center, {2, 1, 0.5}, turn}, center + turn * Vec3(1, 0.2, 0.1),
               turn * Vec3::UnitX()},
          Case{BoxShape{center, {2, 1, 0.5}, turn}, center + turn * Vec3(0.7, -0.5, -0.1),
               turn * -Vec3::UnitY()},
          Case{SphereShape{center, 0.6}, center + turn * Vec3(0, 0.6, 0), turn * Vec3::UnitY()},
          Case{capsule, center + turn * Vec3(0.4, 0, 0.2), turn * Vec3::UnitZ()},
          Case{capsule, center + turn * Vec3(-0.7, 0, 0), turn * -Vec3::UnitX()},
          Case{PlaneShape{turn * Vec3::UnitX(), 0.3}, 0.3 * (turn * Vec3::UnitX()),
               turn * Vec3::UnitX()}}) {
        for (double depth : {1e-3, -1e-3}) {
            Scene scene = scene_of(0.8, 0, kGravity, 1e-3);
            Surface surface;
            surface.name = "shape";
            surface.shape = c.shape;
            scene.surfaces.push_back(surface);
            add_ball(scene, c.point + (0.1 - depth) * c.normal);
            OdeWorld world(scene);
            std::vector<Contact> contacts;
            find_contacts(world, PairTable(scene), contacts);
            ASSERT_EQ(contacts.size(), depth > 0 ? 1u : 0u);
            if (depth < 0) continue;
            EXPECT_LT((contacts[0].normal - c.normal).norm(), 1e-12);
            EXPECT_NEAR(contacts[0].depth, depth, 1e-12);
            EXPECT_LT((contacts[0].point - c.point).norm(), 1e-12);
        }
    }
}

TEST(OdeMessages, AreCollectedInTheInnermostScope) {
    start_ode();
    const OdeMessages outer;
    {
        const OdeMessages inner;
        for (int i = 0; i < 6; ++i) dMessage(3, "LCP error %d", i);
        EXPECT_EQ(inner.text(),
                  "LCP error 0 (number 3); LCP error 1 (number 3); LCP error 2 (number 3); "
                  "LCP error 3 (number 3) (and 2 more)");
    }
    EXPECT_TRUE(outer.empty());
    dMessage(0, "plain");
    EXPECT_EQ(outer.text(), "plain");
}

TEST(OdeMessages, ErrorsAreThrown) {
    start_ode();
    EXPECT_THROW(dError(1, "no"), OdeFatal);
    try {
        dDebug(0, "side %s", "left");
        FAIL();
    } catch (const OdeFatal& error) {
        EXPECT_STREQ(error.what(), "side left");
    }
}

}  // namespace
}  // namespace carom
