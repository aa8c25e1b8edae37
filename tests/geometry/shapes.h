// One shape of each kind, turned and away from the origin.
#pragma once

#include <vector>

#include "geometry/shape.h"

namespace carom {

inline const Quat kTurned = Quat(Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()));

inline std::vector<SurfaceShape> one_of_each() {
    return {PlaneShape{Vec3(1, 2, 2) / 3, 0.4},
            BoxShape{Vec3(0.3, -0.2, 0.5), {1, 2, 0.5}, kTurned},
            SphereShape{Vec3(-1, 0.5, 2), 0.8},
            CapsuleShape{{0, 1, 0}, {1.5, 1.2, -0.4}, 0.3},
            CylinderShape{{0.2, -0.4, -0.9}, {1.1, 0.3, 0.2}, 0.6},
            RingShape{{-0.3, 0.4, 0.7}, Vec3(2, -1, 2) / 3, 1.1, 0.25},
            BowlShape{{0.2, 0.3, 0.1}, 1.3, Vec3(1, 2, 2) / 3, 0.9},
            BowlShape{{-0.2, 0.1, 0.4}, 1.1, Vec3(-2, 1, 2) / 3, 1.7},
            PipeShape{{-0.8, 0.1, 0}, {1.2, 0.1, 0}, 0.9, Vec3(0, 0.6, 0.8), 2.5},
            PipeShape{{0.1, -0.9, 0.2}, {0.1, 0.8, 0.2}, 0.7, Vec3(0.6, 0, 0.8), 4.5},
            PipeShape{{0, 0.2, -0.5}, {0, 0.2, 1.5}, 0.8, Vec3(1, 0, 0), 7}};
}

/// Places around them, inside some of them.
inline std::vector<Vec3> places() {
    std::vector<Vec3> found;
    for (const double x : {-2.1, -0.4, 0.35, 1.7})
        for (const double y : {-1.3, -0.15, 0.9, 2.2})
            for (const double z : {-1.6, 0.45, 2.05}) found.emplace_back(x, y, z);
    return found;
}

}  // namespace carom
