// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corpus of tests/corpus: that its generators still write it, that it says what is wrong with a damaged
// file, and that every rung of every predicate holds on it.
#include <gtest/gtest.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/verify/corpus.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>

#include "verify/corpus/corpus_answers.h"
#include "verify/corpus/corpus_seed.h"

namespace vericone::verify::corpus_test {
namespace {

std::filesystem::path corpus_path(std::string_view predicate) {
  return std::filesystem::path(VERICONE_CORPUS) / (std::string(predicate) + ".txt");
}

class CorpusOf : public ::testing::TestWithParam<std::string_view> {};

TEST_P(CorpusOf, IsWrittenAgainByteForByte) {
  std::ifstream in(corpus_path(GetParam()), std::ios::binary);
  const std::string kept{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  // Not EXPECT_EQ: a difference in a file of this size is unreadable.
  EXPECT_TRUE(kept == corpus_text(GetParam(), kCorpusSeed)) << "run write_corpus tests/corpus";
}

TEST_P(CorpusOf, ReadsBackAsGenerated) {
  EXPECT_TRUE(read_corpus(corpus_path(GetParam())) == corpus_cases(GetParam(), kCorpusSeed));
}

TEST_P(CorpusOf, DependsOnTheSeedAndStaysTheSameWhenExtended) {
  EXPECT_FALSE(corpus_cases(GetParam(), 1) == corpus_cases(GetParam(), 2));
  const auto one = corpus_cases(GetParam(), 1, 1), two = corpus_cases(GetParam(), 1, 2);
  ASSERT_LT(one.size(), two.size());
  EXPECT_TRUE(std::equal(one.begin(), one.end(), two.begin()));
}

struct Tally {
  int cases = 0, degenerate = 0, naive = 0, naive_wrong = 0, naive_generic = 0, naive_generic_wrong = 0;
  int triage = 0, interval = 0, rational_only = 0;
};

bool is_degenerate(const std::string& truth) {
  return truth == "on" || truth == "grazes" || truth.ends_with("touching") || truth == "zero" ||
         truth == "equal";
}

/// Holds every rung against the truth.
Tally hold(std::string_view predicate, std::string_view what) {
  Tally tally;
  for (const CorpusCase& c : read_corpus(corpus_path(predicate))) {
    SCOPED_TRACE(case_line(c));
    for (const RungAnswers& r : answers(c)) {
      if (r.what != what) continue;
      ++tally.cases;
      const bool degenerate = is_degenerate(r.truth);
      tally.degenerate += degenerate;
      for (const auto& answer : {r.triage, r.interval, r.exact, r.rational, r.ladder})
        if (answer) {
          EXPECT_EQ(*answer, r.truth);
        }
      EXPECT_TRUE(r.ladder || r.rational);
      if (!r.ladder) {
        ++tally.rational_only;
        continue;
      }
      EXPECT_TRUE(r.exact);
      tally.triage += r.triage.has_value();
      tally.interval += r.interval.has_value();
      if (degenerate) {  // no arithmetic with a bound can tell
        EXPECT_FALSE(r.triage || r.interval);
        EXPECT_EQ(c.rung, "exact");
      }
      if (r.rung) {
        if (c.rung != "any" && c.predicate == r.what) {
          EXPECT_EQ(to_string(*r.rung), c.rung);
        }
        EXPECT_EQ(*r.rung, r.triage ? Rung::triage : r.interval ? Rung::interval : Rung::exact);
      }
      if (r.naive) {
        const bool wrong = *r.naive != r.truth;
        ++tally.naive;
        tally.naive_wrong += wrong;
        tally.naive_generic += !degenerate;
        tally.naive_generic_wrong += wrong && !degenerate;
      }
    }
  }
  std::cout << what << ": " << tally.cases << " cases, " << tally.degenerate << " degenerate, "
            << tally.rational_only << " in rationals only; decided by triage " << tally.triage
            << ", by interval " << tally.interval << "; naive doubles wrong on " << tally.naive_wrong
            << " of " << tally.naive << ", of them not degenerate " << tally.naive_generic_wrong << " of "
            << tally.naive_generic << '\n';
  return tally;
}

// The lower bounds on the share that plain doubles get wrong are what makes the corpus worth having; they
// are well below what is printed.
TEST(Corpus, HoldsTheRelationOfBodiesThatTouch) {
  const Tally t = hold("position", "relation");
  EXPECT_GE(t.cases, 600);
  EXPECT_GE(t.degenerate, 60);
  EXPECT_GE(t.naive_wrong, t.naive / 20);
}

TEST(Corpus, HoldsPositionsNestingIncluded) {
  const Tally t = hold("position", "position");
  EXPECT_GE(t.cases, 600);
  EXPECT_GE(t.degenerate, 200);
}

TEST(Corpus, HoldsTheRelationOfNeighbours) {
  const Tally t = hold("relation", "relation");
  EXPECT_GE(t.cases, 300);
  EXPECT_GE(t.naive_wrong, t.naive / 10);
}

TEST(Corpus, HoldsMembershipInCones) {
  const Tally t = hold("membership", "membership");
  EXPECT_GE(t.cases, 600);
  EXPECT_GE(t.degenerate, 80);
  EXPECT_GE(t.rational_only, 5);
  EXPECT_GE(t.naive_wrong, t.naive / 8);
  EXPECT_GE(t.naive_generic_wrong, t.naive_generic / 20);
}

TEST(Corpus, HoldsMembershipInSectors) {
  const Tally t = hold("sector", "sector");
  EXPECT_GE(t.cases, 600);
  EXPECT_GE(t.degenerate, 100);
  EXPECT_GE(t.naive_wrong, t.naive / 8);
}

TEST(Corpus, HoldsMembershipInConesOfHulls) {
  const Tally t = hold("hull", "hull");
  EXPECT_GE(t.cases, 500);
  EXPECT_GE(t.degenerate, 100);
  EXPECT_GE(t.naive_wrong, t.naive / 10);
}

TEST(Corpus, HoldsPassageThroughOpenings) {
  const Tally t = hold("orifice", "orifice");
  EXPECT_GE(t.cases, 250);
  EXPECT_GE(t.degenerate, 50);
}

TEST(Corpus, HoldsContactsAtTheEndsOfAHorizon) {
  const Tally t = hold("horizon", "horizon");
  EXPECT_GE(t.cases, 250);
  EXPECT_GE(t.degenerate, 100);
  EXPECT_GE(t.naive_wrong, t.naive / 10);
}

TEST(Corpus, HoldsTheSideOfPoints) {
  const Tally t = hold("side", "side");
  EXPECT_GE(t.cases, 400);
  EXPECT_GE(t.degenerate, 80);
  EXPECT_GE(t.naive_wrong, t.naive / 10);
}

// Every family of the issue is there: kinds of maps, settings, constructions.
TEST_P(CorpusOf, HasAllMapsAndSettings) {
  std::map<std::string, int> seen;
  for (const CorpusCase& c : read_corpus(corpus_path(GetParam()))) {
    std::istringstream parts(c.kind);
    for (std::string part; std::getline(parts, part, '/');) ++seen[part];
    EXPECT_EQ(c.predicate, GetParam());
  }
  std::vector<std::string> needed = {"pythagorean", "cayley", "axes", "plain",
                                     "tiny",        "huge",   "far9", "far15"};
  if (GetParam() != "orifice") needed.insert(needed.end(), {"general", "wide", "thin", "needle"});
  if (GetParam() == "side") std::erase(needed, "far15");
  for (const std::string& kind : needed) EXPECT_GE(seen[kind], 4) << kind;
}

INSTANTIATE_TEST_SUITE_P(Predicates, CorpusOf, ::testing::ValuesIn(kCorpusPredicates),
                         [](const auto& p) { return std::string(p.param); });

TEST(Corpus, StaysSmall) {
  std::uintmax_t bytes = 0;
  for (const auto predicate : kCorpusPredicates) bytes += std::filesystem::file_size(corpus_path(predicate));
  EXPECT_LT(bytes, 2U << 20);
}

TEST(CorpusFile, NumbersAreShortAndExact) {
  using exact::Rational;
  const auto two = [](int e) { return parse_number("1*2^" + std::to_string(e)); };
  const std::vector<std::pair<Rational, std::string>> texts = {{Rational(0), "0"},
                                                               {Rational(-12), "-12"},
                                                               {Rational(3, 8), "3/8"},
                                                               {Rational(-3, 7), "-3/7"},
                                                               {Rational(5) * two(-120), "5*2^-120"},
                                                               {Rational(-12) * two(498), "-3*2^500"}};
  for (const auto& [number, text] : texts) {
    EXPECT_EQ(number_text(number), text);
    EXPECT_EQ(parse_number(text), number);
  }
  EXPECT_EQ(parse_number("010"), 10) << "not octal";
  EXPECT_EQ(parse_number("6/16"), Rational(3, 8));
  EXPECT_EQ(as_double(parse_number("1*2^-1074")), 0x1p-1074);
  EXPECT_EQ(as_double(parse_number("1*2^-1075")), std::nullopt);
  EXPECT_EQ(as_double(parse_number("1*2^1024")), std::nullopt);
  EXPECT_EQ(as_double(parse_number("9007199254740993")), std::nullopt);
  EXPECT_EQ(as_double(parse_number("-9007199254740994")), -9007199254740994.0);
  EXPECT_EQ(as_double(parse_number("1/3")), std::nullopt);
}

std::string error_of(const std::string& content) {
  std::istringstream in(content);
  try {
    read_corpus(in, "f.txt");
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(CorpusFile, SaysWhatIsWrongAndWhere) {
  const std::string head = "# a corpus\nside surface plain 1 zero construction ";
  EXPECT_EQ(error_of(head + "exact point=1,2 a.center=0,0\r\n\n"), "");
  EXPECT_EQ(error_of(head + "exact point=1,x"), "f.txt:2: field point: \"x\" is not an integer");
  EXPECT_EQ(error_of(head + "exact point=1,"), "f.txt:2: field point: \"\" is not an integer");
  EXPECT_EQ(error_of(head + "exact point=1/0"),
            "f.txt:2: field point: \"1/0\" has a denominator that is not positive");
  EXPECT_EQ(error_of(head + "exact point=1*2^99999"),
            "f.txt:2: field point: \"99999\" is not an exponent between -5000 and 5000");
  EXPECT_EQ(error_of(head + "exact point=1 point=2"), "f.txt:2: field point: given twice");
  EXPECT_EQ(error_of(head + "exact point"), "f.txt:2: field point: NAME=NUMBER,NUMBER,... is needed");
  EXPECT_EQ(error_of(head + "fast point=1"),
            "f.txt:2: field rung: \"fast\" is none of any, triage, interval, exact");
  EXPECT_EQ(error_of("side surface plain one zero construction exact point=1"),
            "f.txt:1: field index: \"one\" is not a number");
  EXPECT_EQ(error_of("sides surface plain 1 zero construction exact point=1"),
            "f.txt:1: field predicate: \"sides\" is not known");
  EXPECT_EQ(error_of("side surface plain 1 zero guess exact point=1"),
            "f.txt:1: field source: \"guess\" is neither construction nor exact");
  EXPECT_EQ(error_of("side surface plain 1 zero"),
            "f.txt:1: field truth: the line ends after it; seven columns and the numbers are needed");
  EXPECT_THROW(read_corpus(std::filesystem::path("no/such/file")), std::runtime_error);
  std::istringstream in(head + "exact point=1,2");
  const CorpusCase c = read_corpus(in, "f.txt").front();
  EXPECT_THROW(static_cast<void>(c.values("w")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(c.vector<3>("point")), std::runtime_error);
}

}  // namespace
}  // namespace vericone::verify::corpus_test
