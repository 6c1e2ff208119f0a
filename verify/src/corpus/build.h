// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the generators of the corpus are made of: rational linear algebra, random integer frames, and cases.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/verify/corpus.h>
#include <string>
#include <utility>
#include <vector>

namespace vericone::verify::corpus {

using exact::Rational;
template <int D>
using Vec = exact::RationalVector<D>;
template <int D>
using Mat = exact::RationalMatrix<D>;

template <int D>
Vec<D> apply(const Mat<D>& m, const Vec<D>& v) {
  Vec<D> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r[i] += m[i][j] * v[j];
  return r;
}
template <int D>
Mat<D> product(const Mat<D>& m, const Mat<D>& n) {
  Mat<D> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      for (int k = 0; k < D; ++k) r[i][j] += m[i][k] * n[k][j];
  return r;
}
template <int D>
Mat<D> transposed(const Mat<D>& m) {
  Mat<D> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r[i][j] = m[j][i];
  return r;
}
template <int D>
Mat<D> identity(const Rational& x) {
  Mat<D> r;
  for (int i = 0; i < D; ++i) r[i][i] = x;
  return r;
}
template <int D>
Vec<D> sum(const Vec<D>& x, const Vec<D>& y) {
  Vec<D> r;
  for (int i = 0; i < D; ++i) r[i] = x[i] + y[i];
  return r;
}
template <int D>
Vec<D> times(const Rational& s, const Vec<D>& x) {
  Vec<D> r;
  for (int i = 0; i < D; ++i) r[i] = s * x[i];
  return r;
}
template <int D>
Rational inner(const Vec<D>& x, const Vec<D>& y) {
  Rational r;
  for (int i = 0; i < D; ++i) r += x[i] * y[i];
  return r;
}
template <int D>
Vec<D> column(const Mat<D>& m, int j) {
  Vec<D> r;
  for (int i = 0; i < D; ++i) r[i] = m[i][j];
  return r;
}

Rational power_of_two(int e);

/// An affine map x -> m x + offset from the frame in which a case is built to the one in which it is given.
template <int D>
struct Map {
  Mat<D> m;
  Vec<D> offset;
  std::string kind;
};

/// By `number`, so that all kinds come round: m is an integer matrix (general, wide with larger numbers; a
/// Pythagorean rotation; a Cayley rotation; a signed permutation, which leaves zeros and axis-parallel
/// directions in place), combined with a setting (plain; thin: one coordinate stretched by up to 2^16;
/// needle: by 2^27, axis ratios above 1e8; tiny, huge: all lengths times 2^-498, 2^494; far9, far15: 1e9 and
/// 1e15 units from the origin).
template <int D>
Map<D> random_map(SeededRandom& random, std::uint64_t number);

/// Ellipsoid { p + G u } with an integer factor G whose last row is (0, ..., 0, k): its support point along
/// the last axis is p + the last column of G, at the height k.
template <int D>
Mat<D> random_factor(SeededRandom& random);

template <int D>
struct Body {
  Vec<D> center;
  Mat<D> factor;  // any with the right shape
};

template <int D>
void add_body(CorpusCase& c, const std::string& name, const Map<D>& map, const Body<D>& body);
template <int D>
void add_point(CorpusCase& c, const std::string& name, const Map<D>& map, const Vec<D>& point);
template <int D>
void add_direction(CorpusCase& c, const std::string& name, const Map<D>& map, const Vec<D>& direction);

/// Whether every number of the case is a double.
bool fits(const CorpusCase& c);

/// x moved by `count` representable numbers.
double moved_by_ulps(double x, int count);

/// Copies of `c` whose field `name` is moved by -8..8 ulps in one or in all of its numbers.
std::vector<CorpusCase> neighbours(const CorpusCase& c, const std::string& name, int count,
                                   SeededRandom& random);

std::vector<CorpusCase> position_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> relation_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> membership_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> sector_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> side_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> hull_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> orifice_cases(std::uint64_t seed, int size);
std::vector<CorpusCase> horizon_cases(std::uint64_t seed, int size);

}  // namespace vericone::verify::corpus
