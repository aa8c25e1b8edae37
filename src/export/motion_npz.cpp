#include "export/motion_npz.h"

#include <limits>
#include <vector>

#include "export/npz.h"

namespace carom {

namespace {

constexpr std::size_t kChunkBytes = 1 << 20;

/// -0 and 0 are one number, as in the CSV files.
double plain(double value) { return value + 0.0; }

/// Writes one array of `width` numbers for each time and ball; `of` puts those of a piece at an
/// instant.
class StateArrays {
  public:
    StateArrays(const Motion& motion, const RowTimes& times, NpzWriter& npz,
                const std::function<void(double)>& told)
        : motion_(motion), times_(times), npz_(npz), told_(told) {}

    template <class Of>
    void put(const char* name, std::int64_t width, Of&& of) {
        const std::size_t balls = motion_.balls.size();
        npz_.begin(name, "<f8", {times_.count(), static_cast<std::int64_t>(balls), width});
        std::vector<std::size_t> piece(balls, 0);  // times increase: the search goes on from here
        std::vector<double> values;
        for (std::int64_t k = 0; k < times_.count(); ++k) {
            const double t = times_[k];
            for (std::size_t b = 0; b < balls; ++b) {
                const std::vector<Piece>& pieces = motion_.balls[b].pieces();
                while (piece[b] + 1 < pieces.size() && pieces[piece[b] + 1].start <= t) ++piece[b];
                of(pieces[piece[b]], t, values);
            }
            if (values.size() * sizeof(double) >= kChunkBytes) flush(values, k);
        }
        flush(values, times_.count());
        done_ += 1;
    }

  private:
    static constexpr double kArrays = 4;

    void flush(std::vector<double>& values, std::int64_t k) {
        npz_.write(values.data(), values.size() * sizeof(double));
        values.clear();
        if (told_)
            told_((done_ + static_cast<double>(k) / static_cast<double>(times_.count())) / kArrays);
    }

    const Motion& motion_;
    const RowTimes& times_;
    NpzWriter& npz_;
    const std::function<void(double)>& told_;
    double done_ = 0;
};

void put_states(const Motion& motion, const RowTimes& times, NpzWriter& npz,
                const std::function<void(double)>& told) {
    StateArrays arrays(motion, times, npz, told);
    const auto append = [](const Vec3& v, std::vector<double>& out) {
        for (int i = 0; i < 3; ++i) out.push_back(plain(v[i]));
    };
    arrays.put("position", 3, [&](const Piece& piece, double t, std::vector<double>& out) {
        append(piece.position_at(t), out);
    });
    arrays.put("orientation", 4, [&](const Piece& piece, double t, std::vector<double>& out) {
        const Quat q = piece.at(t).orientation;
        out.push_back(plain(q.w()));
        append(q.vec(), out);
    });
    arrays.put("velocity", 3, [&](const Piece& piece, double t, std::vector<double>& out) {
        append(piece.velocity_at(t), out);
    });
    arrays.put("spin", 3, [&](const Piece& piece, double t, std::vector<double>& out) {
        append(piece.spin_at(t), out);
    });
}

/// One number of every event.
template <class Value, class Of>
std::vector<Value> column(const Motion& motion, Of&& of) {
    std::vector<Value> values;
    values.reserve(motion.events.size());
    for (const Event& event : motion.events) values.push_back(of(event));
    return values;
}

void put_events(const Motion& motion, NpzWriter& npz) {
    const auto put = [&](const char* name, auto of) {
        npz.put(name, column<double>(motion, [&](const Event& e) { return plain(of(e)); }));
    };
    const auto put_vectors = [&](const char* name, Vec3 Event::*member) {
        std::vector<double> values;
        for (const Event& event : motion.events)
            for (int i = 0; i < 3; ++i) values.push_back(plain((event.*member)[i]));
        npz.put(name, values, {static_cast<std::int64_t>(motion.events.size()), 3});
    };
    // What only impacts have is empty in EVENTS.csv, and no number here.
    const auto of_impact = [](double Event::*member) {
        return [member](const Event& e) {
            return e.kind == EventKind::kImpact ? e.*member
                                                : std::numeric_limits<double>::quiet_NaN();
        };
    };
    put("event_time", [](const Event& e) { return e.time; });
    npz.put("event_ball", column<std::int32_t>(motion, [](const Event& e) { return e.ball; }));
    npz.put("event_other",
            column<std::int32_t>(motion, [](const Event& e) { return e.other.index; }));
    npz.put_flags("event_other_is_surface", column<std::uint8_t>(motion, [](const Event& e) {
                      return std::uint8_t(e.other.is_surface ? 1 : 0);
                  }));
    npz.put("event_kind", column<std::string>(motion, [](const Event& e) {
                return std::string(event_kind_name(e.kind));
            }));
    put_vectors("event_point", &Event::point);
    put_vectors("event_normal", &Event::normal);
    put("event_approach_speed", of_impact(&Event::approach_speed));
    put("event_separation_speed", of_impact(&Event::separation_speed));
    put("event_restitution", of_impact(&Event::restitution));
    put("event_impulse", of_impact(&Event::impulse));
    put("event_tangential_impulse", of_impact(&Event::tangential_impulse));
}

}  // namespace

void write_motion_npz(const Scene& scene, const Motion& motion, const RowTimes& times,
                      const std::string& path, const std::function<void(double)>& told) {
    NpzWriter npz(path);
    npz.put("balls", motion.ball_names);
    npz.put("surfaces", motion.surface_names);
    std::vector<double> radii, masses;
    for (const Ball& ball : scene.balls) {
        radii.push_back(ball.radius);
        masses.push_back(ball.mass);
    }
    npz.put("radius", radii);
    npz.put("mass", masses);
    npz.begin("time", "<f8", {times.count()});
    for (std::int64_t k = 0; k < times.count(); ++k) {
        const double t = times[k];
        npz.write(&t, sizeof t);
    }
    put_states(motion, times, npz, told);
    put_events(motion, npz);
    npz.finish();
}

}  // namespace carom
