// The options of films, as the table of codecs says them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/outputs.h"

namespace CLI {
class App;
}

namespace carom {

/// --codec, --pix-fmt, --quality, --crf, --preset, --threads.
void add_encoding_options(CLI::App& command, EncodingOptions& options);

/// --dpi of PNGs.
void add_dpi_option(CLI::App& command, std::optional<double>& dpi);

/// What --format may say: the films, and png.
std::vector<std::string> stream_formats();

}  // namespace carom
