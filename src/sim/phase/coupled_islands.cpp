#include "sim/phase/coupled_islands.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/contact_laws.h"
#include "sim/group/island_step.h"
#include "sim/integrate/uniform_piece.h"
#include "sim/law/contact_modes.h"
#include "sim/world/energy_account.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// What has been no faster than the rounding of its speeds for so long is at rest.
constexpr double kStillSeconds = 2;

/// At rest gravity sets nothing in motion but roundings, as fractions of g and of the speeds.
constexpr double kCoupledBalance = 1e-12;

/// Integrated velocities leave this fraction of the speeds of a 0.
constexpr double kRoundingSpeed = 1e-11;

/// An island whose laws change all the time, as between balls that are being poured, is stepped for
/// a while: so many pieces are shorter than a step, and none between them has lasted for one. What
/// was to last longer, and was cut at once by an impact, tells nothing.
constexpr int kMostCoupledShortPieces = 60;
constexpr double kRestlessSeconds = 0.25;

/// All contacts and their modes as one number.
std::uint64_t modes_of(const CoupledContacts& system) {
    std::uint64_t modes = system.ball_count;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        modes = 64 * modes + 16 * static_cast<std::uint64_t>(c.ball) +
                4 * static_cast<std::uint64_t>(c.other + 1) + static_cast<std::uint64_t>(c.mode);
    }
    return modes;
}

bool is_still(const CoupledContacts& system, const CoupledState& state,
              const CoupledForces& forces) {
    const double speed = kCoupledBalance * speed_of(system, {});
    const double pull = kCoupledBalance * system.gravity.norm();
    for (std::size_t b = 0; b < system.ball_count; ++b)
        if (state[b].v.norm() > speed || forces.acceleration[b].norm() > pull ||
            system.balls[b].radius * forces.spin_rate[b].norm() > pull)
            return false;
    return std::all_of(
        system.contacts.begin(), system.contacts.begin() + system.contact_count,
        [](const CoupledContact& c) { return !c.presses || c.mode != ContactMode::kSliding; });
}

}  // namespace

/// The island as a system of its own. False if it is too large, or not together.
bool CoupledIslands::coupled_system(const std::vector<int>& island, double now,
                                    CoupledIsland& is) const {
    if (island.size() > (has_many_balls(world_) ? 2 : kMostCoupledBalls)) return false;
    if (world_.scene.simulation.gravity.isZero(0)) return false;
    CoupledContacts& system = is.system;
    system.gravity = world_.scene.simulation.gravity;
    system.ball_count = island.size();
    const auto place = [&island](int ball) {
        return static_cast<int>(std::find(island.begin(), island.end(), ball) - island.begin());
    };
    for (std::size_t b = 0; b < island.size(); ++b) {
        const ExactBall& body = world_.ball(island[b]);
        system.balls[b] = {body.radius, body.mass, body.inertia_factor,
                           world_.buoyant_part(island[b]),
                           world_.feels_air(island[b]) ? &world_.air(island[b]) : nullptr};
        const Velocities velocities = world_.velocities(island[b], now);
        is.state[b] = {world_.position(island[b], now), velocities.linear, velocities.spin};
        for (const Link& link : links_.of(island[b])) {
            const Contact c = world_.contact_at(island[b], link.partner, now);
            if (c.ball != island[b]) continue;
            if (is_resisted(c)) return false;  // their moments are a step's to apply
            if (system.contact_count == kMostCoupledContacts || -c.depth < -kLinkGap * body.radius)
                return false;
            CoupledContact& contact = system.contacts[system.contact_count++];
            contact.ball = place(c.ball);
            contact.friction = c.friction;
            if (link.slip_begins) contact.mode = ContactMode::kIncipient;
            if (c.other.is_surface) {
                contact.feature =
                    single_contact(world_.surface(c.other.index).shape, is.state[b].x,
                                   tangential_part(velocities.linear, c.normal), body.radius,
                                   world_.pull_on(island[b], velocities));
                add_borders_of_others(world_, c, is.state[b], contact.feature);
            } else {
                contact.other = place(c.other.index);
                contact.feature.distance = body.radius + world_.ball(c.other.index).radius;
            }
            is.contacts.push_back(c);
        }
    }
    return true;
}

