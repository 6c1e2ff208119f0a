// SPDX-License-Identifier: BSD-3-Clause
//
// Hulls of the bodies that robots load: spheres, capsules, cylinders, boxes, ellipsoids; and what is proved
// of them (docs/explanation/fitting-proof.md#solids).
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/fitting/hull.h>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vericone::fitting {

enum class SolidKind { sphere, capsule, cylinder, box, ellipsoid };
inline constexpr std::array<SolidKind, 5> kSolidKinds{
    SolidKind::sphere, SolidKind::capsule, SolidKind::cylinder, SolidKind::box, SolidKind::ellipsoid};
[[nodiscard]] std::string to_string(SolidKind kind);

/// { center + rotation y : y in the body of this kind and these sizes }, with these numbers as they are: what
/// is proved is proved of them. Capsules and cylinders are about z, all are about their middle.
struct Solid {
  SolidKind kind = SolidKind::sphere;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();        // m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // orthonormal to 1e-9, determinant above 0
  /// Sphere: radius. Capsule: radius, length between the centres of its ends. Cylinder: radius, height. Box:
  /// half of its edges. Ellipsoid: semi-axes, above 0. m; the rest is 0.
  Eigen::Vector3d sizes = Eigen::Vector3d::Zero();

  [[nodiscard]] double volume() const;  // m^3, as if the rotation were one
  /// The farthest that a point of it is from the centre, rounded up a little; m.
  [[nodiscard]] double reach() const;
  /// How deep a point is in it, m: below 0 outside. Changes no faster than the point moves; inside, the
  /// distance from the boundary (of an ellipsoid a lower bound). Rounded.
  [[nodiscard]] double depth(const Eigen::Vector3d& x) const;
};

/// Points and triangles (which are inside a solid where their corners are) against solids, with balls of
/// radius `margin` about the points. Decided by doubles with bounds of their rounding, else in rational
/// numbers: y = rotation^-1 (x - center) is in the body. Beside ellipsoids a ball may count as outside by a
/// ratio of axes. Throws InputError naming "pieces" (none), "pieces[i]" (sizes, or what is no rotation to
/// 1e-9), "points[i]", "triangles[i]" or "margin". Linear in points times solids.
[[nodiscard]] Certificate check(const std::vector<Solid>& solids, const Sample& sample, double margin = 0);

/// The first piece that contains each point and each triangle, -1 where there is none; as check().
[[nodiscard]] Assignment homes_of(const std::vector<Solid>& solids, const Sample& sample);

/// As inside_certificate() of quadrics: the solids as exact rational matrices. There is none where one of the
/// solids is a capsule, which is not what quadrics have in common.
[[nodiscard]] InsideCertificate inside_certificate(const std::vector<Solid>& solids, const Sample& sample);

/// Adds to the sizes of each solid the least of 2^-44, 2^-43, ... of its reach from the origin for which
/// exact arithmetic says that it contains what is assigned to it, with balls of radius `margin` about the
/// points and of `slack` of its reach beside. `slack` covers whoever reads the numbers and rounds: scenes
/// move and turn bodies with a few roundings of 2^-53. Throws std::runtime_error where 2^-20 is not enough.
void enclose(std::vector<Solid>& solids, const Sample& sample, const Assignment& assignment,
             double margin = 0, double slack = 0x1p-46);

/// Of the union, m^3: closed forms less what is counted too often, by columns; error an estimate. Rotations
/// are taken as exact.
[[nodiscard]] VolumeEstimate volume(const std::vector<Solid>& solids);

/// Triangles of a solid's surface, seen from outside counter-clockwise; round parts are cut off by chords.
/// `quadric` is 0.
[[nodiscard]] CombinedSurface surface(const Solid& solid);

/// A small solid of the kind around points, in doubles and not proved; each point may be outside by rounding.
/// Spheres, ellipsoids: the least. Boxes: no turn about one of their axes makes them smaller. Cylinders and
/// capsules: a local minimum, the best of several starts. Throws InputError naming "points": none, or in one
/// plane for an ellipsoid.
[[nodiscard]] Solid small_solid(const std::vector<Eigen::Vector3d>& points, SolidKind kind);

struct SolidOptions {
  std::vector<SolidKind> kinds{SolidKind::capsule, SolidKind::cylinder, SolidKind::box, SolidKind::ellipsoid};
  double margin = 0;       // radius of balls about the points, m; 0 where ellipsoids are among the kinds
  int pieces = 1;          // bodies whose union is the hull, 1 to 64; fewer where a further one gains nothing
  double slack = 0x1p-46;  // of enclose()
  /// As FitOptions::progress.
  std::function<bool(const std::string& what, double share)> progress;
};

struct SolidFit {
  std::vector<Solid> pieces;  // in the world
  Certificate certificate;
  bool certified = false;
  VolumeEstimate volume;                     // of the union, m^3
  std::optional<double> scan_volume;         // m^3
  std::optional<double> convex_hull_volume;  // m^3
  std::optional<double> ellipsoid_volume;    // of the least ellipsoid of the points, m^3
  DistanceStatistics scan_to_hull;           // depth of the scan's points in the union, at least
  DistanceStatistics protrusion;             // of points on the union's boundary from the scan
};

/// A union of solids, each the smallest found of the kinds allowed, that is proved to contain the sample.
/// Equivariant as fit(). Throws InputError naming "points", "triangles[i]", "kinds", "margin" or "pieces";
/// Interrupted.
[[nodiscard]] SolidFit fit_solids(const Sample& sample, const SolidOptions& options = {});

}  // namespace vericone::fitting
