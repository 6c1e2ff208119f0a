// SPDX-License-Identifier: BSD-3-Clause
#include "pilot.h"
#include <vericone/internal/guidance/pursuit/source_laws.h>

#include <algorithm>
#include <cmath>

#include "stopwatch.h"

namespace vericone::vision {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

guidance::Cartesian<2> engagement(const simulation::Motion& own, const Vector2d& position,
                                  const Vector2d& velocity) {
  return {own.position.head<2>(), own.velocity.head<2>(), position, velocity};
}

guidance::FocalState focal_state(const simulation::Motion& own, const guidance::EnclosingEllipse& ellipse) {
  guidance::FocalState state;
  state.position = own.position.head<2>();
  state.velocity = own.velocity.head<2>();
  state.foci = ellipse.foci;
  state.velocities = ellipse.foci_rates;
  state.accelerations = {Vector2d::Zero(), Vector2d::Zero()};
  state.a = ellipse.a;
  state.a_rate = ellipse.a_rate;
  return state;
}

/// (4.26), (4.27).
Vector2d along_heading(const simulation::Motion& own, double lateral, double longitudinal) {
  const Vector2d v = own.velocity.head<2>();
  const double speed = v.norm();
  if (!(speed > 0)) return {longitudinal, lateral};
  const Vector2d ahead = v / speed;
  return longitudinal * ahead + lateral * Vector2d(-ahead.y(), ahead.x());
}

/// x_S of the upright box around an ellipse, px, with `wider` m on each side, and its rate.
std::pair<double, double> size_in_picture(const guidance::EnclosingEllipse& ellipse, double wider,
                                          double focal, double altitude, double climb) {
  const double a = ellipse.a + wider, b = ellipse.b + wider, diagonal = std::hypot(a, b);
  const double size = 2 * focal / altitude * diagonal;
  const double rate = (a * ellipse.a_rate + b * ellipse.b_rate) / (diagonal * diagonal) - climb / altitude;
  return {size, size * rate};
}

}  // namespace

Pilot::Pilot(const Pursuit& pursuit)
    : pursuit_(pursuit),
      follower_(pursuit.side),
      law_(pursuit.focal, pursuit.form),
      foci_{guidance::SingerFilter(pursuit.source_filter), guidance::SingerFilter(pursuit.source_filter)} {
  if (pursuit.vertical) vertical_.emplace(*pursuit.vertical);
}

void Pilot::rendezvous(const simulation::Motion& own, const Known& target, PursuitSample& sample) {
  const guidance::PlanarState state =
      guidance::planar_state(engagement(own, target.position, target.velocity));
  const guidance::PursuitCommand command =
      guidance::rendezvous_law(state, target.acceleration, pursuit_.rendezvous);
  sample.lateral = command.lateral;
  sample.longitudinal = command.longitudinal;
  sample.y1 = command.y1;
  sample.y2 = command.y2;
  sample.layer = command.status == guidance::PursuitStatus::singular;
}

void Pilot::focal_law(const simulation::Motion& own, double t, PursuitSample& sample) {
  guidance::FocalState state = focal_state(own, sample.ellipse);
  if (pursuit_.eyes != Eyes::exact)  // (4.2.7): the foci go through filters of their own
    for (std::size_t i = 0; i < 2; ++i) {
      guidance::SingerFilter& filter = foci_[i];
      if (!filter.started()) {
        guidance::SingerFilter::State first;
        first << state.foci[i].x(), state.velocities[i].x(), 0, state.foci[i].y(), state.velocities[i].y(), 0;
        filter.start(first, guidance::SingerFilter::Covariance::Identity(), t);
      } else {
        filter.step(state.foci[i], pursuit_.noise * Eigen::Matrix2d::Identity(), t);
      }
      state.foci[i] = filter.position();
      state.velocities[i] = filter.velocity();
      state.accelerations[i] = filter.acceleration();
    }
  const guidance::PursuitCommand command = law_.step(state, t);
  sample.lateral = command.lateral;
  sample.longitudinal = command.longitudinal;
  sample.y1 = command.y1;
  sample.y2 = command.y2;
  sample.layer = law_.in_layer();
}

void Pilot::ours(const simulation::Motion& own, std::span<const Known> known, PursuitSample& sample) {
  Vector2d acceleration = Vector2d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  double count = 0;
  for (const Known& one : known)
    if (!one.left_out) {
      acceleration += one.acceleration;
      covariance += one.covariance;
      ++count;
    }
  const guidance::PursuitStep step = guidance::pursuit_law(
      own.position.head<2>(), own.velocity.head<2>(), sample.ellipse, acceleration / count, pursuit_.ours);
  const Vector2d v = own.velocity.head<2>();
  const double speed = v.norm();
  const Vector2d ahead = speed > 0 ? Vector2d(v / speed) : Vector2d(1, 0);
  sample.longitudinal = step.acceleration.dot(ahead);
  sample.lateral = step.acceleration.dot(Vector2d(-ahead.y(), ahead.x()));
  sample.y1 = step.y1;
  sample.y2 = step.y2;
  sample.m = step.m;
  if (covariance.isZero()) return;
  // Of the centre of independent errors.
  const guidance::ConeConfidence confidence =
      guidance::cone_confidence(own.position.head<2>(), v, sample.ellipse, covariance / (count * count));
  sample.probability = confidence.probability;
  sample.y_low = confidence.y_low;
  sample.y_high = confidence.y_high;
}

