// SPDX-License-Identifier: BSD-3-Clause
#include "printed_law.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vericone::dhal2022 {
namespace {

/// a_A of (6.19), before saturation. Angles from the line of sight; K and w the gains.
double law_6_19(const guidance::PlaneView& view, Print print, double gain, double reference, double mu) {
  const guidance::PlanarState& s = view.state;
  const guidance::PlaneCone& cone = view.cone;
  const double v2 = s.v_r * s.v_r + s.v_theta * s.v_theta;
  const double y = guidance::cone_rates(s, cone).y;
  const double twice = 2 * (s.theta - cone.theta_b), alpha = s.alpha - s.theta, beta = s.beta - s.theta;
  const double d1 =
      2 * s.v_r * s.v_theta * std::cos(twice) + (s.v_r * s.v_r - s.v_theta * s.v_theta) * std::sin(twice);
  const double d2 = 2 * (s.v_r * std::cos(alpha) + s.v_theta * std::sin(alpha));
  const double n1 = v2 * (2 * gain * (reference - y) + cone.psi_rate * std::sin(cone.psi));
  if (print == Print::as_printed) {
    const double n3 = -(s.v_r * std::cos(beta) - s.v_theta * std::sin(beta));
    return -(n1 + cone.theta_b_rate * d1 * v2) / (d1 * (0.5 * d1 + mu * n3));
  }
  const double n3 = -(s.v_r * std::cos(beta) + s.v_theta * std::sin(beta));
  return -v2 * (n1 + 2 * cone.theta_b_rate * d1) / (d1 * (d2 + 2 * mu * n3));
}

}  // namespace

simulation::PairProof fly_6_19(const simulation::Scenario& scenario, Print print, double gain,
                               double reference, double duration) {
  const simulation::Body &first = scenario.bodies.at(0), &second = scenario.bodies.at(1);
  const guidance::GuideOptions& options = first.pilot.value().guide;
  const double most = options.inversion.most;
  simulation::Track a(first.shape, first.start, first.orientation, 0),
      b(second.shape, second.start, second.orientation, 0);
  for (std::int64_t k = 0; double(k) * scenario.step < duration; ++k) {
    const double t = double(k) * scenario.step, to = std::min(duration, double(k + 1) * scenario.step);
    const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
    Eigen::Vector3d command_a = Eigen::Vector3d::Zero(), command_b = command_a;
    const auto across = guidance::choose_plane(at_a, at_b, guidance::SectorMethod::slice, {});
    const auto view = across ? guidance::plane_view(at_a, at_b, *across, guidance::SectorMethod::slice,
                                                    guidance::RateMethod::analytic)
                             : std::nullopt;
    if (!view) break;  // slices meet: the bodies do as well
    if (guidance::cone_rates(view->state, view->cone).colliding()) {
      double command = law_6_19(*view, print, gain, reference, options.mu);
      if (!std::isfinite(command)) command = most;  // on the bisector: (5.12) says that it is saturated
      command = std::clamp(command, -most, most);
      command_a = command * view->lateral_a();
      command_b = options.mu * command * view->lateral_b();
    }
    a.advance(command_a, to);
    b.advance(command_b, to);
  }
  return simulation::prove(a, b, 0, std::min(a.end(), b.end()), scenario.proof);
}

}  // namespace vericone::dhal2022
