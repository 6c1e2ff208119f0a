// SPDX-License-Identifier: BSD-3-Clause
#include "run_events.h"
#include <vericone/internal/guidance/collision_course.h>
#include <vericone/internal/guidance/laws.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::simulation {

std::size_t index_of(const Scenario& scenario, const std::string& name) {
  const auto it = std::find_if(scenario.bodies.begin(), scenario.bodies.end(),
                               [&](const Body& body) { return body.name == name; });
  return std::size_t(it - scenario.bodies.begin());
}

void summarise(std::vector<double>& seconds, RunTimes& times) {
  times.decisions = seconds.size();
  if (seconds.empty()) return;
  for (const double s : seconds) times.mean += s / double(seconds.size());
  const auto within = seconds.begin() + std::ptrdiff_t((seconds.size() * 99 + 99) / 100 - 1);
  std::nth_element(seconds.begin(), within, seconds.end());
  times.within = *within;
  times.worst = *std::max_element(within, seconds.end());
}

// The method of Oliveira and Takahashi (ITP, ACM TOMS 47 (2021)): never more than one step beyond what
// halving takes, and a handful where the value is smooth. Values of -1 and 1 are halved.
double sign_change(const std::function<double(double)>& value, double from, double to) {
  const double at_end = value(to), width = 0.5e-12 * (to - from);
  const bool end = at_end >= 0;
  double low = from, high = to, at_low = value(from), at_high = at_end;
  constexpr int kHalvings = 40;
  for (int k = 0; k <= kHalvings && high - low > 2 * width; ++k) {
    const double middle = low + (high - low) / 2, half = middle - low;
    double at = middle;
    const double chord = low + (high - low) * at_low / (at_low - at_high);
    if (std::isfinite(chord)) {
      const double towards = middle >= chord ? 1 : -1,
                   aside = 0.2 * (high - low) * (high - low) / (to - from);
      if (aside <= std::abs(middle - chord)) at = chord + towards * aside;
      const double room = std::ldexp(width, kHalvings + 1 - k) - half;
      if (!(std::abs(at - middle) <= room)) at = middle - towards * std::max(room, 0.0);
    }
    if (!(at > low && at < high)) at = middle;
    if (!(at > low && at < high)) break;
    const double v = value(at);
    if (!std::isfinite(v) || (v >= 0) == end) {
      high = at;
      at_high = v;
    } else {
      low = at;
      at_low = v;
    }
  }
  return high;
}

Passage::Passage(const Track& a, const Track& b)
    : reach_(reach(a.shape()) + reach(b.shape())),
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

double Passage::rate(const Track& a, const Track& b, const Pilot& pilot, double t) {
  if (placed_)
    return std::min(between(a, b, t).dot(b.motion(t).velocity - a.motion(t).velocity), outside(a, b, t));
  const Motion of_a = a.motion(t), of_b = b.motion(t);
  const Eigen::Vector3d c = of_b.position - of_a.position, v = of_b.velocity - of_a.velocity;
  const double closing = c.dot(v);
  const guidance::GuideOptions& guide = pilot.guide;
  if (!(closing >= 0) || pilot.passing == Passing::centres || guide.law == guidance::Law::clearance)
    return closing;
  if (c.isZero(0)) return closing;
  // No contact is farther from the line of sight than that of balls about the bodies, so the bisector is at
  // most half as far from it, whatever the plane.
  const double r = c.norm();
  if (reach_ < r) {
    const double half = 0.5 * std::asin(reach_ / r), along = closing / r, across = (v - along / r * c).norm();
    if (along * std::cos(half) > 1.001 * across * std::sin(half)) return closing;
  }
  const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
  const auto across = guidance::choose_plane(at_a, at_b, guide.sector, guide.plane,
                                             seen_.across ? &*seen_.across : nullptr, &seen_.edges);
  seen_.across = across;
  if (!across) return closing;
  const auto view =
      guidance::plane_view(at_a, at_b, *across, guide.sector, guidance::RateMethod::none, 0, &seen_.edges);
  return view ? guidance::cone_rates(view->state, view->cone).v_r_hat : closing;
}

double margin(const Track& a, const Track& b, const guidance::GuideOptions& options, double t) {
  const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
  if (options.law == guidance::Law::clearance)
    return guidance::law_clearance(at_a, at_b) - options.clearance.required;
  const auto course = guidance::on_collision_course(at_a, at_b, options.sector, options.inversion.cease);
  return course ? (*course ? -1 : 1) : std::numeric_limits<double>::quiet_NaN();
}

const char* to_string(EventKind kind) {
  switch (kind) {
    case EventKind::appears:
      return "appears";
    case EventKind::enters_cone:
      return "enters-cone";
    case EventKind::leaves_cone:
      return "leaves-cone";
    case EventKind::passes:
      return "passes";
    case EventKind::aligned:
      return "aligned";
    case EventKind::reaches_goal:
      return "reaches-goal";
    case EventKind::contact:
      return "contact";
    case EventKind::cannot_avoid:
      return "cannot-avoid";
    case EventKind::goes_through:
      return "goes-through";
    case EventKind::goes_beside:
      return "goes-beside";
  }
  return "?";
}

std::optional<Event> find_event(const Scenario& scenario, const Run& run, EventKind kind,
                                const std::string& agent, const std::string& obstacle, double after) {
  const std::size_t i = index_of(scenario, agent), j = index_of(scenario, obstacle);
  for (const Event& event : run.events)
    if (event.kind == kind && event.agent == i && event.obstacle == j && event.t >= after) return event;
  return std::nullopt;
}

std::optional<EncounterSample> sample_at(const Scenario& scenario, const Run& run, const std::string& agent,
                                         const std::string& obstacle, double t) {
  const std::size_t i = index_of(scenario, agent), j = index_of(scenario, obstacle);
  std::optional<EncounterSample> nearest;
  for (const EncounterSample& sample : run.encounters)
    if (sample.agent == i && sample.obstacle == j &&
        (!nearest || std::abs(sample.t - t) < std::abs(nearest->t - t)))
      nearest = sample;
  if (nearest && !(std::abs(nearest->t - t) <= scenario.step * (1 + 1e-9))) nearest.reset();
  return nearest;
}

}  // namespace vericone::simulation
