// MOTION.csv and EVENTS.csv: columns, rows, numbers that read back.
#include "motion/csv.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace carom {
namespace {

Motion two_balls(double duration) {
    Motion motion;
    motion.duration = duration;
    motion.ball_names = {"b", "a"};
    motion.surface_names = {"floor"};
    motion.balls.resize(2);
    Piece p;
    p.position = Vec3(0.1, -0.0, 1e-7);
    p.velocity = Vec3(1, 0, 0);
    motion.balls[0].append(p);
    motion.balls[1].append(p);
    return motion;
}

std::vector<std::vector<std::string>> table(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream fields(line + ",");
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

std::vector<std::vector<std::string>> motion_table(const Motion& motion, int numerator,
                                                   int denominator) {
    std::string text;
    write_motion_csv(motion, numerator, denominator, [&](std::string_view s) { text += s; });
    EXPECT_EQ(text.back(), '\n');
    return table(text);
}

TEST(MotionCsv, HasTheColumnsAndTheRowsOfTheContract) {
    const auto rows = motion_table(two_balls(0.25), 10, 1);
    const std::vector<std::string> header = {"time", "ball", "x",  "y",  "z",  "qw", "qx", "qy",
                                             "qz",   "vx",   "vy", "vz", "wx", "wy", "wz"};
    EXPECT_EQ(rows[0], header);
    ASSERT_EQ(rows.size(), 1 + 2 * 4u);  // 0, 0.1, 0.2, and the duration
    const char* times[] = {"0", "0.1", "0.2", "0.25"};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(rows[1 + 2 * i][0], times[i]);
        EXPECT_EQ(rows[1 + 2 * i][1], "b");  // in the scene's order
        EXPECT_EQ(rows[2 + 2 * i][1], "a");
    }
    const std::vector<std::string> first = {"0", "b", "0.1", "0", "1e-07", "1", "0", "0",
                                            "0", "1", "0",   "0", "0",     "0", "0"};
    EXPECT_EQ(rows[1], first);
}

TEST(MotionCsv, WritesTheDurationOnceWhereItIsARowAnyway) {
    EXPECT_EQ(motion_table(two_balls(0.3), 10, 1).size(), 1 + 2 * 4u);
    // 0.1 + 0.2 is above 0.3, 0.7 * 10 below 7: both are whole numbers of rows.
    const auto above = motion_table(two_balls(0.1 + 0.2), 10, 1);
    ASSERT_EQ(above.size(), 1 + 2 * 4u);
    EXPECT_EQ(above.back()[0], "0.30000000000000004");
    EXPECT_EQ(motion_table(two_balls(0.7), 10, 1).size(), 1 + 2 * 8u);
    EXPECT_EQ(motion_table(two_balls(0), 10, 1).size(), 1 + 2u);
    EXPECT_EQ(motion_table(two_balls(0.01), 10, 1).size(), 1 + 4u);
}

TEST(MotionCsv, KeepsFractionsOfRates) {
    const auto rows = motion_table(two_balls(1.001), 30000, 1001);
    ASSERT_EQ(rows.size(), 1 + 2 * 31u);
    EXPECT_EQ(std::strtod(rows[3][0].c_str(), nullptr), 1001.0 / 30000.0);
    EXPECT_EQ(rows.back()[0], "1.001");
}

TEST(MotionCsv, NumbersReadBackExactly) {
    Motion motion = two_balls(1.0 / 3);
    const auto rows = motion_table(motion, 7, 1);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double t = std::strtod(rows[i][0].c_str(), nullptr);
        EXPECT_EQ(std::strtod(rows[i][2].c_str(), nullptr), motion.balls[0].at(t).position.x());
    }
}

TEST(MotionCsv, LongTextsComeInPieces) {
    std::size_t calls = 0, bytes = 0;
    write_motion_csv(two_balls(100), 100, 1, [&](std::string_view s) {
        ++calls;
        bytes += s.size();
        EXPECT_LT(s.size(), 100000u);
    });
    EXPECT_GT(calls, 5u);
    EXPECT_GT(bytes, 20000u * 30);
}

TEST(EventsCsv, HasTheColumnsAndLeavesUnusedFieldsEmpty) {
    Motion motion = two_balls(1);
    Event impact;
    impact.time = 0.5;
    impact.ball = 0;
    impact.other = {false, 1};
    impact.point = Vec3(1, 2, -0.0);
    impact.approach_speed = 3;
    impact.separation_speed = 2.4;
    impact.restitution = 0.8;
    impact.impulse = 5.4;
    Event rest;
    rest.time = 0.75;
    rest.ball = 1;
    rest.other = {true, 0};
    rest.kind = EventKind::kRest;
    motion.events = {impact, rest};
    std::string text;
    write_events_csv(motion, [&](std::string_view s) { text += s; });
    EXPECT_EQ(text,
              "time,ball,other,kind,x,y,z,nx,ny,nz,approach_speed,separation_speed,restitution,"
              "impulse,tangential_impulse\n"
              "0.5,b,a,impact,1,2,0,0,0,1,3,2.4,0.8,5.4,0\n"
              "0.75,a,floor,rest,0,0,0,0,0,1,,,,,\n");
    for (const auto& row : table(text)) EXPECT_EQ(row.size(), 15u);
}

}  // namespace
}  // namespace carom
