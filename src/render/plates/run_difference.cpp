#include "render/plates/run_difference.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr double kDifferencePx = 14;  // at 720
constexpr double kLinePitch = 1.45;   // of the letters
constexpr double kSide = 0.75;        // between text and the plate's edges
constexpr double kSwatch = 0.40;      // radius of a disc or ring, of the letters
constexpr double kGap = 0.45;         // between a swatch and its text
constexpr double kBetween = 1.2;      // between two parts of a line
constexpr int kSamples = 240;         // instants that tell how wide the distance gets

}  // namespace

std::vector<Vec2> ball_places(const Motion& motion, const SecondRun& second, const View& view) {
    std::vector<Vec2> places;
    const std::size_t balls = motion.balls.size() + second.motion.balls.size();
    constexpr std::size_t kMostPlaces = 20'000;
    const int samples =
        std::min(kSamples, static_cast<int>(kMostPlaces / std::max(balls, std::size_t{1})));
    for (const Motion* run : {&motion, &second.motion}) {
        for (const Trajectory& ball : run->balls) {
            for (int i = 0; i <= samples; ++i) {
                const double t = motion.duration * i / std::max(samples, 1);
                const View::Projected p = view.project(ball.at(t).position);
                if (p.depth_m > 0) places.emplace_back(p.x_px, p.y_px);
            }
        }
    }
    return places;
}

RunDifference::RunDifference(const Scene& first, const Motion& motion, const SecondRun& second,
                             int width_px, int height_px, const Surroundings& around,
                             const Palette& palette)
    : motion_(motion),
      second_(second),
      pairs_(paired_balls(first, second.scene)),
      palette_(palette),
      ghost_(ghost_ink(first.overlay.theme)),
      font_(letters_px(kDifferencePx, height_px)) {
    for (const BallPair& pair : pairs_) names_.push_back(label_text(first.balls[pair.first].name));
    constexpr double kShare = 0.4;  // of the picture's width, for paths in full
    std::vector<Line> lines = legend(false);
    if (set_columns(lines) > kShare * width_px) lines = legend(true);
    double text_px = std::max(widest_distance(), set_columns(lines));
    // Narrow pictures get smaller letters rather than a plate that hangs out.
    const int border = border_px(height_px);
    const double most_px = width_px - 2 * border - 2 * kSide * font_.size_px();
    if (text_px > most_px) {
        const double fitting = font_.size_px() * most_px / text_px;
        if (fitting < kLeastLetters) return;
        font_ = Font(fitting);
        text_px = most_px;
        set_columns(lines);
    }

    const double size = font_.size_px(), pitch = kLinePitch * size;
    const double rows = static_cast<double>(lines.size());
    rect_ = PixelRect::at(0, 0, whole_px(text_px + 2 * kSide * size),
                          whole_px(1.75 * size + rows * pitch));
    choose_place(width_px, height_px, around);
    make_plate(lines);
}

void RunDifference::make_plate(const std::vector<Line>& lines) {
    const double size = font_.size_px();
    plate_ = Image(rect_.width(), rect_.height());
    Canvas canvas(plate_);
    draw_plate(canvas, rect_.width(), rect_.height(), 0.36 * size, palette_, 0.82);
    double y = std::round(0.5 * (1.75 * size + font_.cap_height_px()));
    for (const Line& line : lines) {
        draw_line(canvas, line, y);
        y = std::round(y + kLinePitch * size);
    }
    text_y_ = y;
    canvas.finish();
}

std::vector<RunDifference::Line> RunDifference::legend(bool brief) const {
    if (second_.view != AgainstView::kGhost) return {};
    using enum Part::Swatch;
    std::vector<Line> lines;
    if (!lists_values(second_)) {
        lines.push_back({{second_.first_name, kDisc}});
        lines.push_back({{second_.second_name, kRing}});
        const std::size_t count = second_.differences.size();
        if (count > 0) lines.push_back({{fmt::format("{} values differ", count), kNone, true}});
        return lines;
    }
    for (const SceneDifference& difference : second_.differences)
        lines.push_back({{shown_path(second_, difference, brief), kNone, true},
                         {difference.first, kDisc},
                         {difference.second, kRing}});
    return lines;
}

std::string RunDifference::distance_line(double t) const {
    const Apart apart = farthest_apart(motion_, second_.motion, pairs_, t);
    std::string text = names_.size() == 1 ? "Apart: " : "Farthest apart: ";
    if (names_.size() > 1 && apart.metres > 0) text += names_[apart.pair] + ", ";
    text += distance_text(apart.metres);
    if (t > second_.ended_s) text += fmt::format(" (the other ended at {:.3g} s)", second_.ended_s);
    return text;
}

double RunDifference::widest_distance() const {
    double widest = 0;
    for (int i = 0; i <= kSamples; ++i) {
        const std::string text = distance_line(motion_.duration * i / kSamples);
        widest = std::max(widest, font_.lay_out(text).width_px);
    }
    return widest + 2 * font_.digit_width_px();  // for what lies between the samples
}

