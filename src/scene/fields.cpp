#include "scene/fields.h"

#include <fmt/format.h>

#include "core/check.h"
#include "scene/scalar.h"

namespace carom {

Fields::Fields(const KeyTable& table, Section section, const Node* map)
    : table_(table),
      section_(section),
      map_(map != nullptr && map->kind == Node::Kind::kMap ? map : nullptr) {}

const KeySpec& Fields::spec(std::string_view key) const {
    const KeySpec* found = table_.find(section_, key);
    if (found == nullptr) throw Bug(fmt::format("the table of keys has no row '{}'", key));
    return *found;
}

const Node* Fields::find(std::string_view key) const {
    spec(key);
    const Node* node = map_ == nullptr ? nullptr : map_->find(key);
    return node != nullptr && node->valid ? node : nullptr;
}

Fields Fields::child(std::string_view key) const {
    // Wrong values below are skipped one by one, so that the right ones still take part in checks.
    const Section section = spec(key).child;
    return Fields(table_, section, map_ == nullptr ? nullptr : map_->find(key));
}

const Fallback& Fields::fallback(std::string_view key, Fallback::Kind kind) const {
    const Fallback& fallback = spec(key).fallback;
    CAROM_CHECK(static_cast<int>(fallback.kind), ==, static_cast<int>(kind));
    return fallback;
}

double Fields::number(std::string_view key) const {
    const Node* node = find(key);
    return node != nullptr ? node_number(*node) : fallback(key, Fallback::Kind::kNumber).number;
}

int Fields::integer(std::string_view key) const { return static_cast<int>(number(key)); }

std::string Fields::word(std::string_view key) const {
    const Node* node = find(key);
    return node != nullptr ? node->text : std::string(fallback(key, Fallback::Kind::kWord).word);
}

double Fields::entry(std::string_view key, int index) const {
    const Node* node = find(key);
    const auto i = static_cast<std::size_t>(index);
    return node != nullptr ? node_number(node->children.at(i))
                           : fallback(key, Fallback::Kind::kNumbers).numbers.at(i);
}

Vec2 Fields::vec2(std::string_view key) const { return {entry(key, 0), entry(key, 1)}; }

Vec3 Fields::vec3(std::string_view key) const {
    return {entry(key, 0), entry(key, 1), entry(key, 2)};
}

std::optional<double> Fields::maybe_number(std::string_view key) const {
    const Node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return node_number(*node);
}

std::optional<std::string> Fields::maybe_word(std::string_view key) const {
    const Node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return node->text;
}

double node_number(const Node& node) {
    const Scalar scalar = resolve_scalar(node.text, node.quoted);
    CAROM_CHECK(static_cast<int>(scalar.kind), ==, static_cast<int>(Scalar::Kind::kNumber));
    return scalar.number;
}

}  // namespace carom
