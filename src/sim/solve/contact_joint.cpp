#include "sim/solve/contact_joint.h"

namespace carom {

dContact contact_joint(const Touch& contact, const Vec3& center, const Vec3& slip) {
    dContact joint = {};
    joint.surface.mode = dContactSoftCFM | dContactSoftERP;  // both 0: not the world's
    to_ode(center + contact.arm, joint.geom.pos);
    to_ode(contact.normal, joint.geom.normal);
    joint.surface.mu = contact.friction;
    if (contact.friction == 0) return joint;  // no friction rows
    joint.surface.mode |= dContactApprox1;
    if (const double speed = slip.norm(); speed > 0) {
        joint.surface.mode |= dContactFDir1;
        // Across the normal again after the division, where a tiny slip is mostly rounding.
        to_ode(tangential_part(slip / speed, contact.normal).normalized(), joint.fdir1);
    }
    return joint;
}

void let_bounce(dContact& joint, double restitution) {
    joint.surface.mode |= dContactBounce;
    joint.surface.bounce = restitution;
    joint.surface.bounce_vel = 0;
}

void reverse_slip(dContact& joint, double part, const Vec3& slip) {
    if ((joint.surface.mode & dContactFDir1) == 0) return;
    joint.surface.mode |= dContactMotion1;
    joint.surface.motion1 = -part * slip.dot(from_ode(joint.fdir1));
}

void keep_above(dContact& joint, double speed) {
    joint.surface.mode |= dContactMotionN;
    joint.surface.motionN = speed;
}

void share_island(dContact& joint) {
    joint.surface.soft_cfm = kIslandCfm;
    if (joint.surface.mu == 0) return;
    joint.surface.mode |= dContactSlip1 | dContactSlip2;
    joint.surface.slip1 = joint.surface.slip2 = kIslandCfm;
}

void resist_first_axis_only(dContact& joint) {
    joint.surface.mode |= dContactMu2;
    joint.surface.mu2 = 0;
}

}  // namespace carom
