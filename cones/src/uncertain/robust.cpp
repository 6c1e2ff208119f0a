// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/robust.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <vericone/internal/cones/uncertain/turned.h>
#include <numbers>
#include <string>
#include <vector>

#include "pairs/convex_hull_of.h"
#include "uncertain/everywhere.h"
#include "uncertain/inward.h"
#include "uncertain/nearest.h"

namespace vericone {

using Eigen::Matrix3d, Eigen::Vector3d;

const char* to_string(RobustVerdict verdict) {
  switch (verdict) {
    case RobustVerdict::in:
      return "in";
    case RobustVerdict::out:
      return "out";
    case RobustVerdict::depends:
      return "depends";
    case RobustVerdict::undecided:
      break;
  }
  return "undecided";
}

namespace robust {
namespace {

void require(const RelativeErrors& errors, const Vector3d& v_a, const Vector3d& v_b) {
  const auto not_negative = [](double x, const char* field, const char* unit) {
    if (!(x >= 0 && std::isfinite(x)))
      throw InputError(field, to_text(x), std::string("a finite number, 0 or more (") + unit + ")");
  };
  if (!(errors.horizon > 0))
    throw InputError("horizon", to_text(errors.horizon), "a positive number (s), or infinity");
  not_negative(errors.acceleration, "acceleration", "m/s^2");
  not_negative(errors.attitude_a, "attitude_a", "rad");
  not_negative(errors.attitude_b, "attitude_b", "rad");
  not_negative(errors.size, "size", "m");
  if (errors.acceleration > 0 && !std::isfinite(errors.horizon))
    throw InputError("horizon", "infinity", "a finite time (s), as accelerations are not known");
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(v_a(i)))
      throw InputError("agent_velocity[" + std::to_string(i) + "]", to_text(v_a(i)), "a finite number (m/s)");
    if (!std::isfinite(v_b(i)))
      throw InputError("obstacle_velocity[" + std::to_string(i) + "]", to_text(v_b(i)),
                       "a finite number (m/s)");
  }
}

/// Rounded up.
double slightly_more(double x) { return x * (1 + 0x1p-50); }

/// Errors of position and of size together, as they may move a body whole; rounded inwards.
ErrorSet with_size(const ErrorSet& position, double size) {
  if (size == 0) return {};
  return ErrorSet::sum(std::nextafter(position.radius() + size, 0), position.factors(), position.segments());
}

bool none(const RelativeErrors& errors) {
  return errors.position.none() && errors.velocity.none() && errors.size == 0 && errors.acceleration == 0 &&
         errors.attitude_a == 0 && errors.attitude_b == 0;
}

/// Within a part of the horizon accelerations stray less: every error that collides by then collides.
constexpr double kParts[] = {1, 0.75, 0.5, 0.25};

double strayed(const RelativeErrors& errors, double horizon) {
  return errors.acceleration > 0 ? slightly_more(0.5 * errors.acceleration * horizon) : 0;
}

/// The bodies as they may be at most, at least, and as they are thought to be; often the same.
struct Bodies {
  const Side &outer_a, &outer_b, &a, &b, &inner_a, &inner_b;
  bool convex;         // the sides are the bodies, so `in` can be proved
  double position_by;  // ball that errors of attitude and size add to those of position, m
};

/// `in` or `depends`, of which one error that collides is known.
template <typename Inner>
void decide_in(RobustAnswer& answer, const Engagement& thought, bool convex, const RelativeErrors& errors,
               const Inner& inner) {
  for (const double part : kParts) {
    const Everywhere found = everywhere(inner(part * errors.horizon), thought, convex);
    answer.cells += found.cells;
    if (found.passes) {
      answer.verdict = RobustVerdict::depends;
      answer.passes = *found.passes;
    } else if (found.all_collide) {
      answer.verdict = RobustVerdict::in;
    }
    if (answer.verdict != RobustVerdict::undecided || errors.acceleration == 0) return;
  }
}

/// Decides whether an error collides: its mean error first, then what the search found.
template <typename Collides>
RobustAnswer decide(const Bodies& bodies, const Vector3d& v_a, const Vector3d& v_b,
                    const RelativeErrors& errors, const Collides& collides) {
  const double by_acceleration = strayed(errors, errors.horizon);
  const auto inflated = [&](const Side& a, const Side& b, double horizon) {
    return Engagement(a, b, v_a, v_b, {errors.position, bodies.position_by},
                      {errors.velocity, strayed(errors, horizon)}, horizon);
  };
  const ErrorSet nothing, moved = with_size(errors.position, errors.size);
  const ErrorSet& places = errors.size > 0 ? moved : errors.position;
  const Engagement outer = inflated(bodies.outer_a, bodies.outer_b, errors.horizon);
  const Engagement thought(bodies.a, bodies.b, v_a, v_b, {places}, {errors.velocity}, errors.horizon);
  const Engagement certain(bodies.a, bodies.b, v_a, v_b, {nothing}, {nothing}, errors.horizon);

  RobustAnswer answer;
  const Vector3d start = outer.c.isZero(0) ? Vector3d(Vector3d::UnitX()) : outer.c;
  const Nearest without = nearest(certain, start);
  if (without.nearness == Nearness::apart) {
    const Nearest all = nearest(outer, without.normal);
    if (all.nearness == Nearness::apart) {
      answer.verdict = RobustVerdict::out;
      answer.normal = all.normal.normalized();
      // The rounding of its length may cost the proof.
      if (!outer.separates_all(answer.normal)) answer.normal = all.normal;
      return answer;
    }
    if (all.nearness == Nearness::close) return answer;
    const bool same = &bodies.outer_a == &bodies.a && bodies.position_by == 0 && by_acceleration == 0;
    if (const auto error = collides(thought, same ? all : nearest(thought, without.normal))) {
      answer.verdict = RobustVerdict::depends;
      answer.collides = *error;
    }
    return answer;
  }
  if (without.nearness == Nearness::close) {
    // The error of 0 grazes; another may pass or collide for certain, or all may.
    const Nearest all = nearest(outer, start);
    if (all.nearness == Nearness::apart) {
      answer.verdict = RobustVerdict::out;
      answer.normal = all.normal;
      return answer;
    }
    if (all.nearness == Nearness::close) return answer;
    const auto error = collides(thought, nearest(thought, start));
    if (!error) return answer;
    answer.collides = *error;
  } else {
    const auto error = collides(certain, without);
    if (!error) return answer;
  }
  decide_in(answer, thought, bodies.convex, errors,
            [&](double horizon) { return inflated(bodies.inner_a, bodies.inner_b, horizon); });
  if (answer.verdict == RobustVerdict::in) answer.collides = {};
  return answer;
}

/// The error of a point of D that is zero, rounded into its sets: at `time` it brings the bodies together.
RelativeError error_of(const Engagement& e, const Nearest& found, double& time) {
  std::array<Vector3d, 4> n, late;
  std::array<double, 4> weight, late_weight;
  int count = 0;
  double all_late = 0;
  for (int i = 0; i < found.count; ++i) {
    n[std::size_t(i)] = -found.corners[std::size_t(i)].n;
    weight[std::size_t(i)] = found.corners[std::size_t(i)].weight;
    if (!found.corners[std::size_t(i)].late) continue;
    late[std::size_t(count)] = found.corners[std::size_t(i)].n;
    late_weight[std::size_t(count++)] = weight[std::size_t(i)];
    all_late += weight[std::size_t(i)];
  }
  time = found.span * all_late;
  for (int i = 0; i < count; ++i) late_weight[std::size_t(i)] /= all_late;
  RelativeError error;
  error.position =
      inward(e.position.set, {n.data(), std::size_t(found.count)}, {weight.data(), std::size_t(found.count)});
  error.velocity =
      inward(e.velocity.set, {late.data(), std::size_t(count)}, {late_weight.data(), std::size_t(count)});
  return error;
}

std::optional<RelativeError> ellipsoids_collide(const Engagement& e, const Nearest& found) {
  if (found.nearness != Nearness::meet) return std::nullopt;
  double time = 0;
  const RelativeError error = error_of(e, found, time);
  Vector3d x = Vector3d::Zero();
  for (int i = 0; i < found.count; ++i) {
    const Nearest::Corner& k = found.corners[std::size_t(i)];
    x += k.weight * e.a.farthest(k.n);
  }
  if (e.overlap_at(time, x, error)) return error;
  return std::nullopt;
}

/// By the exact predicates. No normal need prove it to doubles; one rounded to be across w may.
RobustAnswer without_errors(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& v_a, const Vector3d& v_b,
                            double horizon) {
  const ConeOracle oracle(a, b);
  RobustAnswer answer;
  if (may_collide(oracle.verdict(v_a, v_b))) {
    const auto time = enclose_time_to_contact(oracle, v_a, v_b);
    if (!std::isfinite(horizon) || (time && time->hi() <= horizon)) answer.verdict = RobustVerdict::in;
    if (!time || !(time->lo() > horizon)) return answer;
  }
  answer.verdict = RobustVerdict::out;
  const Side side_a(a), side_b(b);
  const ErrorSet nothing;
  const Engagement certain(side_a, side_b, v_a, v_b, {nothing}, {nothing}, horizon);
  const Vector3d start = certain.c.isZero(0) ? Vector3d(Vector3d::UnitX()) : certain.c;
  const Nearest found = nearest(certain, start);
  answer.normal = found.normal.isZero(0) ? start.normalized() : Vector3d(found.normal.normalized());
  if (certain.separates_all(answer.normal) || !(certain.w.norm() > 0)) return answer;
  const Vector3d across = clearance(a, b, certain.w).normal, along = certain.w.normalized();
  for (int roundings = 0; roundings <= 4; ++roundings) {
    const Vector3d n = across - along * (roundings * 0x1p-53);
    if (roundings == 0 || certain.separates_all(n)) answer.normal = n;
    if (certain.separates_all(n)) break;
  }
  return answer;
}

Side side_of(const ConvexHullOf& hull) {
  if (hull.parts.size() == 1 && hull.points.empty()) return Side(hull.parts.front());
  return Side(hull.parts, hull.points, hull.radius);
}

/// How far a point of the body moves at most that turns about its middle.
double moved_by_turning(const Placed& placed, double angle) {
  if (angle == 0) return 0;
  const Box bounds = placed.body.bounds();
  const Vector3d middle = placed.body.middle();
  const double reach = (bounds.high - middle).cwiseAbs().cwiseMax((middle - bounds.low).cwiseAbs()).norm();
  return 2 * std::sin(0.5 * std::min(angle, std::numbers::pi)) * reach * (1 + 1e-12);
}

/// What the pair itself says of an error; nothing where it cannot tell.
std::optional<bool> pair_collides(const Pair& pair, const Vector3d& v_a, const Vector3d& v_b,
                                  const RelativeError& error, double horizon) {
  const auto ask = [&](const Pair& moved) -> std::optional<bool> {
    const Vector3d v = v_a + error.velocity;
    const Verdict verdict = moved.verdict(v, v_b);
    if (verdict == Verdict::out) return false;
    if (verdict == Verdict::undecided) return std::nullopt;
    const auto contact = moved.contact(v, v_b);
    if (!std::isfinite(horizon) || !contact || contact->latest <= horizon) return true;
    if (contact->earliest > horizon) return false;
    return std::nullopt;
  };
  if (error.position.isZero(0)) return ask(pair);
  Placed obstacle = pair.obstacle();
  obstacle.pose.position += error.position;
  return ask(Pair(pair.agent(), obstacle));
}

}  // namespace
}  // namespace robust

