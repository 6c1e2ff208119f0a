// SPDX-License-Identifier: BSD-3-Clause
//
// That every error collides: no normal parts the bodies for any of them. All normals are those of eight
// octants; in a part of one of them, with corners n1, n2, n3, a time and a point of each body prove it where
// n.(b - a - t w) + h_P(n) + t h_W(n) < 0 at the three corners, as that is convex in n
// (docs/explanation/robust-cone.md).
#include <vericone/geometry/interval.h>
#include <array>
#include <cmath>
#include <optional>

#include "answers/interval_vector.h"
#include "certificate/errors/prove_errors.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

/// A checker may take for the reach of errors what is above it by a part in 10^9.
constexpr double kReachedMore = 1 + 0x1p-29;

IntervalVector3 exactly(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Of a reach, not below it.
Interval above(const StatedErrors& set, const Vector3d& n) {
  if (set.none()) return 0;
  const Rational most = set.most(fractions(n));
  const double near = static_cast<double>(most);
  return Interval(near * kReachedMore, std::abs(near) * 0x1p-40);
}

/// A body, of one convex piece, as points of it are looked for.
class Side {
 public:
  explicit Side(const Stated& body)
      : piece_(body.piece(0)),
        at_(body.at()),
        grid_(std::min({piece_.grid(), grid_of(at_), 0})),
        convex_(piece_.on(grid_, at_)) {}

  [[nodiscard]] bool is_convex() const { return !piece_.delimited(); }
  [[nodiscard]] double size() const { return piece_.round() ? piece_.round()->factor().norm() : 1; }

  /// The farthest along n, rounded; of corners which.
  [[nodiscard]] Vector3d farthest(const Vector3d& n, std::size_t& corner) const {
    if (const Ellipsoid* body = piece_.round()) {
      const Vector3d u = body->factor().transpose() * n;
      return at_ + body->center() + body->factor() * (u / u.norm());
    }
    corner = 0;
    for (std::size_t i = 1; i < piece_.corners.size(); ++i)
      if (n.dot(piece_.corners[i]) > n.dot(piece_.corners[corner])) corner = i;
    return at_ + piece_.corners[corner];
  }

  /// Of a round body: near x, with few digits, and in it.
  [[nodiscard]] std::optional<Vector3d> near(const Vector3d& x, int bits) const {
    const Vector3d middle = at_ + piece_.round()->center();
    const int unit = log2_of(size()) - bits;
    Vector3d found = middle + (1 - std::ldexp(2.0, 1 - bits)) * (x - middle);
    found = (found.array() * std::ldexp(1.0, -unit)).round() * std::ldexp(1.0, unit);
    const int fine = std::min(grid_, grid_of(found) == kNoGrid ? grid_ : grid_of(found));
    const auto finer = static_cast<unsigned>(grid_ - fine);
    const Vector y = on_grid(found, fine) - (convex_.points.front() << finer);
    if (!convex_.round->holds(y, finer)) return std::nullopt;
    return found;
  }

  [[nodiscard]] bool is_round() const { return piece_.round() != nullptr; }
  /// Where a corner stands, exactly.
  [[nodiscard]] IntervalVector3 place(std::size_t corner) const {
    return {Interval(at_.x()) + Interval(piece_.corners[corner].x()),
            Interval(at_.y()) + Interval(piece_.corners[corner].y()),
            Interval(at_.z()) + Interval(piece_.corners[corner].z())};
  }

 private:
  Piece piece_;
  Vector3d at_;
  int grid_;
  Convex convex_;
};

/// A point of a body as the file has it.
struct Member {
  IntervalVector3 place;
  std::optional<std::size_t> corner;
  Vector3d point;
};

struct Normal {
  Vector3d n;                          // whole numbers
  Interval position, velocity, along;  // h_P(n), h_W(n), n.w
};

class Octants {
 public:
  explicit Octants(const UncertainQuestion& question)
      : question_(question), a_(question.agent), b_(question.obstacle) {
    for (int i = 0; i < 3; ++i) w_[i] = Interval(question.v_a(i)) - Interval(question.v_b(i));
  }

  bool run(Text& proof) {
    if (!a_.is_convex() || !b_.is_convex()) return false;
    const char* between = "{\"rule\": \"octants\", \"nodes\": [";
    for (int bits = 0; bits < 8; ++bits) {
      const auto corner = [&](int axis) {
        return normal((bits >> axis & 1 ? -1.0 : 1.0) * Vector3d::Unit(axis));
      };
      proof.raw(between);
      if (!node({corner(0), corner(1), corner(2)}, 0, proof)) return false;
      between = ", ";
    }
    proof.raw("]}");
    return true;
  }

 private:
  using Corners = std::array<Normal, 3>;
  static constexpr int kDeepest = 20, kMostNodes = 6000;

  [[nodiscard]] Normal normal(const Vector3d& n) const {
    return {n, above(question_.position, n), above(question_.velocity, n), dot(exactly(n), w_)};
  }

  bool node(const Corners& c, int depth, Text& proof) {
    if (++nodes_ > kMostNodes) return false;
    if (leaf(c, proof)) return true;
    if (depth == kDeepest) return false;
    const Normal m12 = normal(c[0].n + c[1].n), m23 = normal(c[1].n + c[2].n), m31 = normal(c[2].n + c[0].n);
    const char* between = "[";
    for (const Corners& part : {Corners{c[0], m12, m31}, Corners{m12, c[1], m23}, Corners{m31, m23, c[2]},
                                Corners{m12, m23, m31}}) {
      proof.raw(between);
      if (!node(part, depth + 1, proof)) return false;
      between = ", ";
    }
    proof.raw("]");
    return true;
  }

  /// The gap at the corner, of the points a and b, now and what it gains a second.
  [[nodiscard]] static Interval now(const Normal& v, const IntervalVector3& a, const IntervalVector3& b) {
    const IntervalVector3 n = exactly(v.n);
    return dot(n, b) - dot(n, a) + v.position;
  }

  /// A time at which all corners' gaps are below zero; nothing where there is none.
  [[nodiscard]] std::optional<double> time(const Corners& c, const IntervalVector3& a,
                                           const IntervalVector3& b) const {
    double from = 0, to = question_.until;
    for (const Normal& v : c) {
      const double gap = now(v, a, b).hi(), late = (v.velocity - v.along).hi();
      if (late < 0)
        from = std::max(from, gap / -late);
      else if (late > 0)
        to = std::min(to, -gap / late);
      else if (!(gap < 0))
        return std::nullopt;
    }
    if (!(from < to || (from == 0 && to == 0))) return std::nullopt;
    if (from == 0 && ends_negative(c, a, b, 0)) return 0;
    double t = std::isinf(to) ? 2 * from + 1 : 0.5 * (from + to);
    // With few digits.
    for (const int bits : {3, 6, 10, 16, 24, 34}) {
      const int unit = log2_of(to - from < 1e300 ? std::max(to - from, 0x1p-60 * t) : t) - bits;
      const double rounded = std::ldexp(std::nearbyint(std::ldexp(t, -unit)), unit);
      if (from < rounded && rounded < to && rounded <= question_.until) {
        t = rounded;
        break;
      }
    }
    return t;
  }

  [[nodiscard]] bool ends_negative(const Corners& c, const IntervalVector3& a, const IntervalVector3& b,
                                   double t) const {
    for (const Normal& v : c)
      if (!(now(v, a, b) + Interval(t) * (v.velocity - v.along)).negative()) return false;
    return true;
  }

  [[nodiscard]] bool leaf(const Corners& c, Text& proof) const {
    const Vector3d middle = c[0].n + c[1].n + c[2].n;
    std::size_t corner_a = 0, corner_b = 0;
    const Vector3d a = a_.farthest(middle, corner_a), b = b_.farthest(-middle, corner_b);
    if (!time(c, exactly(a), exactly(b))) return false;
    const auto member = [](const Side& side, const Vector3d& x, std::size_t corner,
                           int bits) -> std::optional<Member> {
      if (!side.is_round()) return Member{side.place(corner), corner, x};
      const auto point = side.near(x, bits);
      if (!point) return std::nullopt;
      return Member{exactly(*point), std::nullopt, *point};
    };
    for (const int bits : {4, 8, 14, 22, 32, 44}) {
      const auto of_a = member(a_, a, corner_a, bits), of_b = member(b_, b, corner_b, bits);
      if (!of_a || !of_b) continue;
      const auto t = time(c, of_a->place, of_b->place);
      if (!t || !ends_negative(c, of_a->place, of_b->place, *t)) continue;
      proof.raw("[").number(*t);
      for (const auto& found : {of_a, of_b}) {
        proof.raw(", ");
        found->corner ? proof.index(*found->corner) : proof.number(found->point);
      }
      proof.raw("]");
      return true;
    }
    return false;
  }

  const UncertainQuestion& question_;
  Side a_, b_;
  IntervalVector3 w_;
  int nodes_ = 0;
};

}  // namespace

bool prove_all_in(const UncertainQuestion& question, Text& proof) {
  if (question.agent.size() != 1 || question.obstacle.size() != 1) return false;
  if (question.agent.piece(0).convex || question.obstacle.piece(0).convex) return false;
  return Octants(question).run(proof);
}

}  // namespace vericone::certificates
