// SPDX-License-Identifier: GPL-3.0-or-later
#include "corpus/build.h"

#include <vericone/internal/geometry/exact/integer.h>
#include <array>
#include <cmath>
#include <limits>

namespace vericone::verify::corpus {
namespace {

/// (m, n) -> m^2 - n^2, 2 m n, m^2 + n^2.
std::array<int, 3> pythagorean_triple(SeededRandom& random) {
  const int m = random.integer(2, 9);
  const int n = random.integer(1, m - 1);
  return {m * m - n * n, 2 * m * n, m * m + n * n};
}

/// |q|^2 times a rotation, q an integer quaternion: the numerator of Cayley's formula.
Mat<3> scaled_rotation(int w, int x, int y, int z) {
  const int m[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                       {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                       {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  Mat<3> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = m[i][j];
  return r;
}

template <int D>
Mat<D> general_matrix(SeededRandom& random, int most) {
  for (;;) {
    Mat<D> m;
    for (auto& row : m)
      for (auto& x : row) x = Rational(random.integer(-most, most));
    if (exact::determinant<D>(m) != 0) return m;
  }
}

template <int D>
Mat<D> pythagorean_rotation(SeededRandom& random) {
  const auto [p, q, h] = pythagorean_triple(random);
  if constexpr (D == 2) return {{{p, -q}, {q, p}}};
  const int axis = random.integer(0, D - 1);
  const int i = (axis + 1) % D, j = (axis + 2) % D;
  Mat<D> m;
  m[axis][axis] = h;
  m[i][i] = m[j][j] = p;
  m[i][j] = -q;
  m[j][i] = q;
  return m;
}

template <int D>
Mat<D> cayley_rotation(SeededRandom& random) {
  if constexpr (D == 2) {
    const int m = random.integer(1, 30);
    const int n = random.integer(1, 30);
    return {{{m * m - n * n, -2 * m * n}, {2 * m * n, m * m - n * n}}};
  } else {
    std::array<int, 4> q{};
    for (int& x : q) x = random.integer(-9, 9);
    if (q[0] == 0 && q[1] == 0 && q[2] == 0) q[0] = 1;
    return scaled_rotation(q[0], q[1], q[2], q[3]);
  }
}

template <int D>
Mat<D> signed_permutation(SeededRandom& random) {
  const int turn = random.integer(0, D - 1);
  Mat<D> m;
  for (int i = 0; i < D; ++i) m[i][(i + turn) % D] = random.coin() ? 1 : -1;
  return m;
}

}  // namespace

Rational power_of_two(int e) {
  const exact::Integer p = exact::Integer(1) << static_cast<unsigned>(std::abs(e));
  return e >= 0 ? Rational(p) : Rational(exact::Integer(1), p);
}

template <int D>
Map<D> random_map(SeededRandom& random, std::uint64_t number) {
  Map<D> map;
  switch (number % 4) {
    case 0:
      // Numbers of few bits can hide an error: products of them are exact in doubles.
      map.kind = random.coin() ? "general" : "wide";
      map.m = general_matrix<D>(random, map.kind == "wide" ? 3000 : 3);
      break;
    case 1:
      map.m = pythagorean_rotation<D>(random);
      map.kind = "pythagorean";
      break;
    case 2:
      map.m = cayley_rotation<D>(random);
      map.kind = "cayley";
      break;
    default:
      map.m = signed_permutation<D>(random);
      map.kind = "axes";
  }
  for (auto& x : map.offset) x = random.integer(-9, 9);
  const auto stretch = [&](int e) {
    const int i = random.integer(0, D - 1);
    for (auto& x : map.m[i]) x *= power_of_two(e);
    map.offset[i] *= power_of_two(e);
  };
  const auto scale = [&](int e) {
    for (int i = 0; i < D; ++i) {
      for (auto& x : map.m[i]) x *= power_of_two(e);
      map.offset[i] *= power_of_two(e);
    }
  };
  const auto shift = [&](int e) {
    for (auto& x : map.offset) x = (random.coin() ? 1 : -1) * power_of_two(e) + random.integer(-999, 999);
  };
  switch ((number / 4) % 9) {
    case 0:
    case 1:
    case 2:
      map.kind += "/plain";
      break;
    case 3:
      stretch(random.integer(4, 16));
      map.kind += "/thin";
      break;
    case 4:
      stretch(27);
      map.kind += "/needle";
      break;
    case 5:
      scale(-498);
      map.kind += "/tiny";
      break;
    case 6:
      scale(494);
      map.kind += "/huge";
      break;
    case 7:
      shift(30);
      map.kind += "/far9";
      break;
    default:
      shift(50);
      map.kind += "/far15";
  }
  return map;
}

template <int D>
Mat<D> random_factor(SeededRandom& random) {
  for (;;) {
    Mat<D> g;
    for (auto& row : g)
      for (auto& x : row) x = Rational(random.integer(-4, 4));
    for (int j = 0; j + 1 < D; ++j) g[D - 1][j] = Rational();
    g[D - 1][D - 1] = Rational(random.integer(1, 4));
    if (exact::determinant<D>(g) != 0) return g;
  }
}

namespace {
std::optional<Rational> square_root(const Rational& x) {
  const exact::Integer n = sqrt(numerator(x)), d = sqrt(denominator(x));
  if (n * n != numerator(x) || d * d != denominator(x)) return std::nullopt;
  return Rational(n, d);
}
}  // namespace

template <int D>
void add_body(CorpusCase& c, const std::string& name, const Map<D>& map, const Body<D>& body) {
  add_point<D>(c, name + ".center", map, body.center);
  const Mat<D> f = product<D>(map.m, body.factor), s = product<D>(f, transposed<D>(f));
  CorpusField axes{name + ".axes", {}}, shape{name + ".shape", {}};
  bool diagonal = true;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      shape.values.push_back(s[i][j]);
      diagonal = diagonal && (i == j || s[i][j] == 0);
    }
  for (int i = 0; i < D && diagonal; ++i) {
    const auto root = square_root(s[i][i]);
    diagonal = root.has_value();
    if (root) axes.values.push_back(*root);
  }
  c.fields.push_back(diagonal ? axes : shape);
}

template <int D>
void add_point(CorpusCase& c, const std::string& name, const Map<D>& map, const Vec<D>& point) {
  const Vec<D> p = sum<D>(apply<D>(map.m, point), map.offset);
  c.fields.push_back({name, {p.begin(), p.end()}});
}

template <int D>
void add_direction(CorpusCase& c, const std::string& name, const Map<D>& map, const Vec<D>& direction) {
  const Vec<D> v = apply<D>(map.m, direction);
  c.fields.push_back({name, {v.begin(), v.end()}});
}

bool fits(const CorpusCase& c) {
  for (const CorpusField& field : c.fields)
    for (const Rational& x : field.values)
      if (!as_double(x)) return false;
  return true;
}

double moved_by_ulps(double x, int count) {
  const double target = std::copysign(std::numeric_limits<double>::infinity(), count);
  for (int i = 0; i < std::abs(count); ++i) x = std::nextafter(x, target);
  return x;
}

std::vector<CorpusCase> neighbours(const CorpusCase& c, const std::string& name, int count,
                                   SeededRandom& random) {
  std::vector<CorpusCase> result;
  for (int k = 0; k < count; ++k) {
    CorpusCase moved = c;
    moved.family += "-ulps";
    moved.source = "exact";
    moved.rung = "any";
    for (CorpusField& field : moved.fields) {
      if (field.name != name) continue;
      const bool all = random.coin();
      const int only = random.integer(0, static_cast<int>(field.values.size()) - 1);
      for (int i = 0; i < static_cast<int>(field.values.size()); ++i) {
        if (!all && i != only) continue;
        int step = random.integer(1, 8);
        if (random.coin()) step = -step;
        // A zero stays: its neighbours are 300 orders of magnitude below everything else.
        if (field.values[i] == 0) continue;
        field.values[i] = Rational(moved_by_ulps(*as_double(field.values[i]), step));
      }
    }
    if (!(moved.fields == c.fields)) result.push_back(std::move(moved));
  }
  return result;
}

template Map<2> random_map<2>(SeededRandom&, std::uint64_t);
template Map<3> random_map<3>(SeededRandom&, std::uint64_t);
template Mat<2> random_factor<2>(SeededRandom&);
template Mat<3> random_factor<3>(SeededRandom&);
template void add_body<2>(CorpusCase&, const std::string&, const Map<2>&, const Body<2>&);
template void add_body<3>(CorpusCase&, const std::string&, const Map<3>&, const Body<3>&);
template void add_point<2>(CorpusCase&, const std::string&, const Map<2>&, const Vec<2>&);
template void add_point<3>(CorpusCase&, const std::string&, const Map<3>&, const Vec<3>&);
template void add_direction<2>(CorpusCase&, const std::string&, const Map<2>&, const Vec<2>&);
template void add_direction<3>(CorpusCase&, const std::string&, const Map<3>&, const Vec<3>&);

}  // namespace vericone::verify::corpus
