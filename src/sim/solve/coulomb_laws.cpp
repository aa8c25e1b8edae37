#include "sim/solve/coulomb_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/contact_laws.h"
#include "sim/solve/contact_rows.h"

namespace carom {

namespace {

/// Roundings of a sum of some dozen terms, relative to the terms.
constexpr double kSumRounding = 64 * std::numeric_limits<double>::epsilon();

/// Impulses above so many times all momentum are no answer: contacts that squeeze each other.
constexpr double kSqueeze = 100;

/// A contact's arm from the centre of this ball, and the sign of its impulse on it; 0 for others.
double side_of(const SolverContact& c, int body, Vec3& arm) {
    if (c.body == body) {
        arm = c.arm;
        return 1;
    }
    if (c.on_surface() || c.other_body != body) return 0;
    arm = c.arm_other;
    return -1;
}

/// Speed at the first contact by an impulse at the second, through one body:
/// v + w x a = P/m + (b x P) x a / I = (1/m + a.b/I) P - b (a.P) / I.
Mat3 through(const ImpactBody& body, const Vec3& a, const Vec3& b) {
    return (1 / body.mass + a.dot(b) / body.inertia) * Mat3::Identity() -
           b * a.transpose() / body.inertia;
}

Mat3 axes_at(const Vec3& normal) {
    Mat3 axes;
    axes.col(0) = normal;
    axes.col(1) = normal.unitOrthogonal();
    axes.col(2) = normal.cross(axes.col(1));
    return axes;
}

Eigen::Index at(std::size_t contact) { return static_cast<Eigen::Index>(3 * contact); }

}  // namespace

CoulombLaws::CoulombLaws(const std::vector<ImpactBody>& bodies,
                         const std::vector<SolverContact>& contacts)
    : before_(at(contacts.size())), coupling_(at(contacts.size()), at(contacts.size())) {
    std::vector<int> contacts_of(bodies.size(), 0);
    int most = 1;
    std::vector<ImpactBody> same = bodies;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const SolverContact& c = contacts[i];
        const ContactRow row(same, c, 0);
        axes_.push_back(axes_at(c.normal));
        mass_.emplace_back(row.normal_mass, row.tangential_mass, row.tangential_mass);
        kappa_.push_back(c.friction * row.normal_mass / row.tangential_mass);
        before_.segment<3>(at(i)) = axes_.back().transpose() * row.speed();
        target_.emplace_back(-tangential_restitution(c) * before_.segment<3>(at(i)));
        target_.back()[0] = c.restitution * std::max(c.approach_speed, 0.0);
        most = std::max(most, ++contacts_of[static_cast<std::size_t>(c.body)]);
        if (!c.on_surface())
            most = std::max(most, ++contacts_of[static_cast<std::size_t>(c.other_body)]);
    }
    agreeing_ = 1.0 / most;
    for (const ImpactBody& b : bodies)
        momentum_ += b.mass * b.velocities.linear.norm() +
                     std::sqrt(b.inertia * b.mass) * b.velocities.spin.norm();
    for (std::size_t i = 0; i < contacts.size(); ++i)
        for (std::size_t j = 0; j < contacts.size(); ++j) {
            Mat3 both = Mat3::Zero();
            const auto add = [&](int body) {
                Vec3 a, b;
                const double sign = side_of(contacts[i], body, a) * side_of(contacts[j], body, b);
                if (sign != 0) both += sign * through(bodies[static_cast<std::size_t>(body)], a, b);
            };
            add(contacts[i].body);
            if (!contacts[i].on_surface()) add(contacts[i].other_body);
            coupling_.block<3, 3>(at(i), at(j)) =
                axes_[i].transpose() * both * axes_[j] * mass_[j].asDiagonal();
        }
}

Eigen::VectorXd CoulombLaws::unknowns_of(const std::vector<Vec3>& impulses) const {
    Eigen::VectorXd y = no_impulses();
    for (std::size_t i = 0; i < impulses.size(); ++i)
        y.segment<3>(at(i)) = (axes_[i].transpose() * impulses[i]).cwiseQuotient(mass_[i]);
    return y;
}

