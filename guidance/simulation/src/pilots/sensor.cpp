// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/mixed.h>
#include <vericone/internal/simulation/sight.h>
#include <vericone/simulation/pilot.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vericone::simulation {
namespace {

using detail::mixed;
using Eigen::Vector3d;

// Channels of a measurement. A shared m is that of the first of all.
constexpr std::uint64_t kShared = 0, kPosition = 1, kVelocity = 4, kEngagement = 7, kBall = 16, kDropout = 64,
                        kBias = 65;

double m_of(const Sensor& sensor, const Draw& draw, std::uint64_t channel) {
  return sensor.deviation * draw.normal(sensor.shared ? kShared : channel);
}

/// Uniform in the ball, or in the disc of planar bodies: a direction, and a radius whose cube (square) is
/// even.
Vector3d in_ball(double radius, const Draw& draw, std::uint64_t channel, bool planar) {
  const double azimuth = 2 * std::numbers::pi * draw.uniform(channel), part = draw.uniform(channel + 1);
  if (planar) return radius * std::sqrt(part) * Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
  const double z = 2 * draw.uniform(channel + 2) - 1, across = std::sqrt(1 - z * z);
  return radius * std::cbrt(part) * Vector3d(across * std::cos(azimuth), across * std::sin(azimuth), z);
}

/// Of every measurement of the pair, m.
Vector3d bias_of(const Sensor& sensor, Draw draw, bool planar) {
  draw.step = 0;
  return sensor.bias * in_ball(1, draw, kBias, planar).normalized();
}

/// The standard deviation along an axis of what is uniform in a ball of radius 1, or in a disc.
double ball_deviation(bool planar) { return planar ? 0.5 : std::sqrt(0.2); }

}  // namespace

const char* to_string(Noise noise) {
  constexpr const char* kWords[] = {"engagement", "per-axis", "isotropic", "bounded"};
  return kWords[std::size_t(noise)];
}

const char* to_string(Estimator estimator) {
  constexpr const char* kWords[] = {"none", "state", "set-membership"};
  return kWords[std::size_t(estimator)];
}

Sensor Sensor::times(double factor) const {
  Sensor other = *this;
  for (double* x :
       {&other.position, &other.velocity, &other.bias, &other.engagement.r, &other.engagement.v_r,
        &other.engagement.v_theta, &other.engagement.theta, &other.engagement.theta_b, &other.engagement.psi})
    *x *= factor;
  return other;
}

double Draw::uniform(std::uint64_t channel) const {
  std::uint64_t key = mixed(seed);
  for (const std::uint64_t part : {trial, pair, step, channel}) key = mixed(key ^ part);
  return (double(key >> 11) + 0.5) * 0x1p-53;
}

double Draw::normal(std::uint64_t channel) const {
  // Box and Muller's, of two numbers of the channel.
  const double radius = std::sqrt(-2 * std::log(uniform(2 * channel)));
  return radius * std::cos(2 * std::numbers::pi * uniform(2 * channel + 1));
}

Measurement measure(const Sensor& sensor, const guidance::BodyState& a, const guidance::BodyState& b,
                    const Draw& draw) {
  Measurement seen{b.position, b.velocity};
  const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
  const bool planar = b.planar();
  const int axes = planar ? 2 : 3;
  switch (sensor.noise) {
    case Noise::engagement:
      break;
    case Noise::per_axis:
    case Noise::isotropic:
      for (int i = 0; i < axes; ++i) {
        const bool parts = sensor.noise == Noise::per_axis;
        const auto channel = std::uint64_t(i);
        const double dp = sensor.position * (parts ? std::abs(c[i]) : 1),
                     dv = sensor.velocity * (parts ? std::abs(v[i]) : 1);
        seen.position[i] += dp * m_of(sensor, draw, kPosition + channel);
        seen.velocity[i] += dv * m_of(sensor, draw, kVelocity + channel);
      }
      for (int i = 0; i < axes; ++i) {
        const bool parts = sensor.noise == Noise::per_axis;
        const double of_p = parts ? std::abs(seen.position[i] - a.position[i]) : 1,
                     of_v = parts ? std::abs(seen.velocity[i] - a.velocity[i]) : 1;
        seen.position_deviation[i] = sensor.deviation * sensor.position * of_p;
        seen.velocity_deviation[i] = sensor.deviation * sensor.velocity * of_v;
      }
      break;
    case Noise::bounded: {
      seen.position += in_ball(sensor.position, draw, kBall, planar);
      seen.velocity += in_ball(sensor.velocity, draw, kBall + 3, planar);
      const Vector3d even = planar ? Vector3d(1, 1, 0) : Vector3d::Ones();
      seen.position_deviation = ball_deviation(planar) * sensor.position * even;
      seen.velocity_deviation = ball_deviation(planar) * sensor.velocity * even;
      break;
    }
  }
  if (sensor.bias > 0) seen.position += bias_of(sensor, draw, planar);
  return seen;
}

