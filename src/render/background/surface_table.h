// The scene's static surfaces as the shaders read them: an array of vec4 in view space.
#pragma once

#include <vector>

#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// Records in the order planes, boxes, spheres, others; each kSurfaceVec4s vec4 long:
///   plane    0: normal, offset (normal . p = offset)
///   box      0: centre, radius around it   1-3: rows of box-from-view, half edge
///   sphere   0: centre, radius
///   others   0: one end, radius            1: from that end to the other, kind (OtherKind)
///            of a ring 0: centre, radius   1: axis, kind   2: x radius of the tube
///            of a bowl 0: centre, radius   1: opening, kind   2: height and radius of the rim
///            of a pipe 2: opening, cosine of half its angle, -2 of a tube
///   all      4: colour, pattern (0 none, 1 checker, 2 grid, 3 wood, 4 court)
///            5: second colour, tile [m]
///   plane    1: x reflection
///            6, 7: pattern axes u and v, coordinate of the eye along them (modulo two tiles where
///            the pattern repeats)
///   box      6: x reflection of its top   7: the top's normal
/// A plane that the camera sees from behind is left out: it is a wall cut away for the view.
constexpr int kSurfaceVec4s = 8;

/// As surfaces.glsl numbers them.
enum class OtherKind { kCapsule = 0, kCylinder = 1, kRing = 2, kBowl = 3, kPipe = 4 };

struct SurfaceTable {
    std::vector<float> vec4s;
    int planes = 0;
    int boxes = 0;
    int spheres = 0;
    int others = 0;
    bool capsules = false, cylinders = false, rings = false, shells = false;  ///< among the others
    /// Some surface has it.
    bool checker = false, grid = false, wood = false, court = false, reflection = false;
    /// One vec4 of a record.
    Eigen::Vector4d at(int record, int slot) const {
        const auto first = static_cast<std::size_t>(4 * (kSurfaceVec4s * record + slot));
        return Eigen::Vector4f(vec4s.data() + first).cast<double>();
    }
    int bodies() const { return boxes + spheres + others; }
    int count() const { return planes + bodies(); }
    /// A body, which balls can pass behind; also two planes, where balls may stand behind one.
    bool can_occlude() const { return bodies() > 0 || planes > 1; }
};

/// The plane of the box's uppermost face.
PlaneShape top_of(const BoxShape& box);

SurfaceTable make_surface_table(const Scene& scene, const View& view);

/// True where the camera stands on the plane's side on which balls live.
bool seen_from_front(const PlaneShape& plane, const View& view);

}  // namespace carom