/// After steps of ODE gaps are shut that a step does not see; if that lifts balls, their speeds
/// pay. False where they cannot.
bool CoupledIslands::pay_for_places(const std::vector<int>& island, double now,
                                    CoupledIsland& is) const {
    if (std::none_of(island.begin(), island.end(),
                     [this](int ball) { return world_.ball(ball).coarse; }))
        return true;
    EnergyAccount account;
    std::vector<Vec3> old_places, places;
    std::vector<Velocities> old_velocities, velocities;
    for (std::size_t b = 0; b < island.size(); ++b) {
        const ExactBall& ball = world_.ball(island[b]);
        old_places.push_back(world_.position(island[b], now));
        old_velocities.push_back(world_.velocities(island[b], now));
        account.add(ball.mass, ball.inertia_factor * ball.mass * ball.radius * ball.radius,
                    ball.radius, old_places.back(), is.system.pull(b));
        places.push_back(is.state[b].x);
        velocities.push_back({is.state[b].v, is.state[b].w});
    }
    const double excess =
        account.total(places, velocities) - account.total(old_places, old_velocities);
    if (!account.can_pay(excess, velocities)) return false;
    if (!account.take_away(excess, velocities)) return true;
    for (std::size_t b = 0; b < island.size(); ++b) {
        is.state[b].v = velocities[b].linear;
        is.state[b].w = velocities[b].spin;
    }
    return true;
}

/// Series that are over end now.
void CoupledIslands::land_now(CoupledIsland& is, double now) const {
    std::array<bool, kMostCoupledContacts> gives_back{};
    bool lands = false;
    for (std::size_t i = 0; i < is.contacts.size(); ++i) {
        if (notes_.landing_of(is.contacts[i], now) == nullptr) continue;
        lands = true;
        // The first hop had none.
        gives_back[i] = now == 0 || log_.slid_in_impact(is.contacts[i], now);
    }
    if (lands) land(is.system, gives_back, is.state);
}

/// Contacts that do not press any more part.
CoupledIslands::Parted CoupledIslands::part(CoupledIsland& is, const CoupledForces& before,
                                            const CoupledForces& forces, double rounding_speed,
                                            double now) {
    Parted parted = Parted::kNone;
    for (std::size_t i = 0; i < is.contacts.size(); ++i) {
        if (is.system.contacts[i].presses) continue;
        const Separation* parting = notes_.separation_of(is.contacts[i], now);
        // What still approaches is left to a step.
        if (before.contacts[i].speed < -rounding_speed || (parting != nullptr && parting->pressed))
            return Parted::kStepInstead;
        if (is_idle(is.system, forces.contacts[i])) continue;
        island_links_.unlink(is.contacts[i], now);
        parted = Parted::kSome;
    }
    return parted;
}

CoupledIslands::Outcome CoupledIslands::integrate(const std::vector<int>& island, double now) {
    CoupledIsland is;
    if (!coupled_system(island, now, is)) return Outcome::kImpossible;
    if (island.size() == 1 && is.contacts.size() < 2) return Outcome::kImpossible;
    const CoupledForces before = coupled_forces(is.system, is.state);
    const double rounding_speed = kRoundingSpeed * speed_of(is.system, is.state);
    land_now(is, now);
    if (!choose_modes(is.system, is.state)) return Outcome::kImpossible;
    if (!pay_for_places(island, now, is)) return Outcome::kImpossible;
    CoupledForces forces = coupled_forces(is.system, is.state);
    const Parted parted = part(is, before, forces, rounding_speed, now);
    if (parted == Parted::kStepInstead) return Outcome::kImpossible;
    CoupledPiece piece;
    if (parted == Parted::kSome) {  // what is left of the island is due again
        begin_pieces(island, now, is, piece, rounding_speed);
        return Outcome::kGoesOn;
    }
    const bool still = is_still(is.system, is.state, forces);
    if (!still) piece = piece_of(island.front(), now, is, forces);
    if (!still && !(piece.seconds > 0)) return Outcome::kImpossible;
    begin_pieces(island, now, is, piece, rounding_speed);
    note_forces(is, forces, still, now);
    ++log_.report.integrated;
    // A series that is over has its row at its end.
    const double row = island_links_.next_contact_event(island, now);
    for (const int ball : island) {
        double& end = world_.ball(ball).phase_end;
        end = still ? row : std::min(end, row);
    }
    const bool rests =
        std::isinf(row) && (still || is_at_rest(island, is, forces, now, piece.seconds));
    return rests ? Outcome::kRests : Outcome::kGoesOn;
}

