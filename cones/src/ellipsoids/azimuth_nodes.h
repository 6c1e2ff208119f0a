// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone {

/// Where on the circle to sample a silhouette so that the trapezoidal rule
/// converges fast.
///
/// Uniform azimuths waste samples: where the normal sweeps across the thin
/// direction of a body its point of tangency runs along the body's flat side
/// within a small angle. In the coordinates that make a body round its tangency
/// point moves evenly, so each body X has its own best angle theta_X(t), the
/// azimuth of L_X e(t) with L_X^2 the body's shape in the plane of e. Nodes are
/// placed evenly in s = (theta_A + theta_B) / 2, which is an analytic change of
/// variable of the circle and keeps the rule's convergence faster than any
/// power. Where neither angle moves, neither point of tangency does, so t itself
/// needs no nodes. For semi-axes 1..10 it turns a worst relative error of 1e-4
/// at 96 samples into 1e-7 (docs/explanation/theory.md, 4). s(t + pi) = s(t) + pi: nodes
/// half a turn apart are opposite and weigh the same.
///
/// Two walks start from s = 0 in step, one forward and one backward; the latter
/// is a forward walk among the bodies mirrored. Their dependent chains of
/// operations fill each other's gaps.
class AzimuthNodes {
 public:
  /// One number for each walk, forward first.
  using Walks = Eigen::Array2d;

  AzimuthNodes() = default;

  /// Nodes at s = +-2 pi k / count. `shape_a`, `shape_b`: the bodies restricted
  /// to the plane of the azimuth.
  AzimuthNodes(const Eigen::Matrix2d& shape_a, const Eigen::Matrix2d& shape_b, int count)
      : a_(shape_a),
        b_(shape_b),
        ds_(2 * std::numbers::pi / count),
        turn_x_(std::cos(2 * ds_)),
        turn_y_(std::sin(2 * ds_)) {}

  struct Nodes {
    Walks x, y;    // unit vectors e at the azimuth t
    Walks weight;  // |dt / ds|
    // S e . e and S e . e' with S the bodies' shapes and e' = de / |dt|, to the
    // right of e for the walk backward
    Walks along_a, along_b, mixed_a, mixed_b;
  };

  /// The nodes of index k and -k; call with k = 0, 1, ... in order, each starts
  /// from the one before.
  Nodes at(int k) {
    constexpr int kExact = 16;  // steps of the recurrence for the target before it is set afresh
    if (k % kExact == 0) {
      target_x_ = std::cos(2 * ds_ * k);
      target_y_ = std::sin(2 * ds_ * k);
    } else {
      const double x = target_x_;
      target_x_ = x * turn_x_ - target_y_ * turn_y_;
      target_y_ = x * turn_y_ + target_y_ * turn_x_;
    }
    const Walks x = x_, y = y_, ax = a_.x, ay = a_.y, bx = b_.x, by = b_.y, weight = weight_, bend = bend_;
    if (k == 0) {
      turn_ = 0;
    } else if (k == 1) {
      turn_ = ds_ * (weight + (0.5 * ds_) * bend);
    } else {
      // Quintic through the last two nodes and their first and second
      // derivatives.
      turn_ = 31 * turn_ - ds_ * (16 * weight + 14 * weight_before_) +
              (ds_ * ds_) * (4 * bend - 2 * bend_before_);
    }
    weight_before_ = weight;
    bend_before_ = bend;
    turn_ = turn_.max(0.0).min(3 * ds_ * weight);
    advance(turn_);
    Walks room = Walks::Constant(newton() ? 0 : -1);
    if (k > 0) {
      // The product of the two complex numbers fixes s only up to half a turn. On the right branch both
      // angles went forward by at most 2 ds, and the azimuth by less than half a turn; for count > 4 no other
      // branch can do that.
      room = room.min(forward(ax, ay, a_.x, a_.y)).min(forward(bx, by, b_.x, b_.y));
      room = room.min(turn_ + 1e-9).min(std::numbers::pi - turn_);
      if (ds_ > std::numbers::pi / 2 - 1e-9) room = -1;
    }
    if (!(room.minCoeff() >= 0)) {
      bisect(ds_ * k);
      for (int i = 0; i < 2; ++i)
        turn_(i) = std::atan2(x(i) * y_(i) - y(i) * x_(i), x(i) * x_(i) + y(i) * y_(i));
    }
    return {x_, Walks(y_(0), -y_(1)), weight_, a_.square, b_.square, a_.mixed, b_.mixed};
  }

 private:
  /// L e of a body, L L = S.
  struct Body {
    Walks xx = Walks::Ones(), xy = Walks::Zero(), yy = Walks::Ones();  // L
    double determinant = 1;
    Walks x = Walks::Ones(), y = Walks::Zero();  // L e
    Walks square = Walks::Ones(),
          mixed = Walks::Zero();  // L e . L e, L e . L e'

    Body() = default;
    explicit Body(const Eigen::Matrix2d& shape) {
      const double root = std::sqrt(std::max(shape.determinant(), 0.0));
      const Eigen::Matrix2d l =
          (shape + root * Eigen::Matrix2d::Identity()) / std::sqrt(shape.trace() + 2 * root);
      xx = l(0, 0);
      xy = Walks(l(0, 1), -l(0, 1));
      yy = l(1, 1);
      determinant = l.determinant();
    }

