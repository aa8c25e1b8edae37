#include "cli/film_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "cli/array_task.h"
#include "cli/usage.h"

namespace carom {

namespace {

/// What one run draws: 19 days of film at 60 frames a second, and days of work. More is a mistake,
/// or is done in parts.
constexpr std::int64_t kMostDrawn = 100'000'000;
constexpr std::int64_t kMostChunks = 1'000'000'000;

std::int64_t whole_number(std::string_view text, const std::string& option) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 0)
        usage(fmt::format("{}: '{}' is no whole number; right is, for example, {}", option, text,
                          option.starts_with("--chunk") ? "--chunk 1/4" : "0-9,20-40:2,100-"));
    return value;
}

/// One "a", "a-b", "a-" or "a-b:step".
void add_range(std::string_view part, std::int64_t count, const std::string& option,
               std::vector<FrameRange>& ranges) {
    std::int64_t step = 1;
    if (const std::size_t colon = part.find(':'); colon != std::string_view::npos) {
        step = whole_number(part.substr(colon + 1), option);
        if (step < 1) usage(fmt::format("{}: a step must be at least 1", option));
        part = part.substr(0, colon);
    }
    const std::size_t dash = part.find('-');
    const std::int64_t first = whole_number(part.substr(0, dash), option);
    std::int64_t last = first;
    if (dash != std::string_view::npos)
        last = dash + 1 == part.size() ? count - 1 : whole_number(part.substr(dash + 1), option);
    if (first >= count || last >= count)
        usage(fmt::format("{}: the film has frames 0 to {}", option, count - 1));
    if (last < first)
        usage(fmt::format("{}: '{}' runs backwards; {}-{} is right", option, part, last, first));
    ranges.push_back({first, last, step});
}

}  // namespace

FrameRanges parse_frames(const std::string& text, std::int64_t count) {
    std::vector<FrameRange> ranges;
    std::string_view rest = text;
    for (bool more = true; more;) {
        const std::size_t comma = rest.find(',');
        more = comma != std::string_view::npos;
        add_range(rest.substr(0, comma), count, "--frames " + text, ranges);
        if (more) rest = rest.substr(comma + 1);
    }
    return FrameRanges(std::move(ranges));
}

FrameRanges parse_chunk(const std::string& text, std::int64_t count, const std::string& name) {
    const std::string option = name + " " + text;
    std::int64_t i = 0, n = 0;
    if (text == "auto") {
        const ArrayTask task = array_task(option);
        i = task.place;
        n = task.count;
    } else {
        const std::size_t slash = text.find('/');
        if (slash == std::string::npos) usage(option + ": expected I/N, e.g. 1/4, or auto");
        i = whole_number(std::string_view(text).substr(0, slash), option);
        n = whole_number(std::string_view(text).substr(slash + 1), option);
    }
    if (n < 1) usage(fmt::format("{}: there is at least one part: {} 1/1", option, name));
    if (i < 1 || i > n)
        usage(fmt::format("{}: there are the parts 1/{} to {}/{}", option, n, n, n));
    if (n > kMostChunks) usage(fmt::format("{}: at most {} chunks", option, kMostChunks));
    // floor(k F / N) in whole numbers; taken apart so that k F cannot overflow.
    const auto bound = [&](std::int64_t k) { return k * (count / n) + k * (count % n) / n; };
    if (bound(i - 1) == bound(i)) return {};
    return FrameRanges({{bound(i - 1), bound(i) - 1, 1}});
}

void require_drawable(const FrameRanges& frames, const Film& film) {
    if (frames.size() <= kMostDrawn) return;
    constexpr double kDay_s = 86400;
    const double days = static_cast<double>(frames.size()) / film.fps.per_second() / kDay_s;
    usage(
        fmt::format("{:.4g} frames, which are {:.4g} days of film at {:.6g} frames/s; at most "
                    "{:.0e} are drawn at once: shorten simulation.duration, lower film.fps, raise "
                    "film.speed, or take a part with --frames or --chunk",
                    static_cast<double>(frames.size()), days, film.fps.per_second(),
                    static_cast<double>(kMostDrawn)));
}

}  // namespace carom
