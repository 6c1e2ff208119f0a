// SPDX-License-Identifier: BSD-3-Clause
//
// Proofs of passage. Why a certificate holds: docs/explanation/proof-of-runs.md.
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/proof.h>

#include <vericone/cones/opening/opening.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "proof/common_point.h"
#include "proof/convex.h"
#include "proof/padding.h"
#include "proof/separation.h"
#include "proof/time_search.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Of a passage; pieces tried at most to raise the bound on the least distance.
constexpr std::size_t kMostPassagePieces = 50'000;
constexpr int kMostMeasured = 200;

/// How questions about the rim are asked: to a part of the distance, or whether it is more than so much.
constexpr std::uint32_t kMostPoints = 3000;
constexpr RimQuestion kMeasure{3e-3, -1, kMostPoints};
constexpr RimQuestion asking(double threshold) { return {1e-2, threshold, kMostPoints}; }

/// The agent in the frame of the opening at one time.
struct Sight {
  double t = 0;
  Vector3d position;  // of its reference point
  Matrix3d rotation;
  Motion motion;  // in the world
  Vector3d center;
};

/// Where the body is all over a piece of time.
enum class Where : std::uint8_t {
  above,   // on the side that the normal points to
  below,   // on the other
  inside,  // what of it is in the plane, if anything, is inside of the opening
  around,  // what of it is in the plane, if anything, is outside of it
};

/// A piece that is proved.
struct ProvedPiece {
  TimeSpan<Sight> span;
  Where where = Where::above;
  double bound = 0;  // of the distance from the rim, metres
  bool measured = false;
};

/// That a body is clear of a rim, and of its wall, and on which side of it.
class Clear {
 public:
  using Moment = Sight;
  using Leaf = ProvedPiece;
  using Span = TimeSpan<Sight>;

  Clear(const Track& agent, const MovingOrifice& orifice, const ProofOptions& options, double from, double to)
      : agent_(agent),
        orifice_(orifice),
        opening_(orifice.opening),
        placed_{orifice.opening, Vector3d::Zero(), Eigen::Matrix<double, 3, 2>::Identity()},
        padding_(options, agent.appears()),
        spin_(orifice.spin.norm()),
        of_places_(rounding_of(agent, from, to)) {
    if (agent.shape().rigid()) rigid_ = convex_around(agent.shape(), agent.appears(), agent.appears());
  }

  Sight at(double t) const {
    const guidance::OrificeState state = orifice_.at(t);
    Matrix3d frame;
    frame << state.opening.axes, state.opening.normal();
    frame = orthonormal<3>(frame);
    const Motion motion = agent_.motion(t);
    return {t, frame.transpose() * (motion.position - state.opening.center),
            frame.transpose() * motion.rotation, motion, state.opening.center};
  }

  /// A point that the body as it is then has in common with rim or wall.
  std::optional<Vector3d> meeting(const Sight& s) const {
    const Convex around = body(s.t, s.t).posed(s.position, s.rotation);
    if (around.support(Vector3d::UnitZ()) < 0 || around.support(-Vector3d::UnitZ()) < 0) return std::nullopt;
    WorldBody there = shape_at(agent_.shape(), s.t, s.position, s.rotation);
    if (const Placed* placed = there.placed()) {
      if (placed->body.hull())
        there = vericone::in_world(*placed->body.hull(), placed->pose);
      else if (placed->body.quadric())
        there = vericone::in_world(*placed->body.quadric(), placed->pose);
      else
        return std::nullopt;
    }
    const auto common = common_point(there, opening_, orifice_.wall, rounding(s, around.reach()));
    if (!common) return std::nullopt;
    return Vector3d(common->x(), common->y(), 0);
  }

  bool meets(const Sight& s) const { return meeting(s).has_value(); }

  TimeLook<ProvedPiece> look(const Span& span, const Sight& mid) {
    const Certificate found = certify(span, mid, false);
    if (found.proved) return {ProvedPiece{span, found.where, found.bound, false}};
    return {std::nullopt, meets(mid)};
  }

