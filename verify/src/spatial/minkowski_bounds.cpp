// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <vericone/internal/verify/spatial/minkowski_bounds.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace vericone::verify {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Exact::FT;
using ExactVector = Exact::Vector_3;
using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Doubles::Point_3>;

using Eigen::Vector3d;

Doubles::Point_3 to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
ExactVector to_exact(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
ExactVector to_exact(const Doubles::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// The shape matrix that defines the body, without rounding.
using ExactMatrix = std::array<std::array<Number, 3>, 3>;

ExactMatrix exact_shape(const Ellipsoid& body) {
  ExactMatrix s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (!body.defined_by_factor()) {
        s[i][j] = body.shape()(i, j);
        continue;
      }
      s[i][j] = 0;
      for (int k = 0; k < 3; ++k) s[i][j] += Number(body.factor()(i, k)) * Number(body.factor()(j, k));
    }
  return s;
}

Number form(const ExactMatrix& m, const ExactVector& v) {
  Number sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += m[i][j] * v[i] * v[j];
  return sum;
}

ExactMatrix adjugate(const ExactMatrix& m) {
  ExactMatrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r[j][i] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
  return r;
}

/// Vertices of a polyhedron inscribed in the body, about its centre, with coordinates that are multiples of
/// `grid`.
std::vector<Vector3d> inscribed(const Ellipsoid& body, const GeodesicSphere& sphere, double grid) {
  // Snapping moves a vertex by at most grid in the body's own unit of its shortest axis; twice that is given.
  const double shortest = body.semi_axes().minCoeff();
  const double shrink = 1 - 2 * grid / shortest - 1e-12;
  if (!(shrink > 0.9)) throw std::logic_error("minkowski_bounds: a body too thin or too small for the grid");
  std::vector<Vector3d> points;
  points.reserve(sphere.vertices.size());
  const ExactMatrix shape = exact_shape(body), adj = adjugate(shape);
  Number det = 0;
  for (int j = 0; j < 3; ++j) det += shape[0][j] * adj[j][0];
  for (const Vector3d& u : sphere.vertices) {
    const Vector3d y = (body.factor() * (shrink * u) / grid).array().round() * grid;
    // y^T S^{-1} y <= 1
    if (form(adj, to_exact(y)) > det) throw std::logic_error("minkowski_bounds: a vertex outside its body");
    points.push_back(y);
  }
  return points;
}

/// A double s such that the body is in s times the polyhedron with these vertices and facets.
///
/// Every facet is seen from the centre on its inner side, so the facets are a star-shaped surface, and a
/// point of the cone over a facet that is below the facet's plane is in the hull. The body is below the plane
/// m.x = s h iff the pole of the plane is not inside the body: m^T S m <= (s h)^2.
double enclosing_scale(const Ellipsoid& body, const std::vector<Vector3d>& points,
                       const GeodesicSphere& sphere) {
  const ExactMatrix shape = exact_shape(body);
  double s = 1;
  std::vector<std::pair<Number, Number>> planes;  // m^T S m, h
  for (const Eigen::Vector3i& f : sphere.facets) {
    const ExactVector p = to_exact(points[f(0)]);
    const ExactVector m = CGAL::cross_product(to_exact(points[f(1)]) - p, to_exact(points[f(2)]) - p);
    const Number h = m * p;
    if (!(h > 0)) throw std::logic_error("minkowski_bounds: a facet turned inside out");
    planes.emplace_back(form(shape, m), h);
    s = std::max(s, std::sqrt(CGAL::to_double(planes.back().first)) / CGAL::to_double(h));
  }
  s *= 1 + 1e-12;
  for (const auto& [reach, h] : planes)
    if (reach > Number(s) * Number(s) * h * h)
      throw std::logic_error("minkowski_bounds: a facet that cuts its body");
  return s;
}

Mesh hull_of_sums(const std::vector<Vector3d>& first, const std::vector<Vector3d>& second) {
  std::vector<Doubles::Point_3> sums;
  sums.reserve(first.size() * second.size());
  for (const Vector3d& x : first)
    for (const Vector3d& y : second) sums.push_back(to_point(x + y));
  Mesh hull;
  CGAL::convex_hull_3(sums.begin(), sums.end(), hull);
  return hull;
}

/// Area of a spherical triangle from its sides (L'Huilier), which keeps the digits of small ones.
double triangle_area(const Vector3d& x, const Vector3d& y, const Vector3d& z) {
  const auto side = [](const Vector3d& u, const Vector3d& v) { return 2 * std::asin((u - v).norm() / 2); };
  const double a = side(y, z), b = side(z, x), c = side(x, y);
  const double s = (a + b + c) / 2;
  const double product =
      std::tan(s / 2) * std::tan((b + c - a) / 4) * std::tan((c + a - b) / 4) * std::tan((a + b - c) / 4);
  return 4 * std::atan(std::sqrt(std::max(product, 0.0)));
}

}  // namespace

struct PolyhedronCone::Exact {
  bool everything = false;
  std::vector<ExactVector> edges;  // counter-clockwise about the axis
  std::vector<Vector3d> rounded;
  double solid_angle = 4 * std::numbers::pi;

