// A glTF 2.0 document with its binary data, as one .glb.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "export/mesh.h"

namespace carom {

/// Collects data, one buffer view for each use of it, and gives numbers of accessors.
class GltfFile {
  public:
    nlohmann::ordered_json document;  ///< all but accessors, views and the buffer

    /// Accessors of `values`, tightly packed. A time has its extremes with it.
    int times(const std::vector<float>& values);
    int vectors(const std::vector<float>& values);      ///< 3 floats each, of an animation
    int quaternions(const std::vector<float>& values);  ///< 4 floats each, of an animation

    /// The primitive of a mesh without its material; with places in a texture where `textured`.
    nlohmann::ordered_json primitive(const Mesh& mesh);

    /// A picture, encoded; its number among the images.
    int png(const std::string& bytes);

    /// The whole file: header, JSON, binary data (glTF 2.0, 4.4). Failure(kRun) beyond 4 GB.
    std::string glb();

  private:
    enum View { kTimes, kVectors, kQuaternions, kCorners, kPlaces, kTriangles, kViews };

    int accessor(View view, const std::string& bytes, int component, const char* type,
                 std::size_t count);
    int floats(View view, const std::vector<float>& values, const char* type, std::size_t width);
    int corners(const std::vector<Vec3>& values, bool with_extremes);

    std::array<std::string, kViews> bytes_;
    std::vector<std::string> pngs_;
    nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

}  // namespace carom
