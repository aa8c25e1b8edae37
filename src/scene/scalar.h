// Scalars of YAML 1.2's core schema, and numbers as people read them.
// Source: YAML Ain't Markup Language version 1.2.2, section 10.3.2 (tag resolution).
#pragma once

#include <string>

namespace carom {

/// What a scalar is by the core schema. A null never gets here: the document knows it as such.
struct Scalar {
    enum class Kind {
        kText,
        kNumber,     ///< finite, in `number`
        kNotFinite,  ///< .inf, .nan, or a number beyond what a double holds
        kBool,
    };
    Kind kind = Kind::kText;
    double number = 0;
    bool boolean = false;
    bool integral() const;  ///< a number without a fraction
};

/// `quoted` scalars are text, whatever they look like.
Scalar resolve_scalar(const std::string& text, bool quoted);

/// The shortest text that reads back as the same double: 0.5, 1e-9, 20.
std::string number_text(double value);

/// The text in single quotes, cut to a bearable length, for messages.
std::string quoted_excerpt(const std::string& text);

/// A name as the contract has it: [A-Za-z_][A-Za-z0-9_-]*, at most kMaxNameLength characters.
bool is_name(const std::string& text);
inline constexpr std::size_t kMaxNameLength = 64;
inline constexpr const char* kNamePattern = "^[A-Za-z_][A-Za-z0-9_-]*$";

}  // namespace carom