  /// The cone over the polyhedron `hull` + shift.
  Exact(const Mesh& hull, const ExactVector& shift) {
    const auto visible = [&](Mesh::Face_index face) {
      const auto h = hull.halfedge(face);
      const ExactVector p = to_exact(hull.point(hull.source(h))) + shift,
                        q = to_exact(hull.point(hull.target(h))) + shift,
                        r = to_exact(hull.point(hull.target(hull.next(h)))) + shift;
      // Outside of the plane through p, q, r: the origin sees the facet from its outer side.
      return CGAL::orientation(p, q, r) == CGAL::NEGATIVE;
    };
    std::vector<bool> seen(hull.number_of_faces());
    for (const auto face : hull.faces()) seen[face.idx()] = visible(face);
    std::unordered_map<std::size_t, Mesh::Vertex_index> next;
    for (const auto h : hull.halfedges())
      if (seen[hull.face(h).idx()] && !seen[hull.face(hull.opposite(h)).idx()])
        next.emplace(hull.source(h).idx(), hull.target(h));
    if (next.empty()) {
      everything = true;
      return;
    }
    const std::size_t start = next.begin()->first;
    std::size_t at = start;
    do {
      const Mesh::Vertex_index v = next.at(at);
      edges.push_back(to_exact(hull.point(v)) + shift);
      at = v.idx();
    } while (at != start);
    if (edges.size() != next.size())
      throw std::logic_error("PolyhedronCone: the silhouette is not one cycle");
    // The rim of the visible facets runs counter-clockwise for an eye at the apex; about the axis of the
    // cone, which points away from it, that is clockwise.
    std::reverse(edges.begin(), edges.end());
    for (const ExactVector& e : edges)
      rounded.push_back(
          Vector3d(CGAL::to_double(e.x()), CGAL::to_double(e.y()), CGAL::to_double(e.z())).normalized());
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& e : rounded) middle += e;
    middle.normalize();
    solid_angle = 0;
    for (std::size_t i = 0; i < rounded.size(); ++i)
      solid_angle += triangle_area(middle, rounded[i], rounded[(i + 1) % rounded.size()]);
  }
};

PolyhedronCone::PolyhedronCone(std::shared_ptr<const Exact> exact) : exact_(std::move(exact)) {}

bool PolyhedronCone::everything() const { return exact_->everything; }
double PolyhedronCone::solid_angle() const { return exact_->solid_angle; }
const std::vector<Vector3d>& PolyhedronCone::edges() const { return exact_->rounded; }

bool PolyhedronCone::contains(const Vector3d& w) const {
  if (exact_->everything) return true;
  if (w.isZero(0)) return false;
  const ExactVector v = to_exact(w);
  const auto& edges = exact_->edges;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (CGAL::orientation(edges[i], edges[(i + 1) % edges.size()], v) == CGAL::NEGATIVE) return false;
  return true;
}

GeodesicSphere::GeodesicSphere(int level) {
  if (level < 0 || level > 5) throw std::logic_error("GeodesicSphere: level must be 0 to 5");
  const double t = std::numbers::phi;
  const double corners[12][3] = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                                 {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  for (const auto& p : corners) vertices.push_back(Vector3d(p[0], p[1], p[2]).normalized());
  const int triangles[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (const auto& f : triangles) facets.emplace_back(f[0], f[1], f[2]);
  for (int round = 0; round < level; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [it, inserted] = middles.try_emplace(std::minmax(i, j), static_cast<int>(vertices.size()));
      if (inserted) vertices.push_back((vertices[i] + vertices[j]).normalized());
      return it->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : facets) {
      const int a = middle(f(0), f(1)), b = middle(f(1), f(2)), c = middle(f(2), f(0));
      finer.emplace_back(f(0), a, c);
      finer.emplace_back(f(1), b, a);
      finer.emplace_back(f(2), c, b);
      finer.emplace_back(a, b, c);
    }
    facets = std::move(finer);
  }
}

std::vector<Vector3d> minkowski_sum_vertices(const std::vector<Vector3d>& first,
                                             const std::vector<Vector3d>& second) {
  const Mesh hull = hull_of_sums(first, second);
  std::vector<Vector3d> vertices;
  for (const auto v : hull.vertices()) {
    const auto& p = hull.point(v);
    vertices.emplace_back(p.x(), p.y(), p.z());
  }
  return vertices;
}

MinkowskiBounds minkowski_bounds(const Ellipsoid& a, const Ellipsoid& b, int level) {
  const GeodesicSphere sphere(level);
  // Sums and differences of multiples of 2^-42 of the size are exact in doubles.
  const double size = std::max(a.semi_axes().maxCoeff(), b.semi_axes().maxCoeff());
  const double grid = std::ldexp(1.0, std::ilogb(size) - 42);
  const std::vector<Vector3d> in_a = inscribed(a, sphere, grid), in_b = inscribed(b, sphere, grid);
  const double scale = std::max(enclosing_scale(a, in_a, sphere), enclosing_scale(b, in_b, sphere));
  std::vector<Vector3d> minus_a;
  minus_a.reserve(in_a.size());
  for (const Vector3d& x : in_a) minus_a.push_back(-x);
  const Mesh hull = hull_of_sums(in_b, minus_a);
  const ExactVector c = to_exact(b.center()) - to_exact(a.center());
  // The cone over scale * P + c is that over P + c / scale.
  return {PolyhedronCone(std::make_shared<PolyhedronCone::Exact>(hull, c)),
          PolyhedronCone(std::make_shared<PolyhedronCone::Exact>(hull, c / Number(scale))), scale,
          hull.number_of_vertices()};
}

}  // namespace vericone::verify
