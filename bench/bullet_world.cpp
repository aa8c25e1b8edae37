#include "bullet_world.h"

#include <btBulletDynamicsCommon.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/failure.h"
#include "scene/virtual_body.h"
#include "sim/contact/restitution.h"
#include "sim/record/recorder.h"

namespace carom::bench {

namespace {

static_assert(sizeof(btScalar) == sizeof(double), "link bullet-float64");

constexpr int kIterations = 50;
constexpr double kSleepSpeed = 1e-3;  // m/s and rad/s

btVector3 to_bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion to_bullet(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }

using ShapePtr = std::unique_ptr<btCollisionShape>;

/// A shape with its place in the world.
struct Placed {
    ShapePtr shape;
    btTransform place = btTransform::getIdentity();
};

Placed place(const PlaneShape& plane) {
    return {std::make_unique<btStaticPlaneShape>(to_bullet(plane.normal), plane.offset_m)};
}
Placed place(const BoxShape& box) {
    return {std::make_unique<btBoxShape>(to_bullet(Vec3(0.5 * box.size))),
            btTransform(to_bullet(box.orientation), to_bullet(box.center))};
}
Placed place(const SphereShape& sphere) {
    return {std::make_unique<btSphereShape>(sphere.radius),
            btTransform(btQuaternion::getIdentity(), to_bullet(sphere.center))};
}
Placed place(const CapsuleShape& capsule) {
    const Vec3 axis = capsule.to - capsule.from;
    const Quat turn = axis.isZero(0) ? Quat::Identity() : Quat::FromTwoVectors(Vec3::UnitZ(), axis);
    return {std::make_unique<btCapsuleShapeZ>(capsule.radius, axis.norm()),
            btTransform(to_bullet(turn), to_bullet(Vec3(0.5 * (capsule.from + capsule.to))))};
}

Placed place(const CylinderShape& cylinder) {
    const Vec3 axis = cylinder.to - cylinder.from;
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitZ(), axis);
    const btVector3 half(cylinder.radius, cylinder.radius, 0.5 * axis.norm());
    return {std::make_unique<btCylinderShapeZ>(half),
            btTransform(to_bullet(turn), to_bullet(Vec3(0.5 * (cylinder.from + cylinder.to))))};
}

/// Bullet has no torus and no hollow shapes but meshes; no case has one.
Placed place(const RingShape&) { throw std::invalid_argument("Bullet has no ring"); }
Placed place(const BowlShape&) { throw std::invalid_argument("Bullet has no bowl"); }
Placed place(const PipeShape&) { throw std::invalid_argument("Bullet has no pipe"); }

// Bullet's hook for pairs: each object carries the table and its material.
PairProperties pair_of(const btCollisionObject* a, const btCollisionObject* b) {
    const auto* table = static_cast<const PairTable*>(a->getUserPointer());
    return table->at(a->getUserIndex(), b->getUserIndex());
}
btScalar pair_restitution(const btCollisionObject* a, const btCollisionObject* b) {
    return pair_of(a, b).restitution;
}
btScalar pair_friction(const btCollisionObject* a, const btCollisionObject* b) {
    return pair_of(a, b).friction;
}

/// What a ball touched in the last step.
struct Touch {
    bool any = false;
    bool impact = false;  ///< approached faster than gravity explains
};

class BulletWorld : public SteppedWorld {
  public:
    BulletWorld(const Scene& scene, double step);
    ~BulletWorld() override;

    void step() override { world_.stepSimulation(step_, 1, step_); }
    Vec3 position(std::size_t i) const override {
        return from_bullet(balls_[i]->getWorldTransform().getOrigin());
    }
    Vec3 velocity(std::size_t i) const override {
        return from_bullet(balls_[i]->getLinearVelocity());
    }
    Vec3 spin(std::size_t i) const override { return from_bullet(balls_[i]->getAngularVelocity()); }
    /// Needs the velocities before that step.
    void read_touches(const std::vector<Velocities>& before, std::vector<Touch>& touches) const;

  private:
    void set_solver();
    void add_surface(const Scene& scene, const Surface& surface);
    void add_ball(const Scene& scene, const Ball& ball);
    btRigidBody* add(const Scene& scene, Placed placed, double mass, const btVector3& inertia,
                     int material);

    double step_;
    double gravity_;
    PairTable pairs_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<ShapePtr> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<btRigidBody*> balls_;
    decltype(gCalculateCombinedRestitutionCallback) default_restitution_;
    decltype(gCalculateCombinedFrictionCallback) default_friction_;
};

BulletWorld::BulletWorld(const Scene& scene, double step)
    : step_(step),
      gravity_(scene.simulation.gravity.norm()),
      pairs_(scene),
      default_restitution_(gCalculateCombinedRestitutionCallback),
      default_friction_(gCalculateCombinedFrictionCallback) {
    world_.setGravity(to_bullet(scene.simulation.gravity));
    set_solver();
    if (!scene.pairs.empty()) {
        gCalculateCombinedRestitutionCallback = pair_restitution;
        gCalculateCombinedFrictionCallback = pair_friction;
    }
    for (const Surface& surface : scene.surfaces) add_surface(scene, surface);
    for (const Ball& ball : scene.balls) add_ball(scene, ball);
}

BulletWorld::~BulletWorld() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    gCalculateCombinedRestitutionCallback = default_restitution_;
    gCalculateCombinedFrictionCallback = default_friction_;
}

void BulletWorld::set_solver() {
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_restitutionVelocityThreshold = 0;
    info.m_warmstartingFactor = 0;  // but not its mode: without that Bullet forgets the impulses
    info.m_splitImpulse = 1;
    info.m_splitImpulsePenetrationThreshold = 0;
    info.m_numIterations = kIterations;
}