bool arrives(const Sensor& sensor, const Draw& draw) {
  return !(sensor.dropout > 0) || draw.uniform(kDropout) >= sensor.dropout;
}

guidance::Sight sight_of(const Sensor& sensor, const Measurement& measurement, const Draw& draw) {
  guidance::Sight sight;
  sight.measured = true;
  if (sensor.noise == Noise::engagement) {
    const guidance::EngagementParts& parts = sensor.engagement;
    using Parts = guidance::EngagementParts;
    std::uint64_t channel = kEngagement;
    for (double Parts::*part :
         {&Parts::r, &Parts::v_r, &Parts::v_theta, &Parts::theta, &Parts::theta_b, &Parts::psi}) {
      sight.errors.*part = parts.*part * m_of(sensor, draw, channel++);
      sight.deviations.*part = parts.*part * sensor.deviation;
    }
    return sight;
  }
  // One number for a direction that is not known yet: the mean of the squares.
  const auto along_any = [](const Vector3d& deviation) { return deviation.norm() / std::sqrt(3.0); };
  sight.position_deviation = along_any(measurement.position_deviation);
  sight.velocity_deviation = along_any(measurement.velocity_deviation);
  return sight;
}

void check(const Sensor& sensor) {
  const guidance::EngagementParts& e = sensor.engagement;
  const std::pair<const char*, double> fields[] = {{"position", sensor.position},
                                                   {"velocity", sensor.velocity},
                                                   {"deviation", sensor.deviation},
                                                   {"r", e.r},
                                                   {"V_r", e.v_r},
                                                   {"V_theta", e.v_theta},
                                                   {"theta", e.theta},
                                                   {"theta_b", e.theta_b},
                                                   {"psi", e.psi},
                                                   {"period", sensor.period},
                                                   {"delay", sensor.delay},
                                                   {"dropout", sensor.dropout},
                                                   {"bias", sensor.bias}};
  for (const auto& [name, value] : fields)
    if (!(value >= 0) || !std::isfinite(value)) throw InputError(name, to_text(value), "a number, 0 or more");
  if (!(sensor.dropout < 1)) throw InputError("dropout", to_text(sensor.dropout), "below 1");
  if (!(sensor.range > 0)) throw InputError("range", to_text(sensor.range), "positive (m)");
  if (!(sensor.view > 0) || (sensor.view > std::numbers::pi && std::isfinite(sensor.view)))
    throw InputError("view", to_text(sensor.view), "positive, at most pi (rad)");
  if (sensor.noise != Noise::engagement) return;
  const std::pair<const char*, bool> others[] = {
      {"period", sensor.period > 0},          {"delay", sensor.delay > 0},
      {"dropout", sensor.dropout > 0},        {"bias", sensor.bias > 0},
      {"range", std::isfinite(sensor.range)}, {"view", std::isfinite(sensor.view)},
      {"occluded", sensor.occluded}};
  for (const auto& [name, given] : others)
    if (given)
      throw InputError(name, "given", "left out: the sensor engagement measures at every command, and all");
}

}  // namespace vericone::simulation