Vec3 CoulombLaws::impulse(std::size_t contact, const Eigen::VectorXd& y) const {
    return axes_[contact] * mass_[contact].cwiseProduct(Vec3(y.segment<3>(at(contact))));
}

/// z of the header.
Eigen::Vector3d CoulombLaws::wanted(std::size_t contact, const Eigen::VectorXd& y,
                                    const Eigen::VectorXd& after) const {
    const Eigen::Index i = at(contact);
    Eigen::Vector3d z = y.segment<3>(i) - after.segment<3>(i);
    return z + share_ * target_[contact];
}

/// What both laws make of z.
Eigen::Vector3d CoulombLaws::allowed(std::size_t contact, const Eigen::Vector3d& z) const {
    Eigen::Vector3d result(std::max(z[0], 0.0), z[1], z[2]);
    const double bound = kappa_[contact] * result[0], size = z.tail<2>().norm();
    if (size > bound) result.tail<2>() *= bound / size;
    return result;
}

Eigen::VectorXd CoulombLaws::residual(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd after = before_ + coupling_ * y;
    Eigen::VectorXd result = y;
    for (std::size_t c = 0; c < kappa_.size(); ++c)
        result.segment<3>(at(c)) -= allowed(c, wanted(c, y, after));
    return result;
}

Eigen::MatrixXd CoulombLaws::jacobian(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd after = before_ + coupling_ * y;
    const Eigen::Index size = before_.size();
    const Eigen::MatrixXd of_z = Eigen::MatrixXd::Identity(size, size) - coupling_;
    Eigen::MatrixXd result = Eigen::MatrixXd::Identity(size, size);
    for (std::size_t c = 0; c < kappa_.size(); ++c) {
        const Eigen::Vector3d z = wanted(c, y, after);
        const Eigen::Index n = at(c);
        if (!(z[0] > 0)) continue;  // open: no impulse
        result.row(n) -= of_z.row(n);
        const double bound = kappa_[c] * z[0], slip = z.tail<2>().norm();
        if (!(slip > bound)) {
            result.middleRows<2>(n + 1) -= of_z.middleRows<2>(n + 1);
        } else {
            const Eigen::Vector2d along = z.tail<2>() / slip;
            const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along * along.transpose();
            result.middleRows<2>(n + 1) -=
                kappa_[c] * along * of_z.row(n) + bound / slip * across * of_z.middleRows<2>(n + 1);
        }
    }
    return result;
}

double CoulombLaws::scale(const Eigen::VectorXd& y) const {
    return (before_.cwiseAbs() + coupling_.cwiseAbs() * y.cwiseAbs()).maxCoeff();
}

void CoulombLaws::relax(Eigen::VectorXd& y) const { y -= agreeing_ * residual(y); }

void CoulombLaws::sweep(Eigen::VectorXd& y) const {
    Eigen::VectorXd after = before_ + coupling_ * y;
    for (std::size_t c = 0; c < kappa_.size(); ++c) {
        const Eigen::Vector3d change = allowed(c, wanted(c, y, after)) - y.segment<3>(at(c));
        y.segment<3>(at(c)) += change;
        after += coupling_.middleCols<3>(at(c)) * change;
    }
}

bool CoulombLaws::squeezes(const Eigen::VectorXd& y) const {
    double largest = 0;
    for (std::size_t c = 0; c < mass_.size(); ++c)
        largest = std::max(largest, mass_[c][0] * y[at(c)]);
    return largest > kSqueeze * momentum_;
}

/// The work of all impulses, p.(before + after) / 2.
bool CoulombLaws::gains_energy(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd mean = before_ + 0.5 * coupling_ * y;
    double work = 0, terms = 0;
    for (std::size_t c = 0; c < mass_.size(); ++c)
        for (Eigen::Index k = 0; k < 3; ++k) {
            const double term = mass_[c][k] * y[at(c) + k] * mean[at(c) + k];
            work += term;
            terms += std::abs(term);
        }
    return work > kSumRounding * terms;
}

}  // namespace carom
