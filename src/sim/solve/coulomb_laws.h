// Newton's law and Coulomb's at several contacts at once, as equations for their impulses.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/solver_body.h"

namespace carom {

/// Per contact three unknowns, along the normal and along two tangents: its impulse over the masses
/// that it feels along and across the normal, y [m/s], which is the change of speed that it makes
/// by itself. With w the relative speeds after, w = before + coupling y, the laws are roots of
///
///   y_n - max(0, z_n)                with z = y - (w - target),
///   y_t - z_t within the disc of radius kappa max(0, z_n),
///
/// kappa = mu m_n / m_t; along the normal the target is the speed of the rebound, across it what
/// tangential restitution makes of the slip, 0 without (P. Alart and A. Curnier, "A mixed
/// formulation for frictional contact problems prone to Newton like solution methods", 1991). They
/// have no parameter to be chosen, since a contact of balls does not couple its own normal with its
/// tangents.
class CoulombLaws {
  public:
    /// `bodies` as before the impact; reads normal, arms, restitution, friction and laws of
    /// `contacts` and approach_speed, from which the targets follow: e max(u, 0), -b (the slip).
    CoulombLaws(const std::vector<ImpactBody>& bodies, const std::vector<SolverContact>& contacts);

    /// The targets are taken as `share` times their full values.
    void set_share(double share) { share_ = share; }

    Eigen::VectorXd no_impulses() const { return Eigen::VectorXd::Zero(before_.size()); }
    Eigen::VectorXd unknowns_of(const std::vector<Vec3>& impulses) const;  ///< from N s
    Vec3 impulse(std::size_t contact, const Eigen::VectorXd& y) const;     ///< N s

    /// How far impulses are from both laws, m/s per equation.
    Eigen::VectorXd residual(const Eigen::VectorXd& y) const;
    Eigen::MatrixXd jacobian(const Eigen::VectorXd& y) const;
    /// What a residual has of the roundings of its terms, as a multiple of epsilon: m/s.
    double scale(const Eigen::VectorXd& y) const;
    /// Sets all contacts right at once, each by itself and by a part that lets them agree: what is
    /// symmetric stays so.
    void relax(Eigen::VectorXd& y) const;
    /// Sets one contact after the other right.
    void sweep(Eigen::VectorXd& y) const;
    /// Whether an impulse is far above all momentum that is there.
    bool squeezes(const Eigen::VectorXd& y) const;
    /// Whether the kinetic energy grows by more than rounding.
    bool gains_energy(const Eigen::VectorXd& y) const;

  private:
    Eigen::Vector3d wanted(std::size_t contact, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& after) const;
    Eigen::Vector3d allowed(std::size_t contact, const Eigen::Vector3d& z) const;

    std::vector<Mat3> axes_;  ///< per contact: normal and tangents, as columns
    std::vector<Vec3> mass_;  ///< per contact, along them, kg
    std::vector<double> kappa_;
    std::vector<Vec3> target_;  ///< m/s
    Eigen::VectorXd before_;    ///< relative speeds, m/s
    Eigen::MatrixXd coupling_;
    double share_ = 1;
    double momentum_ = 0;  ///< of all bodies together, that of spin included, N s
    double agreeing_ = 1;  ///< part of a change that relax() makes
};

}  // namespace carom
