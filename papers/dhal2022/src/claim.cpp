// SPDX-License-Identifier: BSD-3-Clause
#include "claim.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "json/json_value.h"

namespace vericone::dhal2022 {
namespace {

constexpr double kRounding = 1e-12;  // of degrees and components turned into others and back

Claim claim_of(const Printed& printed, const std::string& text) {
  Claim claim;
  claim.id = printed.id;
  claim.section = printed.section;
  claim.figures = printed.figures;
  claim.what = printed.what;
  claim.note = printed.note;
  claim.fit = printed.fit;
  claim.printed = text;
  return claim;
}

Verdict verdict_of(const Printed& printed, bool holds) {
  if (holds) return printed.fit ? Verdict::fitted : Verdict::reproduced;
  return printed.rests_on_assumed ? Verdict::not_decided : Verdict::differs;
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace

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

std::string short_text(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value == 0 ? 0.0 : value);
  return text;
}

std::string seconds_text(double t) { return short_text(t, 4) + " s"; }

Tolerance half_a_digit(int digits) {
  return {0.5 * std::pow(10.0, -digits), "half a unit of the last printed digit"};
}

Tolerance half_a_digit_and_step(int digits, double step) {
  return {0.5 * std::pow(10.0, -digits) + step, "half a unit of the last printed digit, and one step of " +
                                                    short_text(step) +
                                                    " s: one fitted value has to meet several"};
}

Claim number(const Printed& printed, double value, const std::string& text, const std::string& unit,
             std::optional<double> ours, const Tolerance& tolerance) {
  Claim claim = claim_of(printed, with_unit(text, unit));
  claim.printed_value = value;
  claim.ours_value = ours;
  claim.ours = ours ? with_unit(short_text(*ours), unit) : "does not happen";
  claim.tolerance = tolerance.value;
  claim.tolerance_reason = tolerance.reason;
  // The bound itself is within: printed values are halves of digits away from it in decimals, not in doubles.
  claim.later = tolerance.later;
  const double most = tolerance.value * (1 + 1e-9), off = ours ? *ours - value : 0;
  claim.verdict = verdict_of(printed, ours && off <= most && off >= (tolerance.later ? -1e-9 : -most));
  return claim;
}

Claim statement(const Printed& printed, const std::string& text, bool holds, const std::string& ours) {
  Claim claim = claim_of(printed, text);
  claim.ours = ours;
  claim.tolerance_reason = "holds or not";
  claim.verdict = verdict_of(printed, holds);
  return claim;
}

Claim given(const Printed& printed, const std::string& text, const std::vector<double>& values,
            const std::vector<double>& ours, const std::string& unit) {
  if (values.size() != ours.size()) throw std::logic_error(printed.id + ": not as many values as printed");
  Claim claim = claim_of(printed, with_unit(text, unit));
  claim.given = true;
  claim.tolerance = kRounding;
  claim.tolerance_reason = "rounding of the units: relative 1e-12";
  bool same = true;
  std::string list;
  for (std::size_t i = 0; i < values.size(); ++i) {
    same = same && std::abs(ours[i] - values[i]) <= kRounding * std::max(1.0, std::abs(values[i]));
    list.append(i ? ", " : "").append(short_text(std::abs(ours[i]) < kRounding ? 0.0 : ours[i], 10));
  }
  claim.ours = with_unit(values.size() > 1 ? "(" + list + ")" : list, unit);
  if (values.size() == 1) {
    claim.printed_value = values[0];
    claim.ours_value = ours[0];
  }
  claim.verdict = same ? Verdict::given : Verdict::differs;
  if (claim.note.empty()) claim.note = "given; taken as printed";
  return claim;
}

Claim ordered(const Printed& printed, const std::string& text, bool holds, const std::string& ours) {
  Claim claim = statement(printed, text, holds, ours);
  claim.given = true;
  claim.verdict = holds ? Verdict::given : Verdict::differs;
  return claim;
}

Claim printed_right(const Printed& printed, const std::string& text, bool holds, const std::string& ours) {
  Claim claim = statement(printed, text, holds, ours);
  if (!holds) claim.verdict = Verdict::source_wrong;
  return claim;
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

void count_fits(std::vector<Claim>& claims) {
  for (Claim& claim : claims) {
    if (claim.fit == nullptr) continue;
    claim.fit_explains = claim.fit_claims = 0;
    for (const Claim& other : claims) {
      if (other.fit != claim.fit) continue;
      ++claim.fit_claims;
      claim.fit_explains += other.verdict == Verdict::fitted;
    }
  }
}

namespace {

Json fit_json(const Claim& claim) {
  if (claim.fit == nullptr) return {};
  Json free = Json::object();
  for (const auto& [name, numbers] : claim.fit->free) free[name] = numbers;
  return {{"name", claim.fit->name},
          {"free", free},
          {"free_numbers", claim.fit->count()},
          {"explains", claim.fit_explains},
          {"of", claim.fit_claims}};
}

}  // namespace

Json to_json(const Claim& claim) {
  const auto optional = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  return {{"id", claim.id},
          {"section", claim.section},
          {"figures", claim.figures},
          {"kind", claim.given ? "given" : "result"},
          {"what", claim.what},
          {"printed", claim.printed},
          {"printed_value", optional(claim.printed_value)},
          {"ours", claim.ours},
          {"ours_value", optional(claim.ours_value)},
          {"tolerance", optional(claim.tolerance)},
          {"tolerance_one_sided", claim.later},
          {"tolerance_reason", claim.tolerance_reason},
          {"verdict", to_string(claim.verdict)},
          {"fit", fit_json(claim)},
          {"note", claim.note}};
}

}  // namespace vericone::dhal2022
