// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/pair.h>
#include <vericone/internal/geometry/rotation.h>

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "answers/stretch.h"
#include "ellipsoids/apart.h"
#include "ellipsoids/plane_axis.h"
#include "pairs/family.h"

namespace vericone {
namespace pairs {

using Eigen::Vector3d;

Vector3d relative_velocity(const Vector3d& v_a, const Vector3d& v_b) {
  const Vector3d w = v_a - v_b;
  if (w.allFinite()) return w;
  for (int i = 0; i < 3; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    if (!std::isfinite(v_a(i)))
      throw InputError("agent_velocity" + index, to_text(v_a(i)), "a finite number (m/s)");
    if (!std::isfinite(v_b(i)))
      throw InputError("obstacle_velocity" + index, to_text(v_b(i)), "a finite number (m/s)");
    if (!std::isfinite(w(i)))
      throw InputError("agent_velocity" + index, to_text(v_a(i)),
                       "at most 1.8e308 from the obstacle's, " + to_text(v_b(i)));
  }
  return w;
}

namespace {

/// A certified tolerance, or the family's own.
double tolerance_or(const PairOptions& options, double usual) {
  const double tolerance = options.tolerance.value_or(usual);
  if (!(tolerance >= 1e-12 && tolerance < 1))
    throw InputError("tolerance", to_text(tolerance), "at least 1e-12 and below 1");
  return tolerance;
}

constexpr double kCombinedTolerance = 1e-6, kCompositeTolerance = 1e-3;

/// Whether the first of two assemblies is the one to be taken into the frame of the other, where a rotation
/// makes that rounding: the same of the two, whichever is the agent. Where nothing tells them apart, nothing
/// is rounded.
bool is_moved(const Assembly& a, const Pose& a_pose, const Assembly& b, const Pose& b_pose) {
  if (is_upright(a_pose) && is_upright(b_pose)) return true;
  if (a.size() != b.size()) return a.size() < b.size();
  const auto less = [](const auto& x, const auto& y) {
    return std::lexicographical_compare(x.data(), x.data() + x.size(), y.data(), y.data() + y.size());
  };
  if (a_pose.position != b_pose.position) return less(a_pose.position, b_pose.position);
  return !less(b_pose.rotation, a_pose.rotation);
}

/// The points of a convex body that is no more than their hull.
std::optional<HullBody> hull_of(const Convex& body) {
  if (!body.is_hull()) return std::nullopt;
  std::vector<Vector3d> points;
  for (const Convex::Piece& piece : body.pieces()) points.push_back(piece.center);
  return HullBody(std::move(points));
}

/// One of each kind of shape against the other, agents that are no simpler than the obstacle first.
struct Choose {
  const Pose &agent_pose, &obstacle_pose;
  const PairOptions& options;

  using Parts = std::vector<CombinedEllipsoid>;

