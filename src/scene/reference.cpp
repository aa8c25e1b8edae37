// The reference of every key, in Markdown; declared in schema.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/catalogue.h"
#include "scene/keys.h"
#include "scene/scalar.h"
#include "scene/schema.h"
#include "scene/validate.h"
#include "scene/virtual_body.h"

namespace carom {

namespace {

/// For a cell of a table.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
    return out;
}

std::string default_cell(const KeySpec& spec, Section section) {
    if (spec.required) return "**required**";
    if (section == Section::kBallDefaults) return "";
    if (spec.fallback.kind != Fallback::Kind::kNone)
        return fmt::format("`{}`", spec.fallback.text());
    return std::string(spec.fallback_doc);
}

std::string value_cell(const KeySpec& spec) {
    std::string text = expected_text(spec);
    const std::string range = range_text(spec.range);
    if (!range.empty()) text += ", " + range;
    return text;
}

std::string key_rows(const KeyTable& table, Section section) {
    std::string text = "| Key | Value | Default | Meaning | Example |\n|---|---|---|---|---|\n";
    for (const KeySpec* spec : table.keys(section))
        text +=
            fmt::format("| `{}` | {} | {} | {} | `{}` |\n", spec->key, escaped(value_cell(*spec)),
                        default_cell(*spec, section), escaped(spec->doc), escaped(spec->example));
    return text;
}

std::string rule_sentence(const Rule& rule) {
    const std::string keys = fmt::format("`{}`", fmt::join(rule.keys, "`, `"));
    switch (rule.kind) {
        case Rule::Kind::kExactlyOne:
            return fmt::format("Exactly one of {} must stand here.", keys);
        case Rule::Kind::kAtMostOne:
            return fmt::format("Of {} at most one may stand here.", keys);
        case Rule::Kind::kAtLeastOne:
            return fmt::format("At least one of {} must stand here.", keys);
        case Rule::Kind::kAboveZeroWith:
            break;
    }
    return fmt::format("`{}` must be above 0 where `{}` is.", rule.keys[1], rule.keys[0]);
}

std::string section_text(const KeyTable& table, const SectionDoc& doc) {
    const std::string heading =
        doc.path.empty() ? std::string("The file") : fmt::format("`{}`", doc.path);
    std::string text = fmt::format("### {}\n\n{}\n\n", heading, doc.doc);
    if (doc.section == Section::kBallDefaults) {
        return text + fmt::format("`{}`.\n\n", fmt::join(table.key_names(doc.section), "`, `"));
    }
    text += key_rows(table, doc.section) + "\n";
    for (const Rule& rule : table.rules())
        if (rule.section == doc.section) text += rule_sentence(rule) + "\n\n";
    return text;
}

std::string catalogue_text() {
    constexpr double kPaperConstant = 4;
    std::string text =
        "### Presets\n\n"
        "| Preset | Radius, m | Mass, kg | Inertia factor | x, m | v, m/s | Coefficient at K = 4 | "
        "Printed in the paper |\n|---|---|---|---|---|---|---|---|\n";
    for (const Preset& preset : catalogue())
        text += fmt::format("| `{}` | {:.6f} | {} | 2/3 | {} | {} | {:.6f} | {} |\n", preset.name,
                            preset.radius, number_text(preset.mass),
                            number_text(preset.virtual_body.distance_m),
                            number_text(preset.virtual_body.velocity_m_s),
                            rigid_restitution(preset.virtual_body, kPaperConstant),
                            number_text(preset.printed_restitution));
    text += "\n| Preset | Radius | Mass | Coefficient |\n|---|---|---|---|\n";
    for (const Preset& preset : catalogue())
        text += fmt::format("| `{}` | {} | {} | {} |\n", preset.name, preset.radius_source,
                            preset.mass_source, preset.restitution_source);
    text += "\n| Preset | Drag coefficient in air | Up to, m/s | Source |\n|---|---|---|---|\n";
    for (const Preset& preset : catalogue())
        text += fmt::format("| `{}` | {} | {} | {} |\n", preset.name, number_text(preset.drag),
                            number_text(preset.drag_up_to_m_s), preset.drag_source);
    return text;
}

}  // namespace

std::string reference_markdown(FileKind kind) {
    const KeyTable table(kind);
    std::string text;
    for (const SectionDoc& doc : table.sections()) text += section_text(table, doc);
    return kind == FileKind::kScene ? text + catalogue_text() : text;
}

}  // namespace carom