  /// Whether it was before; what holds for the whole holds for a part.
  bool measured(ProvedPiece& piece) {
    if (piece.measured) return true;
    const Sight mid = at(0.5 * (piece.span.from.t + piece.span.to.t));
    piece.bound = std::max(piece.bound, certify(piece.span, mid, true).bound);
    piece.measured = true;
    return false;
  }
  bool near_enough(const ProvedPiece& piece) const { return piece.bound >= 0.99 * nearest_ - 1e-6; }
  ProvedPiece half(const ProvedPiece& whole, const Span& span) {
    ProvedPiece part{span, whole.where, whole.bound, false};
    static_cast<void>(measured(part));
    return part;
  }

  PassageProof prove(double from, double to, double resolution) {
    TimeSearch search(*this, resolution, kMostPassagePieces);
    const TimeEnd end = search.run(from, to);
    PassageProof proof;
    if (end == TimeEnd::touched) {
      const Span& found = search.found();
      proof.verdict = PassageVerdict::touched;
      proof.from = found.from.t;
      proof.time = proof.to = found.to.t;
      proof.place = in_world(found.to.t, meeting(found.to).value_or(Vector3d::Zero()));
    } else if (end == TimeEnd::undecided) {
      undecided(search.found(), proof);
    } else {
      apart(search, from, to, proof);
    }
    proof.pieces = search.leaves().size();
    return proof;
  }

 private:
  Vector3d in_world(double t, const Vector3d& place) const {
    const PlacedOpening opening = orifice_.at(t).opening;
    return opening.center + opening.axes * place.head<2>() + opening.normal() * place.z();
  }

  Convex body(double from, double to) const {
    return rigid_ ? *rigid_ : convex_around(agent_.shape(), from, to);
  }

  /// What taking a body into the opening's frame rounds.
  double rounding(const Sight& s, double reach) const {
    return of_places_ + 1e-14 * (1 + spin_ * std::abs(s.t)) *
                            (s.motion.position.norm() + s.center.norm() + reach + opening_.reach());
  }

  struct Certificate {
    bool proved = false;
    Where where = Where::above;
    double bound = 0;  // of the distance from the rim over the piece, less padding
  };

  /// By what a body may leave the chords between its ends during a piece, in the frame of the opening.
  struct Growth {
    double by_ends = kFar;    // as it is turned at the ends
    double by_middle = kFar;  // as it is turned in the middle
  };
  Growth growth(const Span& span, const Sight& mid, double reach) const {
    const double dt = span.to.t - span.from.t;
    if (!(dt > 0)) return {0, 0};
    const Track::Bounds b = agent_.bounds(span.from.t, span.to.t);
    const double speed =
        (mid.motion.velocity - orifice_.velocity).norm() + b.acceleration * dt / 2 + b.velocity_jumps;
    const double away = mid.position.norm() + speed * dt / 2;
    const double part = dt * dt / 8 * (1 + 1e-12);
    Growth growth;
    const double turning = b.turn_rate == 0 ? 0 : reach * b.turn_acceleration;
    const double blows = b.velocity_jumps * dt / 4 * (1 + 1e-12);
    const double jumps = b.turn_rate == 0 ? 0 : reach * b.turn_jumps * dt / 4;
    const double whirl = spin_ == 0 ? 0
                                    : 2 * spin_ * (speed + (b.turn_rate == 0 ? 0 : reach * b.turn_rate)) +
                                          spin_ * spin_ * (away + reach);
    growth.by_ends = (b.acceleration + turning + whirl) * part + jumps + blows;
    const double half = std::min(std::numbers::pi, (b.turn_rate + spin_) * dt / 2);
    growth.by_middle = (b.acceleration + 2 * spin_ * speed + spin_ * spin_ * away) * part +
                       2 * reach * std::sin(half / 2) * (1 + 1e-12) + blows;
    if (std::isnan(growth.by_ends)) growth.by_ends = kFar;
    return growth;
  }

