// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/passing.h"

#include <algorithm>
#include <cmath>

namespace vericone::simulation {

Passage::Passage(const Track& a, const Track& b, const Pilot& pilot, bool by_centres)
    : guide_(&pilot.guide),
      by_centres_(by_centres || pilot.passing == Passing::centres),
      reach_(reach(a.shape()) + reach(b.shape())),
      placed_(b.shape().rigid() ? b.shape().rigid()->placed() : nullptr) {}

Eigen::Vector3d Passage::between(const Track& a, const Track& b, double t) const {
  const Motion of_b = b.motion(t);
  const Eigen::Vector3d c = of_b.position - a.motion(t).position;
  return placed_ ? Eigen::Vector3d(c + of_b.rotation * placed_->middle()) : c;
}

double Passage::outside(const Track& a, const Track& b, double t) const {
  const Motion of_b = b.motion(t);
  const Eigen::Vector3d seen = of_b.rotation.transpose() * (a.motion(t).position - of_b.position);
  const Box box = placed_->body.bounds();
  return ((placed_->pose.to_body(seen) - box.center()).cwiseAbs() - box.half_widths()).maxCoeff();
}

double Passage::rate(const Track& a, const Track& b, double t) {
  if (placed_)
    return std::min(between(a, b, t).dot(b.motion(t).velocity - a.motion(t).velocity), outside(a, b, t));
  const Motion of_a = a.motion(t), of_b = b.motion(t);
  const Eigen::Vector3d c = of_b.position - of_a.position, v = of_b.velocity - of_a.velocity;
  const double closing = c.dot(v);
  if (!(closing >= 0) || by_centres_ || c.isZero(0)) return closing;
  // No contact is farther from the line of sight than that of balls about the bodies, so the bisector is at
  // most half as far from it, whatever the plane.
  const double r = c.norm();
  if (reach_ < r) {
    const double half = 0.5 * std::asin(reach_ / r), along = closing / r, across = (v - along / r * c).norm();
    if (along * std::cos(half) > 1.001 * across * std::sin(half)) return closing;
  }
  const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
  const auto across = guidance::choose_plane(at_a, at_b, guide_->sector, guide_->plane,
                                             seen_.across ? &*seen_.across : nullptr, &seen_.edges);
  seen_.across = across;
  if (!across) return closing;
  const auto view =
      guidance::plane_view(at_a, at_b, *across, guide_->sector, guidance::RateMethod::none, 0, &seen_.edges);
  return view ? guidance::cone_rates(view->state, view->cone).v_r_hat : closing;
}

}  // namespace vericone::simulation
