#include "media/film_part.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(FilmPart, ReadsWhatItHasWritten) {
    const FilmPart part{"carom 1.2.3, scene 0123456789abcdef",
                        5'000'000'000,
                        5'000'000'009,
                        6'000'000'000,
                        30000,
                        1001,
                        "h264 18 veryfast yuv420p, against 1 side"};
    EXPECT_EQ(part.text(),
              "carom 1.2.3, scene 0123456789abcdef, frames 5000000000-5000000009 of 6000000000 at "
              "30000/1001, h264 18 veryfast yuv420p, against 1 side");
    const auto read = read_film_part(part.text());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->origin, part.origin);
    EXPECT_EQ(read->first, part.first);
    EXPECT_EQ(read->last, part.last);
    EXPECT_EQ(read->count, part.count);
    EXPECT_EQ(read->frames(), 10);
    EXPECT_EQ(read->fps_numerator, 30000);
    EXPECT_EQ(read->fps_denominator, 1001);
    EXPECT_EQ(read->settings, part.settings);
}

TEST(FilmPart, OtherCommentsSpeakOfNone) {
    for (const char* text :
         {"", "carom 1.2.3, scene 0123456789abcdef", "carom 1, scene 2, 4 frames of 36",
          "x, frames 3-2 of 9 at 60/1, h264", "x, frames 0-9 of 9 at 60/1, h264",
          "x, frames -1-2 of 9 at 60/1, h264", "x, frames 0-2 of 9 at 0/1, h264",
          "x, frames 0-2 of 9 at 60/0, h264", "x, frames 0-2 of 9 at 60/1", "x, frames 0-2",
          "x, frames a-b of c at d/e, f"})
        EXPECT_FALSE(read_film_part(text)) << text;
}

}  // namespace
}  // namespace carom
