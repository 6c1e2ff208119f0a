// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/combined/families.h>
#include <vericone/internal/verify/combined/sweep.h>
#include <vericone/internal/verify/seeded_random.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vericone::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint32_t kFirstStream = 700;
constexpr double kGrid = 0x1p-20;
constexpr int kSamples = 200;

Vector3d on_grid(const Vector3d& v) { return (v / kGrid).array().round() * kGrid; }

Vector3d vector(SeededRandom& random, double from, double to) {
  Vector3d v;
  for (int i = 0; i < 3; ++i) v(i) = random.uniform(from, to);
  return v;
}

double log_uniform(SeededRandom& random, double from, double to) {
  return std::exp(random.uniform(std::log(from), std::log(to)));
}

/// Where a surface is nearest to the centre, as a part of the ellipsoid's extent in that direction.
struct Reach {
  double least, most;
};
constexpr Reach kOrdinary{0.2, 0.9}, kShallow{0.97, 0.9995}, kDeep{0.02, 0.1};

struct Blank {
  Ellipsoid ellipsoid;
  Matrix3d rotation;
  Vector3d axes;

  /// To the ellipsoid's surface along u.
  double extent(const Vector3d& u) const {
    return 1 / (axes.cwiseInverse().asDiagonal() * (rotation.transpose() * u)).norm();
  }
};

/// Every second body is handed over by its shape matrix, so that both ways to define a body are tried.
Blank blank(SeededRandom& random, const Vector3d& axes) {
  const Matrix3d r = random.rotation();
  const Ellipsoid e = Ellipsoid::from_axes(Vector3d::Zero(), axes, r);
  return {random.coin() ? e : Ellipsoid::from_shape(Vector3d::Zero(), e.shape()), r, axes};
}

/// A hyperboloid with its axis along the first column of r; the second and third carry the waist.
Delimiter<3> surface(SeededRandom& random, const Blank& body, const Matrix3d& r, int sheets, Reach reach) {
  Vector3d axes;
  for (int i = 0; i < 3; ++i) axes(i) = random.uniform(0.3, 2) * body.extent(r.col(i));
  const double nearest = random.uniform(reach.least, reach.most);
  if (sheets == 2) {
    axes(0) = nearest * body.extent(r.col(0));
  } else {
    axes(1) = nearest * body.extent(r.col(1));
    if (random.coin()) axes(2) = random.uniform(reach.least, reach.most) * body.extent(r.col(2));
  }
  Delimiter<3> d = hyperboloid(sheets, axes, r);
  return d;
}

/// Columns of r turned cyclically by k.
Matrix3d axes_from(const Matrix3d& r, int k) {
  Matrix3d turned;
  for (int i = 0; i < 3; ++i) turned.col(i) = r.col((i + k) % 3);
  return turned;
}

enum class Kind { biconcave, biconvex, star };

CombinedEllipsoid combined(SeededRandom& random, Kind kind, const Vector3d& axes, Reach reach = kOrdinary) {
  const Blank body = blank(random, axes);
  std::vector<Delimiter<3>> delimiters;
  if (kind != Kind::star) {
    const Matrix3d r = axes_from(body.rotation, random.integer(0, 2));
    delimiters.push_back(surface(random, body, r, kind == Kind::biconcave ? 2 : 1, reach));
  } else {
    const int count = random.integer(2, 4);
    for (int i = 0; i < count; ++i) {
      const Matrix3d r = random.rotation();
      const int sheets = random.integer(1, 2);
      delimiters.push_back(surface(random, body, r, sheets, reach));
    }
  }
  return CombinedEllipsoid(body.ellipsoid, delimiters);
}

CombinedEllipsoid any(SeededRandom& random, const Vector3d& axes, Reach reach = kOrdinary) {
  return combined(random, static_cast<Kind>(random.integer(0, 2)), axes, reach);
}

