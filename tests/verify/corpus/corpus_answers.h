// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the library answers on a case of the corpus, rung by rung.
#pragma once

#include <vericone/geometry/sign.h>
#include <vericone/verify/corpus.h>
#include <optional>
#include <string>
#include <vector>

namespace vericone::verify {

/// All in words, "disjoint" or "negative"; empty where a rung has no answer or the predicate has no such
/// rung.
struct RungAnswers {
  std::string what;   // the predicate asked
  std::string truth;  // of the case, in its words
  std::optional<std::string> triage, interval, exact, rational;
  std::optional<std::string> ladder;  // by the public function
  std::optional<Rung> rung;           // that decided it
  std::optional<std::string> naive;   // doubles without a bound
};

/// Of every predicate that a case says something about. A case that doubles do not hold has rational answers
/// alone.
std::vector<RungAnswers> answers(const CorpusCase& c);

/// Lines about 100,000 verdicts of random pairs of all kinds, and about contacts and distances: sums over
/// their bits.
void print_random_answers();

}  // namespace vericone::verify
