// SPDX-License-Identifier: BSD-3-Clause
//
// What the source prints, and what we get (docs/papers.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "json_value.h"

namespace vericone::dhal2022 {

enum class Verdict : std::uint8_t {
  reproduced,    // ours agrees within the tolerance
  differs,       // it does not, and what is printed decides
  not_decided,   // it does not, and ours rests on values that the source does not print
  source_wrong,  // what is printed contradicts itself or is shown wrong
};
const char* to_string(Verdict verdict);

struct Claim {
  std::string id;       // "5.4.1/y-0"
  std::string section;  // of the source
  std::vector<std::string> figures;
  bool given = false;  // a number that goes into the run; otherwise one that comes out
  std::string what;
  std::string printed, ours;  // as text, with units
  std::optional<double> printed_value, ours_value, tolerance;
  std::string tolerance_reason;
  Verdict verdict = Verdict::differs;
  std::string note;
};

/// A claim without what is measured.
struct Printed {
  std::string id, section;
  std::vector<std::string> figures;
  std::string what, note;
  /// Ours rests on values that are not printed: a disagreement decides nothing.
  bool rests_on_assumed = false;
};

struct Tolerance {
  double value = 0;
  std::string reason;
};

/// Half a unit of the last of `digits` printed decimals.
Tolerance half_a_digit(int digits);
/// That, and a guidance step, between two of which an event is seen.
Tolerance half_a_digit_and_step(int digits, double step);

/// A number: compared with ours. Without one of ours (the event did not happen) it is not reproduced.
Claim number(const Printed& printed, double value, const std::string& text, const std::string& unit,
             std::optional<double> ours, const Tolerance& tolerance);

/// A statement: ours holds or does not, `ours` says by which measured numbers.
Claim statement(const Printed& printed, const std::string& text, bool holds, const std::string& ours);

/// Values that go into a run, read back from it: the same doubles up to `rounding`, relative.
Claim given(const Printed& printed, const std::string& text, const std::vector<double>& values,
            const std::vector<double>& ours, const std::string& unit);

Json to_json(const Claim& claim);

/// At most `digits` significant digits.
std::string short_text(double value, int digits = 5);

}  // namespace vericone::dhal2022
