// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/geometry/requires.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/cones/plane_cones.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "across_axis.h"
#include "minimise.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kOptimum = 1e-4;  // rad, to which the plane is right

/// The choices that look at no sector fall back to the opening where they have no plane.
bool by_opening(PlaneChoice choice) {
  return choice != PlaneChoice::least_y && choice != PlaneChoice::least_turn &&
         choice != PlaneChoice::wind_aware;
}

/// A pair seen on the planes through its line of sight, by azimuth from `e1`.
class Planes {
 public:
  Planes(const BodyState& a, const BodyState& b, SectorMethod method, const Vector3d& u, const Vector3d& e1,
         EdgeMemory* memory = nullptr)
      : a_(a),
        b_(b),
        cones_(a.shape, b.shape, a.position, b.position, method, memory),
        u_(u),
        e1_(e1),
        e2_(u.cross(e1)) {}

  Vector3d across(double azimuth) const { return std::cos(azimuth) * e1_ + std::sin(azimuth) * e2_; }

  std::optional<PlaneCandidate> at(double azimuth) const {
    const Vector3d e = across(azimuth);
    const auto opening = cones_.on(u_, e);
    if (!opening) return std::nullopt;
    const auto flat = [&](const Vector3d& v) { return Vector2d(v.dot(u_), v.dot(e)); };
    const ConeFunction y =
        cone_function(opening->psi, opening->theta_b, flat(a_.velocity), flat(b_.velocity));
    return PlaneCandidate{azimuth, opening->psi, opening->theta_b, y.y, y.v_r_hat};
  }

  std::optional<double> opening_slope(double azimuth) const { return cones_.opening_slope(across(azimuth)); }

  /// What the choice makes least; infinite where there is no sector.
  double merit(double azimuth, const PlaneOptions& options) const {
    const auto seen = at(azimuth);
    if (!seen) return kInfinity;
    switch (options.choice) {
      case PlaneChoice::least_y:
        return seen->y;
      case PlaneChoice::least_turn:
        return nearer_edge(*seen).turn;
      case PlaneChoice::wind_aware:
        return against_wind(*seen, options.wind);
      default:
        return -seen->psi;
    }
  }

  /// Merits that differ by less are the same.
  double noise() const { return 1e-12 + 4 * cones_.tolerance(); }
  /// Whether merits are exact to rounding.
  bool exact() const { return cones_.tolerance() == 0; }
  /// Whether they have no kinks; the turn has one where both edges are as near.
  bool smooth(PlaneChoice choice) const {
    return cones_.smooth() && choice != PlaneChoice::least_turn && choice != PlaneChoice::wind_aware;
  }

 private:
  struct Edge {
    double turn;  // rad in space, from the relative velocity
    double side;  // +1: the left one
  };
  Edge nearer_edge(const PlaneCandidate& seen) const {
    const Vector3d w = a_.velocity - b_.velocity, e = across(seen.azimuth);
    if (w.isZero(0)) return {0, 1};
    const PlaneOpening opening{seen.psi, seen.theta_b};
    const auto turn = [&](double angle) {
      // From the chord, which keeps the digits of small angles.
      const double chord = (w.normalized() - (std::cos(angle) * u_ + std::sin(angle) * e)).norm();
      return 2 * std::asin(std::min(0.5 * chord, 1.0));
    };
    const double left = turn(opening.left()), right = turn(opening.right());
    return left <= right ? Edge{left, 1} : Edge{right, -1};
  }

  /// The turn, where the acceleration towards that edge does not oppose the wind; above all turns otherwise.
  double against_wind(const PlaneCandidate& seen, const Vector3d& wind) const {
    const Edge edge = nearer_edge(seen);
    if (wind.isZero(0)) return edge.turn;
    const Vector3d e = across(seen.azimuth), w = a_.velocity - b_.velocity;
    const Vector2d v(a_.velocity.dot(u_), a_.velocity.dot(e));
    const Vector2d heading = v.isZero(0) ? Vector2d(1, 0) : v.normalized();
    // A's lateral acceleration, at heading + pi/2, turns w counter-clockwise where w is ahead of A.
    const double ahead = w.dot(u_) * heading.x() + w.dot(e) * heading.y();
    const double sign = ahead >= 0 ? edge.side : -edge.side;
    const Vector3d acceleration = sign * (-heading.y() * u_ + heading.x() * e);
    const double along = acceleration.dot(wind) / wind.norm();
    return along >= -0.5 ? edge.turn : 2 * std::numbers::pi - along;
  }

