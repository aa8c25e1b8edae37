#include "render/plates/text.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/runs/second_run.h"

namespace carom {

namespace {

constexpr double kTextLinePitch = 1.35;  // of the letters
constexpr double kPlateHeight = 1.75;    // of one line, as the clock's
constexpr double kTextSide = 0.62;       // between text and the plate's edges
constexpr const char* kEllipsis = "\u2026";

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

double width_of(const Font& font, const std::string& text) { return font.lay_out(text).width_px; }

/// Lines of one word that is too wide.
void break_word(const Font& font, const std::string& word, double width_px,
                std::vector<std::string>& lines) {
    std::string line;
    for (std::size_t i = 0; i < word.size();) {
        std::size_t next = i + 1;
        while (next < word.size() && is_continuation(word[next])) ++next;
        const std::string character = word.substr(i, next - i);
        if (!line.empty() && width_of(font, line + character) > width_px) {
            lines.push_back(line);
            line.clear();
        }
        line += character;
        i = next;
    }
    lines.push_back(line);
}

void break_paragraph(const Font& font, const std::string& text, double width_px,
                     std::vector<std::string>& lines) {
    std::string line;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = std::min(text.find(' ', i), text.size());
        const std::string word = text.substr(i, end - i);
        i = end + 1;
        if (word.empty()) continue;
        const std::string longer = line.empty() ? word : line + " " + word;
        if (width_of(font, longer) <= width_px) {
            line = longer;
            continue;
        }
        if (!line.empty()) lines.push_back(line);
        line.clear();
        if (width_of(font, word) > width_px) {
            break_word(font, word, width_px, lines);
            line = lines.back();
            lines.pop_back();
        } else {
            line = word;
        }
    }
    if (!line.empty()) lines.push_back(line);
}

/// One line for several short ones is rarely wanted: lines of like length read better.
std::vector<std::string> balanced_lines(const Font& font, const std::string& text,
                                        double width_px) {
    std::vector<std::string> lines = break_lines(font, text, width_px);
    const std::size_t count = lines.size();
    if (count < 2) return lines;
    double low = width_px / static_cast<double>(count), high = width_px;
    constexpr int kHalvings = 8;  // to a 256th of the width
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        const auto narrower = break_lines(font, text, middle);
        if (narrower.size() > count) {
            low = middle;
        } else {
            high = middle;
            lines = narrower;
        }
    }
    return lines;
}

/// The room for text at one edge: as wide as `width` and starting `inset` from the edge.
struct Room {
    double width = 0;
    int inset = 0;
};

/// The widest room in the middle that leaves `taken` on its sides.
Room room_beside(const std::vector<PixelRect>& taken, int width_px, int height_px, int border,
                 double depth, bool at_top) {
    double half = 0.5 * width_px - border;
    for (const PixelRect& other : taken) {
        const bool reaches =
            at_top ? other.top < border + depth : other.bottom > height_px - border - depth;
        if (!reaches) continue;
        const double left = 0.5 * width_px - other.right, right = other.left - 0.5 * width_px;
        half = std::min(half, std::max(left, right) - border);
    }
    return {std::max(2 * half, 0.0), border};
}

/// The whole width, further inside than everything that is taken at this edge.
Room room_inside(const std::vector<PixelRect>& taken, int width_px, int height_px, int border,
                 bool at_top) {
    int inset = border;
    for (const PixelRect& other : taken) {
        const bool upper = other.middle_y() < 0.5 * height_px;
        if (upper != at_top || other.height() > 0.3 * height_px) continue;
        inset = std::max(inset,
                         at_top ? other.bottom + border / 2 : height_px - other.top + border / 2);
    }
    return {width_px - 2.0 * border, inset};
}

void cut(const Font& font, std::vector<std::string>& lines, std::size_t most, double width_px) {
    if (lines.size() <= most) return;
    lines.resize(std::max<std::size_t>(most, 1));
    std::string& last = lines.back();
    while (!last.empty() && width_of(font, last + kEllipsis) > width_px) {
        while (is_continuation(last.back())) last.pop_back();
        last.pop_back();
    }
    last += kEllipsis;
}

}  // namespace

std::vector<std::string> break_lines(const Font& font, const std::string& text, double width_px) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i <= text.size();) {
        const std::size_t end = std::min(text.find('\n', i), text.size());
        break_paragraph(font, text.substr(i, end - i), width_px, lines);
        i = end + 1;
    }
    return lines;
}

