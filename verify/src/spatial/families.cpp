// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/contact_march.h>
#include <vericone/verify/spatial/campaign.h>

namespace vericone::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Keeps the numbers of the families apart from those of the planar ones.
constexpr std::uint32_t kFirstStream = 100;

Vector3d vector(SeededRandom& random, double from, double to) {
  Vector3d v;
  for (int i = 0; i < 3; ++i) v(i) = random.uniform(from, to);
  return v;
}

/// Every second body is handed over by its shape matrix, so that both ways to define a body are tried.
Ellipsoid body(SeededRandom& random, const Vector3d& center, const Vector3d& semi_axes) {
  const Ellipsoid e = Ellipsoid::from_axes(center, semi_axes, random.rotation());
  return random.coin() ? e : Ellipsoid::from_shape(center, e.shape());
}

Ellipsoid moved_to(const Ellipsoid& body, const Vector3d& center) {
  if (body.defined_by_factor()) return body.translated(center - body.center());
  return Ellipsoid::from_shape(center, body.shape());
}

std::pair<Ellipsoid, Ellipsoid> apart(SeededRandom& random, const Ellipsoid& a, const Ellipsoid& b,
                                      double least, double most) {
  const Vector3d e = random.direction<3>();
  const double factor = random.uniform(least, most);
  return {a, moved_to(b, a.center() + factor * (a.radius(e) + b.radius(e)) * e)};
}

Vector3d thin_axes(SeededRandom& random) {
  const double size = random.uniform(1, 10);
  return random.coin() ? Vector3d(size, size / 100, size / 100) : Vector3d(size, size, size / 100);
}

}  // namespace

const char* name(SpatialFamily family) {
  switch (family) {
    case SpatialFamily::regular:
      return "regular";
    case SpatialFamily::spheres:
      return "spheres";
    case SpatialFamily::thin:
      return "thin";
    case SpatialFamily::sideways:
      return "sideways";
    case SpatialFamily::nearly_touching:
      return "nearly_touching";
    case SpatialFamily::distant:
      return "distant";
  }
  return "?";
}

std::pair<Ellipsoid, Ellipsoid> spatial_pair(SpatialFamily family, std::uint64_t seed, std::uint64_t index) {
  SeededRandom random(kFirstStream + static_cast<std::uint32_t>(family), seed, index);
  const Vector3d center = vector(random, -10, 10), axes_a = vector(random, 1, 10),
                 axes_b = vector(random, 1, 10);
  switch (family) {
    case SpatialFamily::regular: {
      const Ellipsoid a = body(random, center, axes_a), b = body(random, center, axes_b);
      return apart(random, a, b, 1.5, 3);
    }
    case SpatialFamily::spheres: {
      const Ellipsoid a = Ellipsoid::from_axes(center, Vector3d::Constant(axes_a.x())),
                      b = Ellipsoid::from_axes(center, Vector3d::Constant(axes_b.x()));
      return apart(random, a, b, 1.5, 3);
    }
    case SpatialFamily::thin: {
      const int which = random.integer(1, 3);
      const Vector3d thin_a = thin_axes(random), thin_b = thin_axes(random);
      const Ellipsoid a = body(random, center, which & 1 ? thin_a : axes_a),
                      b = body(random, center, which & 2 ? thin_b : axes_b);
      return apart(random, a, b, 1.5, 3);
    }
    case SpatialFamily::sideways: {
      // Side by side along z; long axes in the xy plane, at 30 degrees or more. The offset in the plane is
      // large enough for rho_A(c) + rho_B(c) > c.c and small beside the lengths.
      const Matrix3d frame = random.rotation();
      for (;;) {
        const double length_a = random.uniform(5, 10), length_b = random.uniform(5, 10);
        const double turn = random.uniform(0.5, 1.5);
        const Vector3d thick_a = vector(random, 0.2, 1), thick_b = vector(random, 0.2, 1);
        Matrix3d turned = Matrix3d::Identity();
        turned.topLeftCorner<2, 2>() = rotation_2d(turn);
        const Ellipsoid a = Ellipsoid::from_axes(center, {length_a, thick_a.y(), thick_a.z()}, frame);
        const Ellipsoid b =
            Ellipsoid::from_axes(center, {length_b, thick_b.y(), thick_b.z()}, frame * turned);
        const double aside = random.uniform(1.05, 1.5) * (thick_a.z() + thick_b.z());
        const Vector3d offset = frame * Vector3d(random.uniform(1, 4), 0, aside);
        if (a.radius(offset) + b.radius(offset) > 1.1 * offset.squaredNorm())
          return {a, b.translated(offset)};
      }
    }
    case SpatialFamily::nearly_touching: {
      const Ellipsoid a = body(random, center, axes_a), b = body(random, center, axes_b);
      const Vector3d e = random.direction<3>();
      const double start = 2 * (a.radius(e) + b.radius(e));
      const Ellipsoid away = moved_to(b, a.center() + start * e);
      const double travel = ContactMarch(a, away).first_contact(e).time.value();
      return {a, moved_to(b, a.center() + (1 + 1e-6) * (start - travel) * e)};
    }
    case SpatialFamily::distant: {
      const Ellipsoid a = body(random, center, axes_a), b = body(random, center, axes_b);
      const double scale = std::array{1e3, 1e4, 1e5, 1e6}[index % 4];
      return apart(random, a, b, scale, 1.5 * scale);
    }
  }
  return {};
}

}  // namespace vericone::verify
