// A scene made by a program instead of a file.
#pragma once

#include <carom/scene.h>

#include <memory>
#include <string>

CAROM_NAMESPACE_BEGIN

/// A ball; what is left as it is has the default of a scene file.
struct BallSpec {
    std::string name;
    Vec3 position{};              ///< of the centre, m
    double radius = 0.1;          ///< m
    double mass = 1;              ///< kg
    double inertia_factor = 0.4;  ///< k of I = k m r^2: 2/5 solid, 2/3 thin shell
    Vec3 velocity{};              ///< m/s
    Vec3 spin{};                  ///< rad/s, world axes
    std::string material{};       ///< "" for the default: restitution 1, no friction
    std::string look{};
};

/// Collects parts and hands them to the same reader that reads files, so that the same rules
/// and the same messages hold. Names are checked by build(), not before.
class CAROM_API SceneBuilder {
  public:
    SceneBuilder();
    ~SceneBuilder();
    SceneBuilder(SceneBuilder&&) noexcept;
    SceneBuilder& operator=(SceneBuilder&&) noexcept;

    SceneBuilder& title(const std::string& text);
    SceneBuilder& duration(double seconds);
    SceneBuilder& gravity(const Vec3& metres_per_s2);
    /// A material by its own coefficients, each against a reference of 1.
    SceneBuilder& material(const std::string& name, double restitution, double friction = 0);
    /// The points p with normal . p = offset; balls live on the side that the normal points to.
    SceneBuilder& plane(const std::string& name, const Vec3& normal, double offset,
                        const std::string& material = "");
    /// Full edges, along the axes.
    SceneBuilder& box(const std::string& name, const Vec3& position, const Vec3& size,
                      const std::string& material = "");
    SceneBuilder& sphere(const std::string& name, const Vec3& position, double radius,
                         const std::string& material = "");
    SceneBuilder& ball(const BallSpec& spec);
    /// Any surface or ball as a file says it, in YAML: surface("{name: hoop, ring: {...}}").
    SceneBuilder& surface(const std::string& yaml);
    SceneBuilder& ball(const std::string& yaml);
    /// Any other key, as --set does: set("film.fps", "30"), set("overlay", "{clock: true}").
    SceneBuilder& set(const std::string& path, const std::string& yaml);

    /// The document so far, as a file would have it.
    std::string yaml() const;
    /// Throws SceneError with every mistake.
    Scene build() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

CAROM_NAMESPACE_END
