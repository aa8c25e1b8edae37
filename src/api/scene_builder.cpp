#include <carom/scene_builder.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace carom::v1 {

/// Lines of the document; flow YAML, in which JSON's texts are texts.
struct SceneBuilder::Impl {
    std::string title, materials, surfaces, balls;
    std::string duration, gravity;
    std::vector<Setting> settings;
};

namespace {

/// A text in double quotes: JSON's are YAML's.
std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string list(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string named(const char* key, const std::string& name) {
    return name.empty() ? "" : fmt::format(", {}: {}", key, quoted(name));
}

}  // namespace

SceneBuilder::SceneBuilder() : impl_(std::make_unique<Impl>()) {}
SceneBuilder::~SceneBuilder() = default;
SceneBuilder::SceneBuilder(SceneBuilder&&) noexcept = default;
SceneBuilder& SceneBuilder::operator=(SceneBuilder&&) noexcept = default;

SceneBuilder& SceneBuilder::title(const std::string& text) {
    impl_->title = fmt::format("title: {}\n", quoted(text));
    return *this;
}

SceneBuilder& SceneBuilder::duration(double seconds) {
    impl_->duration = fmt::format("duration: {}", seconds);
    return *this;
}

SceneBuilder& SceneBuilder::gravity(const Vec3& metres_per_s2) {
    impl_->gravity = "gravity: " + list(metres_per_s2);
    return *this;
}

SceneBuilder& SceneBuilder::material(const std::string& name, double restitution, double friction) {
    // Without friction none is named: a pair of which one names it gives a warning.
    const std::string second = friction == 0 ? "" : fmt::format(", friction: {}", friction);
    impl_->materials +=
        fmt::format("  {}: {{restitution: {}{}}}\n", quoted(name), restitution, second);
    return *this;
}

SceneBuilder& SceneBuilder::plane(const std::string& name, const Vec3& normal, double offset,
                                  const std::string& material) {
    return surface(fmt::format("{{name: {}, plane: {{normal: {}, offset: {}}}{}}}", quoted(name),
                               list(normal), offset, named("material", material)));
}

SceneBuilder& SceneBuilder::box(const std::string& name, const Vec3& position, const Vec3& size,
                                const std::string& material) {
    return surface(fmt::format("{{name: {}, box: {{position: {}, size: {}}}{}}}", quoted(name),
                               list(position), list(size), named("material", material)));
}

SceneBuilder& SceneBuilder::sphere(const std::string& name, const Vec3& position, double radius,
                                   const std::string& material) {
    return surface(fmt::format("{{name: {}, sphere: {{position: {}, radius: {}}}{}}}", quoted(name),
                               list(position), radius, named("material", material)));
}

SceneBuilder& SceneBuilder::ball(const BallSpec& spec) {
    return ball(fmt::format(
        "{{name: {}, position: {}, radius: {}, mass: {}, inertia: {}, velocity: {}, spin: {}{}{}}}",
        quoted(spec.name), list(spec.position), spec.radius, spec.mass, spec.inertia_factor,
        list(spec.velocity), list(spec.spin), named("material", spec.material),
        named("look", spec.look)));
}

SceneBuilder& SceneBuilder::surface(const std::string& yaml) {
    impl_->surfaces += "  - " + yaml + "\n";
    return *this;
}

SceneBuilder& SceneBuilder::ball(const std::string& yaml) {
    impl_->balls += "  - " + yaml + "\n";
    return *this;
}

SceneBuilder& SceneBuilder::set(const std::string& path, const std::string& yaml) {
    impl_->settings.emplace_back(path, yaml);
    return *this;
}

std::string SceneBuilder::yaml() const {
    const std::string between = impl_->duration.empty() || impl_->gravity.empty() ? "" : ", ";
    std::string text = "carom: 1\n" + impl_->title;
    if (!impl_->duration.empty() || !impl_->gravity.empty())
        text += fmt::format("simulation: {{{}{}{}}}\n", impl_->duration, between, impl_->gravity);
    if (!impl_->materials.empty()) text += "materials:\n" + impl_->materials;
    if (!impl_->surfaces.empty()) text += "surfaces:\n" + impl_->surfaces;
    if (!impl_->balls.empty()) text += "balls:\n" + impl_->balls;
    return text;
}

Scene SceneBuilder::build() const {
    return Scene::from_text(yaml(), impl_->settings, "<built scene>");
}

}  // namespace carom::v1
