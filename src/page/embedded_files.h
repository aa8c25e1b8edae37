// What stands in every page, inside the program: style, scripts, three.js.
#pragma once

#include <string_view>

namespace carom {

/// A text of the page, and its hash as a content security policy names it ("sha256-...").
struct EmbeddedFile {
    std::string_view text;
    std::string_view hash;
};

EmbeddedFile page_style();
EmbeddedFile viewer_script();
EmbeddedFile overview_script();
EmbeddedFile watch_script();
/// Compressed (gzip); the hash is that of the script itself.
EmbeddedFile three_script();
std::string_view three_version();
/// To be in every page that has three.js.
std::string_view three_licence();

}  // namespace carom
