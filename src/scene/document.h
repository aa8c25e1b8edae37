// A YAML document as a tree with marks: what the table of keys is held against, and what overrides
// change. The one place that names yaml-cpp is document.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"

namespace carom {

/// A value of the document, with the key that it stands under if it stands in a mapping.
struct Node {
    enum class Kind { kNull, kScalar, kList, kMap };
    Kind kind = Kind::kNull;
    bool quoted = false;  ///< a scalar in quotes, or a block: text, whatever it looks like
    bool valid = true;    ///< false once something in it was found wrong
    int source = 0;       ///< 0: the file; n: the n-th override
    SourceMark mark;      ///< of the value; of the key where the value is empty
    SourceMark key_mark;
    std::string key;
    std::string text;            ///< of a scalar
    std::vector<Node> children;  ///< of a list or a mapping, in the file's order

    /// The entry of a mapping, or null.
    const Node* find(std::string_view wanted) const;
    Node* find(std::string_view wanted);
};

/// How large a document may be. These keep a hostile file from exhausting stack, memory or time.
inline constexpr std::size_t kMaxDocumentBytes = 16U << 20U;
inline constexpr std::size_t kMaxDocumentValues = 2'000'000;  ///< about 250 MB as a tree
inline constexpr int kMaxDocumentDepth = 32;  ///< a scene needs 6; yaml-cpp recurses per level

/// Parses one YAML document. Mistakes go to `diagnostics` under the name `file`; what is not YAML
/// gives no tree, while a key that stands twice is reported and its first value kept.
std::optional<Node> parse_document(std::string_view text, const std::string& file,
                                   Diagnostics& diagnostics);

/// A number that tells documents apart (FNV-1a, 64 bits): equal for equal keys and values in equal
/// order, whatever stands between them in blanks, comments and quotes.
std::uint64_t fingerprint(const Node& node);

}  // namespace carom
