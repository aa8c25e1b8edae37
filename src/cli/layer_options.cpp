#include "cli/layer_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "core/failure.h"
#include "media/frame_sink.h"

namespace carom {

namespace {

std::vector<std::string> names_of_layers() {
    std::vector<std::string> names;
    for (const LayerKindInfo& info : layer_kinds()) names.emplace_back(info.name);
    return names;
}

}  // namespace

std::vector<LayerKind> LayerOptions::kinds() const {
    std::vector<LayerKind> kinds;
    for (const std::string& name : names) {
        const LayerKindInfo* info = find_layer_kind(name);
        if (std::find(kinds.begin(), kinds.end(), info->kind) != kinds.end())
            throw Failure(FailureKind::kInput, fmt::format("--layers: {} stands twice", name));
        kinds.push_back(info->kind);
    }
    return kinds;
}

void add_layer_option(CLI::App& command, LayerOptions& options) {
    const std::vector<std::string> names = names_of_layers();
    command
        .add_option("--layers", options.names,
                    fmt::format("What the pixels show, as files beside the pictures: {} (default: "
                                "none)",
                                fmt::join(names, ", ")))
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false)
        ->check(CLI::IsMember(names))
        ->type_name("NAME,...");
}

void require_one_picture(const LayerOptions& options, const SecondRun* second) {
    if (options.wanted() && second != nullptr && second->view == AgainstView::kSide)
        throw Failure(FailureKind::kInput,
                      "--layers: two runs side by side are two pictures; film each by itself, or "
                      "the second one as ghosts, which are in no layer");
}

const OutputRequest& frames_for_layers(const std::vector<OutputRequest>& outputs) {
    for (const OutputRequest& output : outputs)
        if (!output.is_film() && output.path != "-") return output;
    throw Failure(FailureKind::kInput,
                  "--layers: layers are files beside PNG frames, and no -o is a folder or a name "
                  "such as frame_%05d.png");
}

std::string layer_index_path(const OutputRequest& frames, const FrameRanges& part, bool is_chunk) {
    const std::string name = is_chunk
                                 ? fmt::format("layers.{:05}-{:05}.json", part.front(), part.back())
                                 : "layers.json";
    return (std::filesystem::path(sequence_path(frames.path, 0)).parent_path() / name).string();
}

void require_new_layers(const LayerOptions& options, const OutputRequest& frames,
                        const FrameRanges& numbers, bool is_chunk, bool overwrite) {
    if (numbers.empty()) return;
    namespace fs = std::filesystem;
    const std::string index = layer_index_path(frames, numbers, is_chunk);
    const std::string folder = sequence_folder(frames.path);
    std::error_code error;
    if (!fs::exists(folder, error)) return;  // it will be made
    require_writable(index, overwrite);
    if (overwrite) return;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        // "frame_00012.depth.exr": the picture's name with a layer's in it.
        const fs::path stem = entry.path().filename().stem();
        const LayerKindInfo* info = stem.extension().empty()
                                        ? nullptr
                                        : find_layer_kind(stem.extension().string().substr(1));
        if (info == nullptr || std::find(options.names.begin(), options.names.end(), info->name) ==
                                   options.names.end())
            continue;
        const auto frame = sequence_number(frames.path, stem.stem().string() + ".png");
        if (frame && numbers.contains(*frame))
            require_writable(layer_path(sequence_path(frames.path, *frame), *info), false);
    }
}

}  // namespace carom
