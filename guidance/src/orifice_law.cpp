// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/orifice_law.h>
#include <vericone/internal/guidance/directions.h>
#include <vericone/internal/guidance/orifice_function.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/opening/opening.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

/// Perpendicular to the velocity, towards a point: as hard as allowed, at most what turns it there within a
/// second.
OrificeCommand turn_towards(const Vector3d& to_point, const Vector3d& velocity, double most) {
  OrificeCommand command;
  command.status = OrificeStatus::turning;
  const double speed = velocity.norm();
  if (!(speed > 0)) {
    command.status = OrificeStatus::no_relative_velocity;
    return command;
  }
  const Vector3d ahead = velocity / speed;
  Vector3d aside = to_point - ahead * to_point.dot(ahead);
  const double angle = std::atan2(aside.norm(), to_point.dot(ahead));
  // Straight behind: any side is as good; a level turn.
  if (!(aside.norm() > 1e-12 * to_point.norm()))
    aside = ahead.head<2>().isZero(0) ? AxisFrame(ahead).e1 : Vector3d(-ahead.y(), ahead.x(), 0);
  command.demanded = angle * speed;
  command.acceleration = std::min(command.demanded, most) * aside.normalized();
  return command;
}

void command_within(const Vector3d& acceleration, double most, OrificeCommand& command) {
  command.acceleration = acceleration;
  command.demanded = acceleration.norm();
  command.status = OrificeStatus::steering;
  if (command.demanded > most) {
    command.acceleration *= most / command.demanded;
    command.status = OrificeStatus::saturated;
  }
}

/// `rate` = gradient.a by the least a along or across what is allowed.
void invert(const Vector3d& gradient, double rate, double most, OrificeCommand& command) {
  const double squared = gradient.squaredNorm();
  if (squared > 0)
    command_within(rate / squared * gradient, most, command);
  else
    command.status = OrificeStatus::no_effect;
}

/// One side of the rim: its clearance is m + h gradient.a after h seconds of the acceleration a, and is to
/// grow at `rate`.
struct Side {
  Vector3d gradient;
  double rate;
};

/// The least acceleration that gives all sides their rates, or, where they want opposite things, what is
/// missing shared out: min |a|^2 + sum (what is missing of gradient_i.a >= rate_i)^2 / mu_i, by its dual, one
/// side after the other (Hildreth, 1957).
Vector3d for_all(std::span<const Side> sides) {
  constexpr double kSoft = 1e-3;
  std::array<double, 4> weights{};
  Vector3d a = Vector3d::Zero();
  for (int sweep = 0; sweep < 200; ++sweep)
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double squared = sides[i].gradient.squaredNorm(), before = weights[i];
      const double missing = sides[i].rate - sides[i].gradient.dot(a) - kSoft * squared * before;
      weights[i] = std::max(0.0, before + missing / ((1 + kSoft) * squared));
      a += (weights[i] - before) * sides[i].gradient;
    }
  return a;
}

}  // namespace

const char* to_string(OrificeStatus status) {
  switch (status) {
    case OrificeStatus::steering:
      return "steering";
    case OrificeStatus::saturated:
      return "saturated";
    case OrificeStatus::clear:
      return "clear";
    case OrificeStatus::turning:
      return "turning";
    case OrificeStatus::coasting:
      return "coasting";
    case OrificeStatus::no_effect:
      return "no_effect";
    case OrificeStatus::no_relative_velocity:
      return "no_relative_velocity";
  }
  return "?";
}

OrificeFunction orifice_function(const Cartesian<3>& motion, double opening_radius, double agent_radius) {
  const Vector3d c = motion.p_b - motion.p_a, w = motion.v_a - motion.v_b;
  const double room = opening_radius - agent_radius, squared = w.squaredNorm();
  OrificeFunction f;
  if (!(squared > 0)) {
    f.y = -room * room;
    return f;
  }
  const double time = c.dot(w) / squared;
  const Vector3d aside = c - time * w;  // from A to the centre when they are nearest
  f.y = aside.squaredNorm() - room * room;
  f.by_acceleration = -2 * time * aside;
  f.v_r = c.isZero(0) ? 0 : -c.dot(w) / c.norm();
  return f;
}

OrificeCommand orifice_law(const Cartesian<3>& motion, double opening_radius, double agent_radius,
                           const OrificeLawOptions& options) {
  const OrificeFunction f = orifice_function(motion, opening_radius, agent_radius);
  const Vector3d c = motion.p_b - motion.p_a;
  OrificeCommand command;
  command.y = f.y;
  if (f.y < 0 && c.squaredNorm() <= opening_radius * opening_radius) {
    command.status = OrificeStatus::coasting;
    return command;
  }
  if (!(f.v_r < 0)) {
    command = turn_towards(c, motion.v_a, options.most);
    command.y = f.y;
    return command;
  }
  Vector3d gradient = f.by_acceleration;
  if (options.direction) {
    const Vector3d d = unit_vector(*options.direction);
    gradient = gradient.dot(d) * d;
  }
  invert(gradient, options.gain * (options.reference - f.y), options.most, command);
  return command;
}

namespace {

OpeningClearance clearance_of(const BodyState& a, const PlacedOpening& opening, const Vector3d& w) {
  return a.shape.support_point(w) ? opening_clearance(a.shape, opening, w)
                                  : opening_clearance(a.shape.containing_ellipsoid(), opening, w);
}

/// The opening moved so that A flies through its deepest point: what it has room for along w.
double room_along(const BodyState& a, PlacedOpening opening, const Vector3d& w) {
  opening.center = a.position - opening.axes * opening.opening.deepest();
  return clearance_of(a, opening, w).distance;
}

/// Of the time constant 1 / gain: how far ahead a command is looked at.
constexpr double kAhead = 0.25;
/// Not worth more: of all the room there is.
constexpr double kMostRoom = 0.95;

}  // namespace