RobustAnswer robust_verdict(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& v_a, const Vector3d& v_b,
                            const RelativeErrors& errors) {
  using namespace robust;
  require(errors, v_a, v_b);
  const Side side_a(a), side_b(b);
  const double by_size = errors.size;
  if (errors.attitude_a == 0 && errors.attitude_b == 0) {
    const RobustAnswer answer = decide({side_a, side_b, side_a, side_b, side_a, side_b, true, by_size}, v_a,
                                       v_b, errors, ellipsoids_collide);
    if (answer.verdict == RobustVerdict::undecided && none(errors))
      return without_errors(a, b, v_a, v_b, errors.horizon);
    return answer;
  }
  const Ellipsoid outer_a = around_turned(a, errors.attitude_a),
                  outer_b = around_turned(b, errors.attitude_b);
  const Ellipsoid inner_a = within_turned(a, errors.attitude_a),
                  inner_b = within_turned(b, errors.attitude_b);
  const Side of_outer_a(outer_a), of_outer_b(outer_b), of_inner_a(inner_a), of_inner_b(inner_b);
  return decide({of_outer_a, of_outer_b, side_a, side_b, of_inner_a, of_inner_b, true, by_size}, v_a, v_b,
                errors, ellipsoids_collide);
}

RobustAnswer robust_verdict(const Pair& pair, const Vector3d& v_a, const Vector3d& v_b,
                            const RelativeErrors& errors) {
  using namespace robust;
  require(errors, v_a, v_b);
  const ConvexHullOf a(pair.agent()), b(pair.obstacle());
  if (a.convex && b.convex && a.parts.size() == 1 && b.parts.size() == 1)
    return robust_verdict(a.parts.front(), b.parts.front(), v_a, v_b, errors);
  const Side side_a = side_of(a), side_b = side_of(b);
  const double by = slightly_more(errors.size + moved_by_turning(pair.agent(), errors.attitude_a) +
                                  moved_by_turning(pair.obstacle(), errors.attitude_b));
  const auto inflated = [&](double horizon) {
    return Engagement(side_a, side_b, v_a, v_b, {errors.position, by},
                      {errors.velocity, strayed(errors, horizon)}, horizon);
  };
  const Engagement widened = inflated(errors.horizon);
  const ErrorSet moved = with_size(errors.position, errors.size);
  const ErrorSet& places = errors.size > 0 ? moved : errors.position;
  const Engagement thought(side_a, side_b, v_a, v_b, {places}, {errors.velocity}, errors.horizon);

  RobustAnswer answer;
  const Vector3d between = pair.obstacle().middle() - pair.agent().middle();
  const Vector3d start = between.isZero(0) ? Vector3d(Vector3d::UnitX()) : between;
  if (const Nearest all = nearest(widened, start); all.nearness == Nearness::apart) {
    answer.verdict = RobustVerdict::out;
    answer.normal = all.normal;
    return answer;
  }
  const auto without = pair_collides(pair, v_a, v_b, {}, errors.horizon);
  if (!without) return answer;
  if (none(errors)) {
    answer.verdict = *without ? RobustVerdict::in : RobustVerdict::out;
    return answer;
  }
  if (*without) {
    decide_in(answer, thought, a.convex && b.convex, errors, inflated);
    return answer;
  }
  // Towards the hulls' overlap; halves are in the sets as well, exactly.
  const Nearest some = nearest(thought, start);
  if (some.nearness != Nearness::meet) return answer;
  double time = 0;
  RelativeError error = error_of(thought, some, time);
  for (int i = 0; i < 3; ++i) {
    if (pair_collides(pair, v_a, v_b, error, errors.horizon).value_or(false)) {
      answer.verdict = RobustVerdict::depends;
      answer.collides = error;
      return answer;
    }
    error.position *= 0.5, error.velocity *= 0.5;
  }
  return answer;
}

