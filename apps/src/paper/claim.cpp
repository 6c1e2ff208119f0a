// SPDX-License-Identifier: BSD-3-Clause
#include "paper/claim.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "command/find_program.h"

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
bool agrees(const ClaimEntry& entry, double ours, Measures& measures, Claim& claim) {
  const bool there = !std::isnan(ours);
  if (there) claim.ours_value = ours;
  claim.ours = there ? with_unit(short_text(ours), entry.unit) : "does not happen";
  claim.tolerance = measures.value(*entry.tolerance, *entry.values);
  claim.tolerance_reason = entry.tolerance_reason.written(measures, *entry.values);
  // The bound itself is within: printed values are halves of digits away from it in decimals, not in doubles.
  const double most = *claim.tolerance * (1 + 1e-9), off = there ? ours - *claim.printed_value : 0;
  return there && off <= most && off >= (claim.later ? -1e-9 : -most);
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
    holds = entry.printed.empty() ? agrees(entry, ours[0], measures, claim) : read_back(entry, ours, claim);
  }
  claim.ours += entry.text.written(measures, *entry.values);
  if (holds)
    claim.verdict = claim.given ? Verdict::given : claim.fit ? Verdict::fitted : Verdict::reproduced;
  else
    claim.verdict = entry.otherwise;
  if (entry.engaged) {
    const double engaged = measures.value(*entry.engaged, *entry.values);
    if (std::isnan(engaged) || engaged == 0) claim.verdict = Verdict::not_engaged;
  }
  return claim;
}

Json fit_json(const Claim& claim) {
  if (!claim.fit) return {};
  Json free = Json::object();
  for (const auto& [name, numbers] : claim.fit->free) free[name] = numbers;
  return {{"name", claim.fit->name},
          {"free", free},
          {"free_numbers", claim.fit->count()},
          {"explains", claim.fit->explains},
          {"of", claim.fit->claims}};
}

bool is_there(const std::string& command) { return command.empty() || find_program(command).has_value(); }

}  // namespace

std::map<std::string, int> left_out(const ClaimsFile& file) {
  std::map<std::string, int> counts;
  for (const ClaimEntry& entry : file.entries)
    if (!is_there(entry.needs)) ++counts[entry.needs];
  return counts;
}

std::vector<Claim> measure(ClaimsFile& file, Sources& sources) {
  Measures measures(sources);
  std::vector<Claim> claims;
  for (const ClaimEntry& entry : file.entries)
    if (is_there(entry.needs)) claims.push_back(measured(entry, measures));
  for (const Claim& claim : claims)
    if (claim.fit) claim.fit->explains = claim.fit->claims = 0;
  for (const Claim& claim : claims) {
    if (!claim.fit) continue;
    ++claim.fit->claims;
    claim.fit->explains += claim.verdict == Verdict::fitted;
  }
  return claims;
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::given:
      return "given";
    case Verdict::reproduced:
      return "reproduced";
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
  for (const auto& value : free) count += value.second;
  return count;
}

std::string Fit::text() const {
  std::string list;
  for (const auto& value : free) list.append(list.empty() ? "" : ", ").append(value.first);
  return list + ": " + std::to_string(count()) + (count() == 1 ? " free number" : " free numbers");
}

Json to_json(const Claim& claim) {
  return {{"id", claim.id},
          {"section", claim.section},
          {"figures", claim.figures},
          {"kind", claim.given ? "given" : "result"},
          {"what", claim.what},
          {"printed", claim.printed},
          {"printed_value", number_or_null(claim.printed_value)},
          {"ours", claim.ours},
          {"ours_value", number_or_null(claim.ours_value)},
          {"tolerance", number_or_null(claim.tolerance)},
          {"tolerance_one_sided", claim.later},
          {"tolerance_reason", claim.tolerance_reason},
          {"verdict", to_string(claim.verdict)},
          {"fit", fit_json(claim)},
          {"note", claim.note}};
}

Json count_verdicts(const std::vector<Claim>& claims) {
  Json counts;
  for (const char* kind : {"results", "given"})
    for (const Verdict v : kVerdicts)
      counts[kind][to_string(v)] = std::count_if(claims.begin(), claims.end(), [&](const Claim& c) {
        return c.verdict == v && c.given == (std::string(kind) == "given");
      });
  return counts;
}

}  // namespace vericone::paper
