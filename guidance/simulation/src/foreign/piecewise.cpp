// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/simulation/trajectory.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "foreign/bernstein.h"
#include "foreign/pieces.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPointRounding = 1e-14;  // of the largest number in some dozens of sums and products

std::string entry(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

void require_times(const std::vector<double>& times, const char* name) {
  if (times.size() < 2) throw InputError(name, std::to_string(times.size()) + " times", "two or more");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) throw InputError(entry(name, i), to_text(times[i]), "a finite number (s)");
    if (i > 0 && !(times[i] > times[i - 1]))
      throw InputError(entry(name, i), to_text(times[i]),
                       "after the one before, " + to_text(times[i - 1]) + " s");
  }
}

void require_points(const std::vector<Vector3d>& points, std::size_t count, const char* name) {
  if (points.size() != count)
    throw InputError(name, std::to_string(points.size()) + " of them", std::to_string(count));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError(entry(name, i), "a number that is not finite", "finite numbers");
}

/// The Bernstein coefficients between two knots that follow each other: the spline's blossom at a and b as
/// often as they count (de Boor with other arguments, all of them averages).
ControlPoints between_knots(int degree, const std::vector<double>& knots, const std::vector<Vector3d>& points,
                            std::size_t k) {
  const auto n = static_cast<std::size_t>(degree);
  ControlPoints found(n + 1);
  for (std::size_t j = 0; j <= n; ++j) {
    ControlPoints d(points.begin() + static_cast<std::ptrdiff_t>(k - n),
                    points.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    for (std::size_t r = 1; r <= n; ++r) {
      const double u = r <= j ? knots[k + 1] : knots[k];
      for (std::size_t i = n; i >= r; --i) {
        const std::size_t at = k - n + i;  // of the knot
        const double share = (u - knots[at]) / (knots[at + n - r + 1] - knots[at]);
        d[i] = (1 - share) * d[i - 1] + share * d[i];
      }
    }
    found[j] = d[n];
  }
  return found;
}

double largest(const std::vector<Vector3d>& points) {
  double most = 0;
  for (const Vector3d& x : points) most = std::max(most, x.cwiseAbs().maxCoeff());
  return most;
}

}  // namespace

void require_pieces(const Piecewise& of, const std::string& times, const std::string& points) {
  if (of.points.empty() || of.times.size() != of.points.size() + 1)
    throw InputError(
        times, std::to_string(of.times.size()) + " times of " + std::to_string(of.points.size()) + " pieces",
        "one piece or more, and one time more than pieces");
  const auto where = [](const std::string& list, std::size_t i) { return entry(list.c_str(), i); };
  for (std::size_t i = 0; i < of.times.size(); ++i)
    if (!std::isfinite(of.times[i]) || (i > 0 && !(of.times[i] > of.times[i - 1])))
      throw InputError(where(times, i), to_text(of.times[i]) + " s",
                       "finite times, each after the one before");
  if (!(of.error >= 0) || !std::isfinite(of.error))
    throw InputError(points, "an error of " + to_text(of.error), "an error that is finite, not negative");
  for (std::size_t i = 0; i < of.points.size(); ++i) {
    if (of.points[i].empty() || degree_of(of.points[i]) > kMostDegree)
      throw InputError(where(points, i), std::to_string(of.points[i].size()) + " control points",
                       "1 to 10: of degree 9 at most");
    for (const Vector3d& x : of.points[i])
      if (!x.allFinite())
        throw InputError(where(points, i), "a number that is not finite", "finite control points");
  }
}

bool is_rotation(const Matrix3d& matrix) {
  return (matrix * matrix.transpose() - Matrix3d::Identity()).norm() <= 1e-9 && matrix.determinant() > 0;
}

double Piecewise::from() const {
  return times.empty() ? std::numeric_limits<double>::quiet_NaN() : times.front();
}

double Piecewise::to() const {
  return times.empty() ? std::numeric_limits<double>::quiet_NaN() : times.back();
}

Vector3d Piecewise::at(double t, int derivative) const {
  require_pieces(*this, "times", "points");
  if (derivative < 0 || derivative > kMostDegree)
    throw InputError("derivative", std::to_string(derivative), "0 to 9");
  if (!(t >= from()) || !(t <= to()))
    throw InputError("t", to_text(t), "from " + to_text(from()) + " to " + to_text(to()) + " s");
  const auto after = std::upper_bound(times.begin(), times.end(), t);
  const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      after - times.begin() - 1, 0, static_cast<std::ptrdiff_t>(points.size()) - 1));
  const double h = times[k + 1] - times[k];
  ControlPoints p = points[k];
  for (int i = 0; i < derivative; ++i) {
    p = derivative_of(p);
    for (Vector3d& x : p) x /= h;
  }
  return value_at(std::move(p), std::clamp((t - times[k]) / h, 0.0, 1.0));
}

