// SPDX-License-Identifier: BSD-3-Clause
#include "solids/solid_check.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using exact::Rational, exact::RationalMatrix, exact::RationalVector;

constexpr double kRotation = 1e-9;  // how far from orthonormal one may be

RationalMatrix<3> inverse_of(const RationalMatrix<3>& m) {
  RationalMatrix<3> inverse;
  const auto minor = [&](int i, int j) -> Rational {
    const auto at = [&](int row, int column) -> const Rational& {
      return m[std::size_t((i + row) % 3)][std::size_t((j + column) % 3)];
    };
    return at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1);
  };
  const Rational det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse[std::size_t(j)][std::size_t(i)] = minor(i, j) / det;
  return inverse;
}

/// The largest sum of a row's magnitudes: no eigenvalue is larger.
Rational row_norm(const RationalMatrix<3>& symmetric) {
  Rational largest = 0;
  for (const auto& row : symmetric) {
    const Rational sum = abs(row[0]) + abs(row[1]) + abs(row[2]);
    if (sum > largest) largest = sum;
  }
  return largest;
}

/// R^T R - 1.
RationalMatrix<3> defect_of(const RationalMatrix<3>& r) {
  RationalMatrix<3> defect;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      defect[i][j] = i == j ? -1 : 0;
      for (std::size_t k = 0; k < 3; ++k) defect[i][j] += r[k][i] * r[k][j];
    }
  return defect;
}

bool sizes_are_right(const Solid& s) {
  for (int k = 0; k < 3; ++k)
    if (!(s.sizes(k) >= 0 && s.sizes(k) <= 1e100)) return false;
  return s.kind != SolidKind::ellipsoid || s.sizes.minCoeff() > 0;
}

Rational square(const Rational& x) { return x * x; }

}  // namespace

void require_solids(const std::vector<Solid>& solids, double margin) {
  if (solids.empty()) throw InputError("pieces", "none", "one piece or more");
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Solid& s = solids[i];
    const std::string field = "pieces[" + std::to_string(i) + "]";
    if (!s.center.allFinite() || !s.rotation.allFinite() || !sizes_are_right(s))
      throw InputError(field, "a " + to_string(s.kind) + " of other sizes",
                       "a finite center and sizes of 0 or more (of an ellipsoid above 0), metres");
    const double defect = (s.rotation.transpose() * s.rotation - Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(defect < kRotation) || !(s.rotation.determinant() > 0))
      throw InputError(field, "a matrix that is no rotation",
                       "orthonormal rows to 1e-9, determinant above 0");
  }
  if (!(margin >= 0) || !std::isfinite(margin))
    throw InputError("margin", to_text(margin), "finite and not negative (metres)");
}

SolidCheck::SolidCheck(const Solid& solid, double margin) : solid_(solid), margin_(margin) {
  const RationalMatrix<3> r = exact::to_rational<3>(solid.rotation);
  const Rational defect = row_norm(defect_of(r));
  defect_ = defect.convert_to<double>() * (1 + 1e-9) + std::numeric_limits<double>::min();
  inverse_ = inverse_of(r);
  for (int k = 0; k < 3; ++k) sizes_[std::size_t(k)] = solid.sizes(k);
  // |R^-1| <= (1 - defect)^-1/2 <= 1 + defect, where that is below a half.
  ball_ = Rational(margin) * (1 + defect);
}

SolidCheck::Answer SolidCheck::contains(const Vector3d& x) const {
  // R^T d for R^-1 d; each of some twenty operations rounds by 2^-53 of what they add up.
  constexpr double kRoundings = 64 * 0x1p-53;
  const Vector3d d = x - solid_.center;
  const double size = d.lpNorm<1>() + solid_.sizes.sum() + margin_;
  const double wrong =
      kRoundings * size + (2 * defect_ + 64 * kRoundings * defect_) * (size + margin_) + 1e-300;
  const double depth = solid_.depth(x) - margin_;
  if (!std::isfinite(size) || !std::isfinite(depth)) return Answer::unsure;
  return depth > wrong ? Answer::yes : depth < -wrong ? Answer::no : Answer::unsure;
}

