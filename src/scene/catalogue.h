// The catalogue of sport balls. All numbers are Table 1 and Table 2 of Khurelbaatar et al. 2012
// (doi:10.4236/jsea.2012.56049) after the corrections that docs/scene.md lists.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// A sport ball; its name is also the name of its material.
struct Preset {
    std::string_view name;
    double radius = 0;          ///< m
    double mass = 0;            ///< kg
    double inertia_factor = 0;  ///< k of I = k m r^2
    VirtualBody virtual_body;   ///< Table 2 with its columns exchanged, K = 4
    double printed_restitution =
        0;  ///< the paper's, for comparison; the motion uses the computed one
    LookStyle style = LookStyle::kPlain;
    double drag = 0;            ///< C_D at the speeds of a drop test
    double drag_up_to_m_s = 0;  ///< beyond it another one holds
    std::string_view radius_source;
    std::string_view mass_source;
    std::string_view restitution_source;
    std::string_view drag_source;
};

std::span<const Preset> catalogue();

/// Null if there is none of that name.
const Preset* find_preset(std::string_view name);

std::vector<std::string> preset_names();

}  // namespace carom
