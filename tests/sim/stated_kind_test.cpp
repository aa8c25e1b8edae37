// When a contact is said to slide, roll or rest.
#include "sim/record/stated_kind.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(StatedKind, IsNewsWhenItHasBeenSeenForSoManySteps) {
    StatedKind kind;
    EXPECT_FALSE(kind.persists(EventKind::kSlide, 0.1, 3));
    EXPECT_FALSE(kind.persists(EventKind::kSlide, 0.2, 3));
    EXPECT_TRUE(kind.persists(EventKind::kSlide, 0.3, 3));
    EXPECT_EQ(kind.since(), 0.1);
    EXPECT_TRUE(kind.state(EventKind::kSlide));
    EXPECT_FALSE(kind.persists(EventKind::kSlide, 0.4, 3)) << "what is stated is no news";
}

TEST(StatedKind, CountsAnewAfterAStepOfAnotherKind) {
    StatedKind kind;
    kind.persists(EventKind::kRoll, 0.1, 2);
    EXPECT_FALSE(kind.persists(EventKind::kSlide, 0.2, 2));
    EXPECT_FALSE(kind.persists(EventKind::kRoll, 0.3, 2));
    EXPECT_TRUE(kind.persists(EventKind::kRoll, 0.4, 2));
    EXPECT_EQ(kind.since(), 0.3);
}

TEST(StatedKind, AStepThatDoesNotCountDatesTheKindAllTheSame) {
    StatedKind kind;
    kind.see(EventKind::kRest, 0.1);
    EXPECT_TRUE(kind.wavers());
    EXPECT_TRUE(kind.persists(EventKind::kRest, 0.2, 1));
    EXPECT_EQ(kind.since(), 0.1);
    kind.state(EventKind::kRest);
    EXPECT_FALSE(kind.wavers());
}

TEST(StatedKind, TheFirstKindOfWhatExistsAtTheStartIsNoNews) {
    StatedKind kind;
    kind.begins_at_start();
    EXPECT_FALSE(kind.state(EventKind::kRoll));
    EXPECT_TRUE(kind.is_stated());
    EXPECT_TRUE(kind.state(EventKind::kSlide));
}

TEST(StatedKind, ARestIsNewsOnceAndNotAtTheStart) {
    StatedKind met;
    EXPECT_TRUE(met.state_rest());
    EXPECT_FALSE(met.state_rest());
    StatedKind from_start;
    from_start.begins_at_start();
    EXPECT_FALSE(from_start.state_rest());
    EXPECT_TRUE(from_start.from_start()) << "nothing has been told of it yet";
}

}  // namespace
}  // namespace carom
