// What the tests of this folder share: a folder that goes away, a picture that moves, noise.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "core/failure.h"
#include "core/image.h"
#include "core/temporary_folder.h"

namespace carom {

/// A test in an empty folder of its own.
class FolderTest : public ::testing::Test {
  protected:
    std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }

    /// Everything in the folder, hidden names too, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            found.push_back(entry.path().filename().string());
        std::sort(found.begin(), found.end());
        return found;
    }

  private:
    const TemporaryFolder own_folder_{FailureKind::kOutput};

  protected:
    const std::filesystem::path folder_ = own_folder_.path();
};

inline std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The text of the Failure that `action` throws; fails when it throws none or of another kind.
template <class Action>
std::string failure_text(FailureKind kind, const Action& action) {
    try {
        action();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.kind(), kind) << failure.what();
        return failure.what();
    }
    ADD_FAILURE() << "no failure";
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// No file of this process may grow beyond `bytes` while this lives: a disk that is full.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) {
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_ = {};
    void (*handler_)(int) = SIG_DFL;
};

inline Image filled_image(int width, int height, std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        image.bgra[i] = b;
        image.bgra[i + 1] = g;
        image.bgra[i + 2] = r;
        image.bgra[i + 3] = 255;
    }
    return image;
}

inline Image noise_image(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (std::size_t i = 0; i < image.bgra.size(); ++i)
        image.bgra[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random());
    return image;
}

/// A picture like those that are filmed: a sky, a checkered floor, a shaded striped ball that flies
/// and turns.
inline Image moving_picture(int width, int height, int frame) {
    Image image(width, height);
    const double t = frame / 60.0;
    const double radius = height * 0.12, cx = width * (0.2 + 0.3 * t);
    const double cy = height * (0.8 - 0.6 * std::abs(std::sin(3 * t)));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool floor = y > height * 3 / 4;
            double shade = floor ? ((x / 16 + y / 8) % 2 == 0 ? 150 : 100) : 220 - y * 0.3;
            double red = shade;
            const double dx = (x - cx) / radius, dy = (y - cy) / radius;
            const double inside = (1 - std::hypot(dx, dy)) * radius;  // px
            if (inside > 0) {
                const double z = std::sqrt(std::max(0.0, 1 - dx * dx - dy * dy));
                const double stripe = std::sin(8 * (std::atan2(dy, dx) + 4 * t)) > 0 ? 1.0 : 0.8;
                const double light = stripe * (0.3 + 0.7 * std::max(0.0, 0.8 * z - 0.5 * dy));
                const double cover = std::min(1.0, inside);
                red = shade * (1 - cover) + cover * 230 * light;
                shade = shade * (1 - cover) + cover * 110 * light;
            }
            std::uint8_t* pixel = image.row(y) + 4 * x;
            pixel[0] = static_cast<std::uint8_t>(shade);
            pixel[1] = static_cast<std::uint8_t>(shade);
            pixel[2] = static_cast<std::uint8_t>(red);
            pixel[3] = 255;
        }
    }
    return image;
}

}  // namespace carom
