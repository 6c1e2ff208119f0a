// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corpus as text: one case a line, numbers exact. The format is described in tests/corpus/README.md.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/verify/corpus.h>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace vericone::verify {

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
