#include "export/motion_json.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "export/scene_json.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// Text is handed on in pieces of this many bytes.
constexpr std::size_t kChunk = 64 * 1024;

std::string dumped(const Json& json) {
    // Names of files and titles need be no UTF-8, JSON has to be.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

class Text {
  public:
    explicit Text(const TextSink& sink) : sink_(sink) {}

    Text& operator<<(std::string_view s) {
        buffer_ += s;
        if (buffer_.size() >= kChunk) flush();
        return *this;
    }
    /// The shortest digits that read back exactly; -0 and 0 are one number.
    Text& operator<<(double value) {
        fmt::format_to(std::back_inserter(buffer_), "{}", value == 0 ? 0.0 : value);
        return *this;
    }
    /// "name":[x,y,z] behind a comma; nothing where all are 0.
    void vector(std::string_view name, const Vec3& v) {
        if (v.isZero(0)) return;
        *this << ",\"" << name << "\":";
        bracketed(v);
    }
    void bracketed(const Vec3& v) { *this << "[" << v.x() << "," << v.y() << "," << v.z() << "]"; }
    void flush() {
        if (!buffer_.empty()) sink_(buffer_);
        buffer_.clear();
    }

  private:
    const TextSink& sink_;
    std::string buffer_;
};

void write_terms(std::string_view name, const Curve::Terms& terms, Text& out) {
    out << ",\"" << name << "\":[";
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (i > 0) out << ",";
        out.bracketed(terms[i]);
    }
    out << "]";
}

/// What is 0 is left out, and an orientation of 1.
void write_piece(const Piece& piece, Text& out) {
    out << "{\"t\":" << piece.start << ",\"p\":";
    out.bracketed(piece.position);
    out.vector("v", piece.velocity);
    out.vector("a", piece.acceleration);
    const Quat& q = piece.orientation;
    if (q.coeffs() != Quat::Identity().coeffs())
        out << ",\"q\":[" << q.w() << "," << q.x() << "," << q.y() << "," << q.z() << "]";
    out.vector("w", piece.spin);
    out.vector("b", piece.spin_rate);
    if (piece.curve) {
        out << ",\"curve\":{\"seconds\":" << piece.curve->seconds;
        write_terms("position", piece.curve->position, out);
        write_terms("turn", piece.curve->turn, out);
        out << "}";
    }
    out << "}";
}

void write_ball(const Scene& scene, const Motion& motion, std::size_t number, Text& out) {
    const Ball& ball = scene.balls[number];
    const std::string& material = scene.materials[static_cast<std::size_t>(ball.material)].name;
    Json head = {{"name", ball.name},
                 {"radius", ball.radius},
                 {"mass", ball.mass},
                 {"inertia_factor", ball.inertia_factor}};
    if (!material.empty()) head["material"] = material;
    head["look"] = look_json(scene.looks[static_cast<std::size_t>(ball.look)]);
    Json peaks = Json::array();
    for (const Peak& peak : motion.peaks[number]) peaks.push_back({peak.time, peak.height});
    head["peaks"] = std::move(peaks);
    std::string text = dumped(head);
    text.pop_back();
    out << text << ",\"pieces\":[";
    const char* between = "\n";
    for (const Piece& piece : motion.balls[number].pieces()) {
        out << between;
        write_piece(piece, out);
        between = ",\n";
    }
    out << "]}";
}

/// As the columns say; a row of another kind than impact ends after the normal.
void write_event(const Event& event, const Motion& motion, Text& out) {
    const auto& names = event.other.is_surface ? motion.surface_names : motion.ball_names;
    out << "[" << event.time << "," << dumped(motion.ball_names[std::size_t(event.ball)]) << ","
        << dumped(names[std::size_t(event.other.index)]) << ",\"" << event_kind_name(event.kind)
        << "\"";
    for (const Vec3& v : {event.point, event.normal})
        out << "," << v.x() << "," << v.y() << "," << v.z();
    if (event.kind == EventKind::kImpact)
        for (const double v : {event.approach_speed, event.separation_speed, event.restitution,
                               event.impulse, event.tangential_impulse})
            out << "," << v;
    out << "]";
}

}  // namespace

void write_motion_json(const Scene& scene, const Motion& motion, std::string_view version,
                       const TextSink& sink) {
    Text out(sink);
    Json head = {{"format", "carom motion"},
                 {"version", 1},
                 {"generator", fmt::format("carom {}", version)},
                 {"title", scene.title},
                 {"scene_fingerprint", fmt::format("{:016x}", scene.fingerprint)},
                 {"motion_hash", fmt::format("{:016x}", motion.hash())},
                 {"duration", motion.duration},
                 {"gravity", vector_json(scene.simulation.gravity)},
                 {"camera", camera_json(scene, motion)},
                 {"surfaces", surfaces_json(scene)}};
    std::string text = dumped(head);
    text.pop_back();
    out << text << ",\n\"balls\":[";
    for (std::size_t i = 0; i < motion.balls.size(); ++i) {
        out << (i > 0 ? ",\n" : "\n");
        write_ball(scene, motion, i, out);
    }
    out << "],\n\"event_columns\":[\"time\",\"ball\",\"other\",\"kind\",\"x\",\"y\",\"z\",\"nx\","
           "\"ny\",\"nz\",\"approach_speed\",\"separation_speed\",\"restitution\",\"impulse\","
           "\"tangential_impulse\"],\n\"events\":[";
    const char* between = "\n";
    for (const Event& event : motion.events) {
        out << between;
        write_event(event, motion, out);
        between = ",\n";
    }
    out << "]}\n";
    out.flush();
}

}  // namespace carom
