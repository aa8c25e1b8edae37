#include "sim/group/pile_solver.h"

#include <algorithm>
#include <cmath>

#include "sim/solve/gauss_seidel.h"

namespace carom {

namespace {

/// Gives an impulse, n x of its tangential part at hand, to a body; `sign` -1 for the other one.
void push(PileBody& body, const Vec3& impulse, const Vec3& turn, double sign) {
    body.velocity += sign * body.inverse_mass * impulse;
    body.rim -= body.inverse_spin * turn;
}

class PileRows {
  public:
    /// Changes of a body up to `still` [m/s] do not count.
    PileRows(std::vector<PileBody>& bodies, std::vector<PileRow>& rows, double still)
        : bodies_(bodies), rows_(rows), still_(still) {
        for (PileRow& row : rows_) {
            body(row.ball).changed = 0;
            if (row.other >= 0) body(row.other).changed = 0;
        }
        for (PileRow& row : rows_) prepare(row);
    }

    std::size_t size() const { return rows_.size(); }
    bool relax(std::size_t i) { return relax(rows_[i]); }

  private:
    void prepare(PileRow& row) {
        const PileBody& a = body(row.ball);
        double normal = a.inverse_mass, across = a.inverse_mass + a.inverse_spin;
        if (row.other >= 0) {
            const PileBody& b = body(row.other);
            normal += b.inverse_mass;
            across += b.inverse_mass + b.inverse_spin;
        }
        row.normal_mass = 1 / normal;
        row.tangential_mass = 1 / across;
        row.relaxed = -1;
        if (!(row.friction > 0)) row.tangential.setZero();
        if (row.push > 0) give(row, row.push * row.normal + row.tangential, row.tangential);
    }

    bool relax(PileRow& row) {
        const int since = row.relaxed;
        PileBody& a = body(row.ball);
        PileBody* b = row.other >= 0 ? &body(row.other) : nullptr;
        if (a.changed <= since && (b == nullptr || b->changed <= since)) return false;
        row.relaxed = ++clock_;

        if (!(row.friction > 0)) return relax_smooth(row, a, b);
        const Vec3& n = row.normal;
        const Vec3 apart = b == nullptr ? a.velocity : Vec3(a.velocity - b->velocity);
        const double before = row.push;
        row.push = std::max(before + (row.target - apart.dot(n)) * row.normal_mass, 0.0);
        const double change = row.push - before;
        Vec3 impulse = change * n, turn = Vec3::Zero();
        if (row.push > 0 || before > 0) {
            const Vec3 slip = b == nullptr
                                  ? Vec3(apart - apart.dot(n) * n + n.cross(a.rim))
                                  : Vec3(apart - apart.dot(n) * n + n.cross(a.rim + b->rim));
            Vec3 tangential = row.tangential - row.tangential_mass * slip;
            const double bound = row.friction * row.push, size2 = tangential.squaredNorm();
            if (size2 > bound * bound) tangential *= bound / std::sqrt(size2);
            const Vec3 step = tangential - row.tangential;
            row.tangential = tangential;
            impulse += step;
            turn = n.cross(step);
        }
        push(a, impulse, turn, 1);
        if (b != nullptr) push(*b, impulse, turn, -1);
        return note(row, a, b, impulse.norm());
    }

    /// Without friction only speeds along the normal count.
    bool relax_smooth(PileRow& row, PileBody& a, PileBody* b) {
        const double speed =
            b == nullptr ? a.velocity.dot(row.normal) : (a.velocity - b->velocity).dot(row.normal);
        const double before = row.push;
        row.push = std::max(before + (row.target - speed) * row.normal_mass, 0.0);
        const double change = row.push - before;
        if (change == 0) return false;
        a.velocity += change * a.inverse_mass * row.normal;
        if (b != nullptr) b->velocity -= change * b->inverse_mass * row.normal;
        return note(row, a, b, std::abs(change));
    }

    /// Both bodies have got an impulse of this size [N s]: whether it counts for one of them.
    bool note(PileRow& row, PileBody& a, PileBody* b, double size) {
        const bool a_moved = size * a.inverse_mass > still_;
        const bool b_moved = b != nullptr && size * b->inverse_mass > still_;
        // The contact itself is right now: only the others of these bodies are called on.
        if (a_moved) a.changed = clock_ + 1;
        if (b_moved) b->changed = clock_ + 1;
        if (a_moved || b_moved) row.relaxed = ++clock_;
        return a_moved || b_moved;
    }

    PileBody& body(int i) { return bodies_[static_cast<std::size_t>(i)]; }
    void give(PileRow& row, const Vec3& impulse, const Vec3& tangential) {
        const Vec3 turn = row.normal.cross(tangential);
        push(body(row.ball), impulse, turn, 1);
        if (row.other >= 0) push(body(row.other), impulse, turn, -1);
    }

    std::vector<PileBody>& bodies_;
    std::vector<PileRow>& rows_;
    double still_;
    int clock_ = 0;
};

}  // namespace

void sweep_pile(std::vector<PileBody>& bodies, std::vector<PileRow>& rows,
                const PileSweeps& sweeps) {
    PileRows contacts(bodies, rows, sweeps.still);
    gauss_seidel(contacts, SweepOrder::kThereAndBack, sweeps.most,
                 [](bool moved) { return !moved; });
}

}  // namespace carom