SolidCheck::Vector SolidCheck::in_body(const Vector3d& x) const {
  Vector d, y;
  for (std::size_t k = 0; k < 3; ++k) d[k] = Rational(x(int(k))) - Rational(solid_.center(int(k)));
  for (std::size_t i = 0; i < 3; ++i)
    y[i] = inverse_[i][0] * d[0] + inverse_[i][1] * d[1] + inverse_[i][2] * d[2];
  return y;
}

std::array<std::array<Rational, 4>, 3> SolidCheck::coordinates() const {
  std::array<std::array<Rational, 4>, 3> rows;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      rows[i][k] = inverse_[i][k];
      rows[i][3] -= inverse_[i][k] * Rational(solid_.center(int(k)));
    }
  return rows;
}

bool SolidCheck::contains_exactly(const Vector3d& x) const {
  const Vector y = in_body(x);
  const Rational across = square(y[0]) + square(y[1]);
  const Rational radius = sizes_[0] - ball_;
  switch (solid_.kind) {
    case SolidKind::sphere:
      return radius >= 0 && across + square(y[2]) <= square(radius);
    case SolidKind::capsule: {
      const Rational beyond = abs(y[2]) - sizes_[1] / 2;
      return radius >= 0 && (beyond > 0 ? across + square(beyond) : across) <= square(radius);
    }
    case SolidKind::cylinder:
      return radius >= 0 && across <= square(radius) && abs(y[2]) <= sizes_[1] / 2 - ball_;
    case SolidKind::box:
      for (std::size_t k = 0; k < 3; ++k)
        if (abs(y[k]) > sizes_[k] - ball_) return false;
      return true;
    case SolidKind::ellipsoid:
      break;
  }
  // A ball of radius b is within b / (least semi-axis) in the coordinates in which the body is the unit ball.
  const Rational left = 1 - ball_ / *std::min_element(sizes_.begin(), sizes_.end());
  Rational sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += square(y[k] / sizes_[k]);
  return left >= 0 && sum <= square(left);
}

namespace {

class Housing {
 public:
  Housing(const std::vector<Solid>& solids, const Sample& sample, double margin)
      : sample_(sample), used_(used_points(sample)) {
    require_solids(solids, margin);
    for (const Solid& s : solids) checks_.emplace_back(s, margin);
    known_.assign(solids.size() * sample.points.size(), kUnasked);
    exact_.assign(sample.points.size(), 0);
    homes_.points.assign(sample.points.size(), -1);
    for (const std::uint32_t i : used_) homes_.points[i] = home_of({i});
    for (const auto& t : sample.triangles) homes_.triangles.push_back(home_of({t[0], t[1], t[2]}));
  }

  const Assignment& homes() const { return homes_; }

  Certificate certificate(double margin) const {
    Certificate c;
    c.points = used_.size();
    for (const std::uint32_t i : used_) {
      c.points_inside += homes_.points[i] >= 0;
      c.by_exact += exact_[i] != 0;
    }
    c.triangles = homes_.triangles.size();
    c.triangles_inside =
        c.triangles - std::size_t(std::count(homes_.triangles.begin(), homes_.triangles.end(), -1));
    c.margin = margin;
    c.margins_inside = c.points_inside;
    c.touching = touching(margin);
    return c;
  }

 private:
  static constexpr char kUnasked = 0, kYes = 1, kNo = 2, kUnsure = 3;

  bool in(std::size_t solid, std::uint32_t point, bool exactly) {
    checkpoint();
    char& known = known_[solid * sample_.points.size() + point];
    const Vector3d& x = sample_.points[point];
    if (known == kUnasked) {
      const SolidCheck::Answer a = checks_[solid].contains(x);
      known = a == SolidCheck::Answer::yes ? kYes : a == SolidCheck::Answer::no ? kNo : kUnsure;
    }
    if (known == kUnsure && exactly) {
      exact_[point] = 1;
      known = checks_[solid].contains_exactly(x) ? kYes : kNo;
    }
    return known == kYes;
  }

