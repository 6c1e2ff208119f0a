// SPDX-License-Identifier: BSD-3-Clause
//
// Where nothing is safe for as long as was asked: what is for longest. Of one convex part the time of the
// first contact is quasi-convex in the velocity where it is met, so over a box it is at most the largest of
// the corners'. Boxes are halved, best first on the least of these over all parts.
#pragma once

#include <vericone/guidance/avoid.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <queue>
#include <unordered_map>
#include <vector>

#include "avoid/flown.h"

namespace vericone::guidance::avoiding {

/// What is met first with a velocity over ground.
inline std::optional<Avoidance::First> first_met(Threats& threats, const Vector3d& ground) {
  std::optional<Avoidance::First> first;
  threats.near(ground, kInfinity, 0, [&](std::size_t i) {
    const auto contact = threats[i].as_it_is().contact(ground, threats[i].velocity);
    if (contact && !(first && first->time <= contact->earliest))
      first = {threats[i].intruder, contact->earliest};
  });
  return first;
}

class Longest {
 public:
  Longest(const Vector3d& velocity, const Vector3d& wanted, Threats& threats, const AvoidOptions& options)
      : flown_(velocity, options), wanted_(wanted), threats_(threats), options_(options) {}

  /// `answer`: of the whole time, not free, with a velocity that can be flown.
  void look(Avoidance& answer) {
    double latest = answer.status == AvoidStatus::nothing_safe ? options_.until : kInfinity;
    best_ = answer.velocity;
    if (none_now()) {
      latest = 0;
    } else {
      try_one(answer.velocity);
      latest = std::min(latest, divide());
    }
    answer.velocity = best_;
    answer.distance = (best_ - wanted_).norm();
    answer.safe_until = safe_;
    if (safe_ == options_.until) {
      answer.status = AvoidStatus::free;
      return;
    }
    answer.latest = latest;
    if (std::isinf(latest)) return;
    answer.status = AvoidStatus::nothing_safe;
    answer.lower = kInfinity;
  }

 private:
  struct Cell {
    double bound;  // s: until then every velocity of it has met something
    Vector3d low, high;
    std::vector<std::uint32_t> parts;  // those that may matter
    std::size_t known;                 // parts when the bound was found
    int axis;                          // along which times differ most, as a rule
    int depth;
    bool operator<(const Cell& other) const { return bound < other.bound; }  // the latest on top
  };

  /// Whether some body is too near already.
  bool none_now() {
    bool none = false;
    threats_.near(Vector3d::Zero(), 0, 0, [&](std::size_t i) {
      const Part& part = threats_[i];
      none = none || (part.exact() && part.swollen().relation() == Relation::overlapping);
    });
    return none;
  }

  /// The velocity that is safe for longest, to `gap`; returns a time until which none is.
  double divide() {
    const bool all = std::isfinite(options_.speed.to);  // else nothing is proved of faster ones
    const double most = all ? options_.speed.to : wanted_.norm() + 4 * threats_.fastest();
    Vector3d high = Vector3d::Constant(most), low = -high;
    low.z() = std::clamp(options_.climb.from, -most, most);
    high.z() = std::clamp(options_.climb.to, -most, most);
    std::priority_queue<Cell> open;
    const auto add = [&](Cell cell) {
      if (cannot_be_flown(cell)) return;
      trim(cell);
      bound(cell);
      open.push(std::move(cell));
    };
    add({kInfinity, low, high, {}, 0, 0, 0});
    for (int step = 0; step < kMostCells && !open.empty(); ++step) {
      if (open.top().bound <= safe_ * (1 + options_.gap)) break;
      Cell cell = open.top();
      open.pop();
      if (cell.known < parts_.size()) {
        add(std::move(cell));
        continue;
      }
      const Vector3d middle = cell.low + 0.5 * (cell.high - cell.low);
      if (const auto first = try_one(nearest_flown(middle));
          first && *first < cell.known &&
          std::find(cell.parts.begin(), cell.parts.end(), *first) == cell.parts.end())
        cell.parts.push_back(*first);
      const double cut = middle(cell.axis);
      if (!(cut > cell.low(cell.axis) && cut < cell.high(cell.axis))) {
        open.push(cell);
        break;
      }
      Cell upper = cell;
      cell.high(cell.axis) = upper.low(cell.axis) = cut;
      add(std::move(cell));
      add(std::move(upper));
    }
    // All that was left out cannot be flown, or is met by then too.
    return !all ? kInfinity : open.empty() ? safe_ : std::max(open.top().bound, safe_);
  }