namespace {

/// S + by I of the body, or the ball of this radius where that is no ellipsoid.
Ellipsoid with_shape(const Ellipsoid& body, double by, double otherwise) {
  Matrix3d shape = body.shape();
  shape.diagonal().array() += by;
  shape = (0.5 * (shape + shape.transpose())).eval();
  try {
    return Ellipsoid::from_shape(body.center(), shape);
  } catch (const InputError&) {
    return Ellipsoid::from_axes(body.center(), Vector3d::Constant(otherwise));
  }
}

void require_angle(double angle) {
  if (!(angle >= 0 && std::isfinite(angle)))
    throw InputError("angle", to_text(angle), "a finite angle, 0 or more (rad)");
}

/// 1e-13 of the largest entry covers the rounding of shape(), of the sum and of the axes.
double rounding_of(const Ellipsoid& body) { return 1e-13 * body.shape().trace(); }

}  // namespace

Ellipsoid around_turned(const Ellipsoid& body, double angle) {
  require_angle(angle);
  if (angle == 0) return body;
  const Vector3d axes = body.semi_axes();
  if (angle >= std::numbers::pi / 2)
    return Ellipsoid::from_axes(body.center(), Vector3d::Constant(axes(0) * (1 + 1e-12)));
  const double difference = (axes(0) - axes(2)) * (axes(0) + axes(2));
  return with_shape(body, std::sin(angle) * difference + rounding_of(body), axes(0));
}

Ellipsoid within_turned(const Ellipsoid& body, double angle) {
  require_angle(angle);
  if (angle == 0) return body;
  const Vector3d axes = body.semi_axes();
  const double ball = axes(2) * (1 - 1e-12);
  const double difference = (axes(0) - axes(2)) * (axes(0) + axes(2));
  const double less = std::sin(std::min(angle, std::numbers::pi / 2)) * difference + rounding_of(body);
  // Of a body that would keep less than half of its least semi-axis the ball is the better one.
  if (angle >= std::numbers::pi / 2 || less > 0.75 * axes(2) * axes(2))
    return Ellipsoid::from_axes(body.center(), Vector3d::Constant(ball));
  return with_shape(body, -less, ball);
}

}  // namespace vericone
