#include "motion/csv.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "motion/row_times.h"

namespace carom {

namespace {

/// Text is handed on in pieces of this many bytes.
constexpr std::size_t kChunk = 64 * 1024;

/// Collects rows and hands them on.
class Rows {
  public:
    explicit Rows(const TextSink& sink) : sink_(sink) {}

    void text(std::string_view s) { buffer_ += s; }
    void separator() { buffer_ += ','; }
    void end_row() {
        buffer_ += '\n';
        if (buffer_.size() >= kChunk) flush();
    }
    /// The shortest digits that read back exactly; -0 and 0 are one number.
    void number(double value) {
        fmt::format_to(std::back_inserter(buffer_), "{}", value == 0 ? 0.0 : value);
    }
    void field(double value) {
        separator();
        number(value);
    }
    void vector(const Vec3& v) {
        for (int i = 0; i < 3; ++i) field(v[i]);
    }
    void flush() {
        if (!buffer_.empty()) sink_(buffer_);
        buffer_.clear();
        ++pieces_;
    }

    std::int64_t pieces() const { return pieces_; }  ///< handed on so far

  private:
    const TextSink& sink_;
    std::int64_t pieces_ = 0;
    std::string buffer_;
};

void motion_rows(const Motion& motion, double time, Rows& rows) {
    for (std::size_t b = 0; b < motion.balls.size(); ++b) {
        const BallState state = motion.balls[b].at(time);
        rows.number(time);
        rows.separator();
        rows.text(motion.ball_names[b]);
        rows.vector(state.position);
        rows.field(state.orientation.w());
        rows.vector(state.orientation.vec());
        rows.vector(state.velocity);
        rows.vector(state.spin);
        rows.end_row();
    }
}

}  // namespace

void write_motion_csv(const Motion& motion, int rate_numerator, int rate_denominator,
                      const TextSink& sink, const std::function<void(double)>& progress,
                      const std::function<void(double)>& await) {
    Rows rows(sink);
    std::int64_t told = 0;
    rows.text("time,ball,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
    rows.end_row();

    const RowTimes times(motion.duration, rate_numerator, rate_denominator);
    for (std::int64_t k = 0; k < times.count(); ++k) {
        if (await) await(times[k]);
        motion_rows(motion, times[k], rows);
        if (!progress || rows.pieces() == told) continue;
        told = rows.pieces();
        progress(times[k]);
    }
    rows.flush();
}

void write_events_csv(const Motion& motion, const TextSink& sink) {
    Rows rows(sink);
    rows.text(
        "time,ball,other,kind,x,y,z,nx,ny,nz,"
        "approach_speed,separation_speed,restitution,impulse,tangential_impulse");
    rows.end_row();
    for (const Event& event : motion.events) {
        const auto& names = event.other.is_surface ? motion.surface_names : motion.ball_names;
        rows.number(event.time);
        for (std::string_view s :
             {std::string_view(motion.ball_names[static_cast<std::size_t>(event.ball)]),
              std::string_view(names[static_cast<std::size_t>(event.other.index)]),
              std::string_view(event_kind_name(event.kind))}) {
            rows.separator();
            rows.text(s);
        }
        rows.vector(event.point);
        rows.vector(event.normal);
        if (event.kind == EventKind::kImpact) {
            for (double v : {event.approach_speed, event.separation_speed, event.restitution,
                             event.impulse, event.tangential_impulse})
                rows.field(v);
        } else {
            rows.text(",,,,,");
        }
        rows.end_row();
    }
    rows.flush();
}

}  // namespace carom