  const BodyState &a_, &b_;
  PlaneCones cones_;
  Vector3d u_, e1_, e2_;
};

/// The largest opening near azimuth 0, by secants through its slope; nothing where it has been lost, or where
/// there is no slope in closed form.
std::optional<double> opening_followed(const Planes& planes) {
  constexpr double kReach = 0.003, kNear = 0.01, kFar = 0.1;  // rad
  constexpr double kFlat = 1e-10;
  double x = 0;
  for (int round = 0; round < 3; ++round) {
    const auto here = planes.opening_slope(x), ahead = planes.opening_slope(x + kReach);
    if (!here || !ahead) return std::nullopt;
    if (std::abs(*here) < kFlat && std::abs(*ahead) < kFlat) return x;
    const double curvature = *ahead - *here;
    if (!(curvature < 0)) return std::nullopt;
    const double step = -kReach * *here / curvature;
    if (!(std::abs(step) < kFar)) return std::nullopt;
    x += step;
    if (std::abs(step) < kNear) return x;
  }
  return std::nullopt;
}

/// The optimum near azimuth 0, by parabolas through three planes; nothing where it has been lost.
std::optional<double> followed(const Planes& planes, const PlaneOptions& options) {
  // Openings vary slowly from plane to plane. What the relative velocity has a part in does not where that is
  // nearly along the line of sight, and gets a second, narrower parabola.
  const double wide = planes.exact() ? 0.01 : 0.05, narrow = by_opening(options.choice) ? wide : wide / 8;
  const auto merit = [&](double x) { return planes.merit(x, options); };
  double x = 0, reach = wide;
  for (int round = 0; round < 4; ++round) {
    const double here = merit(x), ahead = merit(x + reach), behind = merit(x - reach);
    const double most = std::max({here, ahead, behind}), least = std::min({here, ahead, behind});
    if (!(most < kInfinity)) return std::nullopt;
    if (most - least <= planes.noise()) return x;
    const double curvature = ahead + behind - 2 * here;
    if (!(curvature > 0)) return std::nullopt;
    const double step = 0.5 * reach * (behind - ahead) / curvature;
    if (std::abs(step) > 5 * reach) return std::nullopt;
    if (std::abs(step) <= reach && reach == narrow) {
      // Where the merit has a kink, the parabola's vertex is none of its own.
      return planes.smooth(options.choice) || merit(x + step) <= here + planes.noise() ? x + step : x;
    }
    x += step;
    if (std::abs(step) <= reach) reach = narrow;
  }
  return std::nullopt;
}

/// The best of all candidates; refined, the best of the optima near those that are better than their
/// neighbours.
std::optional<double> best_of_all(const Planes& planes, const PlaneOptions& options) {
  const int count = std::max(options.planes, 1);
  const double spacing = std::numbers::pi / count;
  const auto merit = [&](double x) { return planes.merit(x, options); };
  Minimum best{0, kInfinity};
  const auto offer = [&](const Minimum& found) {
    if (found.value < best.value - (best.value < kInfinity ? planes.noise() : 0)) best = found;
  };
  double before = options.refine ? merit(-spacing) : kInfinity, here = merit(0);
  for (int j = 0; j < count; ++j) {
    const Minimum candidate{j * spacing, here};
    offer(candidate);
    const double after = options.refine || j + 1 < count ? merit((j + 1) * spacing) : kInfinity;
    if (options.refine && here < before - planes.noise() && here <= after)
      offer(minimise(merit, candidate.x - spacing, candidate.x + spacing, candidate, 0.3 * kOptimum,
                     options.choice != PlaneChoice::wind_aware));
    before = std::exchange(here, after);
  }
  if (!(best.value < kInfinity)) return std::nullopt;
  return best.x;
}

