// From the validated document to the Scene, one function per part. Each reports what only it can
// see, and leaves defaults where the document is wrong, so that one run finds every mistake.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/document.h"
#include "scene/fields.h"
#include "scene/keys.h"
#include "scene/report.h"
#include "scene/scene.h"

namespace carom {

/// Where a body of the scene comes from. Geometry that was found wrong takes no part in the search
/// for overlaps: one mistake, one message.
struct BodyOrigin {
    const Node* node = nullptr;
    bool sound = true;
};

/// What the parts share while a scene is being built.
struct Build {
    const KeyTable& table;
    Report& report;
    const Node& root;
    Scene& scene;
    std::map<std::string, int> material_index{};
    std::map<std::string, int> look_index{};
    std::map<std::string, int> default_looks{};  ///< looks that carom made up, by what they are for
    std::vector<const Node*> material_nodes{};   ///< by material; null where the file has none
    std::vector<BodyOrigin> ball_origins{};      ///< by ball
    std::vector<BodyOrigin> surface_origins{};   ///< by surface

    Fields fields(Section section, const Node* map) const { return {table, section, map}; }
    Fields top() const { return fields(Section::kScene, &root); }
    /// The entries of a list or mapping of the file's top level; none if it is left out.
    const std::vector<Node>& entries(std::string_view key) const;
};

// In this order: later ones use what earlier ones filled in.
void build_setup(Build& build);  // title, simulation, film
void build_air(Build& build);
void build_materials(Build& build);  // materials and pairs
void build_looks(Build& build);
void build_surfaces(Build& build);
void build_balls(Build& build);
void build_overlay(Build& build);
void build_camera(Build& build);
void build_test(Build& build);
void build_against(Build& build);
void check_names(Build& build);             // unique over balls and surfaces
void check_overlaps(Build& build);          // at the start
void check_flights(Build& build);           // what air asks of balls
void check_restitution_laws(Build& build);  // of materials that may meet
void warn_of_half_friction(Build& build);   // and of rolling resistance, the same
void warn_without_friction(Build& build);   // of what has no effect then

/// A coefficient over the approach speed, from a mapping that is valid. Reports points that are not
/// in order, and separation speeds that fall; empty then.
std::optional<RestitutionLaw> restitution_law_of(Build& build, const Fields& fields);

/// The material that a reference names; the catalogue's are added when they are first asked for.
/// Reports an unknown name and returns the default material.
int resolve_material(Build& build, const Node& reference);
int preset_material(Build& build, const std::string& preset_name);

/// The look that a reference names; reports an unknown name and returns -1.
int resolve_look(Build& build, const Node& reference);

/// What a ball's key `drag` or `lift` says; it is there.
Drag read_drag(Build& build, const Fields& fields);
Lift read_lift(Build& build, const Fields& fields);

/// Index of the ball that a reference names; reports an unknown name and returns -1.
int resolve_ball(Build& build, const Node& reference);

/// The look of things that name none, made when it is first asked for. `purpose` tells them apart.
int default_look(Build& build, const std::string& purpose, const Look& look);

}  // namespace carom