  FamilyPointer operator()(const CombinedEllipsoid& agent, const CombinedEllipsoid& obstacle) const {
    const auto a = standing(agent, agent_pose), b = standing(obstacle, obstacle_pose);
    const auto pair = apart(a.body, a.at, b.body, b.at);
    const bool round = pair.a.is_ellipsoid() && pair.b.is_ellipsoid();
    return moved(round ? ellipsoid_family(pair.a.ellipsoid(), pair.b.ellipsoid())
                       : combined_family(pair.a, pair.b, tolerance_or(options, kCombinedTolerance)),
                 pair.a.center(), pair.b.center(), pair.world_a, pair.world_b);
  }
  FamilyPointer operator()(const CombinedEllipsoid& agent, const HullBody& obstacle) const {
    if (agent.is_ellipsoid())
      return hull_family(standing(agent.ellipsoid(), agent_pose), standing(obstacle, obstacle_pose));
    return (*this)(agent, Assembly::polyhedra({obstacle}));
  }
  FamilyPointer operator()(const CombinedEllipsoid& agent, const Assembly& obstacle) const {
    if (agent.is_ellipsoid())
      return assembly_family(standing(agent.ellipsoid(), agent_pose), obstacle, obstacle_pose);
    return composite_family(standing(agent, agent_pose), obstacle, obstacle_pose,
                            tolerance_or(options, kCompositeTolerance));
  }
  FamilyPointer operator()(const HullBody& agent, const HullBody& obstacle) const {
    return hull_family(standing(agent, agent_pose), standing(obstacle, obstacle_pose));
  }
  FamilyPointer operator()(const HullBody& agent, const Assembly& obstacle) const {
    return assembly_family(standing(agent, agent_pose), obstacle, obstacle_pose);
  }
  FamilyPointer operator()(const CombinedEllipsoid& agent, const Convex& obstacle) const {
    if (const auto hull = hull_of(obstacle)) return (*this)(agent, *hull);
    if (agent.is_ellipsoid())
      return convex_family(standing(Convex::rounded(agent.ellipsoid(), 0), agent_pose),
                           standing(obstacle, obstacle_pose));
    return (*this)(agent, Assembly::convexes({obstacle}));
  }
  FamilyPointer operator()(const HullBody& agent, const Convex& obstacle) const {
    if (const auto hull = hull_of(obstacle)) return (*this)(agent, *hull);
    return convex_family(standing(Convex::rounded(agent, 0), agent_pose), standing(obstacle, obstacle_pose));
  }
  FamilyPointer operator()(const Convex& agent, const Convex& obstacle) const {
    return convex_family(standing(agent, agent_pose), standing(obstacle, obstacle_pose));
  }
  FamilyPointer operator()(const Convex& agent, const Assembly& obstacle) const {
    if (const auto hull = hull_of(agent)) return (*this)(*hull, obstacle);
    return assembly_family(standing(agent, agent_pose), obstacle, obstacle_pose);
  }
  FamilyPointer operator()(const Assembly& agent, const Assembly& obstacle) const {
    if (is_moved(agent, agent_pose, obstacle, obstacle_pose))
      return composite_family(agent, agent_pose, obstacle, obstacle_pose);
    return mirrored(composite_family(obstacle, obstacle_pose, agent, agent_pose));
  }
  template <typename Obstacle>
  FamilyPointer operator()(const Parts& agent, const Obstacle& obstacle) const {
    std::vector<FamilyPointer> all;
    for (const CombinedEllipsoid& part : agent) all.push_back((*this)(part, obstacle));
    return any_of(std::move(all));
  }
  FamilyPointer operator()(const CombinedEllipsoid& agent, const Parts& obstacle) const {
    std::vector<FamilyPointer> all;
    for (const CombinedEllipsoid& part : obstacle) all.push_back((*this)(agent, part));
    return any_of(std::move(all));
  }
  /// The rest: the obstacle is the simpler one.
  template <typename Agent, typename Obstacle>
  FamilyPointer operator()(const Agent& agent, const Obstacle& obstacle) const {
    return mirrored(Choose{obstacle_pose, agent_pose, options}(obstacle, agent));
  }

