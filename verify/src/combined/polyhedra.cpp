// SPDX-License-Identifier: GPL-3.0-or-later
//
// On the facet with vertices v_1, v_2, v_3 (about the centre) the form q has the Bernstein coefficients
// v_i^T q v_j: its values are means of them. All of them at most the level: the facet is in the region, and
// so is the tetrahedron over it, q being homogeneous and the level not negative. All above the level: the
// facet, and all beyond it as seen from the centre, is outside. Halving the facet sharpens the means.
#include <vericone/internal/verify/combined/truth.h>
#include <vericone/internal/verify/spatial/minkowski_bounds.h>

#include <cmath>
#include <stdexcept>

#include "combined/forms.h"

namespace vericone::verify {
namespace {

constexpr int kHalvings = 8;
constexpr int kRounds = 300;

struct Coefficients {
  Int128 aa, bb, cc, ab, ac, bc;

  Int128 greatest() const { return std::max({aa, bb, cc, ab, ac, bc}); }
  Int128 least() const { return std::min({aa, bb, cc, ab, ac, bc}); }

  /// Four times the coefficients on the half with the vertices (a, c, m), m the middle of a b.
  Coefficients first_half() const {
    return {4 * aa, 4 * cc, aa + 2 * ab + bb, 4 * ac, 2 * (aa + ab), 2 * (ac + bc)};
  }
  /// On the half (c, b, m).
  Coefficients second_half() const {
    return {4 * cc, 4 * bb, aa + 2 * ab + bb, 4 * bc, 2 * (ac + bc), 2 * (ab + bb)};
  }
};

bool below(const Coefficients& c, Int128 level, int halvings) {
  if (c.greatest() <= level) return true;
  if (halvings == 0 || std::max({c.aa, c.bb, c.cc}) > level) return false;
  return below(c.first_half(), 4 * level, halvings - 1) && below(c.second_half(), 4 * level, halvings - 1);
}

struct Above {
  Coefficients c;
  Int128 level;
};

/// Every point above one of the levels.
bool above_one(const std::vector<Above>& forms, int halvings) {
  bool a = false, b = false, c = false;
  for (const Above& f : forms) {
    if (f.c.least() > f.level) return true;
    a = a || f.c.aa > f.level;
    b = b || f.c.bb > f.level;
    c = c || f.c.cc > f.level;
  }
  if (halvings == 0 || !a || !b || !c) return false;
  std::vector<Above> half(forms.size());
  for (std::size_t i = 0; i < forms.size(); ++i) half[i] = {forms[i].c.first_half(), 4 * forms[i].level};
  if (!above_one(half, halvings - 1)) return false;
  for (std::size_t i = 0; i < forms.size(); ++i) half[i] = {forms[i].c.second_half(), 4 * forms[i].level};
  return above_one(half, halvings - 1);
}

std::int64_t length_1(const GridVector& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }

Int128 form(const GridRegion& r, const GridVector& x, const GridVector& y) {
  Int128 sum = 0;
  for (int i = 0; i < 3; ++i) {
    Int128 row = 0;
    for (int j = 0; j < 3; ++j) row += static_cast<Int128>(r.q[i][j]) * y[j];
    sum += row * x[i];
  }
  return sum;
}

class Builder {
 public:
  Builder(const CombinedEllipsoid& body, int level, int unit) : sphere_(level) {
    regions_ = grid_regions(body, unit);
    const double scale = std::ldexp(1.0, -unit);
    for (const Eigen::Vector3d& u : sphere_.vertices) {
      const Eigen::Vector3d y = body.ellipsoid().factor() * u;
      double gauge = 1;
      for (const Delimiter<3>& d : body.delimiters()) {
        const double value = y.dot(d.matrix * y);
        // A body without extent in some direction is given a little.
        if (value > 1e-4 * d.level) gauge = std::max(gauge, value / std::max(d.level, 1e-4 * value));
      }
      rays_.push_back(y * (scale / std::sqrt(gauge)));
    }
  }

  bool inside(const std::vector<GridVector>& v, const Eigen::Vector3i& f) const {
    const Int128 error = error_of(v, f);
    for (const GridRegion& r : regions_)
      if (!below(coefficients(r, v, f), r.level_floor - error, kHalvings)) return false;
    return true;
  }