double Pilot::climb(const simulation::Motion& own, std::span<const Known> known, double focal,
                    PursuitSample& sample) {
  // Ours: a vehicle may be anywhere within two deviations, so the camera climbs while one is hidden.
  constexpr double kDeviations = 2;
  double wider = 0;
  if (pursuit_.law == Whose::ours)
    for (const Known& one : known)
      if (!one.left_out)
        wider =
            std::max(wider, kDeviations * std::sqrt(std::max(one.covariance(0, 0), one.covariance(1, 1))));
  const double z = own.position.z();
  const auto [size, rate] = size_in_picture(sample.ellipse, wider, focal, z, own.velocity.z());
  sample.size = size;
  sample.off_centre = (sample.ellipse.centre - own.position.head<2>()).norm() * focal / z;
  if (!vertical_) {
    // The altitude of the start is held, with the gains of one that Algorithm 2 has locked.
    constexpr guidance::VerticalGains kHold;
    return guidance::altitude_acceleration(pursuit_.start.position.z(), z, own.velocity.z(), kHold.lock_p,
                                           kHold.lock_d);
  }
  const double up = vertical_->step(size, rate, z, own.velocity.z());
  sample.mode = vertical_->mode();
  return up;
}

simulation::VehicleCommand Pilot::step(const simulation::Motion& own, std::span<const Known> known,
                                       double focal, double t, PursuitSample& sample) {
  centres_.clear();
  velocities_.clear();
  const Known* only = nullptr;
  for (const Known& one : known)
    if (!one.left_out) {
      centres_.push_back(one.position);
      velocities_.push_back(one.velocity);
      only = &one;
    }
  simulation::VehicleCommand command;
  if (only == nullptr) {
    // All are lost for good: it stops, and climbs as long as its vertical law's altitude allows.
    constexpr double kBrake = 0.5, kClimb = 2;  // 1/s, m/s
    const double above =
        pursuit_.vertical ? pursuit_.vertical->altitude + pursuit_.vertical->altitude_band : 0;
    const double climb = pursuit_.vertical && own.position.z() < above ? kClimb : 0;
    command.acceleration = kBrake * (Vector3d(0, 0, climb) - own.velocity);
    const double level = command.acceleration.head<2>().norm(), limit = pursuit_.ours.most;
    if (level > limit) command.acceleration.head<2>() *= limit / level;
    return command;
  }
  const auto start = Clock::now();
  sample.ellipse = follower_.step(centres_, velocities_);
  sample.ellipse_seconds = seconds_since(start);
  if (pursuit_.law == Whose::ours)
    ours(own, known, sample);
  else if (pursuit_.source_law == SourceLaw::rendezvous)
    rendezvous(own, *only, sample);
  else
    focal_law(own, t, sample);
  const double up = climb(own, known, focal, sample);
  command.acceleration << along_heading(own, sample.lateral, sample.longitudinal), up;
  ++steps_;
  in_layer_ += sample.layer;
  return command;
}

void evaluate(const Pursuit& pursuit, const simulation::Motion& own,
              std::span<const simulation::RoadPoint> truth, guidance::EllipseFollower& follower,
              PursuitSample& sample) {
  std::vector<Vector2d> centres, velocities;
  for (const simulation::RoadPoint& one : truth) {
    centres.push_back(one.position);
    velocities.push_back(one.velocity);
  }
  sample.true_ellipse = follower.step(centres, velocities);
  if (pursuit.source_law == SourceLaw::rendezvous) {
    // (3.1) without angles, so that it has a value where both are in one place: r V_theta is r x V.
    const Vector2d r = truth[0].position - own.position.head<2>(),
                   v = truth[0].velocity - own.velocity.head<2>();
    sample.true_y2 = v.squaredNorm();
    sample.true_y1 =
        std::pow(r.x() * v.y() - r.y() * v.x(), 2) - std::pow(pursuit.rendezvous.radius, 2) * sample.true_y2;
    return;
  }
  const guidance::FocalRates rates =
      guidance::focal_cone(focal_state(own, sample.true_ellipse), pursuit.form);
  sample.true_y1 = rates.y1;
  sample.true_y2 = rates.y2;
}

}  // namespace vericone::vision
