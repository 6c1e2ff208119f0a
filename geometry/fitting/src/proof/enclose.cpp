// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/hull.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/fitting/canonical.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "infinity.h"
#include "middle.h"
#include "proof/greatest_value.h"
#include "proof/rational_quadric.h"

namespace vericone::fitting {
namespace {

using exact::Rational;
using exact::RationalMatrix;

/// Not below the square root.
double root_up(double x) { return std::nextafter(std::sqrt(x), kInfinity); }

/// The body with its centre bit for bit and its factor multiplied.
template <int D>
BasicEllipsoid<D> inflated(const BasicEllipsoid<D>& body, double factor) {
  const Eigen::Matrix<double, D, 1> center = body.center();
  return body.translated(-center).scaled(factor).translated(center);
}

/// What one piece is to contain, and how far it reaches.
class Content {
 public:
  Content(const Sample& sample, const Assignment& assignment, int piece, const Eigen::Vector3d& near,
          double margin)
      : sample_(sample), near_(near), margin_(margin) {
    std::vector<char> listed(sample.points.size(), 0);
    for (std::uint32_t i = 0; i < assignment.points.size(); ++i)
      if (assignment.points[i] == piece) {
        contents_.points.push_back(i);
        listed[i] = 1;
      }
    for (std::uint32_t t = 0; t < assignment.triangles.size(); ++t) {
      if (assignment.triangles[t] != piece) continue;
      contents_.triangles.push_back(t);
      for (const std::uint32_t i : sample.triangles[t])
        if (!std::exchange(listed[i], 1)) contents_.corners.push_back(i);
    }
  }

  bool empty() const { return contents_.empty(); }

  /// Bound of the greatest value.
  double reach(const RationalMatrix<4>& quadric) const {
    return greatest_value(QuadraticForm(quadric, near_), sample_, contents_, margin_);
  }
  double reach(const Quadric& quadric) const {
    return reach(exact::to_rational<4>(Eigen::Matrix4d(quadric.matrix())));
  }

  /// (x - p)^T S^{-1} (x - p) of an ellipsoid or ellipse.
  template <typename Body>
  double squared_gauge(const Body& body) const {
    return reach(quadric_about(center_in_space(body), inverse_shape(body), 0));
  }

  /// Bounds of z.
  std::pair<double, double> heights() const {
    double low = kInfinity, high = -kInfinity;
    const auto widen = [&](std::uint32_t i, double by) {
      const Rational z = sample_.points[i].z();
      low = std::min(low, rounded_down(Rational(z - Rational(by))));
      high = std::max(high, rounded_up(Rational(z + Rational(by))));
    };
    for (const std::uint32_t i : contents_.points) widen(i, margin_);
    for (const std::uint32_t i : contents_.corners) widen(i, 0);
    return {low, high};
  }

 private:
  const Sample& sample_;
  Contents contents_;
  Eigen::Vector3d near_;
  double margin_;
};

/// The body that contains what it should, by the least factor but for the rounding of its matrix; and the
/// factor, 1 where nothing had to be done.
template <typename Body>
std::pair<Body, double> inflate(const Body& body, const Content& content) {
  const double reach = content.squared_gauge(body);
  if (reach <= 1) return {body, 1};
  double factor = root_up(reach);
  // Entries of the factor are rounded one by one, which moves the surface of a thin body by more than that.
  for (double step = 0x1p-52;; step *= 2) {
    Body larger = inflated(body, factor);
    if (content.squared_gauge(larger) <= 1) return {larger, factor};
    factor *= 1 + step;
  }
}

double inflate_body(Piece& piece, const Content& content) {
  if (piece.footprint) {
    if (piece.low < piece.high) {
      const auto [low, high] = content.heights();
      piece.low = std::min(piece.low, low);
      piece.high = std::max(piece.high, high);
    }
    const auto [ellipse, factor] = inflate(*piece.footprint, content);
    piece.footprint = ellipse;
    return factor;
  }
  auto [ellipsoid, largest] = inflate(piece.body.ellipsoid(), content);
  std::vector<Delimiter<3>> delimiters = piece.body.delimiters();
  const auto center = exact::to_rational<3>(ellipsoid.center());
  for (Delimiter<3>& d : delimiters) {
    const double level = content.reach(quadric_about(center, exact::to_rational<3>(d.matrix), 0));
    if (level <= d.level) continue;
    largest = std::max(largest, std::sqrt(level / d.level));
    d.level = level;
  }
  // A surface moved outwards may miss the ellipsoid: it then delimits nothing, and nothing is wrong with it.
  piece.body = CombinedEllipsoid::trusted(ellipsoid, std::move(delimiters));
  return largest;
}

/// With its constant lowered until nothing is positive.
Quadric inflated(const Quadric& quadric, const Content& content) {
  Eigen::Matrix4d q = quadric.matrix();
  double reach = content.reach(quadric);
  // Once, unless there is a margin, whose bounds are not exact.
  for (double step = 1; reach > 0; step *= 2) {
    const double lower = rounded_down(Rational(Rational(q(3, 3)) - Rational(reach) * Rational(step)));
    q(3, 3) = std::min(lower, std::nextafter(q(3, 3), -kInfinity));
    reach = content.reach(Quadric(q));
  }
  return Quadric(q);
}

void require_valid(const std::vector<Piece>& pieces, const Sample& sample, const Assignment& assignment,
                   double margin) {
  const auto require = [&](const std::vector<int>& of, std::size_t count, const std::string& field) {
    if (of.size() != count)
      throw InputError(field, std::to_string(of.size()) + " entries", std::to_string(count) + " entries");
    for (const int k : of)
      if (k < -1 || k >= static_cast<int>(pieces.size()))
        throw InputError(field, std::to_string(k), "-1 or the index of a piece");
  };
  require(assignment.points, sample.points.size(), "assignment.points");
  require(assignment.triangles, sample.triangles.size(), "assignment.triangles");
  if (!(margin >= 0) || !std::isfinite(margin))
    throw InputError("margin", to_text(margin), "finite and not negative (metres)");
}

}  // namespace

double enclose(std::vector<Piece>& pieces, const Sample& sample, const Assignment& assignment,
               double margin) {
  require_valid(pieces, sample, assignment, margin);
  const Eigen::Vector3d near = middle(sample, used_points(sample));
  double largest = 1;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Content content(sample, assignment, static_cast<int>(k), near, margin);
    if (!content.empty()) largest = std::max(largest, inflate_body(pieces[k], content));
    set_quadrics(pieces[k]);
    if (content.empty()) continue;
    for (Quadric& quadric : pieces[k].quadrics) quadric = inflated(quadric, content);
  }
  return largest;
}

}  // namespace vericone::fitting
