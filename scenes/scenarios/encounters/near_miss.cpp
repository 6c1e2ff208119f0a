// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/encounters/near_miss.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "input/fields.h"

namespace vericone::encounters {
namespace {

using Eigen::Vector3d;
using simulation::Track;

constexpr double kResolved = 1e-6;  // of the size of the volume

/// max(|horizontal| / radius, |vertical| / half_height): below 1 inside.
double size(const Vector3d& apart, const Volume& volume) {
  return std::max(std::hypot(apart.x(), apart.y()) / volume.radius, std::abs(apart.z()) / volume.half_height);
}

/// The least size on the way from p to p + d, and where, 0 to 1. Both parts are convex, so it is where one of
/// them is least, where they are equal, or at an end.
std::pair<double, double> least_on(const Vector3d& p, const Vector3d& d, const Volume& volume) {
  std::pair<double, double> best{std::numeric_limits<double>::infinity(), 0};
  const auto look = [&](double s) {
    if (!(s >= 0 && s <= 1)) return;
    const double there = size(p + s * d, volume);
    if (there < best.first) best = {there, s};
  };
  look(0);
  look(1);
  const double across = d.head<2>().squaredNorm();
  if (across > 0) look(-p.head<2>().dot(d.head<2>()) / across);
  if (d.z() != 0) look(-p.z() / d.z());
  const double r = 1 / (volume.radius * volume.radius), h = 1 / (volume.half_height * volume.half_height);
  const double a = across * r - d.z() * d.z() * h, b = p.head<2>().dot(d.head<2>()) * r - p.z() * d.z() * h,
               c = p.head<2>().squaredNorm() * r - p.z() * p.z() * h;
  const double root = std::sqrt(std::max(b * b - a * c, 0.0)), q = -(b + std::copysign(root, b));
  if (a != 0) look(q / a);
  if (q != 0) look(c / q);
  return best;
}

/// Bisects the time until the least size is known.
class Search {
 public:
  Search(const Track& a, const Track& b, const Volume& volume) : a_(a), b_(b), volume_(volume) {}

  void look(double from, const Vector3d& first, double to, const Vector3d& last, int depth) {
    const double duration = to - from;
    double off = 0;  // m: the way is so near to its chord
    for (const Track* track : {&a_, &b_}) {
      const Track::Bounds bounds = track->bounds(from, to);
      off += duration * (bounds.acceleration * duration / 8 + bounds.velocity_jumps / 4);
    }
    const auto [least, where] = least_on(first, last - first, volume_);
    const double slack = off / std::min(volume_.radius, volume_.half_height);
    const double t = from + where * duration;
    const Vector3d middle = slack > 0 ? apart(t) : Vector3d(first + where * (last - first));
    keep(t, middle);
    constexpr int kDeepest = 60;
    if (least - slack >= best_ - kResolved * std::max(best_, 1.0) || depth == kDeepest) {
      lower_ = std::min(lower_, least - slack);
      return;
    }
    const double half = 0.5 * (from + to);
    const Vector3d there = apart(half);
    keep(half, there);
    // Where it looks nearer first: the other half is then seldom looked into.
    const bool late = t > half;
    for (const bool second : {late, !late})
      second ? look(half, there, to, last, depth + 1) : look(from, first, half, there, depth + 1);
  }

  Vector3d apart(double t) {
    const Vector3d a = a_.motion(t).position, b = b_.motion(t).position;
    farthest_ = std::max({farthest_, a.lpNorm<Eigen::Infinity>(), b.lpNorm<Eigen::Infinity>()});
    return a - b;
  }

  Nearness found() const {
    // Places are known to some units in their last digit; of distances that overflow nothing is.
    const double rounding = 1e-12 + 0x1p-46 * farthest_ / std::min(volume_.radius, volume_.half_height);
    const bool told = std::isfinite(best_) && std::isfinite(rounding);
    const Entered entered = told && best_ < 1 - rounding    ? Entered::yes
                            : told && lower_ > 1 + rounding ? Entered::no
                                                            : Entered::undecided;
    return {entered, time_, place_.head<2>().norm(), std::abs(place_.z())};
  }

 private:
  void keep(double t, const Vector3d& at) {
    const double there = size(at, volume_);
    if (there < best_) {
      best_ = there;
      time_ = t;
      place_ = at;
    }
  }

  const Track &a_, &b_;
  const Volume& volume_;
  double best_ = std::numeric_limits<double>::infinity(), lower_ = best_, time_ = 0, farthest_ = 0;
  Vector3d place_ = Vector3d::Zero();
};

}  // namespace

Volume volume_of(const std::string& text, const std::string& option) {
  const auto refuse = [&] {
    throw InputError(option, text,
                     "radius:half-height, positive, such as 500 ft:100 ft (metres without units)");
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) refuse();
  const auto length = [&](const std::string& word) {
    double x = 0;
    try {
      const bool unit = word.find_first_not_of("0123456789.+-eE ") != std::string::npos;
      x = input::read_quantity(Json(unit ? word : word + " m"), option, " (metres)");
    } catch (const InputError&) {
      refuse();
    }
    if (!(x > 0)) refuse();
    return x;
  };
  return {text, length(text.substr(0, colon)), length(text.substr(colon + 1))};
}

const char* to_string(Entered entered) {
  constexpr const char* kWords[] = {"no", "yes", "undecided"};
  return kWords[std::size_t(entered)];
}

Nearness nearness(const Track& a, const Track& b, double from, double to, const Volume& volume) {
  Search search(a, b, volume);
  search.look(from, search.apart(from), to, search.apart(to), 0);
  return search.found();
}

}  // namespace vericone::encounters
