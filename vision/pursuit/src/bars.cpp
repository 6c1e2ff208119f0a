// SPDX-License-Identifier: BSD-3-Clause
#include "bars.h"

#include <cmath>

namespace vericone::vision {
namespace {

/// In [0, 1), the same on every machine.
double uniform(std::mt19937_64& random) { return double(random() >> 11) * 0x1p-53; }

}  // namespace

Bars::Bars(const FlyingBars& bars, std::uint64_t seed) : options_(bars), random_(seed) {}

bool Bars::step(const simulation::Motion& own, const Camera& camera, double t) {
  if (options_.count == 0 || t < options_.from) return false;
  const double metres = own.position.z() / camera.focal;  // a pixel
  const Eigen::Vector2d half(0.5 * metres * camera.width, 0.5 * metres * camera.height);
  const Eigen::Vector2d middle = own.position.head<2>(), v = own.velocity.head<2>();
  const double speed = v.norm();
  const Eigen::Vector2d ahead = speed > 0 ? Eigen::Vector2d(v / speed) : Eigen::Vector2d(1, 0);
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const bool first = bars_.empty();
  bool moved = first;
  bars_.resize(std::size_t(options_.count));
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    Occluder& bar = bars_[i];
    const Eigen::Vector2d from = bar.centre - middle;
    const bool behind = from.dot(ahead) < -(half.dot(ahead.cwiseAbs()) + 0.5 * bar.size.maxCoeff());
    const bool far = from.norm() > 4 * half.norm();
    if (!first && !behind && !far) continue;
    moved = true;
    // Half a picture to a whole one ahead.
    const double out = (1 + uniform(random_) + (first ? double(i) : 0)) * half.x();
    bar.size = options_.size;
    if (!(bar.size.y() > 0)) bar.size.y() = 8 * half.norm();  // all of the picture's height
    const double aside = options_.size.y() > 0 ? (2 * uniform(random_) - 1) * half.y() : 0;
    bar.centre = middle + out * ahead + aside * left;
    bar.bottom = options_.height;
    bar.top = options_.height;
  }
  return moved;
}

std::vector<Occluder> Bars::with(const std::vector<Occluder>& others) const {
  std::vector<Occluder> all = others;
  all.insert(all.end(), bars_.begin(), bars_.end());
  return all;
}

}  // namespace vericone::vision
