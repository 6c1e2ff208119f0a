// SPDX-License-Identifier: BSD-3-Clause
//
// The search for a proof of passage: pieces of time from the first to the last, halved until each is
// certified or the body is found to meet rim or wall. Why a certificate holds:
// docs/explanation/proof-of-runs.md.
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/proof.h>

#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "proof/common_point.h"
#include "proof/convex.h"
#include "proof/padding.h"

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

struct TimeSpan {
  Sight from, to;
};

/// A piece that is proved.
struct ProvedPiece {
  TimeSpan span;
  Where where = Where::above;
  double bound = 0;  // of the distance from the rim, metres
  bool measured = false;
};

class PassageSearch {
 public:
  PassageSearch(const Track& agent, const MovingOrifice& orifice, const ProofOptions& options)
      : agent_(agent),
        orifice_(orifice),
        opening_(orifice.opening),
        placed_{orifice.opening, Vector3d::Zero(), Eigen::Matrix<double, 3, 2>::Identity()},
        padding_(options, agent.appears()),
        resolution_(options.resolution),
        spin_(orifice.spin.norm()) {
    if (agent.shape().rigid()) rigid_ = convex_around(agent.shape(), agent.appears(), agent.appears());
  }

  PassageProof run(double from, double to) {
    const Sight first = at(from), last = at(to);
    if (const auto place = meeting(first)) return touched(from, first, *place);
    open_.push_back({first, last});
    while (!open_.empty()) {
      checkpoint();
      const TimeSpan span = open_.back();
      open_.pop_back();
      if (step(span)) return proof_;
    }
    if (horizon_) return touched(horizon_->t, *horizon_, horizon_place_);
    if (unresolved_) return undecided();
    return apart(from, to);
  }

 private:
  Sight at(double t) const {
    const guidance::OrificeState state = orifice_.at(t);
    Matrix3d frame;
    frame << state.opening.axes, state.opening.normal();
    frame = orthonormal<3>(frame);
    const Motion motion = agent_.motion(t);
    return {t, frame.transpose() * (motion.position - state.opening.center),
            frame.transpose() * motion.rotation, motion, state.opening.center};
  }
  Sight middle(const TimeSpan& span) const { return at(0.5 * (span.from.t + span.to.t)); }

  Convex body(double from, double to) const {
    return rigid_ ? *rigid_ : convex_around(agent_.shape(), from, to);
  }

  Vector3d in_world(double t, const Vector3d& place) const {
    const PlacedOpening opening = orifice_.at(t).opening;
    return opening.center + opening.axes * place.head<2>() + opening.normal() * place.z();
  }

