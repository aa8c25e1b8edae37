// Whether a shape bends away from a ball everywhere.
#pragma once

#include "geometry/shape.h"

namespace carom {

/// No ball that goes along a convex shape is pressed onto it by its own motion.
inline bool is_convex(const PlaneShape&) { return true; }
inline bool is_convex(const BoxShape&) { return true; }
inline bool is_convex(const SphereShape&) { return true; }
inline bool is_convex(const CapsuleShape&) { return true; }
inline bool is_convex(const CylinderShape&) { return true; }
inline bool is_convex(const RingShape&) { return false; }
inline bool is_convex(const BowlShape&) { return false; }
inline bool is_convex(const PipeShape&) { return false; }
inline bool is_convex(const SurfaceShape& shape) {
    return std::visit([](const auto& s) { return is_convex(s); }, shape);
}

}  // namespace carom