CombinedEllipsoid at(const CombinedEllipsoid& body, const Vector3d& center) {
  const Ellipsoid& e = body.ellipsoid();
  const Ellipsoid moved =
      e.defined_by_factor() ? e.translated(center - e.center()) : Ellipsoid::from_shape(center, e.shape());
  return body.is_ellipsoid() ? CombinedEllipsoid(moved) : CombinedEllipsoid(moved, body.delimiters());
}

CombinedPair apart(SeededRandom& random, const CombinedEllipsoid& a, const CombinedEllipsoid& b, double least,
                   double most) {
  const Vector3d p = on_grid(vector(random, -10, 10)), e = random.direction<3>();
  const double factor = random.uniform(least, most);
  return {at(a, p), at(b, p + on_grid(factor * (a.ellipsoid().radius(e) + b.ellipsoid().radius(e)) * e))};
}

CombinedPair swapped(CombinedPair pair, bool swap) {
  if (swap) std::swap(pair.a, pair.b);
  return pair;
}

CombinedPair with_ellipsoid(SeededRandom& random, Kind kind, std::uint64_t index) {
  const Vector3d axes_a = vector(random, 1, 10), axes_b = vector(random, 1, 10);
  const CombinedEllipsoid a = blank(random, axes_a).ellipsoid, b = combined(random, kind, axes_b);
  return swapped(apart(random, a, b, 1.05, 3), index % 2 == 1);
}

CombinedPair both(SeededRandom& random, Reach reach, double least, double most) {
  const Vector3d axes_a = vector(random, 1, 10), axes_b = vector(random, 1, 10);
  const CombinedEllipsoid a = any(random, axes_a, reach), b = any(random, axes_b, reach);
  return apart(random, a, b, least, most);
}

/// Every fourth pair has a body whose surfaces go through its centre.
CombinedPair deep(SeededRandom& random, std::uint64_t index) {
  CombinedPair pair = both(random, kDeep, 1.05, 2);
  if (index % 4 == 0) {
    std::vector<Delimiter<3>> delimiters = pair.b.delimiters();
    delimiters.front().level = 0;
    pair.b = CombinedEllipsoid(pair.b.ellipsoid(), delimiters);
  }
  return swapped(pair, index % 8 == 4);
}

Vector3d thin_axes(SeededRandom& random) {
  const double size = random.uniform(1, 10), ratio = log_uniform(random, 10, 1000);
  const int kind = random.integer(0, 2);
  const double between = log_uniform(random, 1, ratio);
  return kind == 0   ? Vector3d(size, size / ratio, size / ratio)
         : kind == 1 ? Vector3d(size, size, size / ratio)
                     : Vector3d(size, size / between, size / ratio);
}

CombinedPair thin(SeededRandom& random, std::uint64_t index) {
  const Vector3d axes_a = random.coin() ? thin_axes(random) : vector(random, 1, 10),
                 axes_b = thin_axes(random);
  const CombinedEllipsoid a = random.coin() ? CombinedEllipsoid(blank(random, axes_a).ellipsoid)
                                            : any(random, axes_a),
                          b = any(random, axes_b);
  return swapped(apart(random, a, b, 1.05, 3), index % 2 == 1);
}