  bool cannot_be_flown(const Cell& cell) const {
    const Vector3d nearest = Vector3d::Zero().cwiseMax(cell.low).cwiseMin(cell.high),
                   farthest = cell.low.cwiseAbs().cwiseMax(cell.high.cwiseAbs());
    return nearest.norm() > options_.speed.to * (1 + 1e-9) ||
           farthest.norm() < options_.speed.from * (1 - 1e-9);
  }

  /// Of what is too fast.
  void trim(Cell& cell) const {
    const Vector3d nearest = Vector3d::Zero().cwiseMax(cell.low).cwiseMin(cell.high);
    for (int axis = 0; axis < 3; ++axis) {
      const double others = nearest.squaredNorm() - nearest(axis) * nearest(axis);
      const double most =
          std::sqrt(std::max(0.0, options_.speed.to * options_.speed.to - others)) + 1e-9 * options_.speed.to;
      cell.low(axis) = std::max(cell.low(axis), -most);
      cell.high(axis) = std::min(cell.high(axis), most);
    }
  }

  /// In the speeds and climbs that can be flown.
  Vector3d nearest_flown(const Vector3d& v) const {
    const double speed = std::clamp(v.norm(), options_.speed.from, options_.speed.to);
    Vector3d flown = v.norm() > 0 ? Vector3d(speed / v.norm() * v) : Vector3d(speed * Vector3d::UnitX());
    flown.z() = std::clamp(flown.z(), options_.climb.from, options_.climb.to);
    const double level = std::hypot(flown.x(), flown.y());
    if (level > 0) flown.head<2>() *= std::sqrt(std::max(0.0, speed * speed - flown.z() * flown.z())) / level;
    return flown;
  }

  /// Until when a part is met with a velocity, at the latest; infinite where that is not until the end.
  double met(const Part& part, const Vector3d& v) const {
    const Pair* pair = part.exact() ? &part.swollen() : part.core ? &*part.core : nullptr;
    const auto contact = pair ? pair->contact(v + options_.wind, part.velocity) : std::nullopt;
    return contact && contact->latest <= options_.until ? contact->latest : kInfinity;
  }
  double met(std::uint32_t part, const Vector3d& corner) {
    std::array<std::uint64_t, 3> bits;
    const Vector3d exact = corner + Vector3d::Zero();  // one zero
    std::memcpy(bits.data(), exact.data(), sizeof(bits));
    std::uint64_t key = part;
    for (const std::uint64_t word : bits) key = (key ^ word) * 0x9E3779B97F4A7C15 ^ key >> 29;
    auto& known = times_[key];
    for (const Time& time : known)
      if (time.part == part && time.corner == exact) return time.met;
    known.push_back({part, exact, met(*parts_[part], exact)});
    return known.back().met;
  }

