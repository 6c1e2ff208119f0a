// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/opening/opening.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hulls/search.h"
#include "opening/outline.h"

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// What rounding may move, of the lengths and coordinates that it moves.
constexpr double kRounding = 1e-14;

/// A point of the body near a given one, and the unit vector from there to that; no vector where the point
/// is in the body to rounding.
struct Near {
  Vector3d point = Vector3d::Zero();
  std::optional<Vector3d> normal;
};

// Bodies, about a reference point within: nearest points as guesses, supports that hold.

class NearEllipsoid {
 public:
  explicit NearEllipsoid(const Ellipsoid& body) : body_(body) {
    const Matrix3d& f = body.factor();
    // Axes are the columns where they are orthogonal, as of bodies from axes.
    const Matrix3d gram = f.transpose() * f;
    const double skew = std::max({std::abs(gram(0, 1)), std::abs(gram(0, 2)), std::abs(gram(1, 2))});
    semi_ = f.colwise().norm();
    if (skew <= 1e-14 * gram.diagonal().minCoeff()) {
      for (int i = 0; i < 3; ++i) axes_.col(i) = f.col(i) / semi_(i);
    } else {
      semi_ = body.semi_axes();
      axes_ = body.axis_directions();
    }
    reach_ = f.norm() * (1 + kRounding);
    // F F^T is S to a few roundings of |S|.
    const double loss = body.defined_by_factor() ? 0 : kRounding * reach_;
    loss2_ = loss * reach_;
  }

  [[nodiscard]] const Vector3d& reference() const { return body_.center(); }
  /// Of the ball about the reference point that holds the body.
  [[nodiscard]] double reach() const {
    return std::sqrt(semi_.maxCoeff() * semi_.maxCoeff() + loss2_) * (1 + kRounding);
  }
  /// At least max n.(x - reference), to padding.
  [[nodiscard]] double support(const Vector3d& n) const {
    const double r = body_.radius(n);
    return loss2_ == 0 ? r : std::sqrt(r * r + loss2_);
  }

  /// With y = q - p along the axes: y_i s_i^2 / (t + s_i^2) for the t > 0 with sum (s_i y_i / (t + s_i^2))^2
  /// = 1, which Newton's method finds from the left.
  [[nodiscard]] Near near(const Vector3d& q) const {
    const Vector3d y = axes_.transpose() * q, z = y.cwiseProduct(semi_).cwiseAbs(), s2 = semi_.cwiseAbs2();
    if (y.cwiseQuotient(semi_).squaredNorm() <= 1) return {q, std::nullopt};
    double t = std::max(0.0, (z - s2).maxCoeff());
    for (int i = 0; i < 50; ++i) {
      double f = 0, slope = 0;
      for (int k = 0; k < 3; ++k) {
        const double over = 1 / (t + s2(k)), term = z(k) * over * z(k) * over;
        f += term;
        slope += 2 * term * over;
      }
      const double step = 2 * f * (std::sqrt(f) - 1) / slope;
      t += step;
      if (!(step > 1e-12 * t)) break;
    }
    const Vector3d n = (axes_ * y.cwiseQuotient((s2.array() + t).matrix())).normalized();
    const Vector3d u = body_.factor().transpose() * n;
    return {body_.factor() * (u / u.norm()), n};
  }

 private:
  const Ellipsoid& body_;
  Matrix3d axes_;
  Vector3d semi_;
  double reach_ = 0, loss2_ = 0;
};

/// The convex hull of two ellipsoids: all straight ways from one to the other.
class NearBetween {
 public:
  NearBetween(const Ellipsoid& from, const Ellipsoid& to)
      : ends_{&from, &to},
        middle_(from.translated(0.5 * (to.center() - from.center()))),
        shape_(middle_),
        inverse_(middle_.factor().inverse()) {
    for (int i = 0; i < 2; ++i) {
      center_[i] = ends_[i]->center() - reference();
      // What is defined by its shape has a factor that is right to rounding.
      loss2_ = std::max(loss2_, ends_[i]->defined_by_factor() ? 0 : kRounding * ends_[i]->shape().norm());
    }
  }

