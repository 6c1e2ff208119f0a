// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/pursuit/pursuit_law.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/geometry/decompositions.h>
#include <cmath>
#include <numbers>
#include <string>

namespace vericone::guidance {
namespace {

using Eigen::Index, Eigen::Matrix2d, Eigen::Matrix2Xd, Eigen::Vector2d;

constexpr double kTolerance = 1e-11;
/// Weights below this are rounding: their points only happen to be near the ellipse.
constexpr double kLeastWeight = 1e-7;
constexpr double kCircle = 1e-9;

/// The points that hold the ellipse: about their weighted mean, with their weights.
struct Holders {
  Matrix2Xd y, v;
  Eigen::VectorXd u;
  Vector2d mean = Vector2d::Zero();
  Matrix2d covariance = Matrix2d::Zero();

  Holders(const Eigen::Ref<const Matrix2Xd>& points, const Eigen::Ref<const Matrix2Xd>& velocities) {
    MinVolumeOptions options;
    options.tolerance = kTolerance;
    options.certified = false;
    const MinVolumeResult<2> found = min_volume_ellipsoid<2>(points, options);
    std::vector<std::size_t> kept;
    double sum = 0;
    for (std::size_t k = 0; k < found.support.size(); ++k)
      if (found.weights[k] > kLeastWeight) {
        kept.push_back(k);
        sum += found.weights[k];
      }
    const Index m = std::ssize(kept);
    y.resize(2, m);
    v.resize(2, m);
    u.resize(m);
    for (Index i = 0; i < m; ++i) {
      const std::size_t k = kept[static_cast<std::size_t>(i)];
      y.col(i) = points.col(found.support[k]);
      v.col(i) = velocities.col(found.support[k]);
      u(i) = found.weights[k] / sum;
      mean += u(i) * y.col(i);
    }
    for (Index i = 0; i < m; ++i) {
      y.col(i) -= mean;
      covariance += u(i) * y.col(i) * y.col(i).transpose();
    }
  }
};

struct Rates {
  Vector2d mean = Vector2d::Zero();
  Matrix2d covariance = Matrix2d::Zero();
};

/// At the optimum g_i = 1 + y_i' C^-1 y_i = 3 for every point that holds the ellipse. Differentiated along
/// the velocities, with s_ij = y_i' C^-1 y_j:
///   sum_j u_j' (1 + s_ij)^2 = 2 v_i' C^-1 y_i - 2 sum_j u_j (1 + s_ij) y_i' C^-1 v_j.
/// More than five points can share the weights in several ways; the shortest u' will do, as all give the same
/// ellipse.
Rates rates_of(const Holders& h) {
  const Index m = h.u.size();
  const Matrix2d inverse = cholesky<2>(h.covariance).inverse();
  Eigen::MatrixXd squares(m, m);
  Eigen::VectorXd right(m);
  for (Index i = 0; i < m; ++i) {
    const Vector2d whitened = inverse * h.y.col(i);
    right(i) = 2 * h.v.col(i).dot(whitened);
    for (Index j = 0; j < m; ++j) {
      const double s = 1 + whitened.dot(h.y.col(j));
      squares(i, j) = s * s;
      right(i) -= 2 * h.u(j) * s * whitened.dot(h.v.col(j));
    }
  }
  const Eigen::VectorXd change = shortest_least_squares(squares, right);
  Rates rates;
  for (Index i = 0; i < m; ++i) {
    const Vector2d y = h.y.col(i), v = h.v.col(i);
    rates.mean += change(i) * y + h.u(i) * v;
    rates.covariance += change(i) * (y * y.transpose()) + h.u(i) * (v * y.transpose() + y * v.transpose());
  }
  return rates;
}

Vector2d at_angle(double angle) { return {std::cos(angle), std::sin(angle)}; }

void require_finite(const Eigen::Ref<const Matrix2Xd>& velocities, Index count) {
  if (velocities.cols() != count)
    throw InputError("velocities", std::to_string(velocities.cols()), "one for each point");
  for (Index i = 0; i < count; ++i)
    for (int k = 0; k < 2; ++k)
      if (!std::isfinite(velocities(k, i)))
        throw InputError("velocities[" + std::to_string(i) + "]", to_text(velocities(k, i)),
                         "a finite number (m/s)");
}

}  // namespace

double EnclosingEllipse::reach(const Vector2d& n) const {
  const Vector2d axis = at_angle(angle);
  return std::hypot(a * axis.dot(n), b * (axis.x() * n.y() - axis.y() * n.x()));
}

EnclosingEllipse enclosing_ellipse(const Eigen::Ref<const Matrix2Xd>& points,
                                   const Eigen::Ref<const Matrix2Xd>& velocities, double near) {
  require_finite(velocities, points.cols());
  const Holders holders(points, velocities);
  const Rates rates = rates_of(holders);
  // (4.3) with d = 2: (x - c)' (2 C)^-1 (x - c) <= 1.
  const Matrix2d &c = holders.covariance, &c_rate = rates.covariance;
  const double middle = 0.5 * (c(0, 0) + c(1, 1)), difference = 0.5 * (c(0, 0) - c(1, 1));
  const double half = std::hypot(difference, c(0, 1));
  EnclosingEllipse e;
  e.centre = holders.mean;
  e.centre_rate = rates.mean;
  e.circle = half <= kCircle * middle;
  if (e.circle) {
    e.angle = near;
    e.a = e.b = std::sqrt(2 * middle);
    e.a_rate = e.b_rate = 0.5 * c_rate.trace() / e.a;
    e.foci = {e.centre, e.centre};
    e.foci_rates = {e.centre_rate, e.centre_rate};
    return e;
  }
  const double angle = 0.5 * std::atan2(c(0, 1), difference);
  e.angle = near + std::remainder(angle - near, std::numbers::pi);
  const Vector2d major = at_angle(e.angle), minor(-major.y(), major.x());
  e.a = std::sqrt(2 * (middle + half));
  e.b = std::sqrt(2 * (middle - half));
  const double major_rate = major.dot(c_rate * major), minor_rate = minor.dot(c_rate * minor);
  e.a_rate = major_rate / e.a;
  e.b_rate = minor_rate / e.b;
  e.angle_rate = major.dot(c_rate * minor) / (2 * half);
  const double focal = 2 * std::sqrt(half), focal_rate = (major_rate - minor_rate) / focal;
  const Vector2d to_focus = focal * major, change = focal_rate * major + focal * e.angle_rate * minor;
  e.foci = {e.centre + to_focus, e.centre - to_focus};
  e.foci_rates = {e.centre_rate + change, e.centre_rate - change};
  return e;
}

// A first axis along x or y is far from where its label would jump.
EllipseFollower::EllipseFollower(double side) : side_(side) { ellipse_.angle = std::numbers::pi / 4; }

const EnclosingEllipse& EllipseFollower::step(std::span<const Vector2d> centres,
                                              std::span<const Vector2d> velocities) {
  if (centres.empty()) throw InputError("centres", "0", "at least one vehicle");
  if (velocities.size() != centres.size())
    throw InputError("velocities", std::to_string(velocities.size()), "one for each vehicle");
  Matrix2Xd points(2, 4 * std::ssize(centres)), rates(2, points.cols());
  Index k = 0;
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        points.col(k) = centres[i] + side_ * Vector2d(x, y);
        rates.col(k++) = velocities[i];
      }
  ellipse_ = enclosing_ellipse(points, rates, ellipse_.angle);
  return ellipse_;
}

}  // namespace vericone::guidance