/// Unit vector across u in the plane that `v` spans with it; nothing where it spans none.
std::optional<Vector3d> axis_towards(const Vector3d& u, const Vector3d& v) {
  const Vector3d rest = v - v.dot(u) * u;
  if (!(rest.norm() > 1e-12 * v.norm())) return std::nullopt;
  return across_axis(u, rest);
}

/// The choices that look at no sector.
std::optional<Vector3d> axis_of_motion(const BodyState& a, const BodyState& b, PlaneChoice choice,
                                       const Vector3d& u) {
  const Vector3d w = a.velocity - b.velocity;
  if (w.isZero(0)) return std::nullopt;
  if (choice == PlaneChoice::steepest_clearance) {
    const Clearance m = clearance(a.shape.containing_ellipsoid(), b.shape.containing_ellipsoid(), w);
    if (auto axis = axis_towards(u, m.normal)) return axis;
  }
  return axis_towards(u, -w);
}

}  // namespace

const char* to_string(PlaneChoice choice) {
  switch (choice) {
    case PlaneChoice::largest_opening:
      return "largest-opening";
    case PlaneChoice::least_turn:
      return "least-turn";
    case PlaneChoice::least_y:
      return "least-y";
    case PlaneChoice::wind_aware:
      return "wind-aware";
    case PlaneChoice::steepest_clearance:
      return "steepest-clearance";
    case PlaneChoice::of_motion:
      return "of-motion";
  }
  return "?";
}

std::vector<PlaneCandidate> all_planes(const BodyState& a, const BodyState& b, SectorMethod method,
                                       int planes) {
  VERICONE_REQUIRES(planes >= 1, "planes", "less", "at least 1");
  std::vector<PlaneCandidate> all;
  if (a.position == b.position) return all;
  const AxisFrame frame(b.position - a.position);
  const Planes seen(a, b, method, frame.axis, frame.e1);
  for (int j = 0; j < planes; ++j) {
    if (j % 256 == 255) checkpoint();
    if (const auto candidate = seen.at(std::numbers::pi * j / planes)) all.push_back(*candidate);
  }
  return all;
}

std::optional<Vector3d> choose_plane(const BodyState& a, const BodyState& b, SectorMethod method,
                                     const PlaneOptions& options, const Vector3d* previous,
                                     EdgeMemory* memory) {
  VERICONE_REQUIRES(options.planes >= 1 && options.planes <= 10'000, "options.planes", "others",
                    "from 1 to 10000");
  if (a.position == b.position) return std::nullopt;
  const AxisFrame frame(b.position - a.position);
  const Vector3d& u = frame.axis;
  if (a.planar() || b.planar())
    return a.planar() && b.planar() ? std::optional(Vector3d(-u.y(), u.x(), 0)) : std::nullopt;
  const auto as_before = [&](const Vector3d& e) -> Vector3d {
    return previous && e.dot(*previous) < 0 ? -e : e;
  };
  if (options.choice == PlaneChoice::of_motion || options.choice == PlaneChoice::steepest_clearance)
    if (const auto axis = axis_of_motion(a, b, options.choice, u)) return as_before(*axis);
  if (previous && options.refine) {
    const Planes near(a, b, method, u, across_axis(u, *previous), memory);
    if (by_opening(options.choice))
      if (const auto azimuth = opening_followed(near)) return near.across(*azimuth);
    if (const auto azimuth = followed(near, options)) return near.across(*azimuth);
  }
  // Candidates are counted from the plane of motion: planes equally good (of spheres, all) do not depend on
  // the world's axes, and what is taken holds the relative velocity.
  const Planes planes(a, b, method, u, axis_towards(u, a.velocity - b.velocity).value_or(frame.e1), memory);
  const auto azimuth = best_of_all(planes, options);
  if (!azimuth) return std::nullopt;
  return as_before(planes.across(*azimuth));
}

}  // namespace vericone::guidance
