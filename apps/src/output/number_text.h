// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers as people read them: the digits that are certain. All digits stand in JSON.
#pragma once

#include <numbers>
#include <string>

namespace vericone {

inline constexpr int kShownDigits = 6;  // significant ones, at most

/// Of an angle in radians.
inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// `digits` significant digits, without zeros at the end.
std::string number_text(double x, int digits = kShownDigits);

/// As many digits as an error of x leaves, one of them uncertain: 1.02243 +- 0.0006 is "1.0224".
std::string number_within(double x, double error);

/// Of a lower or upper bound: rounded so that it stays one.
std::string at_least_text(double x, int digits = kShownDigits);
std::string at_most_text(double x, int digits = kShownDigits);

/// A number between two bounds: the digits that both share, or, where they share fewer than three, "LOW to
/// HIGH" rounded outwards. "at least LOW" where there is no upper bound.
std::string between_text(double low, double high);

/// "LOW and HIGH", or with another word than "and", rounded outwards to the digits that tell them apart.
std::string bounds_text(double low, double high, const char* word = " and ");

}  // namespace vericone
