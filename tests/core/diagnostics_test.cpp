#include "core/diagnostics.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

Diagnostic at(const std::string& file, int line, int column, const std::string& message) {
    return {Severity::kError, file, {line, column}, message};
}

TEST(Diagnostic, NamesFileLineAndColumn) {
    EXPECT_EQ(at("a.yaml", 3, 7, "no such key").text(), "a.yaml:3:7: error: no such key");
}

TEST(Diagnostic, LeavesOutWhatIsUnknown) {
    EXPECT_EQ(at("a.yaml", 3, 0, "m").text(), "a.yaml:3: error: m");
    EXPECT_EQ(at("--set film.fps", 0, 0, "m").text(), "--set film.fps: error: m");
    EXPECT_EQ(at("a.yaml", 0, 7, "m").text(), "a.yaml: error: m");
}

TEST(Diagnostic, SaysWarningOfAWarning) {
    const Diagnostic warning{Severity::kWarning, "a.yaml", {1, 2}, "odd"};
    EXPECT_EQ(warning.text(), "a.yaml:1:2: warning: odd");
}

TEST(Diagnostics, AWarningIsNoError) {
    Diagnostics list;
    EXPECT_TRUE(list.empty());
    list.add({Severity::kWarning, "a.yaml", {1, 2}, "odd"});
    EXPECT_FALSE(list.empty());
    EXPECT_FALSE(list.has_errors());
    list.add(at("a.yaml", 1, 2, "wrong"));
    EXPECT_TRUE(list.has_errors());
}

TEST(Diagnostics, SortsByFileLineAndColumnAndKeepsTheOrderOfEqualOnes) {
    Diagnostics list;
    list.add(at("b.yaml", 1, 1, "5"));
    list.add(at("a.yaml", 10, 1, "4"));
    list.add(at("a.yaml", 9, 8, "2"));
    list.add(at("a.yaml", 9, 8, "3"));
    list.add(at("a.yaml", 9, 2, "1"));
    list.sort();
    std::string order;
    for (const Diagnostic& item : list.items()) order += item.message;
    EXPECT_EQ(order, "12345");
}

TEST(NearestWord, FindsTheSlipsThatPeopleMake) {
    const std::vector<std::string> keys = {"restitution", "friction", "radius", "mass", "spin"};
    EXPECT_EQ(nearest_word("restitition", keys), "restitution");  // replaced
    EXPECT_EQ(nearest_word("fricton", keys), "friction");         // left out
    EXPECT_EQ(nearest_word("raddius", keys), "radius");           // doubled
    EXPECT_EQ(nearest_word("msas", keys), "mass");                // swapped
    EXPECT_EQ(nearest_word("mass", keys), "mass");
}

TEST(NearestWord, GivesNothingWhenNothingIsNear) {
    const std::vector<std::string> keys = {"restitution", "friction"};
    EXPECT_EQ(nearest_word("colour", keys), "");
    EXPECT_EQ(nearest_word("friction", {}), "");
    // A third of the length: three letters may hide one slip, not two.
    EXPECT_EQ(nearest_word("abc", {"abx"}), "abx");
    EXPECT_EQ(nearest_word("abc", {"ayx"}), "");
    EXPECT_EQ(nearest_word("abcdef", {"abcdxy"}), "abcdxy");
    EXPECT_EQ(nearest_word("abcdef", {"abcxyz"}), "");
}

TEST(NearestWord, TakesTheNearestAndTheFirstOfEqualOnes) {
    EXPECT_EQ(nearest_word("balls", {"walls", "ball"}), "walls");
    EXPECT_EQ(nearest_word("ballss", {"walls", "balls"}), "balls");
}

}  // namespace
}  // namespace carom
