#include "cli/film_limits.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <thread>

#include "core/failure.h"
#include "core/readable.h"
#include "media/film_choice.h"

namespace carom {

namespace {

constexpr double kBytesPerPixel = 4;

/// Drawing, 1920x1080, five balls before a fixed camera: 15 ms of one core.
constexpr double kDrawing_ns_per_px = 7.4;
/// Sub filter and fast deflate: 0.125 bytes a pixel of Figure 9 at 1920x1080.
constexpr double kPngBytesPerPixel = 0.15, kPng_ns_per_px = 3;

/// Pictures that the drawing holds: the framebuffer, what is read back, and the one behind it.
constexpr double kDrawnPictures = 3;
/// Of a film, besides what the encoder holds: those that wait for it, and the one in its pixels.
constexpr double kFilmPictures = 4;
/// Of PNGs, for each thread: one that waits, one in work, the one before it.
constexpr double kPngPictures = 3;

constexpr double kMost_s = 30 * 86400.0;

/// A count of bytes for people.
std::string bytes_text(double bytes) {
    constexpr std::array kUnits = {"B", "kB", "MB", "GB", "TB", "PB", "EB"};
    std::size_t unit = 0;
    for (; bytes >= 1000 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000;
    return fmt::format("{:.{}f} {}", bytes, bytes < 10 && unit > 0 ? 1 : 0, kUnits[unit]);
}

std::string time_text(double s) {
    constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
    if (s < 2 * kMinute) return fmt::format("{:.0f} s", std::max(s, 1.0));
    if (s < 2 * kHour) return fmt::format("{:.0f} minutes", s / kMinute);
    if (s < 2 * kDay) return fmt::format("{:.0f} hours", s / kHour);
    return fmt::format("{:.0f} days", s / kDay);
}

double pixels(const Scene& scene) {
    return static_cast<double>(scene.film.width_px) * scene.film.height_px;
}

/// One output's bytes on disk, and how many of them are certain.
struct Size {
    double likely = 0, certain = 0;
};

Size size_of(const OutputRequest& output, const Scene& scene, const EncodingOptions& encoding,
             std::int64_t frames) {
    constexpr double kCertainPart = 0.1;
    const double all_pixels = pixels(scene) * static_cast<double>(frames);
    if (!output.is_film())
        return {kPngBytesPerPixel * all_pixels, kCertainPart * kPngBytesPerPixel * all_pixels};
    const FilmChoice choice = chosen_film(output, scene, encoding);
    const double bytes = film_bytes_per_pixel(choice) * all_pixels;
    return {bytes, choice.codec->cost.bytes_per_px == 0 ? bytes : kCertainPart * bytes};
}

/// The folder of an output, or the nearest one above it that is there.
std::string folder_of(const OutputRequest& output) {
    namespace fs = std::filesystem;
    fs::path folder = output.is_film() ? fs::path(output.path).parent_path()
                                       : fs::path(sequence_folder(output.path));
    std::error_code error;
    while (!folder.empty() && !fs::is_directory(folder, error)) folder = folder.parent_path();
    return folder.empty() ? "." : folder.string();
}

void require_disk(const std::vector<OutputRequest>& outputs, const Scene& scene,
                  const EncodingOptions& encoding, std::int64_t frames) {
    struct Disk {
        double free = 0, certain = 0;
        std::string folder;
    };
    std::map<unsigned long, Disk> disks;
    for (const OutputRequest& output : outputs) {
        if (output.path == "-") continue;
        std::error_code error;
        if (std::filesystem::exists(output.path, error) &&
            !std::filesystem::is_regular_file(output.path, error) &&
            !std::filesystem::is_directory(output.path, error))
            continue;  // a device or a pipe
        const std::string folder = folder_of(output);
        struct statvfs info = {};
        if (::statvfs(folder.c_str(), &info) != 0) continue;  // writing will say why
        Disk& disk = disks[info.f_fsid];
        disk.free = static_cast<double>(info.f_bavail) * static_cast<double>(info.f_frsize);
        disk.folder = folder;
        disk.certain += size_of(output, scene, encoding, frames).certain;
    }
    for (const auto& [id, disk] : disks)
        if (disk.certain > disk.free)
            throw Failure(
                FailureKind::kOutput,
                fmt::format("{} frames of {}x{} take at least {}, and the disk of '{}' has {} "
                            "free: take a smaller --size, fewer frames (--frames, --chunk), or a "
                            "format that compresses more",
                            frames, scene.film.width_px, scene.film.height_px,
                            bytes_text(disk.certain), readable(disk.folder),
                            bytes_text(disk.free)));
}

/// A number that stands alone in a file, such as a control group's limit; infinity where there is
/// none.
double number_in(const char* path) {
    std::ifstream file(path);
    double number = 0;
    return file >> number ? number : std::numeric_limits<double>::infinity();
}

int png_threads(const EncodingOptions& encoding) {
    constexpr int kMost = 8;  // as make_png_sequence() has it
    if (encoding.threads > 0) return encoding.threads;
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMost);
}

}  // namespace

double free_memory_bytes() {
    double least = std::numeric_limits<double>::infinity();
    std::ifstream info("/proc/meminfo");
    for (std::string name, unit; info >> name;) {
        double kilobytes = 0;
        info >> kilobytes;
        std::getline(info, unit);
        if (name == "MemAvailable:") least = kilobytes * 1024;
    }
    const double limit = number_in("/sys/fs/cgroup/memory.max");
    const double used = number_in("/sys/fs/cgroup/memory.current");
    if (limit < 1e18 && used < 1e18) least = std::min(least, std::max(0.0, limit - used));
    rlimit own{};
    if (::getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
        least = std::min(least, static_cast<double>(own.rlim_cur));
    return least < 1e18 ? least : 0;
}

FilmNeeds film_needs(const std::vector<OutputRequest>& outputs, const Scene& scene,
                     const EncodingOptions& encoding, std::int64_t frames) {
    constexpr double kCores = 2;
    FilmNeeds needs;
    needs.frames = frames;
    double pictures = kDrawnPictures, ns_per_px = kDrawing_ns_per_px;
    for (const OutputRequest& output : outputs) {
        if (output.is_film()) {
            const FilmCodec& codec = *chosen_film(output, scene, encoding).codec;
            pictures += kFilmPictures + codec.cost.pictures;
            ns_per_px += codec.cost.ns_per_px;
        } else {
            pictures += kPngPictures * (output.path == "-" ? 1 : png_threads(encoding));
            ns_per_px += kPng_ns_per_px;
        }
        if (output.path != "-") needs.disk_bytes += size_of(output, scene, encoding, frames).likely;
    }
    needs.memory_bytes = pictures * kBytesPerPixel * pixels(scene);
    needs.time_s = 1e-9 * ns_per_px * pixels(scene) * static_cast<double>(frames) / kCores;
    return needs;
}

std::string needs_text(const FilmNeeds& needs) {
    const std::string disk =
        needs.disk_bytes > 0 ? bytes_text(needs.disk_bytes) + " on disk, " : "";
    return fmt::format("about {}{} of memory for pictures, {} on two cores", disk,
                       bytes_text(needs.memory_bytes), time_text(needs.time_s));
}

void require_room(const std::vector<OutputRequest>& outputs, const Scene& scene,
                  const EncodingOptions& encoding, std::int64_t frames) {
    const FilmNeeds needs = film_needs(outputs, scene, encoding, frames);
    const double memory = free_memory_bytes();
    if (memory > 0 && needs.memory_bytes > memory)
        throw Failure(FailureKind::kInput,
                      fmt::format("pictures of {}x{} take about {} of memory here, and {} are "
                                  "free: take a smaller --size, fewer --threads or fewer outputs",
                                  scene.film.width_px, scene.film.height_px,
                                  bytes_text(needs.memory_bytes), bytes_text(memory)));
    if (needs.time_s > kMost_s)
        throw Failure(FailureKind::kInput,
                      fmt::format("{} frames of {}x{} take about {} on two cores; more than {} are "
                                  "not begun: take a part with --frames or --chunk, or a smaller "
                                  "--size",
                                  frames, scene.film.width_px, scene.film.height_px,
                                  time_text(needs.time_s), time_text(kMost_s)));
    require_disk(outputs, scene, encoding, frames);
}

}  // namespace carom