OrificeAim orifice_aim(const BodyState& a, const OrificeState& orifice, const std::optional<double>& speed,
                       const std::optional<double>& margin) {
  const auto meet = [&](const auto& point_of) {
    OrificeAim aim;
    // The point turns and moves on the way: a few looks ahead.
    aim.point = point_of(orifice.opening);
    for (int i = 0; i < 8; ++i) {
      const Vector3d c = aim.point - a.position;
      double closing = speed.value_or(a.velocity.norm());
      if (!speed && i == 0) {
        const double relative = c.dot(a.velocity - orifice.velocity) / c.norm();
        if (relative > 0.1 * closing) closing = relative;
      }
      const double seconds = closing > 0 ? c.norm() / closing : 0;
      constexpr double kNever = 1e9;  // s: what moves away faster than A follows is met later each time
      if (!(seconds < kNever)) break;
      aim.seconds = seconds;
      const OrificeState then = orifice.after(aim.seconds);
      aim.point = point_of(then.opening);
      aim.velocity = then.velocity + then.spin.cross(Vector3d(aim.point - then.opening.center));
    }
    return aim;
  };
  const auto deepest = [](const PlacedOpening& at) -> Vector3d {
    return at.center + at.axes * at.opening.deepest();
  };
  const OrificeAim direct = meet(deepest);
  if (!margin || !(direct.seconds > 0)) return direct;
  const Vector3d w = (direct.point - a.position) / direct.seconds - orifice.velocity;
  if (!(w.squaredNorm() > 0)) return direct;
  const PlacedOpening then = orifice.after(direct.seconds).opening;
  const double most = kMostRoom * room_along(a, then, then.normal());
  if (room_along(a, then, w) >= std::min(*margin, most)) return direct;
  const double side = then.normal().dot(a.position - orifice.opening.center) < 0 ? -1 : 1;
  const double away = then.opening.reach() + 2 * a.shape.containing_ellipsoid().radius(then.normal());
  return meet([&](const PlacedOpening& at) -> Vector3d { return deepest(at) + side * away * at.normal(); });
}

OrificeCommand passage_law(const BodyState& a, const OrificeState& orifice,
                           const PassageLawOptions& options) {
  OrificeCommand command;
  const Vector3d w = a.velocity - orifice.velocity;
  const Vector3d n = orifice.opening.normal(), c = orifice.opening.center - a.position;
  const double to_plane = n.dot(c), along = n.dot(w);
  if (!(w.squaredNorm() > 0)) {
    command.status = OrificeStatus::no_relative_velocity;
    return command;
  }
  const double seconds = along != 0 ? to_plane / along : -1;
  const auto turn = [&] {
    const OrificeAim aim = orifice_aim(a, orifice, {}, options.margin);
    return turn_towards(aim.point - a.position, a.velocity, options.most);
  };
  if (!(seconds > 0)) {
    // In the plane, or past it: through as long as some of the body is in it.
    const Ellipsoid body = a.shape.containing_ellipsoid();
    const double reach = body.radius(n.normalized());
    if (to_plane * along <= 0 && std::abs(to_plane) <= reach * n.norm()) {
      command.status = OrificeStatus::coasting;
      return command;
    }
    return turn();
  }
  // As it will be turned when A's centre is there; where it is then is in the relative velocity.
  PlacedOpening then = orifice.after(seconds).opening;
  then.center = orifice.opening.center;
  const OpeningClearance now = clearance_of(a, then, w);
  command.m = now.distance;
  if (now.distance >= options.margin + options.beyond) return command;
  const double room = kMostRoom * room_along(a, then, w);
  if (!(room > 0) || now.normal.isZero(0)) {
    command = turn();
    command.m = now.distance;
    return command;
  }
  const double wanted = std::min(options.margin + options.beyond, room);
  if (now.distance >= wanted) return command;
  // Fading where the margin is kept: what is still missing would ask for ever more as the time runs out.
  const auto rate_at = [&](double m) {
    const double missing = wanted - m, kept = wanted - std::min(options.margin, room);
    const bool fades = m > options.margin && missing > 0 && kept > 0;
    const double fade = fades ? std::min(1.0, missing / kept) : 1;
    return options.gain * missing * fade;
  };
  const auto gradient_of = [&](const OpeningClearance& clearance) {
    Vector3d gradient = -clearance.time * clearance.normal;
    if (options.longitudinal) return gradient;
    const Vector3d ahead = a.velocity.normalized();
    return Vector3d(gradient - ahead * ahead.dot(gradient));
  };
  std::array<Side, 4> sides{Side{gradient_of(now), rate_at(now.distance)}};
  invert(sides[0].gradient, sides[0].rate, options.most, command);
  // What is commanded may leave one side of the rim only to come too near to another before it is done.
  // Steering by the nearer one alone would then change sides at every command.
  const double h = std::min(seconds, kAhead / options.gain);
  for (std::size_t k = 1; k < sides.size(); ++k) {
    const Vector3d change = h * command.acceleration;
    const OpeningClearance later = clearance_of(a, then, w + change);
    const Vector3d gradient = gradient_of(later);
    if (!(gradient.dot(change) < 0) || later.distance >= now.distance) break;
    sides[k] = {gradient, rate_at(later.distance - gradient.dot(change))};
    command_within(for_all({sides.data(), k + 1}), options.most, command);
  }
  command.m = now.distance;
  return command;
}

}  // namespace vericone::guidance
