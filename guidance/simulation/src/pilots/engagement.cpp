// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/engagement.h"

#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/guidance/collision_course.h>
#include <vericone/internal/guidance/laws.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "pilots/line_of_sight.h"
#include "tracks/sign_change.h"

namespace vericone::simulation {
namespace {

using guidance::BodyState;
using guidance::Law;
using guidance::LawStatus;

bool avoids(Law law) {
  return law == Law::avoidance || law == Law::cooperative_avoidance || law == Law::clearance;
}

bool nothing_to_say(const std::optional<guidance::GuideStep>& step) {
  return step && guidance::commands_nothing(step->status);
}

}  // namespace

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

Engagement::Engagement(std::size_t agent, std::size_t obstacle, const Pilot& pilot, const Draw& draw)
    : agent_(agent),
      obstacle_(obstacle),
      pilot_(&pilot),
      metres_(pilot.guide.law == Law::clearance),
      avoids_(avoids(pilot.guide.law)) {
  if (pilot.sensor) observer_.emplace(*pilot.sensor, pilot, draw);
}

const BodyState& Engagement::believed(const Instant& now) const {
  return observer_ ? observer_->last()->believed : now.bodies[obstacle_];
}

void Engagement::look(const Instant& now) {
  if (!there(now)) return;
  if (!seen_) gone_ = passing_rate(now, now.t) >= 0;
  seen_ = true;
  const BodyState &a = now.bodies[agent_], &b = now.bodies[obstacle_];
  if (!observer_) {
    ask(a, b, now.t, gone_, {});
    return;
  }
  observer_->look(now, agent_, obstacle_);
  if (!known(now)) return;
  const Observed& seen = *observer_->last();
  ask(a, seen.believed, now.t, false, seen.sight);
  if (step_ && (step_->reading ? step_->v_r_hat >= 0 : step_->status == LawStatus::receding))
    seen_passed_ = true;
}

void Engagement::ask(const BodyState& a, const BodyState& b, double t, bool gone,
                     const guidance::Sight& sight) {
  const Eigen::Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
  const double closing = -c.dot(v);  // times r
  if (passed_ && gone) return;
  passed_ = false;
  if (c.isZero(0)) {  // no line of sight, and nothing left to avoid
    step_.reset();
    time_to_go_ = 0;
    return;
  }
  step_ = guidance::guide(a, b, pilot_->guide, memory_, t, sight);
  time_to_go_ = closing > 0 ? c.squaredNorm() / closing : std::numeric_limits<double>::infinity();
  if (gone && avoids_ && nothing_to_say(step_)) {
    passed_ = true;
    memory_ = {};
  }
}

double Engagement::edge() const {
  return metres_ ? pilot_->guide.clearance.required : pilot_->guide.inversion.cease;
}

double Engagement::margin(const Instant& now, double t) const {
  const BodyState a = now.tracks[agent_].state(t), b = now.tracks[obstacle_].state(t);
  if (metres_)  // none of bodies that do not move against each other
    return a.velocity != b.velocity ? guidance::law_clearance(a, b) - edge()
                                    : std::numeric_limits<double>::quiet_NaN();
  const auto course = guidance::on_collision_course(a, b, pilot_->guide.sector, edge());
  return course ? (*course ? -1 : 1) : std::numeric_limits<double>::quiet_NaN();
}

/// The first look: nothing is crossed.
bool Engagement::first(const Instant& now) const {
  const auto was_there = [&](std::size_t body) { return now.tracks[body].appears() <= now.before; };
  return !(now.before >= 0) || !was_there(agent_) || !was_there(obstacle_);
}

void Engagement::report(const Instant& now, bool log, Run& run) {
  if (!there(now)) return;
  if (observer_) {
    if (sees_in_part(*pilot_->sensor)) report_sight(now, run);
    if (log) report_truth(now, run);
    return;
  }
  const bool inside = this->inside();
  if (inside != inside_ && step_ && !passed_) {
    // Not a change of sides but a passage: nothing is crossed.
    const bool closing = step_->status != LawStatus::receding;
    double when = now.t;
    if (!first(now) && closing)
      when = sign_change([&](double s) { return margin(now, s); }, now.before, now.t);
    if (inside)
      run.events.push_back({when, EventKind::enters_cone, agent_, obstacle_, metres_ ? step_->m : step_->y});
    if (!inside && closing) run.events.push_back({when, EventKind::leaves_cone, agent_, obstacle_, edge()});
  }
  inside_ = inside;
}

void Engagement::report_sight(const Instant& now, Run& run) {
  if (observer_->sees() == in_sight_) return;
  in_sight_ = !in_sight_;
  run.events.push_back({now.t, in_sight_ ? EventKind::sees : EventKind::loses, agent_, obstacle_, 0});
}

void Engagement::report_truth(const Instant& now, Run& run) {
  const BodyState &a = now.bodies[agent_], &b = now.bodies[obstacle_];
  const auto beyond = [&](double s) { return margin(now, s); };
  const bool closing = (b.position - a.position).dot(b.velocity - a.velocity) < 0;
  const bool inside = closing && beyond(now.t) < 0;
  if (inside != inside_ && !has_passed_) {
    const double when = first(now) || !closing ? now.t : sign_change(beyond, now.before, now.t);
    const double value = !inside   ? edge()
                         : metres_ ? guidance::law_clearance(a, b)
                                   : sample(a, b, now.t, false).step.y;
    if (inside || closing)
      run.events.push_back(
          {when, inside ? EventKind::enters_cone : EventKind::leaves_cone, agent_, obstacle_, value});
  }
  inside_ = inside;
}

double Engagement::passing_rate(const Instant& now, double t) {
  const Track &a = now.tracks[agent_], &b = now.tracks[obstacle_];
  if (!passage_) passage_.emplace(a, b, *pilot_, metres_);
  return passage_->rate(a, b, t);
}

void Engagement::moved(const Instant& now, Run& run) {
  if (!there(now)) return;
  const bool before = gone_;
  gone_ = passing_rate(now, now.until) >= 0;
  if (!gone_) return;
  if (!before) {
    const double when = sign_change([&](double s) { return passing_rate(now, s); }, now.t, now.until);
    const Eigen::Vector3d between = passage_->between(now.tracks[agent_], now.tracks[obstacle_], when);
    run.events.push_back({when, EventKind::passes, agent_, obstacle_, between.norm()});
  }
  has_passed_ = true;
}

void Engagement::log(const Instant& now, bool attended, int planes, Run& run) {
  if (!there(now)) return;
  const BodyState &a = now.bodies[agent_], &b = now.bodies[obstacle_];
  run.encounters.push_back(sample(a, b, now.t, attended));
  if (observer_ && known(now)) run.sights.push_back(sight_sample(a, b, now.t));
  if (planes > 0 && !passed_)
    for (const auto& plane : guidance::all_planes(a, b, pilot_->guide.sector, planes))
      run.planes.push_back({now.t, agent_, obstacle_, plane});
}

bool Engagement::demands() const { return step_ && !nothing_to_say(step_); }

bool Engagement::inside() const {
  if (!step_ || passed_) return false;
  if (avoids_) return demands();
  return step_->y < edge() && step_->v_r_hat < 0;
}

/// Where the law had nothing to say, the log still tells y and psi on the plane that it would have chosen.
/// False where there is no cone.
bool Engagement::follow(const BodyState& a, const BodyState& b, EncounterSample& sample) {
  const guidance::GuideOptions& guide = pilot_->guide;
  const auto across = guidance::choose_plane(a, b, guide.sector, guide.plane, looked_ ? &*looked_ : nullptr);
  looked_ = across;
  if (!across) return false;
  const auto view = guidance::plane_view(a, b, *across, guide.sector, guidance::RateMethod::none);
  if (!view) return false;
  const guidance::ConeRates rates = guidance::cone_rates(view->state, view->cone);
  sample.step.across = view->across;
  sample.step.y = rates.y;
  sample.step.v_r_hat = rates.v_r_hat;
  sample.step.psi = view->cone.psi;
  sample.step.theta_b = view->cone.theta_b;
  return true;
}

EncounterSample Engagement::sample(const BodyState& a, const BodyState& b, double t, bool attended) {
  EncounterSample sample;
  sample.t = t;
  sample.agent = agent_;
  sample.obstacle = obstacle_;
  if (a.position != b.position)
    last_state_ = guidance::spatial_state({a.position, a.velocity, b.position, b.velocity},
                                          last_state_ ? &*last_state_ : nullptr);
  if (last_state_) sample.state = *last_state_;
  sample.attended = attended;
  sample.cone = step_.has_value() && !passed_ && !metres_;
  if (step_) sample.step = *step_;
  if (observer_ && !observer_->last()) sample.step.m = std::numeric_limits<double>::quiet_NaN();
  if (passed_) sample.step.status = LawStatus::receding;
  // Of an agent with a sensor the log tells the truth; what it measured stands beside it.
  if (sample.cone && (!demands() || pilot_->sensor) && !follow(a, b, sample) && pilot_->sensor)
    sample.cone = false;
  if (!sample.cone)
    sample.step.y = sample.step.psi = sample.step.theta_b = std::numeric_limits<double>::quiet_NaN();
  if (sample.step.across.any()) {
    const AxisFrame frame(b.position - a.position);
    sample.plane_azimuth = std::atan2(sample.step.across.dot(frame.e2), sample.step.across.dot(frame.e1));
  }
  return sample;
}

SightSample Engagement::sight_sample(const BodyState& a, const BodyState& b, double t) {
  const Observed& observed = *observer_->last();
  SightSample sample;
  sample.t = t;
  sample.agent = agent_;
  sample.obstacle = obstacle_;
  sample.measurement = observed.measurement;
  sample.believed_position = observed.believed.position;
  sample.believed_velocity = observed.believed.velocity;
  const Measurement& m = observed.measurement;
  if (m.position != a.position)
    last_measured_ = guidance::spatial_state({a.position, a.velocity, m.position, m.velocity},
                                             last_measured_ ? &*last_measured_ : nullptr);
  if (last_measured_) sample.measured = *last_measured_;
  const guidance::EngagementParts& errors = observed.sight.errors;  // (7.2): made where the law looks
  sample.measured.r *= 1 + errors.r;
  sample.measured.theta += errors.theta;
  sample.measured.v_r *= 1 + errors.v_r;
  sample.measured.v_theta *= 1 + errors.v_theta;
  if (!step_ || !step_->reading || b.position == a.position) return sample;
  const auto truth =
      guidance::plane_view(a, b, step_->across, pilot_->guide.sector, guidance::RateMethod::analytic);
  if (!truth) return sample;
  sample.on_plane = true;
  sample.reading = *step_->reading;
  sample.state = truth->state;
  sample.cone = truth->cone;
  // What the agent commands turns its own body, and so the cone.
  sample.cone.psi_rate += sample.cone.psi_rate_by_a * sample.reading.inner;
  sample.cone.theta_b_rate += sample.cone.theta_b_rate_by_a * sample.reading.inner;
  sample.cone.psi_rate_by_a = sample.cone.theta_b_rate_by_a = 0;
  sample.y = guidance::cone_rates(sample.state, sample.cone).y;
  const guidance::GuideReading& read = sample.reading;
  guidance::Measured wrong;
  wrong.v_r = read.state.v_r - sample.state.v_r;
  wrong.v_theta = read.state.v_theta - sample.state.v_theta;
  wrong.theta = read.state.theta - sample.state.theta;
  wrong.theta_b = read.cone.theta_b - sample.cone.theta_b;
  wrong.psi = read.cone.psi - sample.cone.psi;
  wrong.psi_rate = read.cone.psi_rate - sample.cone.psi_rate;
  wrong.theta_b_rate = read.cone.theta_b_rate - sample.cone.theta_b_rate;
  const double gain = pilot_->guide.inversion.gain;
  sample.terms = guidance::noise_terms(sample.state, sample.cone, wrong, gain);
  const guidance::Measured& sigma = read.deviations;
  const guidance::NoiseGradients gradients = guidance::noise_gradients(sample.state, sample.cone, gain);
  sample.y_deviation = guidance::deviation(gradients.y, sigma);
  sample.a_deviation = guidance::deviation(gradients.a, sigma);
  sample.v_deviation = guidance::deviation(gradients.v, sigma);
  return sample;
}

}  // namespace vericone::simulation
