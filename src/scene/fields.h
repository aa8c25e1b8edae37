// Typed access to one validated mapping: the value in the file, or the table's default.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/types.h"
#include "scene/document.h"
#include "scene/keys.h"

namespace carom {

/// A mapping of a known section. Asking for a key, or for a default, that the table does not have
/// is a Bug. A value that was found wrong reads as if it were left out: its mistake is reported
/// already.
class Fields {
  public:
    /// `map` may be null or no mapping (`true`, or found wrong): then every value is the default.
    Fields(const KeyTable& table, Section section, const Node* map);

    /// The value's node, or null where it is left out or wrong.
    const Node* find(std::string_view key) const;
    bool has(std::string_view key) const { return find(key) != nullptr; }
    Fields child(std::string_view key) const;

    double number(std::string_view key) const;
    int integer(std::string_view key) const;
    std::string word(std::string_view key) const;  ///< also names, texts, colours
    Vec2 vec2(std::string_view key) const;
    Vec3 vec3(std::string_view key) const;
    std::optional<double> maybe_number(std::string_view key) const;
    std::optional<std::string> maybe_word(std::string_view key) const;

  private:
    const KeySpec& spec(std::string_view key) const;
    const Fallback& fallback(std::string_view key, Fallback::Kind kind) const;
    double entry(std::string_view key, int index) const;

    const KeyTable& table_;
    Section section_;
    const Node* map_;
};

/// The number that a validated scalar stands for.
double node_number(const Node& node);

}  // namespace carom
