// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/curve.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vericone::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Lanes : public Road {
 public:
  Lanes(const Vector2d& start, const Vector2d& velocity, std::vector<LaneChange> changes)
      : start_(start), velocity_(velocity), changes_(std::move(changes)) {
    left_ = Vector2d(-velocity.y(), velocity.x()).normalized();
  }

  RoadPoint at(double t) const override {
    double way = 0, speed = 0, acceleration = 0;
    for (const LaneChange& change : changes_) {
      const double s = change.seconds, a = change.acceleration, since = t - change.at;
      if (since < 0) continue;
      const double first = std::min(since, s), second = std::clamp(since - s, 0.0, s);
      way += 0.5 * a * first * first + a * s * second - 0.5 * a * second * second;
      speed += a * (first - second);
      acceleration += since < s ? a : since < 2 * s ? -a : 0;
    }
    return {start_ + t * velocity_ + way * left_, velocity_ + speed * left_, acceleration * left_};
  }

  std::vector<double> jumps() const override {
    std::vector<double> times;
    for (const LaneChange& change : changes_)
      for (const int i : {0, 1, 2}) times.push_back(change.at + i * change.seconds);
    std::sort(times.begin(), times.end());
    return times;
  }

 private:
  Vector2d start_, velocity_, left_;
  std::vector<LaneChange> changes_;
};

/// A number with its first two derivatives.
struct Derived {
  double value, first, second;
};

/// sqrt(2 + 2 sqrt 2 s cos p + s^2 cos 2p).
Derived root(double s, double p) {
  constexpr double kTwoRootTwo = 2 * std::numbers::sqrt2;
  const double value = 2 + kTwoRootTwo * s * std::cos(p) + s * s * std::cos(2 * p);
  const double first = -kTwoRootTwo * s * std::sin(p) - 2 * s * s * std::sin(2 * p);
  const double second = -kTwoRootTwo * s * std::cos(p) - 4 * s * s * std::cos(2 * p);
  const double root = std::sqrt(value), slope = 0.5 * first / root;
  return {root, slope, (0.5 * second - slope * slope) / root};
}

class Squircle : public Road {
 public:
  Squircle(const Vector2d& start, double radius, double squareness, double period)
      : centre_(start + Vector2d(0, radius)), radius_(radius), squareness_(squareness), period_(period) {}

  RoadPoint at(double t) const override {
    const double rate = 2 * std::numbers::pi / period_, p = rate * t;
    // y is x a quarter earlier, and so is x of what is printed: p begins at -pi/2.
    const Derived x = across(p - 0.5 * std::numbers::pi), y = across(p - std::numbers::pi);
    return {centre_ + Vector2d(x.value, y.value), rate * Vector2d(x.first, y.first),
            rate * rate * Vector2d(x.second, y.second)};
  }

 private:
  /// x of p: the difference of two roots over s as 4 sqrt 2 s cos p over their sum, which loses nothing for
  /// small s.
  Derived across(double p) const {
    const Derived a = root(squareness_, p), b = root(squareness_, p + std::numbers::pi);
    const double sum = a.value + b.value, first = a.first + b.first, second = a.second + b.second;
    const double scale = 2 * std::numbers::sqrt2 * radius_;
    Derived x;
    x.value = scale * std::cos(p) / sum;
    x.first = (-scale * std::sin(p) - x.value * first) / sum;
    x.second = (-scale * std::cos(p) - 2 * x.first * first - x.value * second) / sum;
    return x;
  }

  Vector2d centre_;
  double radius_, squareness_, period_;
};

/// Its own time of a road, and how it heads.
struct Along {
  const Road& road;
  double height, begins;

  Jet jet(double t) const { return jet(road.at(t - begins)); }
  Jet jet(const RoadPoint& p) const {
    const auto high = [](const Vector2d& v, double z) { return Vector3d(v.x(), v.y(), z); };
    return {high(p.position, height), high(p.velocity, 0), high(p.acceleration, 0)};
  }
  double heading(const RoadPoint& p) const { return std::atan2(p.velocity.y(), p.velocity.x()); }
  double turn_rate(const RoadPoint& p) const {
    const double squared = p.velocity.squaredNorm();
    const double cross = p.velocity.x() * p.acceleration.y() - p.velocity.y() * p.acceleration.x();
    return squared > 0 ? cross / squared : 0;
  }

