// SPDX-License-Identifier: BSD-3-Clause
#include "paper/claim.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "command/find_program.h"
#include "work/threads.h"

namespace vericone::paper {
namespace {

constexpr double kRounding = 1e-12;  // of degrees and components turned into others and back

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

/// Values that go into a run, read back from it: the same doubles up to rounding, relative.
bool read_back(const ClaimEntry& entry, const std::vector<double>& ours, Claim& claim) {
  claim.tolerance = kRounding;
  claim.tolerance_reason = "rounding of the units: relative 1e-12";
  bool same = true;
  std::string list;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    same =
        same && std::abs(ours[i] - entry.printed[i]) <= kRounding * std::max(1.0, std::abs(entry.printed[i]));
    list.append(i ? ", " : "").append(short_text(std::abs(ours[i]) < kRounding ? 0.0 : ours[i], 10));
  }
  claim.ours = with_unit(ours.size() > 1 ? "(" + list + ")" : list, entry.unit);
  if (ours.size() == 1) claim.ours_value = ours[0];
  if (claim.note.empty()) claim.note = "given; taken as printed";
  return same;
}

/// A number: compared with ours. Without one of ours (the event did not happen) it is not reproduced.
bool within(const ClaimEntry& entry, double ours, Measures& measures, Claim& claim) {
  const bool there = !std::isnan(ours);
  if (there) claim.ours_value = ours;
  claim.ours = there ? with_unit(short_text(ours), entry.unit) : "does not happen";
  claim.tolerance = measures.value(*entry.tolerance, *entry.values);
  claim.tolerance_reason = entry.tolerance_reason.written(measures, *entry.values);
  // The bound itself is within: printed values are halves of digits away from it in decimals, not in doubles.
  const double most = *claim.tolerance * (1 + 1e-9), off = there ? ours - *claim.printed_value : 0;
  return there && off <= most && off >= (claim.later ? -1e-9 : -most);
}

Verdict verdict_of_agreement(const Claim& claim) {
  switch (claim.kind) {
    case Kind::given:
      return Verdict::given;
    case Kind::arithmetic:
      return Verdict::consistent;
    case Kind::code:
      return Verdict::by_code;
    case Kind::result:
      break;
  }
  return claim.fits.empty() ? Verdict::reproduced : Verdict::fitted;
}

Claim measured(const ClaimEntry& entry, Measures& measures) {
  Claim claim = entry.claim;
  claim.note = entry.note.written(measures, *entry.values);
  bool holds = false;
  if (entry.holds) {
    claim.printed = entry.printed_text.written(measures, *entry.values);
    const double value = measures.value(*entry.holds, *entry.values);
    holds = !std::isnan(value) && value != 0;
    claim.tolerance_reason = "holds or not";
  } else {
    std::vector<double> ours;
    for (const Expression& formula : entry.ours) ours.push_back(measures.value(formula, *entry.values));
    holds = entry.printed.empty() ? within(entry, ours[0], measures, claim) : read_back(entry, ours, claim);
  }
  claim.ours += entry.text.written(measures, *entry.values);
  claim.verdict = holds ? verdict_of_agreement(claim) : entry.otherwise;
  if (entry.engaged) {
    const double engaged = measures.value(*entry.engaged, *entry.values);
    if (std::isnan(engaged) || engaged == 0) claim.verdict = Verdict::not_engaged;
  }
  return claim;
}

Json fits_json(const Claim& claim) {
  Json list = Json::array();
  for (const auto& fit : claim.fits) {
    Json chosen = Json::object();
    for (const Chosen& one : fit->chosen) chosen[one.name] = one.numbers;
    list.push_back({{"name", fit->name},
                    {"free", chosen},
                    {"free_numbers", fit->count()},
                    {"explains", fit->explains},
                    {"of", fit->claims},
                    {"not_measured", fit->unmeasured}});
  }
  return list;
}

Json origins_json(const Claim& claim) {
  Json list = Json::array();
  for (const std::string& run : claim.origins.runs) list.push_back("run " + run);
  for (const std::string& words : claim.origins.commands) list.push_back("vericone " + words);
  for (const std::string& other : claim.origins.others) list.push_back(other);
  return list;
}

bool is_there(const std::string& command) { return command.empty() || find_program(command).has_value(); }

}  // namespace

