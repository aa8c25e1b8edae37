// Lines of megabytes, with a mark under a place.
#include "core/excerpt.h"

#include <gtest/gtest.h>

#include <string>

namespace carom {
namespace {

std::string times(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

TEST(Excerpt, OfALongLineThePartAroundThePlace) {
    // Whatever the characters before it, each has a column.
    for (const char* character : {"a", "\u00e9", "\u20ac", "\U0001f3b1", "\xff", "\t"}) {
        const std::string before = times(character, 100'000), behind = times("b", 100'000);
        const bool odd = *character == '\xff';
        const std::string shown = *character == '\t' ? " " : odd ? "?" : character;
        EXPECT_EQ(excerpt(before + "word" + behind, {7, 100'001}),
                  "    7 | ..." + times(shown, 60) + "word" + times("b", 36) + "...\n" +
                      "      | " + times(" ", 63) + "^" + times("~", 39) + "\n")
            << character;
    }
}

TEST(Excerpt, BothEndsOfALongLine) {
    const std::string line = "begin" + times(" ", 100'000) + "end";
    EXPECT_EQ(excerpt(line, {1, 1}), "    1 | begin" + times(" ", 95) + "...\n      | ^~~~~\n");
    const std::string at_end = excerpt(line, {1, 100'006});
    EXPECT_EQ(at_end, "    1 | ..." + times(" ", 97) + "end\n      | " + times(" ", 100) + "^~~\n");
    // A place behind the end is the end.
    EXPECT_EQ(excerpt(line, {1, 2'000'000}).substr(0, 110), at_end.substr(0, 110));
}

}  // namespace
}  // namespace carom