btRigidBody* BulletWorld::add(const Scene& scene, Placed placed, double mass,
                              const btVector3& inertia, int material) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, placed.shape.get(), inertia);
    info.m_startWorldTransform = placed.place;
    const Material& of = scene.materials.at(static_cast<std::size_t>(material));
    info.m_restitution = rigid_restitution(of.virtual_body, scene.simulation.restitution_constant);
    info.m_friction = of.friction.value_or(0);
    auto body = std::make_unique<btRigidBody>(info);
    body->setContactProcessingThreshold(0);
    body->setUserPointer(&pairs_);
    body->setUserIndex(material);
    world_.addRigidBody(body.get());
    shapes_.push_back(std::move(placed.shape));
    bodies_.push_back(std::move(body));
    return bodies_.back().get();
}

void BulletWorld::add_surface(const Scene& scene, const Surface& surface) {
    Placed placed = std::visit([](const auto& shape) { return place(shape); }, surface.shape);
    add(scene, std::move(placed), 0, btVector3(0, 0, 0), surface.material);
}

void BulletWorld::add_ball(const Scene& scene, const Ball& ball) {
    const double inertia = ball.inertia_factor * ball.mass * ball.radius * ball.radius;
    btRigidBody* body = add(scene, place(SphereShape{ball.position, ball.radius}), ball.mass,
                            btVector3(inertia, inertia, inertia), ball.material);
    body->setLinearVelocity(to_bullet(ball.velocity));
    body->setAngularVelocity(to_bullet(ball.spin));
    body->setSleepingThresholds(kSleepSpeed, kSleepSpeed);
    if (ball.velocity.norm() * step_ > ball.radius) {
        body->setCcdMotionThreshold(0.5 * ball.radius);
        body->setCcdSweptSphereRadius(0.9 * ball.radius);
    }
    body->setUserIndex2(static_cast<int>(balls_.size()));  // -1 stands for a surface
    balls_.push_back(body);
}

void BulletWorld::read_touches(const std::vector<Velocities>& before,
                               std::vector<Touch>& touches) const {
    std::fill(touches.begin(), touches.end(), Touch{});
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
        // getManifoldByIndexInternal() is const only in effect.
        const btPersistentManifold* manifold =
            const_cast<btCollisionDispatcher&>(dispatcher_).getManifoldByIndexInternal(m);
        for (int c = 0; c < manifold->getNumContacts(); ++c) {
            const btManifoldPoint& point = manifold->getContactPoint(c);
            if (point.getAppliedImpulse() <= 0) continue;
            const int a = manifold->getBody0()->getUserIndex2();
            const int b = manifold->getBody1()->getUserIndex2();
            const Vec3 normal = from_bullet(point.m_normalWorldOnB);
            Vec3 relative = Vec3::Zero();
            if (a >= 0) relative += before[static_cast<std::size_t>(a)].linear;
            if (b >= 0) relative -= before[static_cast<std::size_t>(b)].linear;
            const bool impact = -relative.dot(normal) > 2 * gravity_ * step_;
            for (const int ball : {a, b}) {
                if (ball < 0) continue;
                touches[static_cast<std::size_t>(ball)].any = true;
                touches[static_cast<std::size_t>(ball)].impact |= impact;
            }
        }
    }
}

void check_finite(const Scene& scene, std::size_t ball, const Vec3& position, double time) {
    if (position.allFinite()) return;
    throw Failure(FailureKind::kRun,
                  fmt::format("the state of ball '{}' is not finite after the step at t = {} s",
                              scene.balls[ball].name, time));
}

}  // namespace

std::unique_ptr<SteppedWorld> make_bullet_world(const Scene& scene, double step) {
    return std::make_unique<BulletWorld>(scene, step);
}

SimulationResult simulate_bullet(const Scene& scene, double step,
                                 const SimulationProgress& progress) {
    BulletWorld world(scene, step);
    const double duration = scene.simulation.duration.value_or(scene.simulation.max_duration);
    const auto steps = static_cast<std::int64_t>(std::ceil(duration / step - 1e-9));
    const std::size_t balls = scene.balls.size();
    std::vector<Recorder> recorders;
    std::vector<Velocities> before(balls);
    std::vector<Vec3> position(balls);
    std::vector<Touch> touches(balls);
    for (std::size_t i = 0; i < balls; ++i) {
        recorders.emplace_back(scene.balls[i].radius, scene.simulation.gravity);
        position[i] = world.position(i);
        before[i] = {world.velocity(i), world.spin(i)};
    }
    for (std::int64_t n = 0; n < steps; ++n) {
        const double start = static_cast<double>(n) * step;
        if (progress && n % 64 == 0) progress(start);
        world.step();
        world.read_touches(before, touches);
        for (std::size_t i = 0; i < balls; ++i) {
            Step now;
            now.start = start;
            now.end = static_cast<double>(n + 1) * step;
            now.position = position[i];
            now.before = before[i];
            now.end_position = position[i] = world.position(i);
            now.mean = before[i] = {world.velocity(i), world.spin(i)};
            now.touching = touches[i].any;
            now.impact = touches[i].impact;
            check_finite(scene, i, position[i], start);
            recorders[i].add(now);
        }
    }
    SimulationResult result;
    result.motion.duration = duration;
    for (const Ball& ball : scene.balls) result.motion.ball_names.push_back(ball.name);
    for (const Surface& s : scene.surfaces) result.motion.surface_names.push_back(s.name);
    for (Recorder& recorder : recorders) result.motion.balls.push_back(recorder.finish());
    result.motion.peaks.resize(balls);
    result.report.steps = steps;
    return result;
}

std::string bullet_version() {
    return fmt::format("Bullet {}.{} (double)", btGetVersion() / 100, btGetVersion() % 100);
}

}  // namespace carom::bench
