#include "core/readable.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Readable, LeavesPlainTextAndOtherScriptsAsTheyAre) {
    for (const char* text : {"", "a b.yaml", "Größe µ 球 😀", "back\\slash"})
        EXPECT_EQ(text, readable(text));
}

TEST(Readable, EscapesWhatATerminalWouldObey) {
    EXPECT_EQ("a\\x1b[31mred", readable("a\x1b[31mred"));
    EXPECT_EQ("one\\ntwo\\r\\t", readable("one\ntwo\r\t"));
    EXPECT_EQ("\\x00\\x7f", readable(std::string_view("\0\x7f", 2)));
    EXPECT_EQ("\\u009b31m", readable("\xC2\x9B"
                                     "31m"));              // C1's CSI
    EXPECT_EQ("txt\\u202egpj", readable("txt\u202egpj"));  // turned around
    EXPECT_EQ("a\\u2028b", readable("a\u2028b"));
}

TEST(Readable, BytesThatAreNoUtf8ArePrintedAsNumbers) {
    EXPECT_EQ("\\xff\\xfe", readable("\xFF\xFE"));
    EXPECT_EQ("\\xc3", readable("\xC3"));                    // cut off
    EXPECT_EQ("\\xc0\\xaf", readable("\xC0\xAF"));           // overlong
    EXPECT_EQ("\\xed\\xa0\\x80", readable("\xED\xA0\x80"));  // a surrogate
}

TEST(Readable, LongTextsLoseTheirMiddle) {
    const std::string text = std::string(5000, 'a') + ": the reason";
    const std::string shown = readable_message(text);
    EXPECT_LE(shown.size(), 1010U);
    EXPECT_TRUE(shown.ends_with(": the reason"));
    // Never inside a character.
    for (std::size_t longest = 1; longest < 40; ++longest) {
        std::string umlauts;
        for (int i = 0; i < 30; ++i) umlauts += "ä";
        const std::string cut = readable(umlauts, longest);
        for (std::size_t i = 0; i < cut.size(); i += utf8_length(cut, i))
            ASSERT_GT(utf8_length(cut, i), 0U) << longest;
    }
}

}  // namespace
}  // namespace carom
