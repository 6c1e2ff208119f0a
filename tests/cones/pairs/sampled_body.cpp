// SPDX-License-Identifier: BSD-3-Clause
#include "cones/pairs/sampled_body.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>

namespace vericone::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Ball = SampledBody::Ball;
using Hit = std::function<bool(const Vector3d&, const Vector3d&)>;

constexpr double kClear = 1e-9;  // by so much a ray goes through, in parts of sizes about 1

/// { x : (x - c)^T M (x - c) <= level }.
struct Form {
  Vector3d center;
  Matrix3d matrix;
  double level;
  double value(const Vector3d& x) const { return (x - center).dot(matrix * (x - center)) - level; }
};

struct Forms {
  std::vector<Form> all;  // the first is the ellipsoid
  double reach;           // no point of the body is farther from the centre

  bool contains(const Vector3d& x) const {
    return std::all_of(all.begin(), all.end(), [&](const Form& f) { return f.value(x) <= -kClear; });
  }
  /// Whether a ball may have a point of the body: values change by at most this over it.
  bool may_reach(const Vector3d& x, double radius) const {
    return std::all_of(all.begin(), all.end(), [&](const Form& f) {
      const double change = 2 * f.matrix.norm() * ((x - f.center).norm() + radius) * radius;
      return f.value(x) <= change;
    });
  }
};

Forms forms_of(const CombinedEllipsoid& body) {
  Forms forms;
  const Matrix3d& f = body.ellipsoid().factor();
  forms.all.push_back({body.center(), (f * f.transpose()).inverse(), 1});
  for (const Delimiter<3>& d : body.delimiters()) forms.all.push_back({body.center(), d.matrix, d.level});
  forms.reach = f.norm();
  return forms;
}

void add(SampledBody& sampled, const Forms& forms) {
  const Vector3d& c = forms.all.front().center;
  constexpr int kCells = 9;
  const double half = forms.reach / kCells, radius = std::sqrt(3.0) * half;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      for (int k = 0; k < kCells; ++k) {
        const Vector3d x = c + half * Vector3d(2 * i + 1 - kCells, 2 * j + 1 - kCells, 2 * k + 1 - kCells);
        if (forms.may_reach(x, radius)) sampled.cover.push_back({x, radius});
        if (forms.contains(x)) sampled.inside.push_back(x);
      }
  // Outwards along rays from the centre, about which the body is star-shaped.
  for (int i = 0; i < 60; ++i) {
    const double z = 1 - (2 * i + 1) / 60.0, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
    const Vector3d u(r * std::cos(angle), r * std::sin(angle), z);
    double in = 0, out = 1.01 * forms.reach;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (in + out);
      (forms.contains(c + middle * u) ? in : out) = middle;
    }
    if (in > 0) sampled.inside.push_back(c + in * u);
  }
}

bool ray_hits(const Forms& forms, const Vector3d& x, const Vector3d& d) {
  const Form& ellipsoid = forms.all.front();
  const Vector3d y = x - ellipsoid.center;
  const double a = d.dot(ellipsoid.matrix * d), b = d.dot(ellipsoid.matrix * y),
               c = y.dot(ellipsoid.matrix * y) - 1;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return false;
  const double from = (-b - std::sqrt(discriminant)) / a, to = (-b + std::sqrt(discriminant)) / a;
  constexpr int kSteps = 100;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = from + (to - from) * i / kSteps;
    if (t > kClear && forms.contains(x + t * d)) return true;
  }
  return false;
}

bool slab_hit(const Box& box, const Vector3d& x, const Vector3d& d) {
  double from = kClear, to = 1e9;
  for (int k = 0; k < 3; ++k) {
    const double low = box.low(k) + kClear, high = box.high(k) - kClear;
    if (std::abs(d(k)) < 1e-12) {
      if (x(k) <= low || x(k) >= high) return false;
      continue;
    }
    const double one = (low - x(k)) / d(k), two = (high - x(k)) / d(k);
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
  }
  return from < to;
}

bool triangle_hit(const std::array<Vector3d, 3>& p, const Vector3d& x, const Vector3d& d) {
  Matrix3d m;
  m << p[1] - p[0], p[2] - p[0], -d;
  if (std::abs(m.determinant()) < 1e-6 * d.norm()) return false;
  const Vector3d s = m.inverse() * (x - p[0]);
  return s.x() > kClear && s.y() > kClear && s.x() + s.y() < 1 - kClear && s.z() > kClear;
}

/// The half-spaces n.x <= h of the facets, by trying every three points.
std::vector<std::pair<Vector3d, double>> facets_of(const std::vector<Vector3d>& points) {
  std::vector<std::pair<Vector3d, double>> facets;
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k) {
        Vector3d n = (points[j] - points[i]).cross(points[k] - points[i]);
        if (n.norm() < 1e-9) continue;
        n.normalize();
        double most = -1e300, least = 1e300;
        for (const Vector3d& x : points) {
          most = std::max(most, n.dot(x - points[i]));
          least = std::min(least, n.dot(x - points[i]));
        }
        if (most < 1e-12) facets.emplace_back(n, n.dot(points[i]));
        if (least > -1e-12) facets.emplace_back(-n, -n.dot(points[i]));
      }
  return facets;
}

