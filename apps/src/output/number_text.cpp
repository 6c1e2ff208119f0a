// SPDX-License-Identifier: BSD-3-Clause
#include "output/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace vericone {
namespace {

enum class Towards { nearest, down, up };

int exponent(double x) { return x == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(x)))); }

double parsed(const char* text) { return std::strtod(text, nullptr); }

/// To a multiple of 10^place.
std::string rounded(double x, int place, Towards towards) {
  const int digits = std::clamp(exponent(x) - place + 1, 1, 17);
  const double unit = std::pow(10.0, std::max(place, exponent(x) - digits + 1));
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  const double found = parsed(text);
  if (towards == Towards::down && found > x)
    std::snprintf(text, sizeof text, "%.*e", digits - 1, found - unit);
  if (towards == Towards::up && found < x) std::snprintf(text, sizeof text, "%.*e", digits - 1, found + unit);
  return number_text(parsed(text), digits + 1);
}

}  // namespace

std::string number_text(double x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}

std::string number_within(double x, double error) {
  if (!(error > 0) || !std::isfinite(error) || x == 0) return number_text(x);
  return number_text(x, std::clamp(exponent(x) - exponent(error) + 1, 1, kShownDigits));
}

std::string at_least_text(double x, int digits) {
  return std::isfinite(x) ? rounded(x, exponent(x) - digits + 1, Towards::down) : number_text(x);
}

std::string at_most_text(double x, int digits) {
  return std::isfinite(x) ? rounded(x, exponent(x) - digits + 1, Towards::up) : number_text(x);
}

std::string between_text(double low, double high) {
  if (!std::isfinite(high)) return "at least " + at_least_text(low);
  constexpr int kLeastShared = 3;
  for (int digits = kShownDigits; digits >= kLeastShared; --digits)
    if (const std::string text = number_text(low, digits); text == number_text(high, digits)) return text;
  return bounds_text(low, high, " to ");
}

std::string bounds_text(double low, double high, const char* word) {
  if (!std::isfinite(low) || !std::isfinite(high)) return number_text(low) + word + number_text(high);
  const double most = std::max(std::abs(low), std::abs(high));
  const int place = std::max(exponent(high - low) - 1, exponent(most) - kShownDigits + 1);
  return rounded(low, place, Towards::down) + word + rounded(high, place, Towards::up);
}

}  // namespace vericone