 private:
  /// Turned, its own numbers then rounded once.
  template <typename Body>
  static Standing<Body> standing(const Body& body, const Pose& pose) {
    if (is_upright(pose)) return {body, pose.position};
    return {in_world(body, {Eigen::Vector3d::Zero(), pose.rotation}), pose.position};
  }
};

}  // namespace

namespace {

/// An assembly of one hull that is turned is a hull: its own numbers are rounded once, and not those of what
/// stands before it.
Body simplest(const Placed& placed) {
  const Assembly* pieces = placed.body.assembly();
  const bool alone = pieces && pieces->kind() == PieceKind::hull && pieces->size() == 1;
  return alone && !is_upright(placed.pose) ? Body(pieces->by_slot().hulls.front()) : placed.body;
}

}  // namespace

FamilyPointer family_of(const Placed& agent, const Placed& obstacle, const PairOptions& options) {
  const Body a = simplest(agent), b = simplest(obstacle);
  return std::visit(Choose{agent.pose, obstacle.pose, options}, a.shape(), b.shape());
}

}  // namespace pairs

using Eigen::Vector3d;

namespace {

Body raised_to(const CombinedEllipse& body, const CombinedEllipse& other) {
  return raised(body,
                std::max(body.ellipsoid().semi_axes().maxCoeff(), other.ellipsoid().semi_axes().maxCoeff()));
}

}  // namespace

Pair::Pair(Placed agent, Placed obstacle, PairOptions options)
    : agent_(std::make_shared<Placed>(std::move(agent))),
      obstacle_(std::make_shared<Placed>(std::move(obstacle))),
      family_(pairs::family_of(*agent_, *obstacle_, options)),
      ellipsoids_(family_->ellipsoids()) {}

Pair::Pair(const CombinedEllipse& agent, const CombinedEllipse& obstacle, PairOptions options)
    : Pair(raised_to(agent, obstacle), raised_to(obstacle, agent), options) {}

Guarantee Pair::guarantee() const { return family_->guarantee(); }
std::optional<Relation> Pair::relation() const { return family_->relation(); }

Verdict Pair::other_verdict(const Vector3d& v_a, const Vector3d& v_b) const {
  return family_->verdict(v_a, v_b);
}

Verdict Pair::verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const {
  if (horizon.from == 0 && horizon.until == std::numeric_limits<double>::infinity()) return verdict(v_a, v_b);
  return ellipsoids_ ? ellipsoids_->verdict(v_a, v_b, horizon) : family_->verdict(v_a, v_b, horizon);
}

namespace {

/// At least |x| for every point of the body in the world, to rounding.
double size_of(const Placed& body) {
  const Box bounds = body.body.bounds();
  return bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).norm() + body.pose.position.norm();
}

/// Largest entry 1; nothing where it is none.
std::optional<Vector3d> normalised(const Vector3d& n) {
  const Vector3d unit = n / n.cwiseAbs().maxCoeff();
  return unit.allFinite() ? std::optional(unit) : std::nullopt;
}

}  // namespace

double Pair::gap(const Vector3d& n) const {
  const double own = family_->gap(n);
  if (!std::isnan(own)) return own;
  constexpr double kRoundings = 0x1p-46;
  return -obstacle_->support(-n) - agent_->support(n) -
         kRoundings * n.cwiseAbs().sum() * (size_of(*agent_) + size_of(*obstacle_));
}

std::optional<Vector3d> Pair::normal_along(const Vector3d& start, const Vector3d& end) const {
  const auto nearest = family_->nearest_plane(start, end);
  return nearest ? normalised(nearest->normal) : std::nullopt;
}

std::optional<SafeHalfSpace> Pair::safe_half_space(const Vector3d& v_a, const Vector3d& v_b,
                                                   const Horizon& horizon,
                                                   const std::optional<Vector3d>& warm) const {
  require_horizon(horizon);
  const Vector3d w = pairs::relative_velocity(v_a, v_b);
  const auto safe = [&](const Vector3d& n) -> std::optional<SafeHalfSpace> {
    const SafeHalfSpace half{n, gap(n)};
    // By more than rounding may turn n.w, or the quotient.
    const double slack = 0x1p-50 * n.cwiseAbs().sum() * w.cwiseAbs().maxCoeff(), most = half.most(horizon);
    const bool holds = n.dot(w) + slack <= most - std::abs(most) * 0x1p-50;
    return holds ? std::optional(half) : std::nullopt;
  };
  if (warm)
    if (const auto half = safe(*warm)) return half;
  if (const auto touching = family_->touching_plane(w, horizon)) {
    const auto unit = normalised(*touching);
    return unit ? safe(*unit) : std::nullopt;
  }
  // For ever: until they have passed, by twice the way that is needed.
  const Vector3d start = horizon.from * w;
  const double speed = w.norm();
  const double passed =
      std::isinf(horizon.until) && speed > 0
          ? horizon.from + 2 * (start.norm() + size_of(*agent_) + size_of(*obstacle_)) / speed
          : horizon.until;
  const auto nearest = family_->nearest_plane(start, speed > 0 ? Vector3d(passed * w) : start);
  const auto unit = nearest ? normalised(nearest->normal) : std::nullopt;
  if (!unit) return std::nullopt;
  const Vector3d& n = *unit;
  const double here = gap(n), time = horizon.from + nearest->at * (passed - horizon.from);
  // Where they are nearest at an end of the time the plane is the one to take. Where they pass, it holds for
  // little more than w; turned away from w it goes to where it touches the cone. The gap of the turned plane
  // is concave, so chords between a turn too small and one too large are too small.
  if (!(speed > 0 && here > 0)) return safe(n);
  if (!(nearest->at > 0 && nearest->at < 1))
    if (const auto half = safe(n)) return half;  // else along a flat side, for ever
  const Vector3d back = w / speed;
  double low = 0, at_low = here, high = std::min(here / (time * speed), 1.0), at_high = here;
  for (int step = 0; step < 6 && at_high > 0; ++step, high *= 8) at_high = gap(n - high * back);
  high /= 8;
  if (at_high > 0) return safe(n - high * back);
  for (int step = 0; step < 8 && at_low > 1e-6 * here; ++step) {
    const double between = low + (high - low) * at_low / (at_low - at_high) * (1 - 1e-6);
    const double at = gap(n - between * back);
    (at > 0 ? low : high) = between;
    (at > 0 ? at_low : at_high) = at;
    if (at > 0) at_high *= 0.5;  // or the other end would stay where it is
  }
  if (const auto half = safe(n - low * back)) return half;
  return safe(n);
}