  bool outside(const std::vector<GridVector>& v, const Eigen::Vector3i& f) const {
    const Int128 error = error_of(v, f);
    std::vector<Above> forms;
    for (const GridRegion& r : regions_) forms.push_back({coefficients(r, v, f), r.level_ceil + error});
    return above_one(forms, kHalvings);
  }

  /// Vertices moved in (sign = -1) or out (+1) until `holds` for the facets, as far as that can be had;
  /// `holding` says for which it was.
  template <class Holds>
  std::vector<GridVector> moved(int sign, const Holds& holds, std::vector<bool>& holding) const {
    std::vector<double> factor(rays_.size(), 1 + sign * 1e-5);
    std::vector<GridVector> v(rays_.size());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = rounded(factor[i] * rays_[i]);
    holding.assign(sphere_.facets.size(), false);
    std::vector<bool> changed(v.size(), true);
    for (int round = 0; round < kRounds; ++round) {
      std::vector<bool> bad(v.size(), false);
      bool any = false;
      for (std::size_t k = 0; k < sphere_.facets.size(); ++k) {
        const Eigen::Vector3i& f = sphere_.facets[k];
        if (changed[f(0)] || changed[f(1)] || changed[f(2)]) holding[k] = holds(v, f);
        if (holding[k]) continue;
        any = true;
        for (int i = 0; i < 3; ++i) bad[f(i)] = true;
      }
      if (!any) break;
      const double step = 1 + sign * std::min(0.001 * (1 + 0.3 * round), 0.03);
      for (std::size_t i = 0; i < v.size(); ++i)
        if (bad[i]) v[i] = rounded((factor[i] *= step) * rays_[i]);
      changed = bad;
    }
    return v;
  }

  const std::vector<Eigen::Vector3i>& facets() const { return sphere_.facets; }

 private:
  static GridVector rounded(const Eigen::Vector3d& y) {
    GridVector r;
    for (int i = 0; i < 3; ++i) {
      // Beyond this the sums of the forms would not fit.
      if (!(std::abs(y(i)) < 0x1p25)) throw std::logic_error("polyhedral_bounds: a vertex too far out");
      r[i] = std::llround(y(i));
    }
    return r;
  }
  static Int128 error_of(const std::vector<GridVector>& v, const Eigen::Vector3i& f) {
    const Int128 most = std::max({length_1(v[f(0)]), length_1(v[f(1)]), length_1(v[f(2)])});
    return most * most;
  }
  static Coefficients coefficients(const GridRegion& r, const std::vector<GridVector>& v,
                                   const Eigen::Vector3i& f) {
    const GridVector &a = v[f(0)], &b = v[f(1)], &c = v[f(2)];
    return {form(r, a, a), form(r, b, b), form(r, c, c), form(r, a, b), form(r, a, c), form(r, b, c)};
  }

  GeodesicSphere sphere_;
  std::vector<GridRegion> regions_;
  std::vector<Eigen::Vector3d> rays_;  // in units, to the boundary
};

StarPolyhedron placed(std::vector<GridVector> v, const std::vector<Eigen::Vector3i>& facets,
                      const std::vector<bool>& chosen, const GridVector& at) {
  for (GridVector& x : v)
    for (int i = 0; i < 3; ++i) x[i] += at[i];
  StarPolyhedron p{at, std::move(v), {}};
  for (std::size_t k = 0; k < facets.size(); ++k)
    if (chosen[k]) p.facets.push_back({facets[k](0), facets[k](1), facets[k](2)});
  return p;
}

}  // namespace

PolyhedralBounds polyhedral_bounds(const CombinedEllipsoid& body, int level, int unit, const GridVector& at) {
  const Builder builder(body, level, unit);
  PolyhedralBounds bounds;
  std::vector<bool> holding;
  std::vector<GridVector> v = builder.moved(
      -1, [&](const auto& x, const auto& f) { return builder.inside(x, f); }, holding);
  bounds.inner = placed(std::move(v), builder.facets(), holding, at);
  try {
    v = builder.moved(
        +1, [&](const auto& x, const auto& f) { return builder.outside(x, f); }, holding);
    if (std::find(holding.begin(), holding.end(), false) == holding.end())
      bounds.outer = placed(std::move(v), builder.facets(), holding, at);
  } catch (const std::logic_error&) {
    // A rim so steep that its facets run away: no outer polyhedron.
  }
  return bounds;
}

}  // namespace vericone::verify