/// A placed in a dent of B and made smaller until its samples are clear of B and B's of it.
CombinedPair mouth(SeededRandom& random, std::uint64_t index) {
  for (;;) {
    Vector3d axes = vector(random, 3, 10);
    axes(0) = random.uniform(5, 10);
    const Blank blank_b = blank(random, axes);
    Vector3d surface_axes;
    for (int i = 0; i < 3; ++i) surface_axes(i) = random.uniform(0.3, 1.2) * axes(i);
    surface_axes(0) = random.uniform(0.1, 0.5) * axes(0);
    const CombinedEllipsoid b(blank_b.ellipsoid, {hyperboloid(2, surface_axes, blank_b.rotation)});
    const double out = random.uniform(1.05 * surface_axes(0), 1.1 * axes(0));
    Vector3d local = vector(random, -0.3, 0.3).cwiseProduct(surface_axes);
    local(0) = out;
    const Vector3d c = -on_grid(blank_b.rotation * local);  // from A to B
    if (b.gauge(c) < 1.03) continue;
    const Vector3d axes_a = vector(random, 0.3, 1) * random.uniform(1, 5);
    const Blank blank_a = blank(random, axes_a);
    CombinedEllipsoid a = random.coin() ? CombinedEllipsoid(blank_a.ellipsoid) : any(random, axes_a);
    for (int halvings = 0; halvings < 12; ++halvings) {
      const CombinedSweep sweep(a, at(b, c), kSamples);
      if (!sweep.march(Vector3d::Zero(), 0, 1)) break;
      a = a.scaled(0.75);
    }
    const Vector3d p = on_grid(vector(random, -10, 10));
    return swapped({at(a.scaled(0.97), p), at(b, p + c)}, index % 2 == 1);
  }
}

CombinedPair nearly_touching(SeededRandom& random) {
  const CombinedPair pair = both(random, kOrdinary, 1.5, 1.6);
  const Vector3d c = pair.b.center() - pair.a.center(), e = c.normalized();
  const double gap = log_uniform(random, 1e-4, 1e-1);
  const auto hit = CombinedSweep(pair.a, pair.b, 4 * kSamples).earliest(e);
  if (!hit) return pair;
  return {pair.a, at(pair.b, pair.a.center() + on_grid(c - (hit->t - gap) * e))};
}

}  // namespace

const char* name(CombinedFamily family) {
  switch (family) {
    case CombinedFamily::biconcave:
      return "biconcave";
    case CombinedFamily::biconvex:
      return "biconvex";
    case CombinedFamily::star:
      return "star";
    case CombinedFamily::mixed:
      return "mixed";
    case CombinedFamily::shallow:
      return "shallow";
    case CombinedFamily::deep:
      return "deep";
    case CombinedFamily::thin:
      return "thin";
    case CombinedFamily::mouth:
      return "mouth";
    case CombinedFamily::nearly_touching:
      return "nearly_touching";
    case CombinedFamily::distant:
      return "distant";
  }
  return "?";
}

CombinedPair combined_pair(CombinedFamily family, std::uint64_t seed, std::uint64_t index) {
  SeededRandom random(kFirstStream + static_cast<std::uint32_t>(family), seed, index);
  switch (family) {
    case CombinedFamily::biconcave:
      return with_ellipsoid(random, Kind::biconcave, index);
    case CombinedFamily::biconvex:
      return with_ellipsoid(random, Kind::biconvex, index);
    case CombinedFamily::star:
      return with_ellipsoid(random, Kind::star, index);
    case CombinedFamily::mixed:
      return both(random, kOrdinary, 1.05, 3);
    case CombinedFamily::shallow:
      return both(random, kShallow, 1.05, 3);
    case CombinedFamily::deep:
      return deep(random, index);
    case CombinedFamily::thin:
      return thin(random, index);
    case CombinedFamily::mouth:
      return mouth(random, index);
    case CombinedFamily::nearly_touching:
      return nearly_touching(random);
    case CombinedFamily::distant:
      return both(random, kOrdinary, 100, 1000);
  }
  return {};
}

GridVector grid_direction(const Vector3d& w) {
  const Vector3d scaled = w * (static_cast<double>(kGreatestDirection) / w.cwiseAbs().maxCoeff());
  GridVector r;
  for (int i = 0; i < 3; ++i) r[i] = std::llround(scaled(i));
  return r;
}

Vector3d as_vector(const GridVector& w) {
  Vector3d v;
  for (int i = 0; i < 3; ++i) v(i) = static_cast<double>(w[i]);
  return v;
}

}  // namespace vericone::verify
