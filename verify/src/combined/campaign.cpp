// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/combined/campaign.h>

#include <cstdio>

#include "combined/engagement.h"

namespace vericone::verify {
namespace {

std::string short_text(const char* format, double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, x);
  return buffer;
}

std::string cell(const Check& check) {
  std::string text = std::to_string(check.failed);
  text.append("/").append(std::to_string(check.tried));
  if (check.failed) text.append(" #").append(std::to_string(check.first_failed_index));
  return text;
}

std::string cell(const WorstFigure& worst) {
  return short_text("%.2g", worst.value).append(" #").append(std::to_string(worst.index));
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return short_text("%.2f", whole ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0);
}

std::string row(std::initializer_list<std::string> cells) {
  std::string out = "|";
  for (const std::string& c : cells) out.append(" ").append(c).append(" |");
  return out.append("\n");
}

}  // namespace

std::uint64_t CombinedFamilyReport::failures() const {
  std::uint64_t sum = 0;
  for (const Check* c :
       {&relation, &membership, &mirrored, &inner, &outer, &nested, &edges, &chords, &planes, &times})
    sum += c->failed;
  return sum;
}

CombinedFamilyReport run_combined_family(CombinedFamily family, const CombinedOptions& options) {
  CombinedFamilyReport report;
  report.family = family;
  report.seed = options.seed;
  for (std::uint64_t index = 0; index < options.cases; ++index) {
    if (options.go_on && !options.go_on(index)) break;
    ++report.cases;
    const CombinedPair pair = combined_pair(family, options.seed, index);
    CombinedEngagement engagement(pair, options, index, report);
    if (!engagement.relation()) continue;
    engagement.directions();
    engagement.cone();
    if (index % options.bodies_every == 0) {
      engagement.edges();
      engagement.chords();
      engagement.planes();
      engagement.times();
    }
  }
  if (report.disjoint > 0) {
    report.microseconds_membership /= static_cast<double>(report.disjoint);
    report.milliseconds_cone /= static_cast<double>(report.disjoint);
  }
  return report;
}

std::string to_markdown(std::span<const CombinedFamilyReport> reports) {
  std::string out =
      row({"family", "seed", "pairs", "relation", "membership", "exchanged", "inner", "outer", "nested",
           "edges", "chords", "planes", "times"}) +
      row({"---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---"});
  for (const CombinedFamilyReport& r : reports)
    out += row({name(r.family), std::to_string(r.seed), std::to_string(r.cases), cell(r.relation),
                cell(r.membership), cell(r.mirrored), cell(r.inner), cell(r.outer), cell(r.nested),
                cell(r.edges), cell(r.chords), cell(r.planes), cell(r.times)});
  out += "\n" +
         row({"family", "disjoint", "overlapping", "undecided", "no outer polyhedra", "proved in",
              "proved out", "unproved %", "in, no contact found %", "undecided %", "gap worst", "delay worst",
              "membership us", "cone ms"}) +
         row({"---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---",
              "---", "---"});
  for (const CombinedFamilyReport& r : reports)
    out += row({name(r.family), std::to_string(r.disjoint), std::to_string(r.overlapping),
                std::to_string(r.undecided), std::to_string(r.no_outer), std::to_string(r.proved_in),
                std::to_string(r.proved_out), percent(r.unproved, r.proved_in + r.proved_out + r.unproved),
                percent(r.confirmed.failed, r.confirmed.tried), percent(r.decided.failed, r.decided.tried),
                cell(r.gap), cell(r.delay), short_text("%.1f", r.microseconds_membership),
                short_text("%.1f", r.milliseconds_cone)});
  for (const CombinedFamilyReport& r : reports)
    if (!r.first_failure.empty()) out += "\n" + r.first_failure + "\n";
  return out;
}

}  // namespace vericone::verify
