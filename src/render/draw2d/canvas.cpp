#include "render/draw2d/canvas.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numbers>

#include "core/failure.h"

namespace carom {

// Image stores B, G, R, A; cairo stores native 32-bit words 0xAARRGGBB.
static_assert(std::endian::native == std::endian::little);

namespace {

/// Curves are drawn as lines that are off by no more than this, px: with cairo's own 0.1 its
/// releases differ by up to 10 of 255 at round letters.
constexpr double kFlatness = 1e-3;

void require(cairo_status_t status, const char* attempt) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    throw Failure(FailureKind::kRun,
                  fmt::format("cairo could not {}: {}", attempt, cairo_status_to_string(status)));
}

struct DestroySurface {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

}  // namespace

void Canvas::Destroy::operator()(_cairo* context) const { cairo_destroy(context); }

Canvas::Canvas(Image& image) {
    // The context keeps the surface alive; our own reference ends here.
    const std::unique_ptr<cairo_surface_t, DestroySurface> surface(
        cairo_image_surface_create_for_data(image.bgra.data(), CAIRO_FORMAT_ARGB32, image.width_px,
                                            image.height_px,
                                            static_cast<int>(image.stride_bytes())));
    require(cairo_surface_status(surface.get()), "draw on a picture in memory");
    context_.reset(cairo_create(surface.get()));
    cairo_set_tolerance(context_.get(), kFlatness);
    require(cairo_status(context_.get()), "start a drawing");
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

void Canvas::use(const Ink& ink) {
    cairo_set_source_rgba(context_.get(), ink.r, ink.g, ink.b, ink.a);
}

void Canvas::round_rect(double x, double y, double width, double height, double radius) {
    constexpr double kQuarter = std::numbers::pi / 2;
    cairo_t* c = context_.get();
    const double right = x + width - radius, bottom = y + height - radius;
    cairo_new_sub_path(c);
    cairo_arc(c, right, y + radius, radius, -kQuarter, 0);
    cairo_arc(c, right, bottom, radius, 0, kQuarter);
    cairo_arc(c, x + radius, bottom, radius, kQuarter, 2 * kQuarter);
    cairo_arc(c, x + radius, y + radius, radius, 2 * kQuarter, 3 * kQuarter);
    cairo_close_path(c);
}

void Canvas::finish() {
    require(cairo_status(context_.get()), "draw");
    cairo_surface_flush(cairo_get_target(context_.get()));
}

void lay_over(const Image& source, int x, int y, Image& target) {
    const int first_x = std::max(0, -x), last_x = std::min(source.width_px, target.width_px - x);
    const int first_y = std::max(0, -y), last_y = std::min(source.height_px, target.height_px - y);
    if (first_x >= last_x) return;
    for (int row = first_y; row < last_y; ++row) {
        const std::uint8_t* from = source.row(row) + 4 * static_cast<std::ptrdiff_t>(first_x);
        std::uint8_t* to = target.row(y + row) + 4 * static_cast<std::ptrdiff_t>(x + first_x);
        for (int i = first_x; i < last_x; ++i, from += 4, to += 4) lay_pixel_over(from, to);
    }
}

}  // namespace carom
