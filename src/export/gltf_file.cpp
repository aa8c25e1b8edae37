#include "export/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/failure.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;  // glTF 2.0, 3.6.2.2
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

template <class Value>
void append(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Chunks and views begin at multiples of four bytes.
void pad(std::string& bytes, char with) {
    while (bytes.size() % 4 != 0) bytes += with;
}

}  // namespace

int GltfFile::accessor(View view, const std::string& bytes, int component, const char* type,
                       std::size_t count) {
    std::string& all = bytes_[view];
    Json json = {{"bufferView", view}};
    if (!all.empty()) json["byteOffset"] = all.size();
    json["componentType"] = component;
    json["count"] = count;
    json["type"] = type;
    all += bytes;
    pad(all, '\0');
    accessors_.push_back(std::move(json));
    return static_cast<int>(accessors_.size()) - 1;
}

int GltfFile::floats(View view, const std::vector<float>& values, const char* type,
                     std::size_t width) {
    const std::string bytes(reinterpret_cast<const char*>(values.data()),
                            values.size() * sizeof(float));
    return accessor(view, bytes, kFloat, type, values.size() / width);
}

int GltfFile::times(const std::vector<float>& values) {
    const int number = floats(kTimes, values, "SCALAR", 1);
    accessors_.back()["min"] = {values.front()};
    accessors_.back()["max"] = {values.back()};
    return number;
}

int GltfFile::vectors(const std::vector<float>& values) {
    return floats(kVectors, values, "VEC3", 3);
}

int GltfFile::quaternions(const std::vector<float>& values) {
    return floats(kQuaternions, values, "VEC4", 4);
}

int GltfFile::corners(const std::vector<Vec3>& values, bool with_extremes) {
    std::string bytes;
    std::array<float, 3> least{}, most{};
    least.fill(std::numeric_limits<float>::infinity());
    most.fill(-std::numeric_limits<float>::infinity());
    for (const Vec3& v : values)
        for (int i = 0; i < 3; ++i) {
            const auto f = static_cast<float>(v[i]);
            append(bytes, f);
            least[std::size_t(i)] = std::min(least[std::size_t(i)], f);
            most[std::size_t(i)] = std::max(most[std::size_t(i)], f);
        }
    const int number = accessor(kCorners, bytes, kFloat, "VEC3", values.size());
    if (with_extremes) {
        accessors_.back()["min"] = least;
        accessors_.back()["max"] = most;
    }
    return number;
}

Json GltfFile::primitive(const Mesh& mesh) {
    Json attributes = {{"POSITION", corners(mesh.positions, true)}};
    attributes["NORMAL"] = mesh.normals == mesh.positions ? attributes["POSITION"].get<int>()
                                                          : corners(mesh.normals, false);
    if (!mesh.places.empty()) {
        std::string bytes;
        for (const Vec2& place : mesh.places)
            for (int i = 0; i < 2; ++i)
                append(bytes, static_cast<std::uint16_t>(std::lround(65535 * place[i])));
        attributes["TEXCOORD_0"] =
            accessor(kPlaces, bytes, kUnsignedShort, "VEC2", mesh.places.size());
        accessors_.back()["normalized"] = true;
    }
    std::string bytes;
    const bool is_short = mesh.positions.size() < 65535;
    for (const std::uint32_t corner : mesh.triangles) {
        if (is_short)
            append(bytes, static_cast<std::uint16_t>(corner));
        else
            append(bytes, corner);
    }
    return {{"attributes", std::move(attributes)},
            {"indices", accessor(kTriangles, bytes, is_short ? kUnsignedShort : kUnsignedInt,
                                 "SCALAR", mesh.triangles.size())}};
}

int GltfFile::png(const std::string& bytes) {
    pngs_.push_back(bytes);
    return static_cast<int>(pngs_.size()) - 1;
}

std::string GltfFile::glb() {
    std::string binary;
    Json views = Json::array();
    std::array<int, kViews> number{};
    const auto add_view = [&](const std::string& bytes, int target, int stride) {
        pad(binary, '\0');
        Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
        if (!binary.empty()) view["byteOffset"] = binary.size();
        if (stride != 0) view["byteStride"] = stride;
        if (target != 0) view["target"] = target;
        binary += bytes;
        views.push_back(std::move(view));
        return static_cast<int>(views.size()) - 1;
    };
    for (std::size_t i = 0; i < kViews; ++i) {
        if (bytes_[i].empty()) continue;
        const bool is_corner = i == kCorners || i == kPlaces;
        number[i] = add_view(bytes_[i],
                             is_corner         ? kArrayBuffer
                             : i == kTriangles ? kElementArrayBuffer
                                               : 0,
                             is_corner ? (i == kCorners ? 12 : 4) : 0);
    }
    for (Json& accessor : accessors_)
        accessor["bufferView"] = number[accessor["bufferView"].get<std::size_t>()];
    for (const std::string& png : pngs_)
        document["images"].push_back(
            {{"bufferView", add_view(png, 0, 0)}, {"mimeType", "image/png"}});
    if (!accessors_.empty()) document["accessors"] = accessors_;
    if (!views.empty()) document["bufferViews"] = views;
    pad(binary, '\0');
    if (!binary.empty()) document["buffers"] = Json::array({Json{{"byteLength", binary.size()}}});

    std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    pad(text, ' ');
    constexpr std::size_t kHeads = 12 + 8 + 8;
    const std::size_t size = kHeads + text.size() + binary.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Failure(FailureKind::kRun,
                      fmt::format("the motion would take {:.3g} GB as .glb, whose size is a number "
                                  "of 32 bits: write .npz or .json, or shorten "
                                  "simulation.duration",
                                  static_cast<double>(size) / 1e9));
    std::string glb = "glTF";
    append(glb, std::uint32_t{2});
    append(glb, static_cast<std::uint32_t>(size));
    append(glb, static_cast<std::uint32_t>(text.size()));
    glb += "JSON" + text;
    append(glb, static_cast<std::uint32_t>(binary.size()));
    glb += std::string("BIN\0", 4) + binary;
    return glb;
}

}  // namespace carom