    void set(const Walks& ex, const Walks& ey) {
      x = xx * ex + xy * ey;
      y = xy * ex + yy * ey;
      square = x.square() + y.square();
      mixed = x * (xy * ex - xx * ey) + y * (yy * ex - xy * ey);
    }
  };

  /// What follows from e.
  void evaluate() {
    a_.set(x_, y_);
    b_.set(x_, y_);
    // ds/dt = (det L_A / |L_A e|^2 + det L_B / |L_B e|^2) / 2
    const Walks over_a = a_.square.inverse(), over_b = b_.square.inverse();
    const Walks rate_a = a_.determinant * over_a, rate_b = b_.determinant * over_b;
    weight_ = 2 / (rate_a + rate_b);
    bend_ = weight_ * weight_.square() * (rate_a * over_a * a_.mixed + rate_b * over_b * b_.mixed);
  }

  bool newton() {
    for (int iteration = 0; iteration < 12; ++iteration) {
      evaluate();
      // Angles add up in a product of complex numbers: L_A e . L_B e has the argument 2 s(t).
      const Walks px = a_.x * b_.x - a_.y * b_.y, py = a_.x * b_.y + a_.y * b_.x;
      const Walks sine = py * target_x_ - px * target_y_, cosine = px * target_x_ + py * target_y_;
      const Walks x = sine / cosine, x2 = x.square();
      const double largest = x2.maxCoeff();
      if (largest < 0.01 && cosine.minCoeff() > 0) {
        const Walks back = x * (x2 * (1.0 / 6 - x2 * (1.0 / 10)) - 1.0 / 2);  // of s: -atan(x) / 2
        // Of second order, so the error left is of the third.
        const Walks step = back * (weight_ + 0.5 * back * bend_);
        turn_ += step;
        advance(step);
        if (largest < 1.6e-11) {
          evaluate();
          return true;
        }
      } else {
        Walks step;
        for (int i = 0; i < 2; ++i) step(i) = -std::atan2(sine(i), cosine(i)) / 2 * weight_(i);
        turn_ += step;
        advance(step);
      }
    }
    return false;
  }

  /// Not negative where `to` is ahead of `from` by an angle from 0 to 2 ds.
  Walks forward(const Walks& from_x, const Walks& from_y, const Walks& to_x, const Walks& to_y) const {
    const Walks end_x = from_x * turn_x_ - from_y * turn_y_, end_y = from_x * turn_y_ + from_y * turn_x_;
    const Walks cross = from_x * to_y - from_y * to_x, dot = from_x * to_x + from_y * to_y;
    return cross.min(to_x * end_y - to_y * end_x) + 1e-9 * (cross.abs() + dot.abs());
  }

  /// s(t) - t stays within pi / 2, so the root is bracketed from the start.
  void bisect(double s) {
    Walks lo = Walks::Constant(s - std::numbers::pi / 2), hi = Walks::Constant(s + std::numbers::pi / 2);
    Walks t = Walks::Constant(s);
    const auto angle = [this](const Body& body, int i) {
      return std::atan2(x_(i) * body.y(i) - y_(i) * body.x(i), x_(i) * body.x(i) + y_(i) * body.y(i));
    };
    for (int iteration = 0; iteration < 200; ++iteration) {
      x_ = t.cos();
      y_ = t.sin();
      evaluate();
      bool settled = true;
      for (int i = 0; i < 2; ++i) {
        const double value = t(i) + (angle(a_, i) + angle(b_, i)) / 2;
        (value < s ? lo : hi)(i) = t(i);
        double next = t(i) + (s - value) * weight_(i);
        if (!(next > lo(i) && next < hi(i))) next = 0.5 * (lo(i) + hi(i));
        if (std::abs(next - t(i)) < 1e-15 * (1 + std::abs(t(i)))) continue;
        t(i) = next;
        settled = false;
      }
      if (settled) break;
    }
  }

  /// Turns e. The polynomials need be good to 1e-8 only: the length is
  /// corrected to second order, and the angle is whatever Newton then finds it
  /// to be.
  void advance(const Walks& turn) {
    const Walks turn2 = turn.square();
    const double largest = turn2.maxCoeff();
    Walks c, s;
    if (largest < 1e-4) {
      c = 1 - 0.5 * turn2;
      s = turn * (1 - turn2 * (1.0 / 6));
    } else if (largest < 0.25) {
      c = 1 - turn2 * (1.0 / 2 - turn2 * (1.0 / 24 - turn2 * (1.0 / 720 - turn2 * (1.0 / 40320))));
      s = turn * (1 - turn2 * (1.0 / 6 - turn2 * (1.0 / 120 - turn2 * (1.0 / 5040))));
    } else {
      c = turn.cos();
      s = turn.sin();
    }
    const Walks x = c * x_ - s * y_, y = s * x_ + c * y_;
    const Walks unit = 1.5 - 0.5 * (x.square() + y.square());
    x_ = unit * x;
    y_ = unit * y;
  }

  Body a_, b_;
  double ds_ = 1, turn_x_ = 1, turn_y_ = 0;  // step in s; (cos, sin) of 2 ds
  double target_x_ = 1, target_y_ = 0;       // (cos, sin) of 2 s
  Walks x_ = Walks::Ones(), y_ = Walks::Zero();
  Walks weight_ = Walks::Ones(),
        bend_ = Walks::Zero();  // |dt/ds| and d|dt/ds|/ds
  Walks weight_before_ = Walks::Ones(), bend_before_ = Walks::Zero();
  Walks turn_ = Walks::Zero();  // azimuth from the node before to this one
};

}  // namespace vericone
