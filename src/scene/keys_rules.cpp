// What stands around the rows of the table: rules between keys, and what sections are.
#include "scene/keys.h"

namespace carom {

std::vector<Rule> key_rules() {
    using enum Section;
    return {
        {kMaterial, Rule::Kind::kAtMostOne, {"restitution", "virtual_body"}},
        {kVirtualBody, Rule::Kind::kAboveZeroWith, {"distance", "velocity"}},
        {kRestitution, Rule::Kind::kExactlyOne, {"speed", "power", "viscoelastic"}},
        {kRestitution, Rule::Kind::kExactlyOne, {"value", "power", "viscoelastic"}},
        {kPair,
         Rule::Kind::kAtLeastOne,
         {"restitution", "friction", "rolling", "pivoting", "tangential_restitution"}},
        {kSurface,
         Rule::Kind::kExactlyOne,
         {"plane", "box", "sphere", "capsule", "cylinder", "ring", "bowl", "pipe"}},
        {kBox, Rule::Kind::kAtMostOne, {"rotation_deg", "quaternion"}},
        {kCamera, Rule::Kind::kExactlyOne, {"from", "path"}},
        {kCamera, Rule::Kind::kExactlyOne, {"to", "path"}},
        {kCamera, Rule::Kind::kAtMostOne, {"follow", "path"}},
        {kCamera, Rule::Kind::kAtMostOne, {"orbit_deg_per_s", "path"}},
        {kCamera, Rule::Kind::kAtMostOne, {"fov_deg", "focal_mm"}},
        {kCamera, Rule::Kind::kAtMostOne, {"fov_deg", "orthographic"}},
        {kCamera, Rule::Kind::kAtMostOne, {"focal_mm", "orthographic"}},
        {kAir, Rule::Kind::kAtMostOne, {"density", "temperature_c"}},
        {kAir, Rule::Kind::kAtMostOne, {"density", "pressure_pa"}},
        {kAir, Rule::Kind::kAtMostOne, {"density", "humidity"}},
        {kDragTable, Rule::Kind::kExactlyOne, {"speed", "reynolds"}},
        {kBall, Rule::Kind::kAtMostOne, {"position", "drop_height"}},
        {kBall, Rule::Kind::kAtMostOne, {"position", "at"}},
        {kAgainst, Rule::Kind::kAtLeastOne, {"scene", "set"}},
    };
}

std::vector<SectionDoc> section_docs() {
    using enum Section;
    return {
        {kScene, "scene", "", "The keys of the file."},
        {kSimulation, "simulation", "simulation", "How the motion is computed."},
        {kAir, "air", "air",
         "The air: it acts on every ball, in flight and in contact (docs/real-balls.md)."},
        {kMaterial, "material", "materials.NAME",
         "What a material does in contact; the rule for a pair is the product of both numbers."},
        {kVirtualBody, "virtual_body", "materials.NAME.virtual_body",
         "The paper's virtual body; its coefficient against a rigid body is "
         "exp(-K distance / (2 velocity))."},
        {kRestitution, "restitution", "materials.NAME.restitution",
         "A coefficient that depends on the approach speed v: measured values, or a law. The "
         "separation speed must not fall where v grows."},
        {kPowerRestitution, "power_restitution", "materials.NAME.restitution.power",
         "value (v / at_speed)^(-exponent), at most 1."},
        {kViscoelasticRestitution, "viscoelastic_restitution",
         "materials.NAME.restitution.viscoelastic",
         "1 - gamma v^(1/5) + 3/5 gamma^2 v^(2/5), v in m/s; constant beyond its lowest point, "
         "7/12."},
        {kPair, "pair", "pairs[]",
         "Replaces what two materials' numbers amount to by what is measured. `restitution` may be "
         "a "
         "mapping here too, as a material's."},
        {kLook, "look", "looks.NAME", "Colours and markings."},
        {kSurface, "surface", "surfaces[]", "A static body: one shape, a material, a look."},
        {kPlane, "plane", "surfaces[].plane",
         "The points p with normal . p = offset; balls live on the side that the normal points "
         "to."},
        {kBox, "box", "surfaces[].box", "A solid box."},
        {kSphere, "sphere", "surfaces[].sphere", "A solid sphere."},
        {kCapsule, "capsule", "surfaces[].capsule", "All points within `radius` of a segment."},
        {kCylinder, "cylinder", "surfaces[].cylinder",
         "A solid cylinder with flat ends; balls meet its rims as edges."},
        {kRing, "ring", "surfaces[].ring", "All points within `tube_radius` of a circle: a torus."},
        {kBowl, "bowl", "surfaces[].bowl",
         "The part of a sphere up to `depth` from its lowest point: a wall without thickness, "
         "which "
         "balls meet from inside, from outside and at its rim."},
        {kPipe, "pipe", "surfaces[].pipe",
         "The part of a cylinder around a segment, within angle_deg/2 of the direction opposite to "
         "`opening`: a wall without thickness, as a bowl's."},
        {kDefaults, "defaults", "defaults", "What fills in for values that are left out."},
        {kBallDefaults, "ball_defaults", "defaults.ball",
         "Fills what a ball, and the preset that the ball names, leave out. The keys are those of "
         "`balls[]`:"},
        {kBall, "ball", "balls[]", "A ball, or with `repeat` a grid of equal ones."},
        {kDragTable, "drag_table", "balls[].drag", "Measured drag coefficients."},
        {kLiftTable, "lift_table", "balls[].lift", "Measured lift coefficients."},
        {kRepeat, "repeat", "balls[].repeat",
         "A grid of balls named NAME_i_j_k, i along x, j along y, k along z, each counted from 0."},
        {kCamera, "camera", "camera",
         "Where the picture is taken from: a pinhole, or parallel rays; it stands still, unless "
         "one of "
         "`follow`, `orbit_deg_per_s` and `path` moves it. The view depends on the motion's time "
         "alone."},
        {kCameraKey, "camera_key", "camera.path[]", "Where the camera is at one instant."},
        {kFilm, "film", "film",
         "Size and timing of the film; frame n shows start + speed n / fps where the speed "
         "is constant."},
        {kSpeedKey, "speed_key", "film.speed[]", "The film's speed at one instant."},
        {kOverlay, "overlay", "overlay", "Most are `false`, `true`, or a mapping with options."},
        {kTest, "test", "test",
         "The rule of a drop test. Whether the ball passes is printed by the commands, written by "
         "--stats, and drawn in the last two seconds of the film."},
        {kRuler, "ruler", "overlay.ruler", "A vertical scale in metres."},
        {kClock, "clock", "overlay.clock", "The time of the motion in seconds."},
        {kTrail, "trail", "overlay.trail", "The path of each ball's centre."},
        {kLabels, "labels", "overlay.labels", "The balls' names."},
        {kTitle, "title", "overlay.title", "The scene's title, at the top of the picture."},
        {kPeaks, "peaks", "overlay.peaks",
         "An outline of the ball at each peak reached so far, with the gap under it in metres."},
        {kVelocity, "velocity", "overlay.velocity",
         "The balls' velocities at the picture's instant, from their centres."},
        {kPlot, "plot", "overlay.plot",
         "Height of the balls' lowest points over time, up to the picture's instant."},
        {kAgainst, "against", "against",
         "A second run that films, stills and goldens show with the first. Balls of the same name "
         "belong together."},
    };
}

}  // namespace carom
