// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/combined/edge.h>

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace vericone {
namespace {

using Eigen::Vector3d;

constexpr int kMostTouched = 3;

/// The surfaces of a body that are touched, and the multipliers of their gradients.
struct Touched {
  int count = 0;
  std::array<int, kMostTouched> surface{};
  std::array<double, kMostTouched> weight{};

  bool has(int i) const {
    return std::find(surface.begin(), surface.begin() + count, i) != surface.begin() + count;
  }
  void add(int i) {
    surface[count] = i;
    weight[count++] = 0;
  }
  void drop(int at) {
    for (int k = at; k + 1 < count; ++k) {
      surface[k] = surface[k + 1];
      weight[k] = weight[k + 1];
    }
    --count;
  }
};

}  // namespace

/// The unknowns are the point of A, the angle, the way, the tilt of the normal m = d' + tilt p out of the
/// plane, and the multipliers. With b = a + way d - c: sum lambda_i M_i a = -m, sum mu_j M_j b = m, and every
/// touched surface is met.
class EdgeSearch {
 public:
  EdgeSearch(const CombinedEdges& bodies, const Vector3d& u, const Vector3d& side)
      : a_(bodies.a_), b_(bodies.b_), c_(bodies.c_), u_(u), side_(side), p_(u.cross(side)) {}

  bool run(const CombinedEdge& start, double distance) {
    point_a_ = start.on_a / distance;
    point_b_ = start.on_b / distance;
    const Vector3d apart = c_ + point_b_ - point_a_;
    angle_ = std::atan2(apart.dot(side_), apart.dot(u_));
    way_ = apart.norm();
    if (take(touched_a_, start.touched_a, a_) && take(touched_b_, start.touched_b, b_)) {
      if (first_multipliers() && settle()) return true;
      // Another surface has come into play.
      point_a_ = start.on_a / distance;
      point_b_ = start.on_b / distance;
    }
    return approach(1e-3) && guess_touched() && settle();
  }

  bool reach(const CombinedEdge& start, double distance) {
    point_a_ = start.on_a / distance;
    point_b_ = start.on_b / distance;
    return approach(1e-5) && angle_ > 0 && angle_ < 3.1;
  }

  CombinedEdge points(double distance) const {
    CombinedEdge edge;
    edge.angle = angle_;
    edge.on_a = distance * point_a_;
    edge.on_b = distance * point_b_;
    return edge;
  }

  CombinedEdge result(double distance) const {
    CombinedEdge edge = points(distance);
    const double size = normal().norm();
    edge.normal = -normal() / size;
    const auto put = [&](const Touched& from, TouchedSurfaces& to) {
      to.count = from.count;
      for (int k = 0; k < from.count; ++k) {
        to.surface[k] = from.surface[k];
        to.weight[k] = from.weight[k] * distance / size;
      }
    };
    put(touched_a_, edge.touched_a);
    put(touched_b_, edge.touched_b);
    return edge;
  }

 private:
  using Body = CombinedEdges::Body;
  static constexpr int kMost = 6 + 2 * kMostTouched;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost, kMost>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost, 1>;

  Vector3d along() const { return std::cos(angle_) * u_ + std::sin(angle_) * side_; }
  Vector3d across() const { return -std::sin(angle_) * u_ + std::cos(angle_) * side_; }
  Vector3d normal() const { return across() + tilt_ * p_; }

  /// Whether it says what is touched, and the body has that.
  static bool take(Touched& touched, const TouchedSurfaces& from, const Body& body) {
    touched.count = 0;
    if (from.count < 1 || from.count > kMostTouched) return false;
    for (int k = 0; k < from.count; ++k) {
      if (from.surface[k] < 0 || static_cast<std::size_t>(from.surface[k]) >= body.matrix.size())
        return false;
      touched.add(from.surface[k]);
    }
    return true;
  }

  static double value(const Body& body, int i, const Vector3d& y) {
    return (y.dot(body.matrix[i] * y) - body.level[i]) / scale(body, i, y);
  }
  static double scale(const Body& body, int i, const Vector3d& y) {
    return std::max(body.level[i], 1e-3 * body.matrix[i].norm() * y.squaredNorm());
  }

  /// Multipliers and tilt that fit the points best.
  bool first_multipliers() {
    const int n = touched_a_.count + touched_b_.count + 1;
    Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 2 * kMostTouched + 1> columns(6, n);
    columns.setZero();
    for (int k = 0; k < touched_a_.count; ++k)
      columns.col(k).head<3>() = a_.matrix[touched_a_.surface[k]] * point_a_;
    for (int k = 0; k < touched_b_.count; ++k)
      columns.col(touched_a_.count + k).tail<3>() = b_.matrix[touched_b_.surface[k]] * point_b_;
    columns.col(n - 1).head<3>() = p_;
    columns.col(n - 1).tail<3>() = -p_;
    Eigen::Matrix<double, 6, 1> right;
    right << -across(), across();
    Matrix normal_matrix = columns.transpose() * columns;
    for (int k = 0; k < n; ++k) normal_matrix(k, k) *= 1 + 1e-10;
    Vector weights = columns.transpose() * right;
    solve_square(normal_matrix, weights);
    if (!weights.allFinite()) return false;
    for (int k = 0; k < touched_a_.count; ++k) touched_a_.weight[k] = weights(k);
    for (int k = 0; k < touched_b_.count; ++k) touched_b_.weight[k] = weights(touched_a_.count + k);
    tilt_ = weights(n - 1);
    return true;
  }

  /// Those nearest to the points; of them the ones with positive multipliers.
  bool guess_touched() {
    const auto nearest = [](const Body& body, const Vector3d& y, Touched& touched) {
      touched.count = 0;
      for (int k = 0; k < kMostTouched; ++k) {
        int best = -1;
        double most = -0.3;
        for (int i = 0; i < static_cast<int>(body.level.size()); ++i)
          if (!touched.has(i) && value(body, i, y) > most) {
            most = value(body, i, y);
            best = i;
          }
        if (best < 0) break;
        touched.add(best);
      }
      if (touched.count == 0) touched.add(0);
    };
    nearest(a_, point_a_, touched_a_);
    nearest(b_, point_b_, touched_b_);
    for (;;) {
      if (!first_multipliers()) return false;
      if (!drop_negative()) return true;
    }
  }

  /// Newton's method, with the surfaces touched changed until they are right.
  bool settle() {
    for (int round = 0; round < 8; ++round) {
      if (!newton()) return false;
      if (!change_touched()) return valid();
    }
    return false;
  }

  /// From points near the edge to points of the bodies in contact nearly on the largest angle: whether there
  /// is a contact along a direction is tried by steps from the last one found.
  bool approach(double fine) {
    const Vector3d apart = c_ + point_b_ - point_a_;
    double in = std::atan2(apart.dot(side_), apart.dot(u_));
    way_ = apart.norm();
    double step = 4e-3;
    for (int k = 0; !meet(in); ++k, step *= 2) {
      if (k == 8) return false;
      in -= step;
    }
    double out = in + step;
    for (int k = 0; k < 8 && meet(out); ++k, step *= 2) {
      in = out;
      out = in + step;
    }
    while (out - in > fine) {
      const double middle = 0.5 * (in + out);
      (meet(middle) ? in : out) = middle;
    }
    angle_ = in;
    return true;
  }

  /// Steps against what is violated most, from the point of A and the way at hand; kept where they end in a
  /// contact.
  bool meet(double angle) {
    const Vector3d d = std::cos(angle) * u_ + std::sin(angle) * side_;
    Vector3d on_a = point_a_;
    double way = way_;
    for (int step = 0; step < 40; ++step) {
      const Vector3d on_b = on_a + way * d - c_;
      double worst = 1e-6;
      const Body* of = nullptr;
      int which = 0;
      for (const Body* body : {&a_, &b_})
        for (int i = 0; i < static_cast<int>(body->level.size()); ++i) {
          const double v = value(*body, i, body == &a_ ? on_a : on_b);
          if (v <= worst) continue;
          worst = v;
          of = body;
          which = i;
        }
      if (!of) {
        point_a_ = on_a;
        point_b_ = on_b;
        way_ = way;
        return way > 0;
      }
      const Vector3d& y = of == &a_ ? on_a : on_b;
      const Vector3d gradient = 2 * (of->matrix[which] * y);
      const double over = 1.1 * worst * scale(*of, which, y), along = of == &a_ ? 0 : gradient.dot(d),
                   square = gradient.squaredNorm() + along * along;
      if (!(square > 0)) return false;
      on_a -= over / square * gradient;
      way -= over / square * along;
    }
    return false;
  }

  /// Whether the worst multiplier was negative; a last one stays.
  bool drop_negative() {
    double least = -1e-9;
    Touched* of = nullptr;
    int at = 0;
    for (Touched* t : {&touched_a_, &touched_b_})
      for (int k = 0; k < t->count; ++k) {
        const double size = (t == &touched_a_ ? a_ : b_).matrix[t->surface[k]].norm() * t->weight[k];
        if (t->count > 1 && size < least) {
          least = size;
          of = t;
          at = k;
        }
      }
    if (!of) return false;
    of->drop(at);
    return true;
  }

  bool newton() {
    const int na = touched_a_.count, nb = touched_b_.count, n = 6 + na + nb;
    Matrix jacobian(n, n);
    Vector residual(n);
    for (int step = 0; step < 12; ++step) {
      jacobian.setZero();
      const Vector3d d = along(), e = across(), m = normal();
      point_b_ = point_a_ + way_ * d - c_;
      // Columns: a, angle, way, tilt, lambda, mu. The point of B follows from the first five.
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (int k = 0; k < na; ++k) {
        const Eigen::Matrix3d& q = a_.matrix[touched_a_.surface[k]];
        const Vector3d image = q * point_a_;
        sum += touched_a_.weight[k] * q;
        jacobian.block<3, 1>(0, 6 + k) = image;
        jacobian.block<1, 3>(6 + k, 0) = 2 * image.transpose();
        residual(6 + k) = point_a_.dot(image) - a_.level[touched_a_.surface[k]];
      }
      residual.head<3>() = sum * point_a_ + m;
      jacobian.block<3, 3>(0, 0) = sum;
      jacobian.block<3, 1>(0, 3) = -d;
      jacobian.block<3, 1>(0, 5) = p_;
      sum.setZero();
      for (int k = 0; k < nb; ++k) {
        const Eigen::Matrix3d& q = b_.matrix[touched_b_.surface[k]];
        const Vector3d image = q * point_b_;
        const int row = 6 + na + k;
        sum += touched_b_.weight[k] * q;
        jacobian.block<3, 1>(3, row) = image;
        jacobian.block<1, 3>(row, 0) = 2 * image.transpose();
        jacobian(row, 3) = 2 * way_ * image.dot(e);
        jacobian(row, 4) = 2 * image.dot(d);
        residual(row) = point_b_.dot(image) - b_.level[touched_b_.surface[k]];
      }
      residual.segment<3>(3) = sum * point_b_ - m;
      jacobian.block<3, 3>(3, 0) = sum;
      jacobian.block<3, 1>(3, 3) = way_ * (sum * e) + d;
      jacobian.block<3, 1>(3, 4) = sum * d;
      jacobian.block<3, 1>(3, 5) = -p_;
      Vector change = -residual;
      solve_square(jacobian, change);
      if (!change.allFinite()) return false;
      const double size = change.head<5>().cwiseAbs().maxCoeff();
      const double share = std::min(1.0, 0.3 / size);
      if (step > 8 && size > 0.1) return false;
      point_a_ += share * change.head<3>();
      angle_ += share * change(3);
      way_ += share * change(4);
      tilt_ += share * change(5);
      for (int k = 0; k < na; ++k) touched_a_.weight[k] += share * change(6 + k);
      for (int k = 0; k < nb; ++k) touched_b_.weight[k] += share * change(6 + na + k);
      if (size < 1e-9) {  // Newton squares the last step
        point_b_ = point_a_ + way_ * along() - c_;
        return true;
      }
    }
    return false;
  }

  /// Drops a surface that is pulled at, or adds the one that is violated most; false where neither is.
  bool change_touched() {
    if (drop_negative()) return true;
    double most = 1e-10;
    Touched* of = nullptr;
    int which = 0;
    const auto look = [&](const Body& body, const Vector3d& y, Touched& touched) {
      for (int i = 0; i < static_cast<int>(body.level.size()); ++i) {
        if (touched.has(i) || value(body, i, y) <= most) continue;
        most = value(body, i, y);
        of = &touched;
        which = i;
      }
    };
    look(a_, point_a_, touched_a_);
    look(b_, point_b_, touched_b_);
    if (!of) return false;
    if (of->count == kMostTouched) of->drop(0);
    of->add(which);
    return true;
  }

  bool valid() const {
    const auto positive = [](const Touched& t) {
      return std::all_of(t.weight.begin(), t.weight.begin() + t.count, [](double w) { return w > -1e-9; });
    };
    return way_ > 0 && angle_ > 0 && angle_ < 3.1 && positive(touched_a_) && positive(touched_b_);
  }

  const Body &a_, &b_;
  const Vector3d &c_, u_, side_;
  Vector3d p_, point_a_, point_b_;
  double angle_ = 0, way_ = 1, tilt_ = 0;
  Touched touched_a_, touched_b_;
};

CombinedEdges::CombinedEdges(const CombinedEllipsoid& a, const CombinedEllipsoid& b)
    : c_(b.center() - a.center()) {
  distance_ = c_.norm();
  if (!(distance_ > 0)) return;
  c_ /= distance_;
  const auto fill = [&](const CombinedEllipsoid& body, Body& into) {
    into.matrix.push_back(body.ellipsoid().shape().inverse() * (distance_ * distance_));
    into.level.push_back(1);
    for (const Delimiter<3>& d : body.delimiters()) {
      into.matrix.emplace_back(d.matrix * (distance_ * distance_));
      into.level.push_back(d.level);
    }
  };
  fill(a, a_);
  fill(b, b_);
}

std::optional<CombinedEdge> CombinedEdges::near(const Vector3d& u, const Vector3d& side,
                                                const CombinedEdge& start) const {
  if (!(distance_ > 0)) return std::nullopt;
  EdgeSearch search(*this, u, side);
  if (!search.run(start, distance_)) return std::nullopt;
  return search.result(distance_);
}

std::optional<CombinedEdge> CombinedEdges::reached(const Vector3d& u, const Vector3d& side,
                                                   const CombinedEdge& start) const {
  if (!(distance_ > 0)) return std::nullopt;
  EdgeSearch search(*this, u, side);
  if (!search.reach(start, distance_)) return std::nullopt;
  return search.points(distance_);
}

}  // namespace vericone