  /// What taking a body into the opening's frame rounds.
  double rounding(const Sight& s, double reach) const {
    return 1e-14 * (1 + spin_ * std::abs(s.t)) *
           (s.motion.position.norm() + s.center.norm() + reach + opening_.reach());
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
  Growth growth(const TimeSpan& span, const Sight& mid, double reach) const {
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
  Certificate certify(const TimeSpan& span, const Sight& mid, bool measure) {
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
    proof_.least_time = mid.t;
    nearest_place_ = in_world(mid.t, rim.rim);
  }

  /// Pieces shorter than this are not halved. Once one has been left undecided, only a meeting is still
  /// looked for, ever more coarsely.
  double shortest(double t) const {
    const double since = unresolved_ ? t - unresolved_->from.t : 0;
    return std::max(resolution_, since / 16);
  }

  /// One piece. True: the answer is there.
  bool step(const TimeSpan& span) {
    const Sight mid = middle(span);
    const Certificate found = certify(span, mid, false);
    if (found.proved) {
      proved_.push_back({span, found.where, found.bound, false});
      return false;
    }
    const bool halved = mid.t > span.from.t && mid.t < span.to.t &&
                        span.to.t - span.from.t > shortest(span.from.t) &&
                        (proved_.size() < kMostPassagePieces || unresolved_);
    if (const auto place = meeting(mid)) return met(span, mid, *place, halved);
    if (halved) {
      open_.push_back({mid, span.to});
      open_.push_back({span.from, mid});
      return false;
    }
    const double apart_before = unresolved_ ? unresolved_->from.t : span.from.t;
    if (horizon_ && span.to.t == horizon_->t) {
      touched(apart_before, span.to, horizon_place_);
      return true;
    }
    if (const auto place = meeting(span.to)) {
      touched(apart_before, span.to, *place);
      return true;
    }
    if (!unresolved_) unresolved_ = span;
    return false;
  }

  /// They meet at `there`, within the span: what comes later does not matter any more.
  bool met(const TimeSpan& span, const Sight& there, const Vector3d& place, bool halved) {
    open_.clear();
    horizon_ = there;
    horizon_place_ = place;
    if (!halved) {
      touched(unresolved_ ? unresolved_->from.t : span.from.t, there, place);
      return true;
    }
    open_.push_back({span.from, there});
    return false;
  }

  PassageProof touched(double apart_before, const Sight& there, const Vector3d& place) {
    proof_.verdict = PassageVerdict::touched;
    proof_.from = apart_before;
    proof_.time = proof_.to = there.t;
    proof_.place = in_world(there.t, place);
    proof_.pieces = proved_.size();
    return proof_;
  }

  PassageProof undecided() {
    proof_.verdict = PassageVerdict::undecided;
    proof_.from = proof_.time = unresolved_->from.t;
    proof_.to = unresolved_->to.t;
    measure_middle(body(proof_.from, proof_.to), middle(*unresolved_));
    proof_.place = nearest_place_;
    proof_.least_time = 0;
    proof_.pieces = proved_.size();
    return proof_;
  }

  PassageProof apart(double from, double to) {
    const auto through = passage(true);
    // What is nearly through, or through for some motions within the padding only.
    if (const auto perhaps = passage(false); perhaps && !through) {
      unresolved_ = TimeSpan{at(perhaps->before), at(perhaps->after)};
      return undecided();
    }
    refine();
    proof_.verdict = through ? PassageVerdict::passed : PassageVerdict::missed;
    proof_.from = from;
    proof_.to = to;
    proof_.least_distance = std::min_element(proved_.begin(), proved_.end(), lower)->bound;
    proof_.time = proof_.least_time;
    proof_.place = nearest_place_;
    if (through) cross(*through);
    proof_.pieces = proved_.size();
    return proof_;
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
  std::optional<Through> passage(bool surely) const {
    Way way;
    way.surely = surely;
    looks_ = 0;
    for (const ProvedPiece& piece : proved_) {
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
  void look_within(Way& way, const TimeSpan& span) const {
    constexpr double kDip = 1e-6;
    constexpr int kMostLooks = 20'000;
    const Heights a = heights(span.from), b = heights(span.to);
    const double dt = span.to.t - span.from.t;
    const Sight mid = middle(span);
    const double most = dt / 2 * fastest(span, mid) + (way.surely ? 0 : padding_.until(span.to.t));
    const bool dips = !(a.high < 0) && !(b.high < 0) && (a.high + b.high) / 2 - most < -kDip;
    const bool rises = !(a.low > 0) && !(b.low > 0) && (a.low + b.low) / 2 + most > kDip;
    if ((!dips && !rises) || !(mid.t > span.from.t) || !(mid.t < span.to.t) || ++looks_ > kMostLooks) return;
    look_within(way, {span.from, mid});
    note(way, mid);
    look_within(way, {mid, span.to});
  }

  /// A bound of the speed of the body's points in the frame of the opening, m/s.
  double fastest(const TimeSpan& span, const Sight& mid) const {
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
  void cross(const Through& through) {
    double before = through.before, after = through.after;
    for (int i = 0; i < 60; ++i) {
      const double t = 0.5 * (before + after);
      (middle_height(t) * through.direction < 0 ? before : after) = t;
    }
    proof_.time = after;
    proof_.direction = through.direction;
    const Motion m = agent_.motion(after);
    proof_.place = m.position + m.rotation * body(after, after).center;
  }

  static bool lower(const ProvedPiece& x, const ProvedPiece& y) { return x.bound < y.bound; }

  /// Measures and halves the piece of the least bound until that is near a distance that the body comes to.
  void refine() {
    for (int i = 0; i < kMostMeasured; ++i) {
      const auto least = std::min_element(proved_.begin(), proved_.end(), lower);
      if (!least->measured) {
        measure(*least);
        continue;
      }
      if (least->bound >= 0.99 * nearest_ - 1e-6) return;
      ProvedPiece first = *least, second = *least;
      const Sight mid = middle(least->span);
      if (!(mid.t > first.span.from.t) || !(mid.t < first.span.to.t)) return;
      first.span.to = second.span.from = mid;
      measure(first);
      measure(second);
      *least = first;
      proved_.push_back(second);
    }
  }

  /// What holds for the whole holds for a part.
  void measure(ProvedPiece& piece) {
    piece.bound = std::max(piece.bound, certify(piece.span, middle(piece.span), true).bound);
    piece.measured = true;
  }

  const Track& agent_;
  const MovingOrifice& orifice_;
  const Opening& opening_;
  PlacedOpening placed_;  // in its own frame
  Padding padding_;
  double resolution_, spin_;
  std::optional<Convex> rigid_;
  std::vector<TimeSpan> open_;  // the earliest last
  std::vector<ProvedPiece> proved_;
  std::optional<TimeSpan> unresolved_;  // the first
  std::optional<Sight> horizon_;        // they meet then
  Vector3d horizon_place_ = Vector3d::Zero();
  double nearest_ = kFar;  // a distance that the body comes to, about
  Vector3d nearest_place_ = Vector3d::Zero();
  mutable int looks_ = 0;
  PassageProof proof_;
};

}  // namespace

const char* to_string(PassageVerdict verdict) {
  switch (verdict) {
    case PassageVerdict::passed:
      return "passed";
    case PassageVerdict::touched:
      return "touched";
    case PassageVerdict::missed:
      return "missed";
    case PassageVerdict::undecided:
      return "undecided";
  }
  return "";
}

PassageProof prove_passage(const Track& agent, const MovingOrifice& orifice, double from, double to,
                           const ProofOptions& options) {
  require_time(std::max(agent.appears(), orifice.appears), agent.end(), from, to);
  check(options);
  return PassageSearch(agent, orifice, options).run(from, to);
}

}  // namespace vericone::simulation