bool facet_hit(const std::vector<std::pair<Vector3d, double>>& facets, const Vector3d& x, const Vector3d& d) {
  double from = kClear, to = 1e9;
  for (const auto& [n, h] : facets) {
    const double along = n.dot(d), rest = h - kClear - n.dot(x);
    if (std::abs(along) < 1e-12) {
      if (rest <= 0) return false;
    } else if (along > 0) {
      to = std::min(to, rest / along);
    } else {
      from = std::max(from, rest / along);
    }
  }
  return from < to;
}

void add_hull(SampledBody& sampled, const std::vector<Vector3d>& points, std::vector<Hit>& hits) {
  const auto facets = facets_of(points);
  Vector3d low = points[0], high = points[0];
  for (const Vector3d& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  constexpr int kCells = 5;
  const Vector3d half = (high - low) / (2 * kCells);
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      for (int k = 0; k < kCells; ++k) {
        const Vector3d x = low + half.cwiseProduct(Vector3d(2 * i + 1, 2 * j + 1, 2 * k + 1));
        const auto within = [&](double margin) {
          return std::all_of(facets.begin(), facets.end(),
                             [&](const auto& f) { return f.first.dot(x) - f.second <= margin; });
        };
        if (within(half.norm())) sampled.cover.push_back({x, half.norm()});
        if (within(-kClear)) sampled.inside.push_back(x);
      }
  for (const Vector3d& x : points) sampled.inside.push_back(x);
  hits.push_back([facets](const Vector3d& x, const Vector3d& d) { return facet_hit(facets, x, d); });
}

Hit any(std::vector<Hit> hits) {
  return [hits = std::move(hits)](const Vector3d& x, const Vector3d& d) {
    return std::any_of(hits.begin(), hits.end(), [&](const Hit& hit) { return hit(x, d); });
  };
}

void add_forms(SampledBody& sampled, const CombinedEllipsoid& body, std::vector<Hit>& hits) {
  const Forms forms = forms_of(body);
  add(sampled, forms);
  hits.push_back([forms](const Vector3d& x, const Vector3d& d) { return ray_hits(forms, x, d); });
}

void add_triangle(SampledBody& sampled, const std::array<Vector3d, 3>& p, std::vector<Hit>& hits) {
  hits.push_back([p](const Vector3d& x, const Vector3d& d) { return triangle_hit(p, x, d); });
  constexpr int kParts = 5;
  const double side = std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()}) / kParts;
  for (int j = 0; j <= kParts; ++j)
    for (int k = 0; j + k <= kParts; ++k) {
      const Vector3d x = p[0] + (p[1] - p[0]) * j / kParts + (p[2] - p[0]) * k / kParts;
      sampled.cover.push_back({x, side});
      sampled.inside.push_back(x);
    }
}

void add_ball(SampledBody& sampled, const Vector3d& c, double radius, std::vector<Hit>& hits) {
  sampled.cover.push_back({c, radius * (1 + 1e-12)});
  sampled.inside.push_back(c);
  for (int k = 0; k < 6; ++k)
    sampled.inside.push_back(c + (k % 2 ? 1 : -1) * radius * (1 - 1e-9) * Vector3d::Unit(k / 2));
  hits.push_back([c, radius](const Vector3d& x, const Vector3d& d) {
    const Vector3d y = x - c;
    const double t = -y.dot(d) / d.squaredNorm();
    return t > kClear && (y + t * d).norm() < radius - kClear;
  });
}

void add_box(SampledBody& sampled, const Box& box, std::vector<Hit>& hits) {
  const Vector3d c = box.center(), half = box.half_widths();
  for (int j = 0; j < 27; ++j) {
    const Vector3d step = half.cwiseProduct(Vector3d(j % 3 - 1, j / 3 % 3 - 1, j / 9 - 1));
    sampled.cover.push_back({c + step * (2.0 / 3), half.norm() / 3 * (1 + 1e-12)});
    sampled.inside.push_back(c + step * (1 - 1e-9));
  }
  hits.push_back([box](const Vector3d& x, const Vector3d& d) { return slab_hit(box, x, d); });
}

/// The farthest point along n, by the definition.
Vector3d farthest_of(const Convex& body, const Vector3d& n) {
  Vector3d best = Vector3d::Zero();
  double most = -1e300;
  for (const Convex::Piece& piece : body.pieces()) {
    Vector3d x = piece.center;
    const Vector3d across = piece.factor * (piece.factor.transpose() * n);
    if (const double square = n.dot(across); square > 0) x += across / std::sqrt(square);
    if (n.dot(x) > most) most = n.dot(x), best = x;
  }
  return best + body.margin() * n.normalized();
}