TextElement::TextElement(const Request& request, int width_px, int height_px,
                         const std::vector<PixelRect>& taken, const Palette& palette) {
    const int border = border_px(height_px);
    const double wanted = letters_px(request.size_px, height_px);
    const double smallest = std::min(wanted, std::max(0.7 * wanted, kSmallestLetters));
    const auto height_of = [&](double size, std::size_t lines) {
        return (kPlateHeight + kTextLinePitch * (static_cast<double>(lines) - 1)) * size;
    };
    // One line beside what is taken; the same with smaller letters; a few lines beside it if the
    // room is wide; then inside of it.
    struct Attempt {
        double size;
        bool beside;
        std::size_t most_lines;
    };
    constexpr double kShare = 1.0 / 3;  // of the picture's height
    const auto most = static_cast<std::size_t>(
        std::max(1.0, 1 + (kShare * height_px / smallest - kPlateHeight) / kTextLinePitch));
    const Attempt attempts[] = {{wanted, true, 1},        {smallest, true, 1}, {wanted, false, 1},
                                {0.85 * wanted, true, 2}, {wanted, false, 2},  {smallest, false, 3},
                                {smallest, false, most}};
    std::optional<Font> font;
    Room room;
    for (const Attempt& attempt : attempts) {
        font.emplace(std::max(attempt.size, smallest));
        const double depth = height_of(font->size_px(), attempt.most_lines);
        room = attempt.beside
                   ? room_beside(taken, width_px, height_px, border, depth, request.at_top)
                   : room_inside(taken, width_px, height_px, border, request.at_top);
        const double text_px = room.width - 2 * kTextSide * font->size_px();
        if (attempt.most_lines > 1 && attempt.beside && room.width < 0.4 * width_px) continue;
        lines_ = balanced_lines(*font, request.text, text_px);
        if (lines_.size() <= attempt.most_lines) break;
    }
    const double size = font->size_px(), side = kTextSide * size;
    if (room.width - 2 * side < width_of(*font, kEllipsis)) return;
    cut(*font, lines_, most, room.width - 2 * side);

    double text_width = 0;
    for (const std::string& line : lines_) text_width = std::max(text_width, width_of(*font, line));
    const int width = std::min(whole_px(text_width + 2 * side), width_px);
    const int height = whole_px(height_of(size, lines_.size()));
    rect_ =
        PixelRect::at((width_px - width) / 2,
                      request.at_top ? room.inset : height_px - room.inset - height, width, height);
    picture_ = Image(width, height);
    Canvas canvas(picture_);
    if (request.plate) {
        draw_plate(canvas, width, height, 0.36 * size, palette, 0.80);
    }
    const double halo = request.plate ? 0 : 0.2 * size;
    const double base = 0.5 * (kPlateHeight * size + font->cap_height_px());
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const TextRun run = font->lay_out(lines_[i]);
        font->draw(canvas, run, 0.5 * (width - run.width_px),
                   std::round(base + kTextLinePitch * size * static_cast<double>(i)), palette.ink,
                   halo, palette.paper);
    }
    canvas.finish();
}

Appearance TextElement::appearance(double /*t*/) { return {{rect_}, {}}; }

void TextElement::draw(double /*t*/, Image& picture) {
    lay_over(picture_, rect_.left, rect_.top, picture);
}

namespace {

std::unique_ptr<Element> make_text(const ElementContext& context,
                                   const TextElement::Request& request) {
    return std::make_unique<TextElement>(request, context.view.width_px(), context.view.height_px(),
                                         context.taken, context.palette);
}

/// Light letters want a plate on the light sky.
bool wants_plate(const ElementContext& context) {
    return context.scene.overlay.theme == Theme::kDark;
}

std::unique_ptr<Element> make_run_name(const ElementContext& context) {
    if (context.part == PicturePart::kWhole) return nullptr;
    constexpr double kNamePx = 17;  // letters, at 720
    const bool second = context.part == PicturePart::kSecondHalf;
    std::string text = run_caption(*context.second, second);
    // Beside a clock, paths in full have room only in wide pictures.
    constexpr double kShare = 0.62;  // of the half's width
    const Font font(letters_px(kNamePx, context.view.height_px()));
    if (width_of(font, text) > kShare * context.view.width_px())
        text = run_caption(*context.second, second, true);
    return make_text(context, {text, kNamePx, true, wants_plate(context)});
}

}  // namespace

ElementKind title_kind() {
    ElementKind kind;
    kind.keeps_place = true;
    kind.name = "title";
    kind.repeat = Repeat::kOncePerFilm;
    kind.wanted = [](const Scene& scene) { return scene.overlay.title.has_value(); };
    kind.make = [](const ElementContext& context) {
        return make_text(context, {context.scene.title, context.scene.overlay.title->size_px, true,
                                   wants_plate(context)});
    };
    return kind;
}

ElementKind run_name_kind() {
    ElementKind kind;
    kind.keeps_place = true;
    kind.wanted = [](const Scene&) { return true; };
    kind.make = make_run_name;
    return kind;
}

ElementKind caption_kind() {
    constexpr double kCaptionPx = 15;  // letters, at 720
    ElementKind kind;
    kind.keeps_place = true;
    kind.name = "caption";
    kind.repeat = Repeat::kOncePerFilm;
    kind.wanted = [](const Scene& scene) { return !scene.overlay.caption.empty(); };
    kind.make = [](const ElementContext& context) {
        return make_text(context, {context.scene.overlay.caption, kCaptionPx, false, true});
    };
    return kind;
}

}  // namespace carom