  /// Between two jumps: the acceleration at the end is that before a jump there.
  Curve curve(double from, double to) const {
    const double h = to - from;
    const RoadPoint a = road.at(from - begins);
    RoadPoint b = road.at(to - begins);
    b.acceleration = road.at(to - begins - 1e-9 * h).acceleration;
    const double by = std::remainder(heading(b) - heading(a), 2 * std::numbers::pi);
    const double w0 = turn_rate(a), w1 = turn_rate(b);
    // Of third degree: the road says nothing of the second derivative.
    const Quintic turned{Vector3d::Zero(),
                         {0, 0, w0},
                         {0, 0, (3 * by / h - 2 * w0 - w1) / h},
                         {0, 0, (w0 + w1 - 2 * by / h) / (h * h)},
                         Vector3d::Zero(),
                         Vector3d::Zero()};
    return {quintic(jet(a), jet(b), h), turned,
            Eigen::AngleAxisd(heading(a), Vector3d::UnitZ()).toRotationMatrix(), from, to};
  }

  void pieces(double from, double to, double error, std::vector<Curve>& curves) const {
    Curve whole = curve(from, to);
    constexpr int kPlaces = 8;
    bool good = true;
    for (int i = 1; i <= kPlaces && good; ++i) {
      const double t = from + (to - from) * i / (kPlaces + 1);
      const RoadPoint there = road.at(t - begins);
      const Motion made = whole.at(t);
      const Vector2d ahead = made.rotation.col(0).head<2>();
      const double turned =
          std::remainder(std::atan2(ahead.y(), ahead.x()) - heading(there), 2 * std::numbers::pi);
      good = (made.position - jet(there).value).norm() <= 0.5 * error && std::abs(turned) <= 0.5 * error;
    }
    const double middle = 0.5 * (from + to);
    constexpr double kShortest = 1e-6;  // s: rounding is all that is left
    if (good || !(to - from > kShortest)) {
      if (curves.size() % 64 == 63) checkpoint();
      curves.push_back(std::move(whole));
      return;
    }
    pieces(from, middle, error, curves);
    pieces(middle, to, error, curves);
  }
};

void require_positive(double value, const std::string& field, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a positive finite number") + unit);
}

}  // namespace

std::shared_ptr<const Road> lane_road(const Vector2d& start, const Vector2d& velocity,
                                      std::vector<LaneChange> changes) {
  if (!velocity.allFinite()) throw InputError("velocity", "a number that is not finite", "finite (m/s)");
  if (!changes.empty() && !velocity.any())
    throw InputError("velocity", "0", "a velocity, or no changes: lanes are along it");
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::string path = "changes[" + std::to_string(i) + "]";
    if (!(changes[i].at >= 0) || !std::isfinite(changes[i].at))
      throw InputError(path + ".at", to_text(changes[i].at), "a finite number, 0 or more (s)");
    require_positive(changes[i].seconds, path + ".seconds", " (s)");
    if (!std::isfinite(changes[i].acceleration))
      throw InputError(path + ".acceleration", to_text(changes[i].acceleration), "a finite number (m/s^2)");
  }
  return std::make_shared<Lanes>(start, velocity, std::move(changes));
}

std::shared_ptr<const Road> squircle_road(const Vector2d& start, double radius, double squareness,
                                          double period) {
  require_positive(radius, "radius", " (m)");
  require_positive(period, "period", " (s)");
  if (!(squareness >= 0 && squareness < 1))
    throw InputError("squareness", to_text(squareness), "0 or more, below 1: a square has corners");
  return std::make_shared<Squircle>(start, radius, squareness, period);
}

Motion start_of(const Road& road, double height) {
  const Along along{road, height, 0};
  const RoadPoint start = road.at(0);
  const Jet jet = along.jet(start);
  return {jet.value, jet.first,
          Eigen::AngleAxisd(along.heading(start), Vector3d::UnitZ()).toRotationMatrix()};
}

std::vector<Curve> curves_of(const Road& road, double height, double from, double to, double error,
                             double begins) {
  if (!(to > from) || !std::isfinite(to))
    throw InputError("to", to_text(to), "a time after " + to_text(from) + " s");
  require_positive(error, "error", " (m)");
  const Along along{road, height, begins};
  std::vector<Curve> curves;
  double begin = from;
  for (const double jump : road.jumps()) {
    const double t = jump + begins;
    // Those that rounding alone sets apart are one.
    if (!(t > begin + 1e-9) || !(t < to - 1e-9)) continue;
    along.pieces(begin, t, error, curves);
    begin = t;
  }
  along.pieces(begin, to, error, curves);
  return curves;
}

}  // namespace vericone::simulation
