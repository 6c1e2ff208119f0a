// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints what must not depend on compiler options or on the machine: the answer of every rung on every case
// of the corpus, 100,000 verdicts, and constructions in hexadecimal. Built several times with different
// options (options_test.cpp compares) and for other machines (scripts/machines does).
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/tracked.h>
#include <vericone/verify/corpus.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "verify/corpus/corpus_answers.h"

namespace {

using namespace vericone;
using namespace vericone::verify;

std::string text(const std::optional<std::string>& answer) { return answer.value_or("-"); }

void print_answers(const CorpusCase& c) {
  for (const RungAnswers& r : answers(c))
    std::printf("answer %s | %s %s %s %s %s %s\n", (c.label() + ' ' + r.what).c_str(), text(r.triage).c_str(),
                text(r.interval).c_str(), text(r.exact).c_str(), text(r.rational).c_str(),
                text(r.ladder).c_str(), r.rung ? to_string(*r.rung) : "-");
}

/// Rounded operations of IEEE 754 alone, as the first two rungs use them.
void print_arithmetic(const CorpusCase& c) {
  Interval sum = 0;
  Tracked tracked = Tracked::of(0.0);
  double previous = 1;
  for (const CorpusField& field : c.fields)
    for (const auto& x : field.values) {
      const auto value = as_double(x);
      if (!value || !(std::abs(*value) < 1e100) || std::abs(*value) < 1e-100) continue;
      sum = sum + Interval(*value) * Interval(previous) / Interval(3.0) - sqrt(square(Interval(previous)));
      tracked = tracked + Tracked::of(*value) * Tracked::of(previous) - Tracked::of(previous);
      previous = *value;
    }
  std::printf("arithmetic %s | %a %a %a %a\n", c.label().c_str(), sum.mid(), sum.rad(), tracked.value(),
              tracked.magnitude());
}

/// Constructions use Eigen, whose vectors are as long as the processor's: sums may be taken in another order.
void print_constructions(const CorpusCase& c) {
  if (c.predicate == "membership") {
    const auto a = c.body<3>("a"), b = c.body<3>("b");
    if (!a || !b) return;
    const TrueCone cone = true_cone(*a, *b, 8);
    for (const BoundarySample& s : cone.boundary)
      std::printf("direction %s | %a %a %a\n", c.label().c_str(), s.direction.x(), s.direction.y(),
                  s.direction.z());
  } else if (c.predicate == "sector") {
    const auto a = c.body<2>("a"), b = c.body<2>("b");
    if (!a || !b) return;
    const Sector sector = sector_by_support(*a, *b);
    std::printf("angles %s | %a %a\n", c.label().c_str(), sector.psi, sector.theta_b);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  for (const auto predicate : kCorpusPredicates)
    for (const CorpusCase& c :
         read_corpus(std::filesystem::path(argv[1]) / (std::string(predicate) + ".txt"))) {
      print_answers(c);
      if (c.index % 4 == 0) print_arithmetic(c);
      if (c.family == "tangent") print_constructions(c);
    }
  print_random_answers();
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
