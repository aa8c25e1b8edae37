// The vectors and rotations that every stage shares. World frame: right-handed, z up, SI units.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;   ///< unit; rotates body coordinates into world coordinates
using Box3 = Eigen::AlignedBox3d;  ///< sides along the axes

}  // namespace carom
