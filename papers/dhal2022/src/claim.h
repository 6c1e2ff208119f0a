// SPDX-License-Identifier: BSD-3-Clause
//
// What the source prints, and what we get (docs/papers.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"

namespace vericone::dhal2022 {

enum class Verdict : std::uint8_t {
  given,         // goes into the run and was read back from it as printed
  reproduced,    // ours agrees within the tolerance
  fitted,        // it agrees because a value that is not printed was chosen so: consistent, no more
  not_engaged,   // nothing was commanded against that obstacle: what happened says nothing about the law
  not_decided,   // it does not agree, and ours rests on values that the source does not print
  differs,       // it does not agree, and what is printed decides
  source_wrong,  // what is printed contradicts itself or is shown wrong
};
inline constexpr Verdict kVerdicts[] = {Verdict::given,       Verdict::reproduced,  Verdict::fitted,
                                        Verdict::not_engaged, Verdict::not_decided, Verdict::differs,
                                        Verdict::source_wrong};
const char* to_string(Verdict verdict);

/// Values that the source does not print, chosen so that printed numbers come out: how many, by name.
struct Fit {
  std::string name;
  std::vector<std::pair<std::string, int>> free;

  int count() const;
  std::string text() const;  // "K, w: 2 free numbers"
};

struct Claim {
  std::string id;       // "5.4.1/y-0"
  std::string section;  // of the source
  std::vector<std::string> figures;
  bool given = false;  // a number that goes into the run; otherwise one that comes out
  std::string what;
  std::string printed, ours;  // as text, with units
  std::optional<double> printed_value, ours_value, tolerance;
  bool later = false;  // the tolerance is one-sided
  std::string tolerance_reason;
  Verdict verdict = Verdict::differs;
  std::string note;
  const Fit* fit = nullptr;  // that it belongs to, of static life
  /// Of the printed numbers and statements of that fit, those that come out, and all: see count_fits.
  int fit_explains = 0, fit_claims = 0;
};

/// A claim without what is measured.
struct Printed {
  std::string id, section;
  std::vector<std::string> figures;
  std::string what, note;
  /// Ours rests on values that are not printed: a disagreement decides nothing.
  bool rests_on_assumed = false;
  /// Ours agrees, if it does, because this was chosen.
  const Fit* fit = nullptr;
};

struct Tolerance {
  double value = 0;
  std::string reason;
  bool later = false;  // one-sided: from the printed value to that much later
};

/// Half a unit of the last of `digits` printed decimals.
Tolerance half_a_digit(int digits);
/// That, and a guidance step: of times that one fitted value has to meet together.
Tolerance half_a_digit_and_step(int digits, double step);

/// A number: compared with ours. Without one of ours (the event did not happen) it is not reproduced.
Claim number(const Printed& printed, double value, const std::string& text, const std::string& unit,
             std::optional<double> ours, const Tolerance& tolerance);

/// A statement: ours holds or does not, `ours` says by which measured numbers.
Claim statement(const Printed& printed, const std::string& text, bool holds, const std::string& ours);

/// Values that go into a run, read back from it: the same doubles up to `rounding`, relative.
Claim given(const Printed& printed, const std::string& text, const std::vector<double>& values,
            const std::vector<double>& ours, const std::string& unit);

/// A statement about what the scenario orders, read back from its run.
Claim ordered(const Printed& printed, const std::string& text, bool holds, const std::string& ours);

/// What is printed is wrong where `holds` is false: ours is the evidence.
Claim printed_right(const Printed& printed, const std::string& text, bool holds, const std::string& ours);

/// Sets fit_explains and fit_claims of all.
void count_fits(std::vector<Claim>& claims);

Json to_json(const Claim& claim);

/// At most `digits` significant digits.
std::string short_text(double value, int digits = 5);
/// "2.13 s".
std::string seconds_text(double t);

}  // namespace vericone::dhal2022