/// A piece of no length is one at rest.
void CoupledIslands::begin_pieces(const std::vector<int>& island, double now,
                                  const CoupledIsland& is, const CoupledPiece& piece,
                                  double rounding_speed) {
    for (std::size_t b = 0; b < island.size(); ++b) {
        ExactBall& ball = world_.ball(island[b]);
        BallState at = world_.state(island[b], now);
        at.position = is.state[b].x;
        at.velocity = is.state[b].v;
        at.spin = is.state[b].w;
        ++links_.member(island[b]).steps;
        ball.rounding_speed = rounding_speed;
        ball.phase_end = now + piece.seconds;
        ball.coarse = false;
        world_.begin_piece(island[b], now, at, piece.balls[b].acceleration,
                           piece.balls[b].spin_rate,
                           piece.seconds > 0 && piece.curved ? OptionalCurve(piece.balls[b].curve)
                                                             : OptionalCurve());
    }
}

/// The next piece; of no length where the island has to be stepped.
CoupledPiece CoupledIslands::piece_of(int first_ball, double now, CoupledIsland& is,
                                      CoupledForces& forces) {
    if (std::optional<CoupledPiece> steady =
            steady_piece(is.system, is.state, forces, now, end_ - now))
        return *steady;
    PieceGuess& guess = guesses_[first_ball];
    if (now < guess.stepped_until) return {};
    const std::uint64_t modes = modes_of(is.system);
    CoupledPiece piece =
        next_piece(is.system, is.state, now, guess.modes == modes ? guess.seconds : 0);
    // What ends at once is over.
    for (std::size_t i = 0; i < 2 * is.contacts.size() && piece.seconds == 0; ++i) {
        if (piece.end == CoupledEnd::kParts) {
            is.system.contacts[piece.contact].presses = false;
        } else if (piece.end != CoupledEnd::kGripEnds ||
                   !begin_slip(is.system, is.state, piece.contact)) {
            return {};
        }
        forces = coupled_forces(is.system, is.state);
        if (!is.system.contacts[piece.contact].presses &&
            !is_idle(is.system, forces.contacts[piece.contact]))
            return {};
        piece = next_piece(is.system, is.state, now, 0);
    }
    guess.seconds = piece.next_seconds;
    guess.modes = modes;
    if (std::min(now - guess.begun, guess.lasts) >= kIslandStep) guess.short_pieces = 0;
    guess.begun = now;
    guess.lasts = piece.seconds;
    if (piece.seconds < kIslandStep) ++guess.short_pieces;
    if (guess.short_pieces > kMostCoupledShortPieces) {
        guess.short_pieces = 0;
        guess.stepped_until = now + kRestlessSeconds;
        ++log_.report.given_up;
    }
    return piece;
}

/// Whether the speeds and slips of the island have long been what rounding leaves, `seconds` of it
/// ahead. Newton's first law knows no lowest speed but that.
bool CoupledIslands::is_at_rest(const std::vector<int>& island, const CoupledIsland& is,
                                const CoupledForces& forces, double now, double seconds) {
    const double slow = kRoundingSpeed * speed_of(is.system, {});
    bool calm = std::all_of(island.begin(), island.end(), [&](int ball) {
        return world_.velocities(ball, now).linear.norm() <= slow &&
               world_.velocities(ball, now + seconds).linear.norm() <= slow;
    });
    for (std::size_t i = 0; i < is.contacts.size(); ++i)
        calm =
            calm && (is.system.contacts[i].friction == 0 || forces.contacts[i].slip.norm() <= slow);
    bool long_enough = calm;
    for (const int ball : island) {
        IslandMember& m = links_.member(ball);
        m.slow_steps = calm ? m.slow_steps + static_cast<int>(seconds / kIslandStep) + 1 : 0;
        long_enough = long_enough && m.slow_steps * kIslandStep >= kStillSeconds;
    }
    return long_enough;
}

/// What the rows say about the contacts, whose kinds are known.
void CoupledIslands::note_forces(const CoupledIsland& is, const CoupledForces& forces, bool still,
                                 double now) {
    for (std::size_t i = 0; i < is.contacts.size(); ++i) {
        const Contact& contact = is.contacts[i];
        const CoupledContactForces& at = forces.contacts[i];
        const ContactMode mode = is.system.contacts[i].mode;
        const bool presses = is.system.contacts[i].presses;
        island_links_.note_push(
            contact,
            presses ? Vec3(kIslandStep * (at.push * at.normal + at.friction)) : Vec3(Vec3::Zero()));
        for (Link& link : links_.of(contact.ball)) {
            if (link.partner != contact.other) continue;
            link.pressed = presses;
            link.slip_begins = mode == ContactMode::kIncipient;
            if (!link.pressed) continue;
            link.last = contact;
            if (still || kind_of(mode) == link.kind.stated() || row_waits(link, now)) continue;
            if (link.kind.state(kind_of(mode))) log_.add(kind_of(mode), contact, now);
        }
    }
}

}  // namespace carom
