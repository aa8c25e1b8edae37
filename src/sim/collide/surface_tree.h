// Which surfaces are near a place or a path, so that the cost of an event does not grow with the
// number of surfaces.
#pragma once

#include <cstddef>
#include <vector>

#include "core/types.h"
#include "scene/scene.h"
#include "sim/collide/time_of_impact.h"

namespace carom {

/// The box in which a path stays between two times, without its rounding.
Box3 bounds_of(const Path& path, double from, double to);

/// A binary tree of the boxes around the bounded surfaces of a scene, cut at the middle one along
/// the longest side (C. Ericson, "Real-Time Collision Detection", 2005, chapter 6). Planes are not
/// in it. Answers are indices into the scene's surfaces, each once and ascending: who walks
/// through them meets the surfaces in the same order as one who walks through all.
class SurfaceTree {
  public:
    explicit SurfaceTree(const std::vector<Surface>& surfaces);

    /// The surfaces that come within `reach` of the box, and maybe some more.
    void find_near(const Box3& box, double reach, std::vector<int>& found) const;
    /// Those that come within `reach` of a path in so many seconds, and maybe some more. Of a long
    /// path parts are looked at, as short as the surfaces are near to it.
    void find_along(const Path& path, double seconds, double reach, std::vector<int>& found) const;
    /// Whether none comes into the box.
    bool is_clear(const Box3& box) const { return nodes_.empty() || !meets(0, box); }
    /// The box with all that comes within `reach` of it, and a little more for rounding.
    static Box3 widened(const Box3& box, double reach);
    /// Whether one of them comes within `reach` of the box, or nearly so.
    bool is_near(int surface, const Box3& box, double reach) const {
        return bounds_[static_cast<std::size_t>(surface)].intersects(widened(box, reach));
    }

  private:
    struct Node {
        Box3 box;
        int surface = -1;  ///< of a leaf; of others the left child is the next node ...
        int right = -1;    ///< ... and this the right one
    };

    int build(std::vector<int>::iterator begin, std::vector<int>::iterator end);
    bool meets(std::size_t node, const Box3& box) const;
    void collect(std::size_t node, const Box3& box, std::vector<int>& found) const;
    void collect_along(std::size_t node, const Path& path, double from, double to, double reach,
                       std::vector<int>& found) const;

    std::vector<Box3> bounds_;  ///< per surface, empty for planes
    std::vector<Node> nodes_;   ///< [0] is the root; empty without bounded surfaces
};

}  // namespace carom
