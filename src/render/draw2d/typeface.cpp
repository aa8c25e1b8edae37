#include "render/draw2d/typeface.h"

#include <fmt/format.h>
#include <freetype/freetype.h>
#include <freetype/ftoutln.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <string>

#include "core/failure.h"
#include "render/draw2d/embedded_font.h"

namespace carom {

namespace {

using Segment = Glyph::Segment;

void require(FT_Error error, const char* attempt) {
    if (error == 0) return;
    throw Failure(FailureKind::kRun, fmt::format("FreeType could not {} (its error {:#04x})",
                                                 attempt, static_cast<unsigned>(error)));
}

/// Collects what FT_Outline_Decompose tells.
struct Collector {
    std::vector<Segment>& segments;
    double em_per_unit;

    Vec2 em(const FT_Vector* p) const {
        return em_per_unit * Vec2(static_cast<double>(p->x), static_cast<double>(p->y));
    }
    Vec2 pen() const {
        const Segment& last = segments.back();
        return last.points[last.kind == Segment::Kind::kCurve ? 2 : 0];
    }
};

Collector& collector(void* user) { return *static_cast<Collector*>(user); }

int move_to(const FT_Vector* to, void* user) {
    Collector& c = collector(user);
    c.segments.push_back({Segment::Kind::kMove, {c.em(to), Vec2::Zero(), Vec2::Zero()}});
    return 0;
}
int line_to(const FT_Vector* to, void* user) {
    Collector& c = collector(user);
    c.segments.push_back({Segment::Kind::kLine, {c.em(to), Vec2::Zero(), Vec2::Zero()}});
    return 0;
}
/// Bézier's second order, raised to the third.
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
    Collector& c = collector(user);
    const Vec2 a = c.pen(), b = c.em(control), d = c.em(to);
    c.segments.push_back({Segment::Kind::kCurve, {(a + 2 * b) / 3, (d + 2 * b) / 3, d}});
    return 0;
}
int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
    Collector& c = collector(user);
    c.segments.push_back({Segment::Kind::kCurve, {c.em(first), c.em(second), c.em(to)}});
    return 0;
}

/// Those of Unicode's Default_Ignorable_Code_Point that texts bring along: soft hyphen, joiners,
/// marks of direction, variation selectors, byte order mark.
bool is_ignorable(char32_t c) {
    return c == 0xAD || c == 0x34F || (c >= 0x200B && c <= 0x200F) ||
           (c >= 0x202A && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) ||
           (c >= 0xFE00 && c <= 0xFE0F) || c == 0xFEFF || (c >= 0xE0000 && c <= 0xE0FFF);
}

}  // namespace

char32_t take_character(std::string_view& utf8) {
    const auto byte = [&](std::size_t i) {
        return i < utf8.size() ? static_cast<unsigned char>(utf8[i]) : 0u;
    };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    char32_t character = length < 2 ? first : first & (0x7Fu >> length);
    bool well_formed = length > 0;
    for (std::size_t i = 1; i < length; ++i) {
        well_formed = well_formed && (byte(i) & 0xC0u) == 0x80u;
        character = character << 6 | (byte(i) & 0x3Fu);
    }
    const bool too_long =
        (length == 3 && character < 0x800) || (length == 4 && character < 0x10000);
    const bool surrogate = character >= 0xD800 && character < 0xE000;
    if (!well_formed || too_long || surrogate || character > 0x10FFFF) {
        utf8.remove_prefix(1);
        return 0xFFFD;
    }
    utf8.remove_prefix(length);
    return character;
}

class Typeface::Impl {
  public:
    Impl() {
        FT_Library library = nullptr;
        require(FT_Init_FreeType(&library), "start");
        library_.reset(library);
        const auto font = embedded_font();
        FT_Face face = nullptr;
        require(
            FT_New_Memory_Face(library, font.data(), static_cast<FT_Long>(font.size()), 0, &face),
            "read the program's font");
        face_.reset(face);
        em_per_unit_ = 1.0 / face->units_per_EM;
    }

    std::string name() const { return fmt::format("{} {}", face_->family_name, face_->style_name); }

    const Glyph& glyph(char32_t character) {
        const std::lock_guard lock(mutex_);
        const auto [known, is_new] = glyphs_.try_emplace(character);
        if (is_new) read(character, known->second);
        return known->second;
    }

  private:
    void read(char32_t character, Glyph& glyph) {
        const FT_UInt index = FT_Get_Char_Index(face_.get(), character);  // 0: the box
        if (index == 0 && is_ignorable(character)) return;
        require(FT_Load_Glyph(face_.get(), index, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP),
                "load a glyph");
        const FT_GlyphSlot slot = face_->glyph;
        glyph.advance_em = em_per_unit_ * static_cast<double>(slot->metrics.horiAdvance);
        FT_Outline_Funcs functions{};
        functions.move_to = move_to;
        functions.line_to = line_to;
        functions.conic_to = conic_to;
        functions.cubic_to = cubic_to;
        Collector into{glyph.segments, em_per_unit_};
        require(FT_Outline_Decompose(&slot->outline, &functions, &into), "follow an outline");
    }

    struct Destroy {
        void operator()(FT_Library library) const { FT_Done_FreeType(library); }
        void operator()(FT_Face face) const { FT_Done_Face(face); }
    };
    std::unique_ptr<FT_LibraryRec_, Destroy> library_;
    std::unique_ptr<FT_FaceRec_, Destroy> face_;
    double em_per_unit_ = 0;
    std::mutex mutex_;
    std::map<char32_t, Glyph> glyphs_;  ///< its entries stay where they are
};

Typeface::Typeface() : impl_(std::make_unique<Impl>()) {}
Typeface::~Typeface() = default;
const Glyph& Typeface::glyph(char32_t character) const { return impl_->glyph(character); }
std::string Typeface::name() const { return impl_->name(); }

const Typeface& overlay_typeface() {
    static const Typeface typeface;
    return typeface;
}

}  // namespace carom
