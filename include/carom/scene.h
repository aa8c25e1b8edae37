// A scene: what a YAML file says, validated, with every default filled in.
#pragma once

#include <carom/error.h>
#include <carom/export.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

CAROM_NAMESPACE_BEGIN

/// Metres, seconds, radians; z points up, right-handed.
using Vec3 = std::array<double, 3>;

/// A value of the scene's document that is changed before it is validated, as --set does: a
/// path by keys, names or [i], and YAML: {"balls.a.mass", "1"}.
using Setting = std::pair<std::string, std::string>;

/// Cheap to copy: copies share one, which never changes. Safe from several threads at once.
class CAROM_API Scene {
  public:
    /// Throws SceneError with every mistake, Error where the file cannot be read.
    static Scene from_file(const std::string& path, const std::vector<Setting>& settings = {});
    /// The same of YAML; `name` stands for the file in messages.
    static Scene from_text(const std::string& yaml, const std::vector<Setting>& settings = {},
                           const std::string& name = "<text>");

    std::string title() const;
    /// s; empty: until all rests.
    std::optional<double> duration() const;
    std::vector<std::string> balls() const;     ///< names, in the scene's order; repeats unrolled
    std::vector<std::string> surfaces() const;  ///< names, in the scene's order
    std::vector<double> radii() const;          ///< of the balls, m
    std::vector<double> masses() const;         ///< of the balls, kg
    std::pair<int, int> size() const;           ///< of the picture, pixels
    double fps() const;
    std::vector<double> stills() const;  ///< s
    const std::vector<Diagnostic>& warnings() const;

    struct Impl;
    explicit Scene(std::shared_ptr<const Impl> impl);
    const Impl& impl() const { return *impl_; }

  private:
    std::shared_ptr<const Impl> impl_;
};

CAROM_NAMESPACE_END
