// The page of a golden report.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/markup.h"
#include "core/measures_text.h"
#include "golden/golden_report.h"

namespace carom {

namespace {

// The policy lets the page load nothing, and run this script alone: whatever a name may hold, it
// cannot act. Its hash belongs to the text between the tags (a test compares them).
constexpr const char* kScript =
    "addEventListener('input',e=>{if(e.target.type==='range')"
    "e.target.closest('section').style.setProperty('--x',e.target.value+'%')})";
constexpr const char* kScriptHash = "sha256-VXWjZ/jx1Y0VqAvAyJlcJwIehBzZXC8VvGlnEpih8xg=";

constexpr const char* kStyle = R"(
:root{color-scheme:light dark;--line:#8888}
body{font:15px/1.45 system-ui,sans-serif;margin:1.5em}
h1{font-size:1.5em;margin:0}h2{font-size:1.1em;margin:0 0 .2em;overflow-wrap:anywhere}
section{border-top:1px solid var(--line);padding:1em 0;--x:50%}
p{margin:.2em 0;overflow-wrap:anywhere}.missed{color:#c8102e;font-weight:600}
@media(prefers-color-scheme:dark){.missed{color:#ff7b8a}}
small{opacity:.75}ul{margin:.3em 0}label{margin-right:1.2em;white-space:nowrap}
.tabs{margin:.6em 0}.views{display:flex;flex-wrap:wrap;gap:1em}
figure{margin:0;max-width:100%;overflow:auto}figcaption{font-weight:600}
.pic{position:relative;overflow:hidden;isolation:isolate;
background:repeating-conic-gradient(#bbb 0 25%,#eee 0 50%) 0 0/16px 16px}
.pic i,.pic u{position:absolute;background-repeat:no-repeat}
.pic u{inset:0}.pic b{position:absolute;outline:1px dashed #f0f;
background:repeating-linear-gradient(45deg,#f0f4 0 4px,#0000 4px 8px)}
.amplified{background:#000;filter:url(#amplify)}.amplified .m{mix-blend-mode:difference}
.amplified b{background:#000;outline:0}
.blink,.slide{display:none}
section:has(input[value=blink]:checked) .side,section:has(input[value=slide]:checked) .side{display:none}
section:has(input[value=blink]:checked) .blink,section:has(input[value=slide]:checked) .slide{display:block}
@keyframes off{50%{opacity:0}}@keyframes on{0%{opacity:0}50%{opacity:1}}
.blink .e{animation:off 1.2s steps(1) infinite}.blink .a{animation:on 1.2s steps(1) infinite}
.slide .e{clip-path:inset(0 calc(100% - var(--x)) 0 0)}.slide .a{clip-path:inset(0 0 0 var(--x))}
.slide .pic::after{content:"";position:absolute;top:0;bottom:0;
left:var(--x);border-left:1px solid #f0f}
input[type=range]{max-width:100%;margin:.3em 0}
)";

/// What difference_image() does, for a browser: 0 stays, k of 255 becomes 48 + 8 k.
std::string amplifier() {
    constexpr int kFloor = 48, kGain = 8, kLargest = 255;
    std::string table = "0";
    for (int k = 1; k <= kLargest; ++k)
        table += fmt::format(" {:.4g}", std::min(1.0, (kFloor + kGain * k) / 255.0));
    std::string functions;
    for (const char channel : {'R', 'G', 'B'})
        functions += fmt::format("<feFunc{} type=\"table\" tableValues=\"{}\"/>", channel, table);
    return fmt::format(
        "<svg width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\"><filter "
        "id=\"amplify\" color-interpolation-filters=\"sRGB\" x=\"0\" y=\"0\" width=\"100%\" "
        "height=\"100%\"><feComponentTransfer>{}</feComponentTransfer></filter></svg>\n",
        functions);
}

std::string picture_rule(const std::string& name, const std::string& png) {
    return fmt::format(".{}{{background-image:url(data:image/png;base64,{})}}\n", name,
                       base64(png));
}

std::string place(const PixelRect& r) {
    return fmt::format("left:{}px;top:{}px;width:{}px;height:{}px", r.left, r.top, r.width(),
                       r.height());
}

/// The pictures of a still: layers in frames of its size.
class Pictures {
  public:
    Pictures(const StillCheck& check, std::size_t number) : check_(check), number_(number) {
        for (const PixelRect& r : check.ignored)
            ignored_ += fmt::format("<b style=\"{}\"></b>", place(r));
    }

    /// The rules that hold the pictures' bytes, each once.
    std::string rules() const {
        std::string text;
        const auto add = [&](char kind, const std::string& png) {
            if (!png.empty()) text += picture_rule(fmt::format("{}{}", kind, number_), png);
        };
        add('g', check_.golden_png);
        add('c', check_.changed_png);
        add('d', check_.difference_png);
        if (check_.changed_png.empty()) add('w', check_.drawn_png);
        return text;
    }

    /// Both pictures are there, in one size.
    bool comparable() const {
        return !check_.changed_png.empty() || !check_.difference_png.empty();
    }

    std::string golden() const {
        return frame("", check_.golden_width_px, check_.golden_height_px, layer('g', ""));
    }
    std::string drawn() const { return frame("", drawn_layers("a")); }
    std::string both() const { return frame("", layer('g', "e") + drawn_layers("a")); }
    std::string difference() const {
        if (!check_.difference_png.empty()) return frame("", layer('d', ""));
        const PixelRect& r = check_.changed;
        return frame(
            " amplified",
            fmt::format("<i class=\"g{}\" style=\"{};background-position:-{}px -{}px\"></i>"
                        "{}",
                        number_, place(r), r.left, r.top, changed()));
    }

  private:
    /// A whole picture.
    std::string layer(char kind, const char* role) const {
        return fmt::format("<u class=\"{}{} {}\"></u>", kind, number_, role);
    }
    /// What was drawn: whole, or the golden with what has changed on it.
    std::string drawn_layers(const char* role) const {
        if (check_.changed_png.empty()) return layer('w', role);
        return fmt::format("<u class=\"{}\">{}{}</u>", role, layer('g', ""), changed());
    }
    std::string changed() const {
        return fmt::format("<i class=\"c{} m\" style=\"{}\"></i>", number_, place(check_.changed));
    }
    std::string frame(const char* kind, const std::string& inside) const {
        return frame(kind, check_.width_px, check_.height_px, inside);
    }
    std::string frame(const char* kind, int width, int height, const std::string& inside) const {
        return fmt::format("<div class=\"pic{}\" style=\"width:{}px;height:{}px\">{}{}</div>", kind,
                           width, height, inside, ignored_);
    }

    const StillCheck& check_;
    std::size_t number_;
    std::string ignored_;
};

std::string figure(const char* title, const std::string& picture) {
    return fmt::format("<figure><figcaption>{}</figcaption>{}</figure>\n", title, picture);
}

std::string choice(std::size_t number, const char* value, const char* label, bool chosen) {
    return fmt::format("<label><input type=\"radio\" name=\"v{}\" value=\"{}\"{}> {}</label>",
                       number, value, chosen ? " checked" : "", label);
}

std::string head_of_still(const StillCheck& check, const ImageTolerance& limits) {
    std::string text = fmt::format("<h2>{}</h2>\n<p>{}: {}</p>\n", escaped(check.still.name),
                                   outcome_word(check.outcome), escaped(check.why));
    if (!check.missed.empty())
        text += fmt::format("<p class=\"missed\">{} (limits: {})</p>\n", escaped(check.missed),
                            limits_text(limits));
    return text + fmt::format("<p><small>{} at {} s · golden {} · drawn by {}{}</small></p>\n",
                              escaped(check.still.scene), check.still.time_s,
                              escaped(check.still.golden), escaped(check.still.renderer),
                              check.ignored.empty() ? "" : " · hatched parts are ignored");
}

std::string section(const StillCheck& check, const ImageTolerance& limits, std::size_t number) {
    const Pictures pictures(check, number);
    std::string text = "<section>\n" + head_of_still(check, limits);
    text += "<style>\n" + pictures.rules() + "</style>\n";
    if (pictures.comparable())
        text += "<div class=\"tabs\">" + choice(number, "side", "side by side", true) +
                choice(number, "blink", "blink", false) + choice(number, "slide", "slider", false) +
                "</div>\n";
    text += "<div class=\"side views\">\n";
    if (!check.golden_png.empty()) text += figure("Expected", pictures.golden());
    text += figure("Actual", pictures.drawn());
    if (pictures.comparable()) text += figure("Difference", pictures.difference());
    text += "</div>\n";
    if (pictures.comparable()) {
        text += "<div class=\"blink\">" + figure("Expected and actual in turn", pictures.both()) +
                "</div>\n";
        text += "<div class=\"slide\">" + figure("Expected | actual", pictures.both()) +
                fmt::format(
                    "<input type=\"range\" style=\"width:{}px\" aria-label=\"where actual "
                    "begins\"></div>\n",
                    check.width_px);
    }
    return text + "</section>\n";
}

/// Names in a list, as many as anybody reads.
std::string list(const char* title, const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 100;
    if (names.empty()) return "";
    std::string text = fmt::format("<details><summary>{}: {}</summary><ul>\n", title, names.size());
    for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i)
        text += "<li>" + escaped(names[i]) + "</li>\n";
    if (names.size() > kMost) text += fmt::format("<li>and {} more</li>\n", names.size() - kMost);
    return text + "</ul></details>\n";
}

}  // namespace

std::string html_page(const GoldenReport& report) {
    std::vector<std::string> same;
    std::string sections;
    std::size_t number = 0;
    for (const StillCheck& check : report.stills) {
        if (check.outcome == Outcome::kSame)
            same.push_back(check.still.name);
        else
            sections += section(check, report.limits, number++);
    }
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src '{}'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n"
        "<title>Goldens: {}</title>\n<style>{}</style></head><body>\n",
        kScriptHash, report.counts_text(), kStyle);
    text += amplifier();
    text +=
        fmt::format("<h1>Goldens: {}</h1>\n<p>In {}; limits in force together: {}; carom {}</p>\n",
                    report.counts_text(), escaped(report.folder), limits_text(report.limits),
                    escaped(report.version));
    text += list("Invalid scenes", report.invalid_scenes);
    text += list("Goldens without a scene", report.orphans);
    text += list("Same", same);
    return text + sections + fmt::format("<script>{}</script>\n</body></html>\n", kScript);
}

}  // namespace carom