std::optional<Rung> Pair::rung(const Vector3d& v_a, const Vector3d& v_b) const {
  return family_->rung(v_a, v_b);
}

std::optional<Passage> Pair::passage(const Vector3d& v_a, const Vector3d& v_b) const {
  if (v_a == v_b) return Passage::never;
  switch (verdict(v_a, v_b)) {
    case Verdict::in:
    case Verdict::overlapping:
    case Verdict::touching:
      return Passage::ahead;
    case Verdict::on:
      return Passage::ahead_grazing;
    case Verdict::undecided:
      return std::nullopt;
    case Verdict::out:
      break;
  }
  switch (verdict(v_b, v_a)) {
    case Verdict::in:
      return Passage::behind;
    case Verdict::on:
      return Passage::behind_grazing;
    case Verdict::undecided:
      return std::nullopt;
    default:
      break;
  }
  return Passage::never;
}

std::optional<Contact> Pair::contact(const Vector3d& v_a, const Vector3d& v_b) const {
  if (verdict(v_a, v_b) == Verdict::out) return std::nullopt;
  Contact contact = family_->contact(v_a, v_b);
  // They meet, if past the largest double.
  contact.earliest = std::min(contact.earliest, std::numeric_limits<double>::max());
  return contact;
}

Miss Pair::miss(const Vector3d& v_a, const Vector3d& v_b) const {
  Miss miss = family_->miss(v_a, v_b);
  if (!std::isnan(miss.depth) || ellipsoids_ || v_a == v_b) return miss;
  const Clearance around =
      clearance(agent_->containing_ellipsoid(), obstacle_->containing_ellipsoid(), v_a - v_b);
  miss.depth = std::max(-around.distance, 0.0);
  miss.distance = -miss.depth;
  miss.normal = around.normal;
  miss.time = std::max(around.time, 0.0);
  return miss;
}

std::optional<Penetration> Pair::penetration() const {
  if (relation() != Relation::overlapping) return std::nullopt;
  return vericone::penetration(*agent_, *obstacle_);
}

std::optional<PlaneSector> Pair::sector(const Vector3d& from, const Vector3d& to,
                                        const Vector3d& across) const {
  const pairs::SightLine line{from, to};
  const Vector3d u = line.direction();
  if (!u.allFinite() || u.isZero(0))
    throw InputError("to", "the same point as \"from\", or not finite", "another point");
  const Vector3d e = second_axis(u, across);
  if (relation() != Relation::disjoint) return std::nullopt;
  return family_->sector(line, e);
}

std::optional<PlaneSector> Pair::sector(const Vector3d& across) const {
  return sector(agent_->middle(), obstacle_->middle(), across);
}

std::shared_ptr<const DirectionClassifier> Pair::directions() const { return family_->directions(); }

}  // namespace vericone