  /// `nearest`: a distance that the body comes to; infinite: not asked about.
  Certificate certify(const Span& span, const Sight& mid, bool measure) {
    const Convex own = body(span.from.t, span.to.t);
    const double reach = own.reach();
    const Growth growth = this->growth(span, mid, reach);
    const bool ends = growth.by_ends <= growth.by_middle;
    const Chords body{own.posed(span.from.position, ends ? span.from.rotation : mid.rotation),
                      own.posed(span.to.position, ends ? span.to.rotation : mid.rotation)};
    const double padding = padding_.until(span.to.t);
    const double needed = (ends ? growth.by_ends : growth.by_middle) + rounding(mid, reach) +
                          rounding(span.from, reach) + rounding(span.to, reach) + padding;
    if (!std::isfinite(needed)) return {};
    Certificate found;
    const double low = -body.support(-Vector3d::UnitZ()), high = body.support(Vector3d::UnitZ());
    if (low > needed || high < -needed) {
      found.proved = true;
      found.where = low > needed ? Where::above : Where::below;
      found.bound = std::max(low, -high) - needed;
      if (!measure) return found;
    }
    const RimDistance rim = body.rim(placed_, measure ? kMeasure : asking(needed));
    found.bound = std::max(found.bound, rim.least - needed);
    if (measure && rim.most - needed < nearest_) measure_middle(own, mid);
    if (found.proved || !(rim.least > needed)) return found;
    const double depth = opening_.depth(in_plane(body));
    found.where = depth > 0 ? Where::inside : Where::around;
    found.proved = std::abs(depth) > 1e-12 * (reach + opening_.reach()) && (depth > 0 || !orifice_.wall);
    return found;
  }

  /// A point of the body that lies in the plane of the opening, or next to that.
  static Eigen::Vector2d in_plane(const Chords& body) {
    const Vector3d high = body.support_point(Vector3d::UnitZ()), low = body.support_point(-Vector3d::UnitZ());
    if (!(high.z() > 0)) return high.head<2>();
    if (!(low.z() < 0)) return low.head<2>();
    return (high + high.z() / (high.z() - low.z()) * (low - high)).head<2>();
  }

  void measure_middle(const Convex& own, const Sight& mid) {
    const Convex there = own.posed(mid.position, mid.rotation);
    const double drift = padding_.drifted(mid.t);
    const RimDistance rim = there.rim(placed_, kMeasure);
    if (!(rim.most - drift < nearest_)) return;
    nearest_ = rim.most - drift;
    nearest_time_ = mid.t;
    nearest_place_ = in_world(mid.t, rim.rim);
  }

  void undecided(const Span& span, PassageProof& proof) {
    proof.verdict = PassageVerdict::undecided;
    proof.from = proof.time = span.from.t;
    proof.to = span.to.t;
    measure_middle(body(proof.from, proof.to), at(0.5 * (span.from.t + span.to.t)));
    proof.place = nearest_place_;
  }

  void apart(TimeSearch<Clear>& search, double from, double to, PassageProof& proof) {
    const auto through = passage(search.leaves(), true);
    // What is nearly through, or through for some motions within the padding only.
    if (const auto perhaps = passage(search.leaves(), false); perhaps && !through)
      return undecided({at(perhaps->before), at(perhaps->after)}, proof);
    search.refine(kMostMeasured);
    proof.verdict = through ? PassageVerdict::passed : PassageVerdict::missed;
    proof.from = from;
    proof.to = to;
    proof.least_distance = search.least().bound;
    proof.time = proof.least_time = nearest_time_;
    proof.place = nearest_place_;
    if (through) cross(*through, proof);
  }

  struct Through {
    double before, after;  // s, wholly on one side and wholly on the other
    int direction;
  };

  /// Goes along the pieces until the body has been wholly on one side, then inside of the opening all the
  /// way, then wholly on the other side.
  struct Way {
    int side = 0;      // the last that it was wholly on
    double since = 0;  // s, the last time known
    Where by = Where::inside;
    bool surely = true;
    std::optional<Through> through;

    void wholly_on(int here, double t) {
      if (here == -side && by == Where::inside && !through) through = Through{since, t, here};
      side = here;
      since = t;
      by = Where::inside;
    }
  };

  /// The first. `surely`: for all motions within the padding, otherwise for one of them, perhaps.
  std::optional<Through> passage(const std::vector<ProvedPiece>& pieces, bool surely) const {
    Way way;
    way.surely = surely;
    looks_ = 0;
    for (const ProvedPiece& piece : pieces) {
      note(way, piece.span.from);
      if (piece.where == Where::inside) look_within(way, piece.span);
      if (piece.where == Where::around) way.by = Where::around;
      // Where an inside and an around follow each other nothing of the body is in the plane, which is noted.
      note(way, piece.span.to);
      if (way.through) break;
    }
    return way.through;
  }

