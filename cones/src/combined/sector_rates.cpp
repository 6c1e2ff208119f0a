// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/LU>
#include <string>

#include "planar/sector_parts.h"

namespace vericone {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// A body whose conics q_i(y, t) = y^T N_i y - level_i, y from the centre, change in axes that turn with it.
struct ChangingBody {
  const CombinedEllipse& body;
  const Matrix2d& shape_rate;
  const std::vector<DelimiterRate<2>>& rates;
  double omega;

  /// Half the gradient of conic i at y.
  Vector2d gradient(int i, const Vector2d& y) const {
    if (i > 0) return body.delimiters()[i - 1].matrix * y;
    const Matrix2d inverse = scaled_inverse<2>(body.ellipsoid().factor());
    return inverse.transpose() * (inverse * y);
  }

  /// Half the partial derivative of conic i by time. S^{-1} changes by -S^{-1} S' S^{-1}.
  double change(int i, const Vector2d& y) const {
    if (i == 0) {
      const Vector2d z = gradient(0, y);
      return -0.5 * z.dot(shape_rate * z);
    }
    if (static_cast<std::size_t>(i) > rates.size()) return 0;
    return 0.5 * (y.dot(rates[i - 1].matrix * y) - rates[i - 1].level);
  }

  /// n . (velocity of the touching point y) for the normal n, but for the motion of the centre. On an arc the
  /// envelope theorem leaves the motion of the boundary across itself; a corner stays on both its conics.
  double across(const Touch& touch, const Vector2d& y, const Vector2d& n) const {
    const double turning = omega * n.dot(Vector2d(-y.y(), y.x()));
    if (!touch.corner) {
      const Vector2d g = gradient(touch.first, y);
      return turning - change(touch.first, y) * n.dot(g) / g.squaredNorm();
    }
    if (touch.first == touch.second) return 0;  // the centre
    Matrix2d gradients;
    gradients << gradient(touch.first, y).transpose(), gradient(touch.second, y).transpose();
    const Vector2d changes(change(touch.first, y), change(touch.second, y));
    return turning - n.dot(gradients.inverse() * changes);
  }
};

void require_conics_of(const CombinedEllipse& body, const Touch& touch, const char* field) {
  for (const int conic : {touch.first, touch.second})
    if (conic < 0 || static_cast<std::size_t>(conic) > body.delimiters().size())
      throw InputError(field, "conic " + std::to_string(conic),
                       "of the body: 0 to " + std::to_string(body.delimiters().size()));
}

}  // namespace

// For an edge from p on A to q on B, q - p = kappa d, the inner normal n keeps n.(q - p) = 0; with the points
// moving as above, n.(q' - p') + n'.(q - p) = 0 gives the turning rate of d, as for two ellipses.
SectorRates combined_sector_rates(const CombinedSector& combined, const CombinedEllipse& a,
                                  const CombinedEllipse& b, const PlanarMotion& motion,
                                  const std::vector<DelimiterRate<2>>& rates_a,
                                  const std::vector<DelimiterRate<2>>& rates_b) {
  require_edges(combined.sector);
  require_conics_of(a, combined.left_a, "sector.left_a");
  require_conics_of(a, combined.right_a, "sector.right_a");
  require_conics_of(b, combined.left_b, "sector.left_b");
  require_conics_of(b, combined.right_b, "sector.right_b");
  const ChangingBody changing_a{a, motion.shape_rate_a, rates_a, motion.omega_a},
      changing_b{b, motion.shape_rate_b, rates_b, motion.omega_b};
  const auto edge_rate = [&](const SectorEdge& edge, const Touch& on_a, const Touch& on_b, double side) {
    const Vector2d& n = edge.normal;
    const double kappa = (edge.point_on_b - edge.point_on_a).dot(edge.direction);
    const double change = n.dot(motion.v_b - motion.v_a) +
                          changing_b.across(on_b, edge.point_on_b - b.center(), n) -
                          changing_a.across(on_a, edge.point_on_a - a.center(), n);
    return side * change / kappa;
  };
  const double left = edge_rate(combined.sector.left, combined.left_a, combined.left_b, -1),
               right = edge_rate(combined.sector.right, combined.right_a, combined.right_b, 1);
  return {left - right, 0.5 * (left + right)};
}

}  // namespace vericone
