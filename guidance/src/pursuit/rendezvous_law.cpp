// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/internal/guidance/pursuit/source_laws.h>
#include <algorithm>
#include <cmath>

namespace vericone::guidance {

const char* to_string(PursuitStatus status) {
  switch (status) {
    case PursuitStatus::steering:
      return "steering";
    case PursuitStatus::saturated:
      return "saturated";
    case PursuitStatus::singular:
      return "singular";
  }
  return "?";
}

void saturate(PursuitCommand& command, double most) {
  if (!(most >= 0)) throw InputError("most", to_text(most), "0 or more (m/s^2)");
  const auto limit = [&](double& a) {
    const double limited = std::clamp(a, -most, most);
    if (limited != a && command.status == PursuitStatus::steering) command.status = PursuitStatus::saturated;
    a = limited;
  };
  limit(command.lateral);
  limit(command.longitudinal);
}

RendezvousRates rendezvous_cone(const PlanarState& s, double radius) {
  const double square = radius * radius, r2 = s.r * s.r;
  const double sine = std::sin(s.alpha - s.theta), cosine = std::cos(s.alpha - s.theta);
  RendezvousRates f;
  f.y2 = s.v_r * s.v_r + s.v_theta * s.v_theta;
  f.y1 = r2 * s.v_theta * s.v_theta - square * f.y2;
  // (3.4) as corrected. Along the kinematics without acceleration r V_theta and V are constant: no drift.
  const double by_v_theta = 2 * s.v_theta * (r2 - square), by_v_r = -2 * square * s.v_r;
  f.by_lateral1 = -by_v_theta * cosine + by_v_r * sine;
  f.by_longitudinal1 = -by_v_theta * sine - by_v_r * cosine;
  f.by_lateral2 = 2 * (-s.v_theta * cosine + s.v_r * sine);
  f.by_longitudinal2 = 2 * (-s.v_theta * sine - s.v_r * cosine);
  return f;
}

PursuitCommand rendezvous_law(const PlanarState& s, const Eigen::Vector2d& acceleration_b,
                              const RendezvousGains& gains) {
  const RendezvousRates f = rendezvous_cone(s, gains.radius);
  PursuitCommand command;
  command.y1 = f.y1;
  command.y2 = f.y2;
  const double denominator = 2 * s.v_r * s.v_theta * s.r * s.r;
  if (!(std::abs(denominator) >= gains.singular) || denominator == 0) {
    command.status = PursuitStatus::singular;
    return command;
  }
  // (3.7), (3.8): right as printed.
  const double sign = gains.closing && s.v_r > 0 ? -1 : 1;
  const double cone = sign * gains.cone * (f.y1 - gains.reference), speed = gains.speed * f.y2;
  const double sine = std::sin(s.alpha - s.theta), cosine = std::cos(s.alpha - s.theta);
  const double square = gains.radius * gains.radius, rest = s.v_theta * (s.r * s.r - square);
  const double lateral =
      cone * (s.v_r * cosine + s.v_theta * sine) + speed * (s.v_r * square * cosine - rest * sine);
  const double longitudinal =
      cone * (s.v_r * sine - s.v_theta * cosine) + speed * (s.v_r * square * sine + rest * cosine);
  const Eigen::Vector2d ahead(std::cos(s.alpha), std::sin(s.alpha)), left(-ahead.y(), ahead.x());
  command.lateral = lateral / denominator + left.dot(acceleration_b);
  command.longitudinal = longitudinal / denominator + ahead.dot(acceleration_b);
  saturate(command, gains.most);
  return command;
}

}  // namespace vericone::guidance
