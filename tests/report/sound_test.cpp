// The sound of a motion, and the bounces that are heard in it again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "core/failure.h"
#include "media/wav.h"
#include "report/bounce_onsets.h"
#include "report/fit.h"
#include "report/impact_sound.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

Scene bouncing(double restitution, const std::string& more = "") {
    const SceneResult read = read_scene(
        "carom: 1\nsimulation: {duration: 4}\n" + more +
            "surfaces: [{name: floor, plane: {}}]\nmaterials: {it: {restitution: " +
            std::to_string(restitution) +
            "}}\nballs: [{name: a, preset: table_tennis, material: it, drop_height: 0.305}]\n",
        "scene.yaml");
    return read.scene.value();
}

std::vector<double> impact_times(const Motion& motion) {
    std::vector<double> times;
    for (const Event& e : motion.events)
        if (e.kind == EventKind::kImpact) times.push_back(e.time);
    return times;
}

double heard_restitution(const SoundSamples& sound) {
    const std::vector<double> at = bounce_onsets(sound);
    Measurements measured;
    for (std::size_t i = 1; i < at.size(); ++i) measured.intervals_s.push_back(at[i] - at[i - 1]);
    return fit_restitution(measured, {}).restitution;
}

TEST(Sound, BeginsWithinASampleOfTheFirstImpact) {
    const Scene scene = bouncing(0.9);
    const Motion motion = simulate(scene).motion;
    const SoundSamples sound = impact_sound(scene, motion);
    std::size_t first = 0;
    while (sound.samples[first] == 0) ++first;
    const double off = static_cast<double>(first) - impact_times(motion)[0] * sound.rate;
    EXPECT_GE(off, 0);
    EXPECT_LT(off, 1);
    EXPECT_NEAR(sound.samples[first], 0.8, 1e-2);
}

/// Slow motion makes impacts later, not lower.
TEST(Sound, FollowsTheFilmsClock) {
    Scene scene = bouncing(0.9);
    const Motion motion = simulate(scene).motion;
    scene.film.start = 0.2;
    scene.film.speed = 0.5;
    const SoundSamples sound = impact_sound(scene, motion);
    std::size_t first = 0;
    while (sound.samples[first] == 0) ++first;
    const double at = (impact_times(motion)[0] - 0.2) / 0.5;
    EXPECT_NEAR(static_cast<double>(first) / sound.rate, at, 1 / sound.rate);
}

TEST(Sound, BouncesAreHeardAgain) {
    for (const double e : {0.6, 0.75, 0.9}) {
        const Scene scene = bouncing(e);
        const Motion motion = simulate(scene).motion;
        const std::vector<double> heard = bounce_onsets(impact_sound(scene, motion));
        const std::vector<double> exact = impact_times(motion);
        ASSERT_GE(heard.size(), 5u);
        double off = 0;
        for (std::size_t i = 1; i < std::min<std::size_t>(heard.size(), 6); ++i)
            off = std::max(off, std::abs((heard[i] - heard[0]) - (exact[i] - exact[0])));
        const double found = heard_restitution(impact_sound(scene, motion));
        std::printf("e = %g: %zu of %zu heard, off by %.2g s, fit %.8f\n", e, heard.size(),
                    exact.size(), off, found);
        EXPECT_LT(off, 1e-5);
        EXPECT_NEAR(found, e, 1e-5);
    }
}

/// A recording as people make them: hum, hiss, a voice before the drop, an echo from a wall.
TEST(Sound, BouncesAreHeardInARecording) {
    const Scene scene = bouncing(0.8);
    const SoundSamples dry = impact_sound(scene, simulate(scene).motion);
    SoundSamples wet = dry;
    const std::size_t voice = 48'000;
    wet.samples.insert(wet.samples.begin(), voice, 0.0F);
    const std::size_t echo = 1500;  // 31 ms
    for (std::size_t i = wet.samples.size(); i-- > echo;)
        wet.samples[i] += 0.2F * wet.samples[i - echo];
    std::mt19937 random(7);
    std::normal_distribution<float> hiss(0, 0.003F);
    for (std::size_t i = 0; i < wet.samples.size(); ++i) {
        const double t = static_cast<double>(i) / 48'000;
        wet.samples[i] += hiss(random) + 0.02F * static_cast<float>(std::sin(314.16 * t));
        if (i > voice - 8000) continue;
        const double syllable = std::max(0.0, std::sin(2 * std::numbers::pi * 3.3 * t));
        for (int harmonic = 1; harmonic < 12; ++harmonic)
            wet.samples[i] += static_cast<float>(
                0.1 * syllable / harmonic * std::sin(2 * std::numbers::pi * 140 * harmonic * t));
    }
    const double found = heard_restitution(wet);
    std::printf("in a room: fit %.6f\n", found);
    EXPECT_NEAR(found, 0.8, 2e-3);
}

TEST(Sound, SilenceIsRefused) {
    SoundSamples silence;
    silence.samples.resize(48'000);
    EXPECT_THROW(bounce_onsets(silence), Failure);
    std::mt19937 random(7);
    std::normal_distribution<float> hiss(0, 0.1F);
    for (float& s : silence.samples) s = hiss(random);
    EXPECT_THROW(bounce_onsets(silence), Failure);
}

class WavFile : public ::testing::Test {
  protected:
    std::string path_ =
        (std::filesystem::temp_directory_path() / ("carom" + std::to_string(getpid()) + ".wav"))
            .string();
    void TearDown() override { std::filesystem::remove(path_); }
    void write(const std::string& bytes) {
        std::ofstream(path_, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
};

TEST_F(WavFile, ReadsWhatItWrites) {
    SoundSamples sound;
    sound.rate = 44'100;
    for (int i = 0; i < 1000; ++i) sound.samples.push_back(std::sin(0.01F * static_cast<float>(i)));
    write_wav(path_, sound, Existing::kReplace);
    const SoundSamples read = read_wav(path_);
    ASSERT_EQ(read.samples.size(), 1000u);
    EXPECT_EQ(read.rate, 44'100);
    for (std::size_t i = 0; i < 1000; ++i)
        EXPECT_NEAR(read.samples[i], sound.samples[i], 1.0 / 32767);
}

TEST_F(WavFile, WhatIsNoWavIsRefused) {
    for (const std::string& bytes :
         {std::string(), std::string("RIFF\0\0\0\0WAVE", 12), std::string(100, 'x'),
          std::string("RIFF\x24\0\0\0WAVEfmt \x10\0\0\0\x06\0\x01\0\x80\xbb\0\0\0\0\0\0\x01\0\x08\0"
                      "data\x04\0\0\0abcd",
                      48)}) {
        write(bytes);
        EXPECT_THROW(read_wav(path_), Failure);
    }
    EXPECT_THROW(read_wav("/nowhere.wav"), Failure);
}

}  // namespace
}  // namespace carom
