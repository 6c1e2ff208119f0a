// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/testing/random_bodies.h>

#include <vericone/geometry/error.h>

namespace vericone::testing {
namespace {

using Eigen::Vector3d;

CombinedEllipsoid random_combined_body(RandomBodies& random) {
  for (;;) {
    const double a = random.uniform(0.4, 1.5), b = random.uniform(0.4, 1.5), c = random.uniform(0.4, 1.5);
    const Ellipsoid around = Ellipsoid::from_axes(Vector3d::Zero(), {a, b, c}, random.rotation());
    std::vector<Delimiter<3>> delimiters;
    const int count = random.integer(1, 3);
    for (int i = 0; i < count; ++i) {
      const double x = random.uniform(0.2, 1.2), y = random.uniform(0.2, 1.2), z = random.uniform(0.2, 1.2);
      const int sheets = random.integer(1, 2);
      delimiters.push_back(hyperboloid(sheets, {x, y, z}, random.rotation()));
    }
    try {
      return {around, delimiters};
    } catch (const InputError&) {  // one of them delimits nothing
    }
  }
}

Ellipsoid random_ellipsoid_body(RandomBodies& random, const Vector3d& center) {
  const double a = random.uniform(0.2, 1.5), b = random.uniform(0.2, 1.5), c = random.uniform(0.2, 1.5);
  return Ellipsoid::from_axes(center, {a, b, c}, random.rotation());
}

std::vector<Vector3d> hull_points(RandomBodies& random, const Vector3d& center, double size) {
  std::vector<Vector3d> points;
  const int count = random.integer(6, 12);
  for (int i = 0; i < count; ++i) points.push_back(center + random.in_box(size));
  return points;
}

Body any_mesh(RandomBodies& random) {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  for (std::uint32_t i = 0; i < 7; ++i) {
    const Vector3d c = random.in_box(1);
    for (int k = 0; k < 3; ++k) points.push_back(c + random.in_box(0.8));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return Assembly::mesh(std::move(points), std::move(triangles));
}

Body any_cloud(RandomBodies& random) {
  const double radius = random.coin() ? 0.3 : random.uniform(0.05, 0.3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 9; ++i) points.push_back(random.in_box(1.2));
  return Assembly::cloud(std::move(points), radius);
}

Body any_boxes(RandomBodies& random) {
  std::vector<Box> boxes;
  for (int i = 0; i < 6; ++i) {
    const Vector3d c = random.in_box(1), half = random.in_box(0.4).cwiseAbs() + Vector3d::Constant(0.02);
    boxes.push_back({c - half, c + half});
  }
  return Assembly::boxes(std::move(boxes));
}

Body any_pieces(RandomBodies& random) {
  if (random.coin()) {
    std::vector<HullBody> hulls;
    for (int i = 0; i < 4; ++i) {
      const Vector3d center = random.in_box(1);
      hulls.emplace_back(hull_points(random, center, 0.5));
    }
    return Assembly::polyhedra(std::move(hulls));
  }
  std::vector<CombinedEllipsoid> parts;
  for (int i = 0; i < 2; ++i) {
    const Vector3d center = random.in_box(1);
    parts.push_back(random.coin() ? CombinedEllipsoid(random_ellipsoid_body(random, center))
                                  : random_combined_body(random).translated(center));
  }
  return Body::pieces(std::move(parts));
}

/// Of every word, upright in its own frame; some with a margin.
Body any_convex(RandomBodies& random) {
  const auto size = [&] { return random.uniform(0.2, 1.2); };
  const auto ellipsoid = [&] { return random_ellipsoid_body(random, random.in_box(0.5)); };
  const auto base = [&]() -> Convex {
    switch (random.integer(0, 8)) {
      case 0:
        return Convex::cylinder(size(), 2 * size());
      case 1:
        return Convex::capsule(size(), 2 * size());
      case 2:
        return Convex::cone(size(), 2 * size());
      case 3:
        return Convex::frustum(size(), size(), 2 * size());
      case 4:
        return Convex::elliptic_cylinder(size(), size(), 2 * size());
      case 5:
        return Convex::disc(size());
      case 6:
        return Convex::rounded(HullBody(hull_points(random, Vector3d::Zero(), 0.8)), 0.4 * size());
      case 7:
        return Convex::rounded(ellipsoid(), 0.4 * size());
      default:
        return Convex::hull_of(ellipsoid(), ellipsoid());
    }
  };
  const Convex body = base();
  return random.integer(0, 3) == 0 ? body.swollen(0.3 * size()) : body;
}

}  // namespace

Body any_body(RandomBodies& random, BodyKind kind) {
  switch (kind) {
    case BodyKind::ellipsoid:
      return random_ellipsoid_body(random, Vector3d::Zero());
    case BodyKind::combined:
      return random_combined_body(random);
    case BodyKind::hull:
      return HullBody(hull_points(random, Vector3d::Zero(), 1));
    case BodyKind::mesh:
      return any_mesh(random);
    case BodyKind::cloud:
      return any_cloud(random);
    case BodyKind::boxes:
      return any_boxes(random);
    case BodyKind::convex:
      return any_convex(random);
    case BodyKind::pieces:
      break;
  }
  return any_pieces(random);
}

Pose any_pose(RandomBodies& random, double distance) {
  Pose pose;
  pose.rotation = random.rotation();
  pose.position = distance * random.direction();
  return pose;
}

}  // namespace vericone::testing
