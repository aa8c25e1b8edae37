#include <carom/scene.h>
#include <carom/version.h>

#include <algorithm>

#include "api/inner.h"
#include "scene/reader.h"

namespace carom::v1 {

Error::~Error() = default;
SceneError::~SceneError() = default;
Stopped::~Stopped() = default;

const char* version() { return CAROM_VERSION; }

namespace {

std::vector<Override> overrides_of(const std::vector<Setting>& settings) {
    std::vector<Override> overrides;
    for (const auto& [path, value] : settings) overrides.push_back({path, value});
    return overrides;
}

std::vector<Diagnostic> plain(const Diagnostics& diagnostics) {
    std::vector<Diagnostic> result;
    for (const carom::Diagnostic& d : diagnostics.items())
        result.push_back({d.severity == Severity::kError, d.file, d.mark.line, d.mark.column,
                          d.message, d.shown()});
    return result;
}

}  // namespace

Scene scene_from(SceneSource source) {
    SceneResult result = read_scene(source.text, source.file, source.overrides);
    std::vector<Diagnostic> diagnostics = plain(result.diagnostics);
    if (!result.scene) {
        std::string text;
        for (const Diagnostic& d : diagnostics) text += d.shown;
        while (text.ends_with('\n')) text.pop_back();
        throw SceneError(text, std::move(diagnostics));
    }
    return Scene(std::make_shared<Scene::Impl>(
        Scene::Impl{std::move(*result.scene), std::move(diagnostics), std::move(source)}));
}

namespace {

template <class Things, class Member>
auto members(const Things& things, Member member) {
    std::vector<std::decay_t<decltype(things[0].*member)>> values;
    for (const auto& thing : things) values.push_back(thing.*member);
    return values;
}

}  // namespace

Scene::Scene(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Scene Scene::from_file(const std::string& path, const std::vector<Setting>& settings) {
    return translated([&] {
        return scene_from({read_scene_text(path), path, overrides_of(settings)});
    });
}

Scene Scene::from_text(const std::string& yaml, const std::vector<Setting>& settings,
                       const std::string& name) {
    return translated([&] { return scene_from({yaml, name, overrides_of(settings)}); });
}

std::string Scene::title() const { return impl_->scene.title; }
std::optional<double> Scene::duration() const { return impl_->scene.simulation.duration; }
std::vector<std::string> Scene::balls() const {
    return members(impl_->scene.balls, &carom::Ball::name);
}
std::vector<std::string> Scene::surfaces() const {
    return members(impl_->scene.surfaces, &carom::Surface::name);
}
std::vector<double> Scene::radii() const {
    return members(impl_->scene.balls, &carom::Ball::radius);
}
std::vector<double> Scene::masses() const {
    return members(impl_->scene.balls, &carom::Ball::mass);
}
std::pair<int, int> Scene::size() const {
    return {impl_->scene.film.width_px, impl_->scene.film.height_px};
}
double Scene::fps() const { return impl_->scene.film.fps.per_second(); }
std::vector<double> Scene::stills() const { return impl_->scene.film.stills; }
const std::vector<Diagnostic>& Scene::warnings() const { return impl_->warnings; }

}  // namespace carom::v1