/// Inside: the hull of the farthest points along 26 directions; outside: planes along many.
void add_convex(SampledBody& sampled, const Convex& body, std::vector<Hit>& hits) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 27; ++i)
    if (i != 13) points.push_back(farthest_of(body, Vector3d(i % 3 - 1.02, i / 3 % 3 - 1.01, i / 9 - 0.97)));
  std::vector<std::pair<Vector3d, double>> planes;
  for (int i = 0; i < 150; ++i) {
    const double z = 1 - (2 * i + 1) / 150.0, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
    const Vector3d n(r * std::cos(angle), r * std::sin(angle), z);
    planes.emplace_back(n, n.dot(farthest_of(body, n)));
  }
  Vector3d low = points[0], high = points[0];
  for (int k = 0; k < 3; ++k) {
    low(k) = farthest_of(body, -Vector3d::Unit(k))(k);
    high(k) = farthest_of(body, Vector3d::Unit(k))(k);
  }
  constexpr int kCells = 7;
  const Vector3d half = (high - low) / (2 * kCells);
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      for (int k = 0; k < kCells; ++k) {
        const Vector3d x = low + half.cwiseProduct(Vector3d(2 * i + 1, 2 * j + 1, 2 * k + 1));
        const bool near = std::all_of(planes.begin(), planes.end(), [&](const auto& plane) {
          return plane.first.dot(x) <= plane.second + half.norm() + 1e-12;
        });
        if (near) sampled.cover.push_back({x, half.norm() + 1e-12});
      }
  const Vector3d middle = body.middle();
  for (const Vector3d& x : points)
    for (const double part : {1 - 1e-9, 0.5}) sampled.inside.push_back(middle + part * (x - middle));
  if (half.minCoeff() < 1e-6 || body.pieces().size() + (body.margin() > 0) < 2) return;  // flat
  const auto facets = facets_of(points);
  hits.push_back([facets](const Vector3d& x, const Vector3d& d) { return facet_hit(facets, x, d); });
}

}  // namespace

SampledBody sampled(const Body& body) {
  struct Add {
    SampledBody& result;
    std::vector<Hit>& hits;
    void operator()(const CombinedEllipsoid& part) const { add_forms(result, part, hits); }
    void operator()(const HullBody& hull) const { add_hull(result, hull.points(), hits); }
    void operator()(const Convex& body) const { add_convex(result, body, hits); }
    void operator()(const std::vector<CombinedEllipsoid>& parts) const {
      for (const CombinedEllipsoid& part : parts) add_forms(result, part, hits);
    }
    void operator()(const Assembly& assembly) const {
      const Assembly::Storage& pieces = assembly.by_slot();
      for (const auto& corners : pieces.triangles) add_triangle(result, corners, hits);
      for (const Vector3d& center : pieces.balls) add_ball(result, center, assembly.radius(), hits);
      for (const Box& box : pieces.boxes) add_box(result, box, hits);
      for (const HullBody& hull : pieces.hulls) add_hull(result, hull.points(), hits);
      for (const Convex& body : pieces.convexes) add_convex(result, body, hits);
    }
  };
  SampledBody result{body, {}, {}, {}};
  std::vector<Hit> hits;
  std::visit(Add{result, hits}, body.shape());
  result.hit = any(std::move(hits));
  return result;
}

SampledPlaced stand(const SampledBody& body, const Pose& pose) {
  SampledPlaced result{{body.body, pose}, {}, {}, {}};
  for (const Ball& ball : body.cover)
    result.cover.push_back({pose.to_world(ball.center), ball.radius * (1 + 1e-9)});
  for (const Vector3d& x : body.inside) result.inside.push_back(pose.to_world(x));
  result.hit = [hit = body.hit, pose](const Vector3d& x, const Vector3d& d) {
    return hit(pose.to_body(x), pose.rotation.transpose() * d);
  };
  return result;
}

Swept sweep(const SampledPlaced& a, const SampledPlaced& b, const Vector3d& w) {
  const Vector3d d = w.normalized();
  bool near = false;
  for (const Ball& p : a.cover) {
    for (const Ball& q : b.cover) {
      const Vector3d y = q.center - p.center;
      const double along = std::max(0.0, y.dot(d)), reach = p.radius + q.radius;
      near = near || (y - along * d).squaredNorm() <= reach * reach;
    }
    if (near) break;
  }
  if (!near) return Swept::miss;
  for (const Vector3d& x : a.inside)
    if (b.hit(x, d)) return Swept::meet;
  for (const Vector3d& x : b.inside)
    if (a.hit(x, -d)) return Swept::meet;
  return Swept::unclear;
}

}  // namespace vericone::testing
