// What of a picture differs from the one before it in a film.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/pixel_rect.h"

namespace carom {

/// Rectangles within the picture that hold every pixel that may differ; or all of it.
struct ChangedParts {
    bool all = true;
    std::vector<PixelRect> parts;  ///< empty where `all`; may overlap

    static ChangedParts nothing() { return {false, {}}; }
    static ChangedParts only(std::vector<PixelRect> parts) { return {false, std::move(parts)}; }

    bool is_nothing() const { return !all && parts.empty(); }

    /// Adds what a later picture changes.
    void add(const ChangedParts& later) {
        if (all) return;
        constexpr std::size_t kMost = 1000;  // a list that nobody asks for must not grow for ever
        if (later.all || parts.size() + later.parts.size() > kMost)
            *this = {};
        else
            parts.insert(parts.end(), later.parts.begin(), later.parts.end());
    }
};

}  // namespace carom
