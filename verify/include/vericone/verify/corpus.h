// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cases for the exact predicates whose answers are known: exactly degenerate ones built from integers, and
// their neighbours among the doubles. The constructions share no formula with the predicates: a common
// supporting plane, a homothety or convexity says the truth (docs/explanation/corpus.md).
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/exact/rational.h>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vericone::verify {

struct CorpusField {
  std::string name;
  std::vector<exact::Rational> values;
  bool operator==(const CorpusField&) const = default;
};

struct CorpusCase {
  std::string predicate;  // one of kCorpusPredicates
  std::string family;     // the construction: tangent, nudged, ulps, ...
  std::string kind;  // the map applied to it: general, cayley, ..., and the setting: thin, tiny, far, ...
  std::uint64_t index = 0;  // number of the construction; cases that share it are neighbours
  std::string truth;        // the answer, in the words of the predicate
  std::string source;       // construction: known from how it was built; exact: evaluated in integers
  std::string rung;         // the rung that has to decide; "any" where none is prescribed
  std::vector<CorpusField> fields;

  bool operator==(const CorpusCase&) const = default;

  /// Throws std::runtime_error naming the field where it is missing or has another number of values.
  [[nodiscard]] const std::vector<exact::Rational>& values(std::string_view field) const;
  [[nodiscard]] bool has(std::string_view field) const;

  /// The double that is exactly the number; empty where a field holds a number that no double is.
  [[nodiscard]] std::optional<std::vector<double>> doubles(std::string_view field) const;

  /// The body "NAME.center" with "NAME.shape" (upper triangle by rows) or "NAME.axes" (along the coordinate
  /// axes), built as a user would: by from_shape or from_axes. Empty where doubles do not hold it.
  template <int D>
  [[nodiscard]] std::optional<BasicEllipsoid<D>> body(const std::string& name) const;

  /// The same in rational numbers; always there.
  template <int D>
  [[nodiscard]] exact::RationalBody<D> rational_body(const std::string& name) const;

  /// D numbers as a vector; the field must hold doubles (std::runtime_error).
  template <int D>
  [[nodiscard]] Eigen::Matrix<double, D, 1> vector(const std::string& field) const;

  /// 2 or 3, from the fields.
  [[nodiscard]] int dimension() const;

  /// "predicate family kind #index", for messages.
  [[nodiscard]] std::string label() const;
};

/// Truths: position: disjoint, touching, crossing, a_inside_b, b_inside_a, a_inside_b_touching,
/// b_inside_a_touching, equal; relation: disjoint, touching, overlapping; membership, sector, hull,
/// horizon: in, on, out; orifice: passes, grazes, blocked; side: negative, zero, positive.
inline constexpr std::array<std::string_view, 8> kCorpusPredicates = {
    "position", "relation", "membership", "sector", "side", "hull", "orifice", "horizon"};

/// All cases of one predicate, always in the same order; depends on nothing but the arguments. `size` scales
/// the number of constructions: 1 for the file in tests/corpus, more for campaigns. Takes a few tenths of a
/// second at size 1. Throws std::invalid_argument for an unknown predicate.
[[nodiscard]] std::vector<CorpusCase> corpus_cases(std::string_view predicate, std::uint64_t seed,
                                                   int size = 1);

/// The double that is exactly x, if there is one.
[[nodiscard]] std::optional<double> as_double(const exact::Rational& x);

// The corpus as text: one case a line, numbers exact. The format is described in tests/corpus/README.md.

/// "7", "-3/8", "5*2^-120": the shortest of these that is exact.
[[nodiscard]] std::string number_text(const exact::Rational& x);

/// The inverse; also reads unreduced fractions. Throws std::runtime_error with what is wrong.
[[nodiscard]] exact::Rational parse_number(std::string_view text);

[[nodiscard]] std::string case_line(const CorpusCase& c);

/// A whole file: header and cases.
[[nodiscard]] std::string corpus_text(std::string_view predicate, std::uint64_t seed);

/// Throws std::runtime_error "NAME:LINE: field FIELD: what is wrong".
std::vector<CorpusCase> read_corpus(std::istream& in, const std::string& name);
[[nodiscard]] std::vector<CorpusCase> read_corpus(const std::filesystem::path& file);

}  // namespace vericone::verify
