// SPDX-License-Identifier: BSD-3-Clause
#include "run_events.h"

#include <cmath>
#include <limits>

namespace vericone::simulation {

double sign_change(const std::function<double(double)>& value, double from, double to) {
  const bool end = value(to) >= 0;
  double low = from, high = to;
  while (high - low > 1e-12 * (to - from)) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) break;
    const double v = value(middle);
    (!std::isfinite(v) || (v >= 0) == end ? high : low) = middle;
  }
  return high;
}

double closing_rate(const Track& a, const Track& b, double t) {
  const Motion at_a = a.motion(t), at_b = b.motion(t);
  return (at_b.position - at_a.position).dot(at_b.velocity - at_a.velocity);
}

double passing_rate(const Track& a, const Track& b, const Pilot& pilot, double t) {
  const double closing = closing_rate(a, b, t);
  const guidance::GuideOptions& guide = pilot.guide;
  if (!(closing >= 0) || pilot.passing == Passing::centres || guide.law == guidance::Law::clearance)
    return closing;
  const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
  if (at_a.position == at_b.position) return closing;
  const auto across = guidance::choose_plane(at_a, at_b, guide.sector, guide.plane, nullptr);
  if (!across) return closing;
  const auto view = guidance::plane_view(at_a, at_b, *across, guide.sector, guidance::RateMethod::none);
  return view ? guidance::cone_rates(view->state, view->cone).v_r_hat : closing;
}

double margin(const Track& a, const Track& b, const guidance::GuideOptions& options, double t) {
  const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
  if (options.law == guidance::Law::clearance)
    return guidance::law_clearance(at_a, at_b) - options.clearance.required;
  const auto course = guidance::on_collision_course(at_a, at_b, options.sector, options.inversion.cease);
  return course ? (*course ? -1 : 1) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace vericone::simulation