  [[nodiscard]] const Vector3d& reference() const { return middle_.center(); }
  [[nodiscard]] double reach() const {
    double most = 0;
    for (int i = 0; i < 2; ++i)
      most = std::max(most, center_[i].norm() + std::sqrt(ends_[i]->factor().squaredNorm() + loss2_));
    return most * (1 + kRounding);
  }
  [[nodiscard]] double support(const Vector3d& n) const {
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 2; ++i) {
      const double r = ends_[i]->radius(n);
      most = std::max(most, n.dot(center_[i]) + (loss2_ == 0 ? r : std::sqrt(r * r + loss2_)));
    }
    return most;
  }

  /// As if the first had been moved along the chord as it is: the normal is a guess, of which the bounds are
  /// made; the point is one of the hull, between the supports of both.
  [[nodiscard]] Near near(const Vector3d& q) const {
    const Vector3d chord = inverse_ * (center_[1] - center_[0]);
    const double length2 = chord.squaredNorm();
    double share = length2 > 0 ? std::clamp(chord.dot(inverse_ * (q - center_[0])) / length2, 0.0, 1.0) : 0.5;
    Near best;
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round) {
      const Vector3d center = center_[0] + share * (center_[1] - center_[0]);
      Vector3d n;
      if (const Near at = shape_.near(q - center); at.normal) {
        n = *at.normal;
      } else {
        // Whose points lie on straight ways from one end to the other.
        const Matrix3d within =
            (ends_[0]->factor() + share * (ends_[1]->factor() - ends_[0]->factor())).inverse();
        const Vector3d u = within * (q - center);
        if (!(u.squaredNorm() > 1)) return {q, std::nullopt};
        n = (within.transpose() * u).normalized();
      }
      const Vector3d x = center_[0] + tip(0, n), y = center_[1] + tip(1, n), way = y - x;
      const double along =
          way.squaredNorm() > 0 ? std::clamp((q - x).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
      const Vector3d point = x + along * way;
      if (const double distance = (q - point).norm(); distance < least) {
        least = distance;
        best = {point, n};
      }
      if (std::abs(along - share) < 1e-3) break;
      share = along;
    }
    return best;
  }

 private:
  [[nodiscard]] Vector3d tip(int i, const Vector3d& n) const {
    const Vector3d u = ends_[i]->factor().transpose() * n;
    return ends_[i]->factor() * (u / u.norm());
  }

  std::array<const Ellipsoid*, 2> ends_;
  Ellipsoid middle_;
  NearEllipsoid shape_;
  Matrix3d inverse_;
  std::array<Vector3d, 2> center_;
  double loss2_ = 0;
};

class NearHull {
 public:
  explicit NearHull(const WorldBody& body) : body_(body) {
    Vector3d low, high;
    for (int i = 0; i < 3; ++i) {
      high(i) = (*body_.support_point(Vector3d::Unit(i)))(i);
      low(i) = (*body_.support_point(-Vector3d::Unit(i)))(i);
    }
    middle_ = 0.5 * low + 0.5 * high;
    reach_ = (0.5 * high - 0.5 * low).norm() * (1 + kRounding);
  }

  [[nodiscard]] const Vector3d& reference() const { return middle_; }
  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] double support(const Vector3d& n) const { return n.dot(farthest(n)); }

  /// By Gilbert, Johnson and Keerthi.
  [[nodiscard]] Near near(const Vector3d& q) const {
    HullSimplex<3> simplex;
    simplex.add({}, farthest(q) - q);
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 100; ++step) {
      simplex.reduce();
      const double length2 = simplex.nearest.squaredNorm(), length = simplex.normal.norm();
      if (simplex.surrounds || !(length > 0)) return {q, std::nullopt};
      if (!(length2 < last)) break;
      last = length2;
      const Vector3d next = farthest(-simplex.normal) - q;
      // No point is nearer along the normal than the face: converged.
      if (!(simplex.normal.dot(simplex.z[0] - next) > 1e-12 * length * simplex.z[0].norm())) break;
      simplex.add({}, next);
    }
    return {q + simplex.nearest, -simplex.normal.normalized()};
  }

 private:
  [[nodiscard]] Vector3d farthest(const Vector3d& n) const { return *body_.support_point(n) - middle_; }

  const WorldBody& body_;
  Vector3d middle_;
  double reach_ = 0;
};

// Pieces of the rim: arcs of at most a quarter of the outline, and parts of edges. Both are the points
// center + axes x for x of an arc of the unit circle or of a segment.

struct Piece {
  double least;   // proved distance
  Vector2d from;  // points of the unit circle, counterclockwise; or of the edge, in the opening's plane
  Vector2d to;
  bool operator<(const Piece& other) const { return least > other.least; }  // the nearest first in a heap
};

/// The least of a.x over an arc of the unit circle or a segment.
double least_over(const Piece& piece, const Vector2d& a, bool arc) {
  const double ends = std::min(a.dot(piece.from), a.dot(piece.to));
  if (!arc) return ends;
  const auto cross = [](const Vector2d& x, const Vector2d& y) { return x.x() * y.y() - x.y() * y.x(); };
  // The least of the circle is at -a / |a|; within the arc, or so near to its end that it does not matter.
  const double length = a.norm(), margin = -1e-12 * length;
  return cross(piece.from, -a) >= margin && cross(-a, piece.to) >= margin && -a.dot(piece.from + piece.to) > 0
             ? -length
             : ends;
}

