// What all pages have: head, policy, style, the viewer.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "motion/motion.h"
#include "render/runs/second_run.h"
#include "scene/scene.h"

namespace carom {

/// Up to the beginning of the body. The policy lets the page load nothing but what it holds itself,
/// and run the scripts of these hashes alone, whatever a text in it may say. `connects` lets it ask
/// the server that it comes from.
std::string page_head(std::string_view title, const std::vector<std::string_view>& scripts,
                      bool connects = false);

/// The scene's title, or the name of its file.
std::string page_title(const Scene& scene);

/// "1 ball", "2 balls".
std::string counted(std::size_t count, std::string_view of_one);

/// The player's elements, hidden until its script has begun. `second`: null where there is none.
std::string viewer_elements(const Motion& motion, const SecondRun* second);

/// Pictures of balls' markings as URIs, by their looks as the motion's JSON has them.
using KnownTextures = std::map<std::string, std::string>;

/// What the viewer needs, at the end of the body: motion, that of the second run where it is not
/// null, textures, three.js, its script. What of the textures is not known is drawn, and known
/// then.
std::string viewer_data(const Scene& scene, const Motion& motion, const SecondRun* second,
                        std::string_view version, KnownTextures& known);

/// A text of several lines, with every line as escaped() has it.
std::string escaped_lines(std::string_view text);

std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace carom