double RunDifference::width_of(const Part& part) const {
    const double size = font_.size_px();
    const double swatch = part.swatch == Part::Swatch::kNone ? 0 : (2 * kSwatch + kGap) * size;
    return swatch + font_.lay_out(part.text).width_px;
}

double RunDifference::set_columns(const std::vector<Line>& lines) {
    columns_ = {0};
    double widest = 0;
    for (std::size_t column = 0;; ++column) {
        double end = -1;
        for (const Line& line : lines)
            if (column < line.size())
                end = std::max(end, columns_[column] + width_of(line[column]));
        if (end < 0) return widest;
        widest = std::max(widest, end);
        columns_.push_back(end + kBetween * font_.size_px());
    }
}

void RunDifference::draw_line(Canvas& canvas, const Line& line, double y) const {
    cairo_t* c = canvas.context();
    const double size = font_.size_px(), radius = kSwatch * size;
    for (std::size_t column = 0; column < line.size(); ++column) {
        const Part& part = line[column];
        double x = kSide * size + columns_[column];
        const bool ring = part.swatch == Part::Swatch::kRing;
        if (part.swatch != Part::Swatch::kNone) {
            const double stroke = ring ? 0.13 * size : 0;
            cairo_new_path(c);
            cairo_arc(c, x + radius, y - 0.5 * font_.cap_height_px(), radius - 0.5 * stroke, 0,
                      2 * std::numbers::pi);
            canvas.use(ring ? with_alpha(ghost_, 0.22) : with_alpha(palette_.ink, 0.85));
            cairo_fill_preserve(c);
            canvas.use(ghost_);
            cairo_set_line_width(c, stroke);
            if (ring) cairo_stroke(c);
            cairo_new_path(c);
            x += (2 * kSwatch + kGap) * size;
        }
        const TextRun run = font_.lay_out(part.text);
        const Ink ink = part.muted ? with_alpha(palette_.ink, 0.72) : ring ? ghost_ : palette_.ink;
        font_.draw(canvas, run, x, y, ink);
    }
}

/// Of the corners that are free, the one that hides balls the least, the lower ones first; with
/// halves, the middle of the lower edge.
void RunDifference::choose_place(int width_px, int height_px, const Surroundings& around) {
    const int border = border_px(height_px);
    const int w = rect_.width(), h = rect_.height();
    const int left = border, right = width_px - border - w;
    const int top = border, bottom = height_px - border - h;
    const bool side = second_.view == AgainstView::kSide;
    std::vector<PixelRect> corners;
    for (const int y : {bottom, top})
        for (const int x : {left, right}) corners.push_back(PixelRect::at(x, y, w, h));
    if (side) corners = {PixelRect::at((width_px - w) / 2, bottom, w, h)};
    std::ptrdiff_t fewest = -1;
    for (const PixelRect& corner : corners) {
        const bool free =
            std::none_of(around.taken.begin(), around.taken.end(),
                         [&](const PixelRect& other) { return corner.overlaps(other); });
        if (!free) continue;
        const auto covers = [&](const Vec2& p) {
            return p.x() > corner.left && p.x() < corner.right && p.y() > corner.top &&
                   p.y() < corner.bottom;
        };
        const auto hidden = std::count_if(around.places.begin(), around.places.end(), covers);
        if (fewest >= 0 && hidden >= fewest) continue;
        fewest = hidden;
        rect_ = corner;
    }
    if (fewest >= 0) return;
    // Above what stands in the way; above one it may meet the next, whatever their order.
    rect_ = corners.front();
    for (std::size_t turn = 0; turn < around.taken.size(); ++turn)
        for (const PixelRect& other : around.taken)
            if (rect_.overlaps(other)) rect_ = rect_.with_top(other.top - border / 2 - h);
    rect_ = rect_.with_top(std::max(rect_.top, 0));
}

Appearance RunDifference::appearance(double t) {
    const std::string line = distance_line(t);
    return {{rect_}, {line.begin(), line.end()}};
}

void RunDifference::draw(double t, Image& picture) {
    Image plate = plate_;
    Canvas canvas(plate);
    const TextRun run = font_.lay_out(distance_line(t));
    // Alone on its plate it stands in the middle, below a legend at its left.
    const bool alone = second_.view == AgainstView::kSide;
    const double x = alone ? 0.5 * (rect_.width() - run.width_px) : kSide * font_.size_px();
    font_.draw(canvas, run, x, text_y_, palette_.ink);
    canvas.finish();
    lay_over(plate, rect_.left, rect_.top, picture);
}

ElementKind run_difference_kind() {
    ElementKind kind;
    kind.name = "against";
    kind.keeps_place = true;
    kind.repeat = Repeat::kOncePerFilm;
    kind.wanted = [](const Scene&) { return true; };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        if (context.second == nullptr) return nullptr;
        RunDifference::Surroundings around{context.around, {}};
        if (context.part == PicturePart::kWhole)
            around.places = ball_places(context.motion, *context.second, context.view);
        return std::make_unique<RunDifference>(context.scene, context.motion, *context.second,
                                               context.view.width_px(), context.view.height_px(),
                                               around, context.palette);
    };
    return kind;
}

}  // namespace carom