template <typename Body>
RimDistance search(const Body& body, const PlacedOpening& placed, const RimQuestion& question) {
  const Opening& opening = placed.opening;
  const bool arcs = !opening.polygonal();
  // Rim points about the body's reference point: origin + frame x.
  const Vector3d origin = placed.center - body.reference();
  Eigen::Matrix<double, 3, 2> frame = placed.axes;
  if (arcs)
    for (int i = 0; i < 2; ++i) frame.col(i) *= opening.semi_axes()(i);
  const double rim_reach = arcs ? frame.norm() : opening.reach() * frame.norm();
  const double padding =
      kRounding * (placed.center.norm() + body.reference().norm() + rim_reach + body.reach());
  RimDistance found;
  if (!std::isfinite(padding)) return found;

  const auto answered = [&] {
    if (found.points == 0) return false;
    return found.most - found.least <= std::max(question.tolerance * found.most, 4 * padding) ||
           (question.threshold >= 0 &&
            (found.least > question.threshold || found.most <= question.threshold));
  };
  const auto offer = [&](const Vector3d& on_rim, const Near& near) {
    const double distance = near.normal ? (on_rim - near.point).norm() * (1 + kRounding) + padding : padding;
    if (distance >= found.most) return;
    found.most = distance;
    found.rim = on_rim + body.reference();
    found.body = near.point + body.reference();
  };
  /// What a plane proves of a piece.
  const auto proved = [&](const Piece& piece, const Vector3d& n, double height) {
    return (height + least_over(piece, frame.transpose() * n, arcs)) * (1 - kRounding) - padding;
  };

  // The opening as a whole first: far from its plane, or beside the wall, that is enough.
  if (question.threshold >= 0) {
    const Near near = body.near(origin);
    if (near.normal) {
      const Vector3d& n = *near.normal;
      const double reach =
          arcs ? (frame.transpose() * n).norm() : opening.reach() * (frame.transpose() * n).norm();
      found.least = std::max(0.0, (n.dot(origin) - reach - body.support(n)) * (1 - kRounding) - padding);
      if (found.least > question.threshold) return found;
      found.least = 0;
    }
  }

  std::vector<Piece> heap;
  if (arcs) {
    heap.reserve(64);
    const std::array<Vector2d, 5> corner{Vector2d(1, 0), Vector2d(0, 1), Vector2d(-1, 0), Vector2d(0, -1),
                                         Vector2d(1, 0)};
    for (int i = 0; i < 4; ++i) heap.push_back({0, corner[i], corner[i + 1]});
  } else {
    // Edges by their distance from the ball about the body.
    const std::vector<Vector2d>& p = opening.vertices();
    heap.reserve(p.size() + 64);
    const Vector2d* a = &p.back();
    Vector3d start = origin + frame * *a;
    for (const Vector2d& b : p) {
      const Vector3d end = origin + frame * b;
      const double from_middle = nearest_on_segment<Vector3d>(start, end, Vector3d::Zero()).norm();
      heap.push_back({std::max(0.0, from_middle * (1 - kRounding) - body.reach() - padding), *a, b});
      a = &b;
      start = end;
    }
    std::make_heap(heap.begin(), heap.end());
  }
  while (found.points < question.most_points) {
    checkpoint();
    found.least = std::min(heap.front().least, found.most);
    if (answered()) break;
    std::pop_heap(heap.begin(), heap.end());
    const Piece piece = heap.back();
    heap.pop_back();
    const Vector2d sum = piece.from + piece.to,
                   middle = arcs ? Vector2d(sum.normalized()) : Vector2d(0.5 * sum);
    if (middle == piece.from || middle == piece.to) break;  // as far as doubles go
    const Vector3d q = origin + frame * middle;
    const Near near = body.near(q);
    ++found.points;
    offer(q, near);
    const double height = near.normal ? near.normal->dot(origin) - body.support(*near.normal) : 0;
    for (const Piece& part : {Piece{piece.least, piece.from, middle}, Piece{piece.least, middle, piece.to}}) {
      heap.push_back(part);
      if (near.normal) heap.back().least = std::max(part.least, proved(part, *near.normal, height));
      std::push_heap(heap.begin(), heap.end());
    }
    if (!near.normal) {
      found.least = 0;
      break;
    }
  }
  return found;
}

}  // namespace

RimDistance rim_distance(const Ellipsoid& body, const PlacedOpening& opening, const RimQuestion& question) {
  return search(NearEllipsoid(body), opening, question);
}

RimDistance rim_distance(const Ellipsoid& from, const Ellipsoid& to, const PlacedOpening& opening,
                         const RimQuestion& question) {
  return search(NearBetween(from, to), opening, question);
}

RimDistance rim_distance(const WorldBody& body, const PlacedOpening& opening, const RimQuestion& question) {
  if (body.quadric() && body.quadric()->is_ellipsoid())
    return rim_distance(body.quadric()->ellipsoid(), opening, question);
  if (const Placed* placed = body.placed();
      placed && placed->body.quadric() && placed->body.quadric()->is_ellipsoid())
    return rim_distance(in_world(placed->body.quadric()->ellipsoid(), placed->pose), opening, question);
  if (!body.support_point(Eigen::Vector3d::UnitX()))
    throw InputError("body", "one that is neither an ellipsoid nor a hull",
                     "an ellipsoid or a hull of points");
  return search(NearHull(body), opening, question);
}

}  // namespace vericone
