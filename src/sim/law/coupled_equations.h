// The linear equations of the forces between linked balls.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "sim/law/coupled_contacts.h"

namespace carom {

inline constexpr int kMostForces = 3 * static_cast<int>(kMostCoupledContacts);
using ForceSizes = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostForces, 1>;

/// Geometry and relative motion at a contact, seen from its `ball`.
struct ContactMotion {
    Vec3 n, n_rate, across_speed, turn_speed, slip;
    double gap = 0, speed = 0;
};
struct ContactMotions {
    std::array<ContactMotion, kMostCoupledContacts> contacts;
    std::array<Vec3, kMostCoupledBalls> pull;  ///< of gravity and air, m/s^2, per ball

    ContactMotion& operator[](std::size_t i) { return contacts[i]; }
    const ContactMotion& operator[](std::size_t i) const { return contacts[i]; }
};

ContactMotions contact_motions(const CoupledContacts& system, const CoupledState& state);

/// A force, and the one direction in which it is to set the relative motion at its contact right.
struct ForceRow {
    std::size_t contact = 0;
    Vec3 n, along, force;
    bool normal = true;
};

/// Linear and angular changes of all balls.
struct CoupledChange {
    std::array<Vec3, kMostCoupledBalls> linear, spin;

    CoupledChange() {
        linear.fill(Vec3::Zero());
        spin.fill(Vec3::Zero());
    }
};

/// The equations of all contacts that press, one per normal and two more where it rolls.
class ForceEquations {
  public:
    enum class Rows { kNormals, kNormalsAndSlips };
    enum class Sliding { kSmooth, kHeldBack };  ///< by mu N against the slip

    ForceEquations(const CoupledContacts& system, const ContactMotions& at, Rows rows,
                   Sliding sliding);

    std::size_t count() const { return count_; }
    const ForceRow& row(std::size_t i) const { return rows_[i]; }

    /// The forces that change what the rows look at by `wanted`. Of many answers the one with next
    /// to no friction, and then the smallest.
    ForceSizes solve(const ForceSizes& wanted) const;

    /// What a force on the contact's ball, and its opposite on the other, changes for row i.
    double effect(std::size_t i, const ForceRow& acts, const Vec3& force) const;

    /// Adds what it does to the balls.
    void apply(const ForceRow& acts, const Vec3& force, CoupledChange& change) const;
    void apply(const ForceSizes& sizes, CoupledChange& change) const;

  private:
    const CoupledContacts& system_;
    std::array<ForceRow, kMostForces> rows_;
    std::size_t count_ = 0;
};

}  // namespace carom
