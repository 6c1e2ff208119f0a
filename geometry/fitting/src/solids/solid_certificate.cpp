// SPDX-License-Identifier: BSD-3-Clause
//
// Solids as what quadrics have in common, in rational numbers: for certificates.
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/fitting/solids.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "proof/inside_text.h"
#include "solids/solid_check.h"

namespace vericone::fitting {
namespace {

using exact::Rational;
using Row = std::array<Rational, 4>;
using Matrix = std::array<Row, 4>;

/// Adds row row^T times a factor.
void add_square(Matrix& m, const Row& row, const Rational& factor) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) m[i][j] += factor * row[i] * row[j];
}

/// { x : x~^T M x~ <= 0 for each }; nothing of a capsule.
std::vector<Matrix> quadrics_of(const Solid& solid) {
  const std::array<Row, 3> y = SolidCheck(solid, 0).coordinates();
  const auto below = [&](const Rational& size, std::initializer_list<std::size_t> axes) {
    Matrix m{};
    for (const std::size_t k : axes) add_square(m, y[k], 1);
    m[3][3] -= size * size;
    return m;
  };
  const auto size = [&](int k) { return Rational(solid.sizes(k)); };
  switch (solid.kind) {
    case SolidKind::sphere:
      return {below(size(0), {0, 1, 2})};
    case SolidKind::cylinder:
      return {below(size(0), {0, 1}), below(size(1) / 2, {2})};
    case SolidKind::box:
      return {below(size(0), {0}), below(size(1), {1}), below(size(2), {2})};
    case SolidKind::capsule:
      return {};
    case SolidKind::ellipsoid:
      break;
  }
  Matrix m{};
  for (int k = 0; k < 3; ++k) add_square(m, y[std::size_t(k)], 1 / (size(k) * size(k)));
  m[3][3] -= 1;
  return {m};
}

void write_matrices(std::string& text, const std::vector<Matrix>& matrices) {
  std::string_view between = R"({"kind": "quadrics", "matrices": [)";
  for (const Matrix& m : matrices) {
    text += between;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        text += (j > 0 ? ", \"" : i > 0 ? "], [\"" : "[[\"") + m[i][j].str() + "\"";
    text += "]]";
    between = ", ";
  }
  text += "]}";
}

}  // namespace

InsideCertificate inside_certificate(const std::vector<Solid>& solids, const Sample& sample) {
  const auto is_capsule = [](const Solid& s) { return s.kind == SolidKind::capsule; };
  if (std::any_of(solids.begin(), solids.end(), is_capsule))
    return {{}, "a piece is a capsule, for which certificates have no word: --check itself proves it"};
  return inside_text(sample, homes_of(solids, sample), solids.size(), [&](std::string& text) {
    if (solids.size() == 1) return write_matrices(text, quadrics_of(solids.front()));
    std::string_view between = R"({"kind": "union", "pieces": [)";
    for (const Solid& solid : solids) {
      write_matrices(text += between, quadrics_of(solid));
      between = ", ";
    }
    text += "]}";
  });
}

}  // namespace vericone::fitting