  /// The first that contains all of them; exact arithmetic only for what no solid certainly contains.
  int home_of(std::initializer_list<std::uint32_t> corners) {
    for (const bool exactly : {false, true})
      for (std::size_t k = 0; k < checks_.size(); ++k)
        if (std::all_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return in(k, i, exactly); }))
          return int(k);
    return -1;
  }

  std::vector<std::size_t> touching(double margin) const {
    constexpr std::size_t kMost = 20;
    constexpr double kTouching = 1e-9;
    std::vector<std::pair<double, std::size_t>> near;
    for (const std::uint32_t i : used_) {
      if (homes_.points[i] < 0) continue;
      double deepest = -1;
      for (const SolidCheck& check : checks_)
        deepest =
            std::max(deepest, (check.solid().depth(sample_.points[i]) - margin) / check.solid().reach());
      if (deepest < kTouching) near.emplace_back(deepest, i);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > kMost) near.resize(kMost);
    std::vector<std::size_t> indices;
    for (const auto& [depth, i] : near) indices.push_back(i);
    return indices;
  }

  const Sample& sample_;
  std::vector<std::uint32_t> used_;
  std::vector<SolidCheck> checks_;
  std::vector<char> known_, exact_;
  Assignment homes_;
};

void enclose(Solid& solid, const std::vector<Vector3d>& points, double margin, double slack) {
  const double reach = solid.center.norm() + solid.reach() + margin;
  const auto contains_all = [&](const Solid& tried) {
    const SolidCheck check(tried, margin + slack * reach);
    return std::all_of(points.begin(), points.end(), [&](const Vector3d& x) {
      checkpoint();
      const SolidCheck::Answer a = check.contains(x);
      return a == SolidCheck::Answer::yes || (a == SolidCheck::Answer::unsure && check.contains_exactly(x));
    });
  };
  // Some roundings are enough, but for triangles without area that lead from piece to piece.
  double farthest = reach;
  for (const Vector3d& x : points) farthest = std::max(farthest, 2 * (x - solid.center).norm() + margin);
  for (int exponent = 45; exponent >= 0; --exponent) {
    const Solid tried = grown(solid, exponent == 45 ? 0 : std::ldexp(farthest, -exponent));
    if (!contains_all(tried)) continue;
    solid = tried;
    return;
  }
  throw std::runtime_error("a " + to_string(solid.kind) +
                           " does not contain the points that it was found for");
}

}  // namespace

Solid grown(Solid s, double by) {
  switch (s.kind) {
    case SolidKind::sphere:
      s.sizes(0) += by;
      break;
    case SolidKind::capsule:
      s.sizes(0) += by;
      break;
    case SolidKind::cylinder:
      s.sizes(0) += by;
      s.sizes(1) += 2 * by;
      break;
    case SolidKind::box:
      s.sizes.array() += by;
      break;
    case SolidKind::ellipsoid:
      // All by one factor: a thin axis alone would let points out along the others.
      s.sizes *= 1 + by / s.sizes.minCoeff();
      break;
  }
  return s;
}

Certificate check(const std::vector<Solid>& solids, const Sample& sample, double margin) {
  return Housing(solids, sample, margin).certificate(margin);
}

Assignment homes_of(const std::vector<Solid>& solids, const Sample& sample) {
  return Housing(solids, sample, 0).homes();
}

void enclose(std::vector<Solid>& solids, const Sample& sample, const Assignment& assignment, double margin,
             double slack) {
  require_solids(solids, margin);
  std::vector<std::vector<Vector3d>> points(solids.size());
  const auto add = [&](int home, std::uint32_t i) {
    if (home >= 0) points[std::size_t(home)].push_back(sample.points[i]);
  };
  for (std::uint32_t i = 0; i < sample.points.size(); ++i) add(assignment.points[i], i);
  for (std::size_t t = 0; t < sample.triangles.size(); ++t)
    for (const std::uint32_t i : sample.triangles[t]) add(assignment.triangles[t], i);
  for (std::size_t k = 0; k < solids.size(); ++k) enclose(solids[k], points[k], margin, slack);
}

}  // namespace vericone::fitting
