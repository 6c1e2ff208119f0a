// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/vehicle.h>

#include <vericone/geometry/error.h>
#include <vericone/simulation/pilot.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::simulation {

using Eigen::Vector3d;

Current::Current(const Vector3d& uniform, const Shear& shear, const Gusts& gusts)
    : uniform_(uniform), shear_(shear), gusts_(gusts.most) {
  if (!uniform.allFinite()) throw InputError("uniform", "a number that is not finite", "finite (m/s)");
  if (!shear.rate.allFinite()) throw InputError("shear.rate", "a number that is not finite", "finite (1/s)");
  if (!std::isfinite(shear.level))
    throw InputError("shear.level", to_text(shear.level), "a finite number (m)");
  if (!(gusts.most >= 0) || !std::isfinite(gusts.most))
    throw InputError("gusts.most", to_text(gusts.most), "a finite number, 0 or more (m/s)");
  if (!(gusts.shortest > 0) || !std::isfinite(gusts.shortest))
    throw InputError("gusts.shortest", to_text(gusts.shortest), "a positive finite number (s)");
  if (!(gusts.longest >= gusts.shortest) || !std::isfinite(gusts.longest))
    throw InputError("gusts.longest", to_text(gusts.longest),
                     "not below gusts.shortest, " + to_text(gusts.shortest) + " s");
  if (gusts.most == 0) return;
  shortest_ = gusts.shortest;
  // The stream of the gusts: no pair of bodies has this number.
  const Draw draw{gusts.seed, 0, ~std::uint64_t{0}, 0};
  using std::numbers::pi;
  std::uint64_t channel = 0;
  for (Wave& wave : waves_) {
    const double azimuth = 2 * pi * draw.uniform(channel++), height = 2 * draw.uniform(channel++) - 1;
    const double z = gusts.horizontal ? 0 : height, flat = std::sqrt(1 - z * z);
    wave.amplitude =
        gusts.most / double(waves_.size()) * Vector3d(flat * std::cos(azimuth), flat * std::sin(azimuth), z);
    const double period = gusts.shortest * std::pow(gusts.longest / gusts.shortest, draw.uniform(channel++));
    wave.rate = 2 * pi / period;
    wave.phase = 2 * pi * draw.uniform(channel++);
  }
}

Current Current::carried(const Vector3d& by) const {
  Current water = *this;
  water.uniform_ += by;
  return water;
}

Vector3d Current::velocity(double z, double t) const {
  Vector3d v = uniform_ + (z - shear_.level) * gradient();
  if (gusts_ > 0)
    for (const Wave& wave : waves_) v += std::sin(wave.rate * t + wave.phase) * wave.amplitude;
  return v;
}

Vector3d Current::acceleration(double t) const {
  Vector3d a = Vector3d::Zero();
  if (gusts_ > 0)
    for (const Wave& wave : waves_) a += wave.rate * std::cos(wave.rate * t + wave.phase) * wave.amplitude;
  return a;
}

double Current::most(double bottom, double top) const {
  const auto steady = [&](double z) {
    if (shear_.rate.isZero(0)) return uniform_.norm();
    if (!std::isfinite(z)) return std::numeric_limits<double>::infinity();
    return (uniform_ + (z - shear_.level) * gradient()).norm();
  };
  return (std::max(steady(bottom), steady(top)) + gusts_) * (1 + 1e-12);
}

}  // namespace vericone::simulation
