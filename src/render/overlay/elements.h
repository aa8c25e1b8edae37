// The list of all elements that a picture may have over it.
#pragma once

#include <span>

#include "render/element/element.h"

namespace carom {

/// In the order in which they take their places, which is that of drawing within a layer.
std::span<const ElementKind> element_kinds();

}  // namespace carom
