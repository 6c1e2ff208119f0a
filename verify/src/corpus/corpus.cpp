// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/geometry/exact/rational.h>
#include <vericone/verify/corpus.h>

#include <vericone/internal/geometry/exact/integer.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "corpus/build.h"

namespace vericone::verify {

using exact::Integer, exact::Rational;

std::optional<double> as_double(const Rational& x) {
  Integer n = numerator(x);
  const Integer d = denominator(x);
  if (n == 0) return 0.0;
  if ((d & (d - 1)) != 0) return std::nullopt;
  const bool negative = n < 0;
  if (negative) n = -n;
  const unsigned up = lsb(n);
  n >>= up;
  const int e = static_cast<int>(up) - static_cast<int>(lsb(d)), bits = static_cast<int>(msb(n)) + 1;
  if (bits > 53 || e < -1074 || e + bits > 1024) return std::nullopt;
  const double value = std::ldexp(static_cast<double>(static_cast<std::int64_t>(n)), e);
  return negative ? -value : value;
}

bool CorpusCase::has(std::string_view field) const {
  return std::any_of(fields.begin(), fields.end(), [&](const CorpusField& f) { return f.name == field; });
}

const std::vector<Rational>& CorpusCase::values(std::string_view field) const {
  for (const CorpusField& f : fields)
    if (f.name == field) return f.values;
  throw std::runtime_error(label() + ": field " + std::string(field) + ": missing");
}

std::optional<std::vector<double>> CorpusCase::doubles(std::string_view field) const {
  std::vector<double> r;
  for (const Rational& x : values(field)) {
    const auto value = as_double(x);
    if (!value) return std::nullopt;
    r.push_back(*value);
  }
  return r;
}

std::string CorpusCase::label() const {
  return predicate + ' ' + family + ' ' + kind + " #" + std::to_string(index) + " (" + truth + ')';
}

namespace {
[[noreturn]] void wrong_size(const CorpusCase& c, const std::string& field, std::size_t wanted) {
  throw std::runtime_error(c.label() + ": field " + field + ": has " +
                           std::to_string(c.values(field).size()) + " numbers, must have " +
                           std::to_string(wanted));
}

void require_size(const CorpusCase& c, const std::string& field, std::size_t wanted) {
  if (c.values(field).size() != wanted) wrong_size(c, field, wanted);
}
}  // namespace

template <int D>
Eigen::Matrix<double, D, 1> CorpusCase::vector(const std::string& field) const {
  require_size(*this, field, D);
  const auto numbers = doubles(field);
  if (!numbers) throw std::runtime_error(label() + ": field " + field + ": is not in doubles");
  return Eigen::Matrix<double, D, 1>(numbers->data());
}

template <int D>
std::optional<BasicEllipsoid<D>> CorpusCase::body(const std::string& name) const {
  using Vector = Eigen::Matrix<double, D, 1>;
  require_size(*this, name + ".center", D);
  const auto center = doubles(name + ".center");
  if (!center) return std::nullopt;
  if (has(name + ".axes")) {
    require_size(*this, name + ".axes", D);
    const auto axes = doubles(name + ".axes");
    if (!axes) return std::nullopt;
    return BasicEllipsoid<D>::from_axes(Vector(center->data()), Vector(axes->data()));
  }
  require_size(*this, name + ".shape", D * (D + 1) / 2);
  const auto entries = doubles(name + ".shape");
  if (!entries) return std::nullopt;
  Eigen::Matrix<double, D, D> s;
  for (int i = 0, at = 0; i < D; ++i)
    for (int j = i; j < D; ++j) s(i, j) = s(j, i) = (*entries)[at++];
  return BasicEllipsoid<D>::from_shape(Vector(center->data()), s);
}

template <int D>
exact::RationalBody<D> CorpusCase::rational_body(const std::string& name) const {
  exact::RationalBody<D> r;
  require_size(*this, name + ".center", D);
  std::copy_n(values(name + ".center").begin(), D, r.center.begin());
  if (has(name + ".axes")) {
    require_size(*this, name + ".axes", D);
    for (int i = 0; i < D; ++i) r.shape[i][i] = values(name + ".axes")[i] * values(name + ".axes")[i];
    return r;
  }
  require_size(*this, name + ".shape", D * (D + 1) / 2);
  for (int i = 0, at = 0; i < D; ++i)
    for (int j = i; j < D; ++j) r.shape[i][j] = r.shape[j][i] = values(name + ".shape")[at++];
  return r;
}

int CorpusCase::dimension() const {
  for (const char* field : {"a.center", "w", "point"})
    if (has(field)) return static_cast<int>(values(field).size());
  throw std::runtime_error(label() + ": no field says the dimension");
}

template Eigen::Vector2d CorpusCase::vector<2>(const std::string&) const;
template Eigen::Vector3d CorpusCase::vector<3>(const std::string&) const;
template std::optional<Ellipse> CorpusCase::body<2>(const std::string&) const;
template std::optional<Ellipsoid> CorpusCase::body<3>(const std::string&) const;
template exact::RationalBody<2> CorpusCase::rational_body<2>(const std::string&) const;
template exact::RationalBody<3> CorpusCase::rational_body<3>(const std::string&) const;

std::vector<CorpusCase> corpus_cases(std::string_view predicate, std::uint64_t seed, int size) {
  if (predicate == "position") return corpus::position_cases(seed, size);
  if (predicate == "relation") return corpus::relation_cases(seed, size);
  if (predicate == "membership") return corpus::membership_cases(seed, size);
  if (predicate == "sector") return corpus::sector_cases(seed, size);
  if (predicate == "side") return corpus::side_cases(seed, size);
  if (predicate == "hull") return corpus::hull_cases(seed, size);
  if (predicate == "orifice") return corpus::orifice_cases(seed, size);
  if (predicate == "horizon") return corpus::horizon_cases(seed, size);
  throw std::invalid_argument("no corpus of \"" + std::string(predicate) + "\"");
}

}  // namespace vericone::verify
