#include "render/font.h"

#include <cairo-ft.h>
#include <cairo.h>
#include <fmt/format.h>
#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <filesystem>

#include "core/failure.h"

#ifdef __SANITIZE_ADDRESS__
// fontconfig keeps its configuration until the process ends, behind packed pointers that the leak
// checker cannot follow: FcInit() alone is reported. Objects that it hands out are freed here.
// OSMesa (22.3) keeps the 160 bytes that describe a context's dummy buffer when it destroys the
// context. There is one such hook per program, so both stand here.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig\nleak:libOSMesa\n";
}
#endif

namespace carom {

namespace {

struct DestroyPattern {
    void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
};
using Pattern = std::unique_ptr<FcPattern, DestroyPattern>;

const FcChar8* fc_text(const char* text) { return reinterpret_cast<const FcChar8*>(text); }

[[noreturn]] void font_is_missing(const std::string& family, const std::string& instead) {
    throw Failure(FailureKind::kRun,
                  fmt::format("the overlay's font '{}' is not installed (fontconfig offers {}); "
                              "install Debian's package fonts-inter",
                              family, instead.empty() ? "nothing" : "'" + instead + "'"));
}

/// File and index of a face, and nothing else: settings of the machine must not change pixels.
Pattern face_in(const char* file, int index) {
    Pattern face(FcPatternCreate());
    if (!face) throw Failure(FailureKind::kRun, "fontconfig has no memory for a pattern");
    FcPatternAddString(face.get(), FC_FILE, fc_text(file));
    FcPatternAddInteger(face.get(), FC_INDEX, index);
    return face;
}

Pattern find_face(const std::string& family) {
    // Where the package puts it; fontconfig would read all of its configuration to find the same.
    constexpr const char* kPackaged = "/usr/share/fonts/opentype/inter/Inter-Medium.otf";
    if (family == kOverlayFontFamily && std::filesystem::exists(kPackaged))
        return face_in(kPackaged, 0);

    Pattern wish(FcPatternCreate());
    if (!wish) throw Failure(FailureKind::kRun, "fontconfig has no memory for a pattern");
    FcPatternAddString(wish.get(), FC_FAMILY, fc_text(family.c_str()));
    FcPatternAddInteger(wish.get(), FC_WEIGHT, FC_WEIGHT_MEDIUM);
    FcPatternAddInteger(wish.get(), FC_SLANT, FC_SLANT_ROMAN);
    FcConfigSubstitute(nullptr, wish.get(), FcMatchPattern);
    FcDefaultSubstitute(wish.get());
    FcResult result = FcResultNoMatch;
    const Pattern found(FcFontMatch(nullptr, wish.get(), &result));
    FcChar8* name = nullptr;
    if (!found || FcPatternGetString(found.get(), FC_FAMILY, 0, &name) != FcResultMatch)
        font_is_missing(family, "");
    if (family != reinterpret_cast<const char*>(name))
        font_is_missing(family, reinterpret_cast<const char*>(name));

    FcChar8* file = nullptr;
    int index = 0;
    if (FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch)
        font_is_missing(family, "a face without a file");
    FcPatternGetInteger(found.get(), FC_INDEX, 0, &index);
    return face_in(reinterpret_cast<const char*>(file), index);
}

void require(cairo_status_t status, const std::string& family) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    throw Failure(FailureKind::kRun, fmt::format("cairo could not load the font '{}': {}", family,
                                                 cairo_status_to_string(status)));
}

/// Length of the UTF-8 sequence that starts with this byte.
std::size_t sequence_length(char first) {
    const auto byte = static_cast<unsigned char>(first);
    return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

struct MeasuredGlyph {
    unsigned long index = 0;
    cairo_text_extents_t extents{};
};

MeasuredGlyph measure(cairo_scaled_font_t* font, std::string_view character) {
    cairo_glyph_t* glyphs = nullptr;
    int count = 0;
    const cairo_status_t status = cairo_scaled_font_text_to_glyphs(
        font, 0, 0, character.data(), static_cast<int>(character.size()), &glyphs, &count, nullptr,
        nullptr, nullptr);
    if (status != CAIRO_STATUS_SUCCESS)
        throw Failure(FailureKind::kRun, fmt::format("cairo could not lay out text: {}",
                                                     cairo_status_to_string(status)));
    MeasuredGlyph measured;
    if (count > 0) {
        cairo_scaled_font_glyph_extents(font, glyphs, 1, &measured.extents);
        measured.index = glyphs[0].index;
    }
    cairo_glyph_free(glyphs);
    return measured;
}

}  // namespace

void Font::DestroyFace::operator()(_cairo_font_face* face) const { cairo_font_face_destroy(face); }
void Font::DestroyScaled::operator()(_cairo_scaled_font* font) const {
    cairo_scaled_font_destroy(font);
}

Font::Font(const std::string& family, double size_px) : size_px_(size_px) {
    const Pattern pattern = find_face(family);
    face_.reset(cairo_ft_font_face_create_for_pattern(pattern.get()));
    require(cairo_font_face_status(face_.get()), family);

    cairo_matrix_t font_matrix, identity;
    cairo_matrix_init_scale(&font_matrix, size_px, size_px);
    cairo_matrix_init_identity(&identity);
    const std::unique_ptr<cairo_font_options_t, void (*)(cairo_font_options_t*)> options(
        cairo_font_options_create(), cairo_font_options_destroy);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    scaled_.reset(cairo_scaled_font_create(face_.get(), &font_matrix, &identity, options.get()));
    require(cairo_scaled_font_status(scaled_.get()), family);

    for (const char digit : std::string_view("0123456789"))
        digit_width_px_ =
            std::max(digit_width_px_, measure(scaled_.get(), {&digit, 1}).extents.x_advance);
    cap_height_px_ = -measure(scaled_.get(), "H").extents.y_bearing;
}

Font::~Font() = default;
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;

TextRun Font::lay_out(std::string_view utf8) const {
    TextRun run;
    while (!utf8.empty()) {
        const std::size_t length = std::min(sequence_length(utf8[0]), utf8.size());
        const MeasuredGlyph glyph = measure(scaled_.get(), utf8.substr(0, length));
        const double own = glyph.extents.x_advance;
        const bool digit = utf8[0] >= '0' && utf8[0] <= '9';
        const double cell = digit ? digit_width_px_ : own;
        run.glyphs.push_back({glyph.index, run.width_px + 0.5 * (cell - own)});
        run.width_px += cell;
        utf8.remove_prefix(length);
    }
    return run;
}

void Font::draw(Canvas& canvas, const TextRun& run, double x, double y, const Ink& ink,
                double halo_px, const Ink& halo) const {
    std::vector<cairo_glyph_t> glyphs;
    for (const TextRun::Glyph& glyph : run.glyphs)
        glyphs.push_back({glyph.index, x + glyph.x_px, y});
    cairo_t* c = canvas.context();
    cairo_set_scaled_font(c, scaled_.get());
    cairo_new_path(c);
    // Outlines, not cached glyph pictures: those would be moved to whole pixels one by one.
    cairo_glyph_path(c, glyphs.data(), static_cast<int>(glyphs.size()));
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
    // A faint wide stroke below a firmer narrow one fades softly into any background.
    for (const auto& [width, alpha] : {std::pair(2.0, 0.35), std::pair(1.2, 0.70)}) {
        if (halo_px <= 0) break;
        canvas.use({halo.r, halo.g, halo.b, alpha});
        cairo_set_line_width(c, width * halo_px);
        cairo_stroke_preserve(c);
    }
    canvas.use(ink);
    cairo_fill(c);
}

}  // namespace carom