  /// Of the parts that matter to it and all that are new.
  void bound(Cell& cell) {
    std::vector<std::uint32_t> matter;
    std::array<double, 3> differ{};
    double least = kInfinity;
    const auto take = [&](std::uint32_t i) {
      std::array<double, 8> times;
      for (std::size_t k = 0; k < 8; ++k) {
        Vector3d corner;
        for (std::size_t axis = 0; axis < 3; ++axis)
          corner(static_cast<int>(axis)) = (k >> axis & 1 ? cell.high : cell.low)(static_cast<int>(axis));
        times[k] = met(i, corner);
      }
      const double last = *std::max_element(times.begin(), times.end());
      if (std::isinf(*std::min_element(times.begin(), times.end())) &&
          std::isinf(met(*parts_[i], 0.5 * (cell.low + cell.high))))
        return;
      matter.push_back(i);
      least = std::min(least, last);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<double, 2> face{};
        for (std::size_t k = 0; k < 8; ++k)
          face[k >> axis & 1] = std::max(face[k >> axis & 1], std::min(times[k], 2 * options_.until));
        differ[axis] += std::abs(face[1] - face[0]);
      }
    };
    for (const std::uint32_t i : cell.parts) take(i);
    for (std::size_t i = cell.known; i < parts_.size(); ++i) take(static_cast<std::uint32_t>(i));
    cell.parts = std::move(matter);
    cell.known = parts_.size();
    cell.bound = std::min(cell.bound, least);
    const Vector3d sides = cell.high - cell.low;
    sides.maxCoeff(&cell.axis);
    // Times may be alike at opposite sides and differ between.
    if (++cell.depth % 4 == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const int k = static_cast<int>(axis);
          sides(k) > 0 && differ[axis] > differ[static_cast<std::size_t>(cell.axis)])
        cell.axis = k;
  }

  /// Whether a velocity is safe for longer than the best one. The part that it meets first, known from then
  /// on.
  std::optional<std::uint32_t> try_one(const Vector3d& v) {
    if (!flown_.can_fly(v)) return std::nullopt;
    double until = options_.until;
    const Part* first = nullptr;
    const bool exactly = options_.margin == 0 && flown_.ramp(v) == 0;
    threats_.near(v + options_.wind, options_.until, flown_.beside(v), [&](std::size_t i) {
      const Part& part = threats_[i];
      double time = met(part, v);
      if (exactly) {  // the first contact is proved
        const auto contact = part.as_it_is().contact(v + options_.wind, part.velocity);
        time = contact ? std::min(time, contact->earliest) : kInfinity;
      }
      if (!(time < until)) return;
      until = time;
      first = &part;
    });
    std::optional<std::uint32_t> index;
    if (first) {
      const auto known = std::find(parts_.begin(), parts_.end(), first);
      index = static_cast<std::uint32_t>(known - parts_.begin());
      if (known == parts_.end()) parts_.push_back(first);
    }
    if (!exactly && until > safe_) until = proved(v, until);
    if (!(until > safe_)) return index;
    safe_ = until;
    best_ = v;
    return index;
  }

  /// The longest proved, from what is now the best up to `until`.
  double proved(const Vector3d& v, double until) {
    const auto keeps = [&](double time) {
      bool all = true;
      const double duration = flown_.ramp(v);
      threats_.near_until(v + options_.wind, time, flown_.beside(v), [&](std::size_t i) {
        all = flown_.lets_pass(threats_[i], v, duration, time);
        return !all;
      });
      return all;
    };
    if (keeps(until)) return until;
    double low = safe_ * (1 + 0.25 * options_.gap), high = until;
    if (!(low < high)) return 0;
    if (low == 0) low = 1e-3 * until;
    if (!keeps(low)) return 0;
    for (int step = 0; step < 20 && high - low > 0.1 * options_.gap * low; ++step) {
      const double between = 0.5 * (low + high);
      (keeps(between) ? low : high) = between;
    }
    return low;
  }

  static constexpr int kMostCells = 20'000;
  struct Time {
    std::uint32_t part;
    Vector3d corner;
    double met;
  };

  Flown flown_;
  Vector3d wanted_;
  Threats& threats_;
  const AvoidOptions& options_;
  double safe_ = 0;  // s, of the best velocity
  Vector3d best_;
  std::vector<const Part*> parts_;  // those known
  std::unordered_map<std::uint64_t, std::vector<Time>> times_;
};

}  // namespace vericone::guidance::avoiding
