#include "scene/keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/check.h"
#include "scene/scalar.h"

namespace carom {

namespace {

std::size_t index_of(Section section) { return static_cast<std::size_t>(section); }

}  // namespace

std::string Fallback::text() const {
    switch (kind) {
        case Kind::kNone:
            return "";
        case Kind::kNumber:
            return number_text(number);
        case Kind::kBool:
            return boolean ? "true" : "false";
        case Kind::kWord:
            return std::string(word);
        case Kind::kNumbers:
            break;
    }
    return fmt::format("[{}]", fmt::join(numbers.begin(), numbers.begin() + count, ", "));
}

KeyTable::KeyTable(FileKind kind) : kind_(kind) {
    using Rows = std::vector<KeySpec> (*)();
    const Rows of_scene[] = {setup_keys, overlay_keys, material_keys, surface_keys,
                             shape_keys, ball_keys,    air_keys,      against_keys};
    if (kind == FileKind::kSweep) {
        rows_ = sweep_keys();
        rules_ = sweep_rules();
        sections_ = sweep_section_docs();
    } else {
        for (const Rows rows : of_scene)
            for (KeySpec& row : rows()) rows_.push_back(std::move(row));
        rules_ = key_rules();
        sections_ = section_docs();
    }
    for (const KeySpec& row : rows_) {
        by_section_[index_of(row.section)].push_back(&row);
        if (row.in_defaults) by_section_[index_of(Section::kBallDefaults)].push_back(&row);
    }
}

const std::vector<const KeySpec*>& KeyTable::keys(Section section) const {
    return by_section_[index_of(section)];
}

const KeySpec* KeyTable::find(Section section, std::string_view key) const {
    for (const KeySpec* row : keys(section))
        if (row->key == key) return row;
    return nullptr;
}

std::vector<std::string> KeyTable::key_names(Section section) const {
    std::vector<std::string> names;
    for (const KeySpec* row : keys(section)) names.emplace_back(row->key);
    return names;
}

const SectionDoc& KeyTable::section_doc(Section section) const {
    for (const SectionDoc& doc : sections_)
        if (doc.section == section) return doc;
    throw Bug("a section of the scene file has no description");
}

}  // namespace carom