  struct Heights {
    double low, high;
  };
  Heights heights(const Sight& s) const {
    const Convex there = body(s.t, s.t).posed(s.position, s.rotation);
    return {-there.support(-Vector3d::UnitZ()), there.support(Vector3d::UnitZ())};
  }

  void note(Way& way, const Sight& s) const {
    const Heights h = heights(s);
    const double most = padding_.until(s.t) + rounding(s, h.high - h.low), off = way.surely ? most : -most;
    if (h.low > off) way.wholly_on(1, s.t);
    if (h.high < -off) way.wholly_on(-1, s.t);
  }

  /// Notes when the body is wholly on a side within a piece, unless by less than kDip, as long as its ends do
  /// not tell.
  void look_within(Way& way, const Span& span) const {
    constexpr double kDip = 1e-6;
    constexpr int kMostLooks = 20'000;
    const Heights a = heights(span.from), b = heights(span.to);
    const double dt = span.to.t - span.from.t;
    const Sight mid = at(0.5 * (span.from.t + span.to.t));
    const double most = dt / 2 * fastest(span, mid) + (way.surely ? 0 : padding_.until(span.to.t));
    const bool dips = !(a.high < 0) && !(b.high < 0) && (a.high + b.high) / 2 - most < -kDip;
    const bool rises = !(a.low > 0) && !(b.low > 0) && (a.low + b.low) / 2 + most > kDip;
    if ((!dips && !rises) || !(mid.t > span.from.t) || !(mid.t < span.to.t) || ++looks_ > kMostLooks) return;
    look_within(way, {span.from, mid});
    note(way, mid);
    look_within(way, {mid, span.to});
  }

  /// A bound of the speed of the body's points in the frame of the opening, m/s.
  double fastest(const Span& span, const Sight& mid) const {
    const double dt = span.to.t - span.from.t, reach = body(span.from.t, span.to.t).reach();
    const Track::Bounds b = agent_.bounds(span.from.t, span.to.t);
    const double speed =
        (mid.motion.velocity - orifice_.velocity).norm() + b.acceleration * dt / 2 + b.velocity_jumps;
    return speed + (b.turn_rate == 0 ? 0 : reach * b.turn_rate) +
           spin_ * (mid.position.norm() + speed * dt / 2 + reach);
  }

  double middle_height(double t) const {
    const Sight s = at(t);
    return (s.position + s.rotation * body(t, t).center).z();
  }

  /// When and where the middle crosses.
  void cross(const Through& through, PassageProof& proof) const {
    double before = through.before, after = through.after;
    for (int i = 0; i < 60; ++i) {
      const double t = 0.5 * (before + after);
      (middle_height(t) * through.direction < 0 ? before : after) = t;
    }
    proof.time = after;
    proof.direction = through.direction;
    const Motion m = agent_.motion(after);
    proof.place = m.position + m.rotation * body(after, after).center;
  }

  const Track& agent_;
  const MovingOrifice& orifice_;
  const Opening& opening_;
  PlacedOpening placed_;  // in its own frame
  Padding padding_;
  double spin_, of_places_;
  std::optional<Convex> rigid_;
  double nearest_ = kFar, nearest_time_ = 0;  // a distance that the body comes to, about, and when, s
  Vector3d nearest_place_ = Vector3d::Zero();
  mutable int looks_ = 0;
};

}  // namespace

const char* to_string(PassageVerdict verdict) {
  constexpr const char* kWords[] = {"passed", "touched", "missed", "undecided"};
  return kWords[std::size_t(verdict)];
}

PassageProof prove_passage(const Track& agent, const MovingOrifice& orifice, double from, double to,
                           const ProofOptions& options) {
  require_time(std::max(agent.appears(), orifice.appears), agent.end(), from, to);
  check(options);
  return Clear(agent, orifice, options, from, to).prove(from, to, options.resolution);
}

}  // namespace vericone::simulation