std::map<std::string, int> left_out(const ClaimsFile& file, const Which& which) {
  std::map<std::string, int> counts;
  for (const ClaimEntry& entry : file.entries)
    if (which(entry.claim) && !is_there(entry.needs)) ++counts[entry.needs];
  return counts;
}

std::vector<Claim> measure(ClaimsFile& file, Sources& sources, const Which& which) {
  // Pursuits use one processor each.
  std::vector<std::string> pursuits;
  for (const ClaimEntry& entry : file.entries)
    if (which(entry.claim) && is_there(entry.needs))
      std::copy_if(entry.claim.origins.commands.begin(), entry.claim.origins.commands.end(),
                   std::back_inserter(pursuits),
                   [](const auto& words) { return words.starts_with("pursue "); });
  sources.prepare(pursuits, threads_for(0), "command");
  Measures measures(sources);
  std::vector<Claim> claims;
  for (const auto& fit : file.fits) fit->explains = fit->claims = fit->unmeasured = 0;
  for (const ClaimEntry& entry : file.entries) {
    const bool now = which(entry.claim) && is_there(entry.needs);
    if (now) claims.push_back(measured(entry, measures));
    for (const auto& fit : entry.claim.fits) {
      ++(now ? fit->claims : fit->unmeasured);
      if (now) fit->explains += agrees(claims.back().verdict);
    }
  }
  return claims;
}

bool agrees(Verdict verdict) {
  return verdict == Verdict::given || verdict == Verdict::consistent || verdict == Verdict::reproduced ||
         verdict == Verdict::by_code || verdict == Verdict::fitted;
}

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::result:
      return "result";
    case Kind::code:
      return "by the authors' code";
    case Kind::given:
      return "given";
    case Kind::arithmetic:
      return "the source's own arithmetic";
  }
  return "?";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::given:
      return "given";
    case Verdict::consistent:
      return "consistent";
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::by_code:
      return "by the authors' code";
    case Verdict::fitted:
      return "fitted";
    case Verdict::not_engaged:
      return "not engaged";
    case Verdict::not_decided:
      return "not decided by what is printed";
    case Verdict::differs:
      return "differs";
    case Verdict::source_wrong:
      return "source wrong";
  }
  return "?";
}

int Fit::count() const {
  int count = 0;
  for (const Chosen& one : chosen) count += one.numbers;
  return count;
}

std::string Fit::text() const {
  std::string list;
  for (const Chosen& one : chosen) list.append(list.empty() ? "" : ", ").append(one.name);
  return list + ": " + std::to_string(count()) + (count() == 1 ? " free number" : " free numbers");
}

Json to_json(const Claim& claim) {
  return {{"id", claim.id},
          {"section", claim.section},
          {"figures", claim.figures},
          {"kind", to_string(claim.kind)},
          {"what", claim.what},
          {"printed", claim.printed},
          {"printed_value", number_or_null(claim.printed_value)},
          {"ours", claim.ours},
          {"ours_value", number_or_null(claim.ours_value)},
          {"tolerance", number_or_null(claim.tolerance)},
          {"tolerance_one_sided", claim.later},
          {"tolerance_reason", claim.tolerance_reason},
          {"verdict", to_string(claim.verdict)},
          {"measured_on", origins_json(claim)},
          {"fits", fits_json(claim)},
          {"note", claim.note}};
}

Json count_verdicts(const std::vector<Claim>& claims) {
  Json counts;
  for (const Kind kind : {Kind::result, Kind::code, Kind::arithmetic, Kind::given})
    for (const Verdict v : kVerdicts)
      counts[to_string(kind)][to_string(v)] = std::count_if(
          claims.begin(), claims.end(), [&](const Claim& c) { return c.verdict == v && c.kind == kind; });
  return counts;
}

}  // namespace vericone::paper
