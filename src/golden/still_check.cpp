#include "golden/still_check.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/checksum.h"
#include "core/failure.h"
#include "core/measures_text.h"
#include "golden/ignore_file.h"
#include "media/file_kind.h"
#include "media/png.h"
#include "media/png_text.h"

namespace carom {

namespace {

constexpr std::size_t kPixelBytes = 4;
constexpr const char* kRenderer = "Renderer";  // keyword of the text in a golden

std::string file_bytes(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The part `from` of a picture, written into `to` at the same place.
void copy_rect(const Image& from, const PixelRect& rect, Image& to) {
    for (int y = rect.top; y < rect.bottom; ++y) {
        const std::size_t at = static_cast<std::size_t>(rect.left) * kPixelBytes;
        std::memcpy(to.row(y) + at, from.row(y) + at,
                    static_cast<std::size_t>(rect.width()) * kPixelBytes);
    }
}

Image cut_out(const Image& from, const PixelRect& rect) {
    Image part(rect.width(), rect.height());
    for (int y = 0; y < rect.height(); ++y)
        std::memcpy(part.row(y),
                    from.row(rect.top + y) + static_cast<std::size_t>(rect.left) * kPixelBytes,
                    part.stride_bytes());
    return part;
}

bool is_opaque(const Image& image) {
    for (std::size_t i = kPixelBytes - 1; i < image.bgra.size(); i += kPixelBytes)
        if (image.bgra[i] != 255) return false;
    return true;
}

/// Around all pixels that differ; both pictures have one size.
PixelRect differing_rect(const Image& a, const Image& b) {
    PixelRect rect;
    for (int y = 0; y < a.height_px; ++y) {
        if (std::memcmp(a.row(y), b.row(y), a.stride_bytes()) == 0) continue;
        const auto differs = [&](int x) {
            const std::size_t at = static_cast<std::size_t>(x) * kPixelBytes;
            return std::memcmp(a.row(y) + at, b.row(y) + at, kPixelBytes) != 0;
        };
        int left = 0, right = a.width_px;
        while (!differs(left)) ++left;
        while (!differs(right - 1)) --right;
        rect = rect.joined({left, y, right, y + 1});
    }
    return rect;
}

/// Which limits are missed; empty where none is.
std::string missed_limits(const GoldenLimits& limits, bool same_renderer, const ImageMeasures& m) {
    if (!within(limits.any, m)) return missed_text(limits.any, m);
    if (!limits.same_renderer || !same_renderer || m.largest <= *limits.same_renderer) return "";
    return fmt::format(
        "off by {:.6g}, {:.6g} more than the {} of 255 allowed to the renderer that drew the "
        "golden",
        m.largest, m.largest - *limits.same_renderer, *limits.same_renderer);
}

void compare(const AnyImage& golden, const Image& drawn, const GoldenLimits& limits,
             bool same_renderer, StillCheck& check) {
    const Image flat = flattened(golden);
    check.golden_width_px = flat.width_px;
    check.golden_height_px = flat.height_px;
    const bool one_size = flat.width_px == drawn.width_px && flat.height_px == drawn.height_px;
    if (!one_size) {
        check.measures.same_size = false;
        check.why = fmt::format("sizes differ ({}x{}, drawn {}x{})", flat.width_px, flat.height_px,
                                drawn.width_px, drawn.height_px);
        check.missed = "the sizes differ";
        check.outcome = Outcome::kDifferent;
        return;
    }
    require_inside(check.ignored, flat.width_px, flat.height_px, check.still.name);
    Image masked = drawn;
    for (const PixelRect& rect : check.ignored) copy_rect(flat, rect, masked);
    // A golden of 16 bits is compared in 8 where parts are ignored.
    check.measures = check.ignored.empty() ? measure_difference(golden, drawn)
                                           : measure_difference(flat, masked);
    check.measures.pixels -= covered_pixels(check.ignored, flat.width_px, flat.height_px);
    check.why = measures_text(check.measures);
    check.missed = missed_limits(limits, same_renderer, check.measures);
    if (check.missed.empty()) return;
    check.outcome = Outcome::kDifferent;
    if (!is_opaque(flat) || !is_opaque(drawn)) {
        check.difference_png = encode_png(difference_image(flat, masked), PngEffort::kSmall);
        return;
    }
    check.changed = differing_rect(flat, drawn);
    if (check.changed.empty()) check.changed = PixelRect::at(0, 0, flat.width_px, flat.height_px);
    check.changed_png = encode_png(cut_out(drawn, check.changed), PngEffort::kSmall);
}

}  // namespace

const char* outcome_word(Outcome outcome) {
    switch (outcome) {
        case Outcome::kSame:
            return "same";
        case Outcome::kDifferent:
            return "different";
        case Outcome::kMissing:
            return "missing";
        case Outcome::kUnreadable:
            return "unreadable";
    }
    return "";
}

StillCheck check_still(const DrawnStill& still, const Image& drawn, const GoldenLimits& limits) {
    StillCheck check;
    check.still = still;
    check.width_px = drawn.width_px;
    check.height_px = drawn.height_px;
    check.ignored = ignored_rects(still.folder, still.name);
    if (!std::filesystem::exists(still.golden)) {
        check.outcome = Outcome::kMissing;
        check.why = "there is no golden";
    } else {
        const std::string bytes = file_bytes(still.golden);
        check.golden_checksum = checksum_text(bytes);
        try {
            if (file_content(still.golden).kind == PictureFileKind::kLfsPointer)
                throw Failure(FailureKind::kInput, kLfsAdvice);
            const AnyImage golden = read_any_png(still.golden);
            const bool same_renderer = text_in_png(bytes, kRenderer) == still.renderer;
            compare(golden, drawn, limits, same_renderer, check);
            if (check.outcome != Outcome::kSame) check.golden_png = bytes;
        } catch (const Failure& failure) {
            if (check.golden_width_px > 0) throw;  // what is ignored is wrong, not the picture
            check.outcome = Outcome::kUnreadable;
            check.why = failure.what();
        }
    }
    if (check.outcome != Outcome::kSame)
        check.drawn_png =
            encode_png(drawn, PngEffort::kSmall, {.texts = {{kRenderer, still.renderer}}});
    return check;
}

}  // namespace carom