Piecewise piecewise_of_powers(const std::vector<double>& times,
                              const std::vector<std::vector<Vector3d>>& powers) {
  require_times(times, "times");
  if (powers.size() + 1 != times.size())
    throw InputError("powers", std::to_string(powers.size()) + " pieces",
                     std::to_string(times.size() - 1) + ", one less than times");
  Piecewise made{times, {}, 0};
  for (std::size_t piece = 0; piece < powers.size(); ++piece) {
    const std::vector<Vector3d>& a = powers[piece];
    const std::string where = entry("powers", piece);
    if (a.empty() || degree_of(a) > kMostDegree)
      throw InputError(where, std::to_string(a.size()) + " coefficients", "1 to 10: of degree 9 at most");
    require_points(a, a.size(), where.c_str());
    const double h = times[piece + 1] - times[piece];
    const int n = degree_of(a);
    ControlPoints scaled(a.size()), b(a.size(), Vector3d::Zero());
    double power = 1, sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i, power *= h) {
      scaled[i] = power * a[i];
      sum += scaled[i].cwiseAbs().maxCoeff();
    }
    if (!std::isfinite(sum)) throw InputError(where, "too large", "finite over its time");
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= j; ++i)
        b[static_cast<std::size_t>(j)] +=
            binomial(j, i) / binomial(n, i) * scaled[static_cast<std::size_t>(i)];
    made.points.push_back(std::move(b));
    made.error = std::max(made.error, kPointRounding * sum);
  }
  return made;
}

Piecewise piecewise_of_spline(int degree, const std::vector<double>& knots,
                              const std::vector<Vector3d>& points) {
  if (degree < 1 || degree > kMostDegree) throw InputError("degree", std::to_string(degree), "1 to 9");
  const auto n = static_cast<std::size_t>(degree);
  if (points.size() < n + 1)
    throw InputError("points", std::to_string(points.size()) + " of them",
                     "at least degree + 1, " + std::to_string(n + 1));
  require_points(points, points.size(), "points");
  if (knots.size() != points.size() + n + 1)
    throw InputError("knots", std::to_string(knots.size()) + " of them",
                     "points + degree + 1, " + std::to_string(points.size() + n + 1));
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]))
      throw InputError(entry("knots", i), to_text(knots[i]), "a finite number (s)");
    if (i > 0 && !(knots[i] >= knots[i - 1]))
      throw InputError(entry("knots", i), to_text(knots[i]), "not before " + to_text(knots[i - 1]));
  }
  const std::size_t last = knots.size() - 1 - n;
  if (!(knots[n] < knots[last]))
    throw InputError("knots", "no time from knot " + std::to_string(n) + " to knot " + std::to_string(last),
                     "a domain that takes time");
  for (std::size_t i = n + 1; i + n < last; ++i)
    if (knots[i] == knots[i + n] && knots[i] > knots[n] && knots[i] < knots[last])
      throw InputError(entry("knots", i), to_text(knots[i]) + " more often than the degree",
                       "at most " + std::to_string(n) + " times, where the curve is to be in one piece");
  Piecewise made{{knots[n]}, {}, kPointRounding * largest(points)};
  for (std::size_t k = n; k < last; ++k) {
    if (!(knots[k + 1] > knots[k])) continue;
    made.times.push_back(knots[k + 1]);
    made.points.push_back(between_knots(degree, knots, points, k));
  }
  return made;
}

Piecewise piecewise_through(const std::vector<double>& times, const std::vector<Vector3d>& points) {
  require_times(times, "times");
  require_points(points, times.size(), "points");
  Piecewise made{times, {}, 0};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) made.points.push_back({points[i], points[i + 1]});
  return made;
}

std::vector<Vector3d> velocities_through(const std::vector<double>& times,
                                         const std::vector<Vector3d>& points) {
  require_times(times, "times");
  require_points(points, times.size(), "points");
  std::vector<Vector3d> velocities;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, points.size() - 1);
    velocities.emplace_back((points[after] - points[before]) / (times[after] - times[before]));
  }
  return velocities;
}

Piecewise piecewise_through(const std::vector<double>& times, const std::vector<Vector3d>& points,
                            const std::vector<Vector3d>& given) {
  require_times(times, "times");
  require_points(points, times.size(), "points");
  const std::vector<Vector3d> velocities = given.empty() ? velocities_through(times, points) : given;
  require_points(velocities, times.size(), "velocities");
  Piecewise made{times, {}, kPointRounding * largest(points)};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double third = (times[i + 1] - times[i]) / 3;
    made.points.push_back({points[i], points[i] + third * velocities[i],
                           points[i + 1] - third * velocities[i + 1], points[i + 1]});
  }
  return made;
}

Trajectory turned_through(Trajectory trajectory, const std::vector<double>& times,
                          const std::vector<Matrix3d>& rotations) {
  require_times(times, "times");
  if (rotations.size() != times.size())
    throw InputError("rotations", std::to_string(rotations.size()) + " of them",
                     std::to_string(times.size()) + ", one for each time");
  Piecewise turned{times, {}, 1e-15};
  for (std::size_t i = 0; i + 1 < rotations.size(); ++i) {
    const Eigen::AngleAxisd by(Matrix3d(rotations[i + 1] * rotations[i].transpose()));
    if (!(by.angle() < std::numbers::pi - 1e-6))
      throw InputError(entry("rotations", i + 1), "half a turn from the one before",
                       "less, so that there is a shortest way");
    turned.points.push_back({Vector3d::Zero(), by.angle() * by.axis()});
  }
  trajectory.turned = std::move(turned);
  trajectory.rotation.assign(rotations.begin(), rotations.end() - 1);
  return trajectory;
}

}  // namespace vericone::simulation
