// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/sum.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <vector>

namespace vericone::verify {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Eigen::Vector3d;

bool spans_space(const std::vector<Point>& points) {
  // Any edge, any triangle with it, any tetrahedron with that.
  const Point& a = points.front();
  const Point *b = nullptr, *c = nullptr;
  for (const Point& p : points) {
    if (!b) {
      if (p != a) b = &p;
    } else if (!c) {
      if (!CGAL::collinear(a, *b, p)) c = &p;
    } else if (!CGAL::coplanar(a, *b, *c, p)) {
      return true;
    }
  }
  if (!b || !c) return false;
  for (const Point& p : points)
    if (!CGAL::coplanar(a, *b, *c, p)) return true;
  return false;
}

}  // namespace

struct HullSum::Exact {
  /// Inside: normal . x <= offset.
  struct Facet {
    Vector normal;
    Number offset;
  };
  std::vector<Facet> facets;
};

HullSum::HullSum(std::span<const Vector3d> agent, std::span<const Vector3d> obstacle) {
  const auto point = [](const Vector3d& x) { return Point(x.x(), x.y(), x.z()); };
  std::vector<Point> differences;
  for (const Vector3d& x : obstacle)
    for (const Vector3d& a : agent) differences.push_back(CGAL::ORIGIN + (point(x) - point(a)));
  auto exact = std::make_shared<Exact>();
  if (spans_space(differences)) {
    CGAL::Surface_mesh<Point> hull;
    CGAL::convex_hull_3(differences.begin(), differences.end(), hull);
    for (const auto face : hull.faces()) {
      const auto h = hull.halfedge(face);
      const Point &p = hull.point(hull.source(h)), &q = hull.point(hull.target(h)),
                  &r = hull.point(hull.target(hull.next(h)));
      const Vector normal = CGAL::cross_product(q - p, r - p);
      exact->facets.push_back({normal, normal * (p - CGAL::ORIGIN)});
    }
  }
  exact_ = exact;
}

bool HullSum::solid() const { return !exact_->facets.empty(); }

Membership HullSum::meets(double from, double to, const Vector3d& w) const {
  const Vector v(w.x(), w.y(), w.z());
  Number enter = from, leave = std::isinf(to) ? 0 : to;
  bool unbounded = std::isinf(to), boundary = false;
  for (const auto& [normal, offset] : exact_->facets) {
    const Number slope = normal * v;
    const auto sign = CGAL::sign(slope);
    if (sign == CGAL::ZERO) {
      if (CGAL::is_negative(offset)) return Membership::out;
      boundary |= CGAL::is_zero(offset);
    } else if (sign == CGAL::POSITIVE) {
      const Number t = offset / slope;
      if (unbounded || t < leave) leave = t;
      unbounded = false;
    } else {
      const Number t = offset / slope;
      if (t > enter) enter = t;
    }
    if (!unbounded && enter > leave) return Membership::out;
  }
  if (boundary) return Membership::on;
  if (unbounded || enter < leave) return Membership::in;
  // A single time: inside when no facet is met there.
  for (const auto& [normal, offset] : exact_->facets)
    if (normal * v * enter == offset) return Membership::on;
  return Membership::in;
}

}  // namespace vericone::verify
