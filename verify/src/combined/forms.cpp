// SPDX-License-Identifier: GPL-3.0-or-later
#include "combined/forms.h"

#include <vericone/internal/verify/combined/truth.h>

#include <cmath>
#include <stdexcept>

namespace vericone::verify {
namespace {

/// Bits of the greatest entry of GridRegion::q.
constexpr int kFormBits = 52;

/// x 2^k.
mpq_class shifted(const mpq_class& x, int k) {
  mpq_class r;
  if (k >= 0)
    mpq_mul_2exp(r.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(k));
  else
    mpq_div_2exp(r.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-k));
  return r;
}

mpz_class floor_of(const mpq_class& x) {
  mpz_class r;
  mpz_fdiv_q(r.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return r;
}

Int128 to_int128(const mpz_class& x) {
  if (mpz_sizeinbase(x.get_mpz_t(), 2) > 120) throw std::logic_error("combined_forms: a number too great");
  const mpz_class magnitude = abs(x), high = magnitude >> 62, low = magnitude - (high << 62);
  const Int128 r = (static_cast<Int128>(high.get_si()) << 62) + low.get_si();
  return sgn(x) < 0 ? -r : r;
}

}  // namespace

std::vector<RationalRegion> rational_regions(const CombinedEllipsoid& body) {
  std::vector<RationalRegion> all;
  const Ellipsoid& e = body.ellipsoid();
  std::array<std::array<mpq_class, 3>, 3> s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (!e.defined_by_factor()) {
        s[i][j] = mpq_class(e.shape()(i, j));
        continue;
      }
      for (int k = 0; k < 3; ++k) s[i][j] += mpq_class(e.factor()(i, k)) * mpq_class(e.factor()(j, k));
    }
  RationalRegion first;
  mpq_class det = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      first.m[j][i] = s[i1][j1] * s[i2][j2] - s[i1][j2] * s[i2][j1];
    }
  for (int j = 0; j < 3; ++j) det += s[0][j] * first.m[j][0];
  for (auto& row : first.m)
    for (mpq_class& x : row) x /= det;
  first.level = 1;
  all.push_back(first);
  for (const Delimiter<3>& d : body.delimiters()) {
    RationalRegion r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r.m[i][j] = mpq_class(d.matrix(i, j));
    r.level = mpq_class(d.level);
    all.push_back(r);
  }
  return all;
}

std::vector<GridRegion> grid_regions(const CombinedEllipsoid& body, int unit) {
  std::vector<GridRegion> all;
  for (const RationalRegion& region : rational_regions(body)) {
    double greatest = 0;
    for (const auto& row : region.m)
      for (const mpq_class& x : row) greatest = std::max(greatest, std::abs(x.get_d()));
    // y = 2^unit k: y^T m y <= level is k^T (m 2^-scale) k <= level 2^(-scale - 2 unit).
    const int scale = std::ilogb(greatest) + 1 - kFormBits;
    GridRegion r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r.q[i][j] = floor_of(shifted(region.m[i][j], -scale)).get_si();
    const mpq_class level = shifted(region.level, -scale - 2 * unit);
    r.level_floor = to_int128(floor_of(level));
    r.level_ceil = r.level_floor + (r.level_floor == 0 && level == 0 ? 0 : 1);
    all.push_back(r);
  }
  return all;
}

bool exactly_meets(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const Eigen::Vector3d& x,
                   const Eigen::Vector3d& w, double t) {
  if (!(t >= 0)) return false;
  const auto contains = [](const CombinedEllipsoid& body, const std::array<mpq_class, 3>& point) {
    std::array<mpq_class, 3> y;
    for (int i = 0; i < 3; ++i) y[i] = point[i] - mpq_class(body.center()(i));
    for (const RationalRegion& r : rational_regions(body)) {
      mpq_class value = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) value += r.m[i][j] * y[i] * y[j];
      if (value > r.level) return false;
    }
    return true;
  };
  std::array<mpq_class, 3> p, q;
  for (int i = 0; i < 3; ++i) {
    p[i] = mpq_class(x(i));
    q[i] = p[i] + mpq_class(t) * mpq_class(w(i));
  }
  return contains(a, p) && contains(b, q);
}

}  // namespace vericone::verify
