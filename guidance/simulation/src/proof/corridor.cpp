// SPDX-License-Identifier: BSD-3-Clause
#include "proof/corridor.h"

#include "proof/separation.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kResolved = 1e-3;        // of the radius
constexpr double kShortest = 1e-6;        // s
constexpr double kRoundings = 0x1p-46;    // of what the distances are made of
constexpr std::size_t kMost = 1'000'000;  // intervals

struct Instant {
  double t;
  Vector3d position;
  double beside;  // m, from the leg
};

class Corridor {
 public:
  Corridor(const Track& track, const CorridorOfLeg& corridor)
      : track_(track), corridor_(corridor), reach_(reach(track.shape())) {}

  CorridorProof over(double from, double to) {
    of_places_ = rounding_of(track_, from, to);
    std::vector<std::pair<Instant, Instant>> open{{at(from), at(to)}};
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; !open.empty(); ++i) {
      const auto [a, b] = open.back();
      open.pop_back();
      const double surely = surely_left(a, b);
      if (surely >= seen_ - kResolved * corridor_.radius || b.t - a.t < kShortest || i > kMost) {
        room = std::min(room, surely);
        continue;
      }
      const Instant middle = at(0.5 * (a.t + b.t));
      open.emplace_back(a, middle);
      open.emplace_back(middle, b);
    }
    return {room, seen_ + reach_ < -rounding_};
  }

 private:
  Instant at(double t) {
    const Vector3d position = track_.motion(t).position, leg = corridor_.to - corridor_.from,
                   c = position - corridor_.from;
    const double square = leg.squaredNorm();
    const double part = square > 0 ? std::clamp(c.dot(leg) / square, 0.0, 1.0) : 0;
    const Instant now{t, position, (c - part * leg).norm()};
    seen_ = std::min(seen_, corridor_.radius - reach_ - now.beside);
    rounding_ = std::max(
        rounding_, of_places_ + kRoundings * (position.norm() + corridor_.from.norm() + leg.norm() + reach_));
    return now;
  }

  double surely_left(const Instant& a, const Instant& b) const {
    const double dt = b.t - a.t;
    const Track::Bounds bounds = track_.bounds(a.t, b.t);
    const double off = (bounds.acceleration * dt / 8 + bounds.velocity_jumps / 4) * dt * (1 + 1e-12);
    return corridor_.radius - reach_ - std::max(a.beside, b.beside) - off - rounding_;
  }

  const Track& track_;
  const CorridorOfLeg& corridor_;
  double reach_, of_places_ = 0;
  double seen_ = std::numeric_limits<double>::infinity(), rounding_ = 0;  // m
};

}  // namespace

CorridorProof prove_corridor(const Track& track, const CorridorOfLeg& corridor, double from, double to) {
  return Corridor(track, corridor).over(from, to);
}

}  // namespace vericone::simulation
