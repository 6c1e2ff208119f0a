// SPDX-License-Identifier: BSD-3-Clause
#include "units/units.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>

#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

enum class Quantity { length, speed, acceleration, time, angle, turning, area };

/// So many thirds, thousandths, ... of the first unit of its dimension: `times` / `over`, exactly.
struct Unit {
  std::string_view name;
  Quantity quantity;
  std::int64_t times, over;
  bool degrees = false;  // counted in degrees where others of its dimension are in radians
};

constexpr double kDegree = std::numbers::pi / 180;

// By their definitions: the international foot, inch and mile (1959), the nautical mile (1929), the standard
// acceleration of free fall (1901).
constexpr std::array kUnits{Unit{"m", Quantity::length, 1, 1},
                            Unit{"km", Quantity::length, 1000, 1},
                            Unit{"cm", Quantity::length, 1, 100},
                            Unit{"mm", Quantity::length, 1, 1000},
                            Unit{"ft", Quantity::length, 3048, 10'000},
                            Unit{"in", Quantity::length, 254, 10'000},
                            Unit{"mi", Quantity::length, 1'609'344, 1000},
                            Unit{"nmi", Quantity::length, 1852, 1},
                            Unit{"m/s", Quantity::speed, 1, 1},
                            Unit{"km/h", Quantity::speed, 1000, 3600},
                            Unit{"kn", Quantity::speed, 1852, 3600},
                            Unit{"kt", Quantity::speed, 1852, 3600},
                            Unit{"ft/s", Quantity::speed, 3048, 10'000},
                            Unit{"ft/min", Quantity::speed, 3048, 600'000},
                            Unit{"mph", Quantity::speed, 1'609'344, 3'600'000},
                            Unit{"m/s^2", Quantity::acceleration, 1, 1},
                            Unit{"ft/s^2", Quantity::acceleration, 3048, 10'000},
                            Unit{"g", Quantity::acceleration, 980'665, 100'000},
                            Unit{"s", Quantity::time, 1, 1},
                            Unit{"ms", Quantity::time, 1, 1000},
                            Unit{"min", Quantity::time, 60, 1},
                            Unit{"h", Quantity::time, 3600, 1},
                            Unit{"rad", Quantity::angle, 1, 1},
                            Unit{"deg", Quantity::angle, 1, 1, true},
                            Unit{"rad/s", Quantity::turning, 1, 1},
                            Unit{"deg/s", Quantity::turning, 1, 1, true},
                            Unit{"rpm", Quantity::turning, 6, 1, true},
                            Unit{"m^2", Quantity::area, 1, 1},
                            Unit{"cm^2", Quantity::area, 1, 10'000},
                            Unit{"km^2", Quantity::area, 1'000'000, 1}};

/// As the table and messages have it: m^2 for m², deg for °.
std::string plain_unit(std::string_view unit) {
  std::string plain(unit);
  const auto replace = [&](std::string_view from, std::string_view to) {
    for (std::size_t at = plain.find(from); at != std::string::npos; at = plain.find(from, at + to.size()))
      plain.replace(at, from.size(), to);
  };
  replace("²", "^2");
  replace("³", "^3");
  replace("°", "deg");
  for (const auto& [word, name] :
       {std::pair("metres", "m"), std::pair("square metres", "m^2"), std::pair("seconds", "s"),
        std::pair("radians", "rad"), std::pair("degrees", "deg"), std::pair("degrees/s", "deg/s")})
    if (plain == word) return name;
  return plain;
}

const Unit* find_unit(std::string_view name) {
  const auto* const found = std::ranges::find(kUnits, name, &Unit::name);
  return found == kUnits.end() ? nullptr : found;
}

/// What stands in the parentheses of " (metres), the lower one first".
std::string unit_of_words(std::string_view words) {
  const std::size_t open = words.find('('), close = words.find(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return "";
  return plain_unit(words.substr(open + 1, close - open - 1));
}

/// The decimal digits of `number` (as text, at most kMostDigits of them) times `times` over `over`, as the
/// nearest double. The quotient's digits are written so far that no number half-way between two doubles lies
/// beyond them (the longest has 767), and a last 1 stands for those left out.
std::optional<double> scaled_decimal(std::string_view number, std::int64_t times, std::int64_t over) {
  constexpr int kDigits = 800;
  std::string digits;
  long exponent = 0;
  const std::size_t e = number.find_first_of("eE");
  for (const char c : number.substr(0, e)) {
    if (c == '-') continue;
    if (c != '.') digits += c;
    if (c == '.' || exponent < 0) --exponent;
  }
  if (number.find('.') != std::string_view::npos) ++exponent;  // the point itself
  if (e != std::string_view::npos) {
    std::string_view power = number.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    long given = 0;
    const auto [end, error] = std::from_chars(power.data(), power.data() + power.size(), given);
    if (error != std::errc()) given = power.starts_with('-') ? -2000 : 2000;  // beyond all doubles
    exponent += std::clamp(given, -2000L, 2000L);
  }
  // digits * times: carries from the right.
  std::int64_t carry = 0;
  for (std::size_t i = digits.size(); i-- > 0;) {
    carry += (digits[i] - '0') * times;
    digits[i] = char('0' + carry % 10);
    carry /= 10;
  }
  digits.insert(0, std::to_string(carry));
  std::string quotient;
  std::int64_t rest = 0;
  const auto next = [&](int digit) {
    rest = 10 * rest + digit;
    quotient += char('0' + rest / over);
    rest %= over;
  };
  for (const char c : digits) next(c - '0');
  for (int i = 0; i < kDigits && rest != 0; ++i, --exponent) next(0);
  if (rest != 0) quotient += '1', --exponent;
  quotient += "e" + std::to_string(exponent);
  double found = 0;
  const auto [end, error] = std::from_chars(quotient.data(), quotient.data() + quotient.size(), found);
  if (error != std::errc()) return std::nullopt;
  return number[0] == '-' ? -found : found;
}

/// In units of `to`, of the same dimension.
std::optional<double> converted(std::string_view number, const Unit& from, const Unit& to) {
  const std::int64_t times = from.times * to.over, over = from.over * to.times,
                     common = std::gcd(times, over);
  const std::optional<double> x = scaled_decimal(number, times / common, over / common);
  if (!x || from.degrees == to.degrees) return x;
  return from.degrees ? *x * kDegree : *x / kDegree;
}

struct Written {
  std::string number, unit;
};

/// "-1.5e3 ft" as its two parts; nothing of other text.
std::optional<Written> parts_of(std::string_view text) {
  constexpr std::size_t kMostDigits = 60;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.size() <= first || !(is_digit(text[first]) || text[first] == '.')) return std::nullopt;
  double ignored = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  const std::size_t length = std::size_t(end - text.data());
  if (error == std::errc::invalid_argument || length > kMostDigits) return std::nullopt;
  const std::size_t unit = text.find_first_not_of(' ', length);
  if (unit == std::string_view::npos) return std::nullopt;  // a number in quotes is text
  return Written{std::string(text.substr(0, length)), plain_unit(text.substr(unit))};
}

std::string listed(std::string_view unit) {
  std::string list;
  for (const std::string_view one : units_for(unit)) list.append(list.empty() ? "" : ", ").append(one);
  return list;
}

}  // namespace

bool may_be_number(const Json& value) { return value.is_number() || value.is_string(); }

std::vector<std::string_view> units_for(std::string_view unit) {
  const Unit* const own = find_unit(plain_unit(unit));
  if (own == nullptr) return {};
  std::vector<std::string_view> names{own->name};
  for (const Unit& one : kUnits)
    if (one.quantity == own->quantity && one.name != own->name) names.push_back(one.name);
  return names;
}

double read_quantity(const Json& value, const std::string& path, const char* words) {
  const auto refuse = [&](const std::string& more) {
    throw InputError(path, quoted(value), std::string("a finite number") + words + more);
  };
  const std::optional<Written> written =
      value.is_string() ? parts_of(value.get_ref<const std::string&>()) : std::nullopt;
  if (!written) refuse("");
  const std::string own = unit_of_words(words);
  const Unit *const from = find_unit(written->unit), *const to = find_unit(own);
  std::optional<double> x;
  if (own.empty()) refuse(", without a unit");
  if (written->unit == own)
    x = scaled_decimal(written->number, 1, 1);
  else if (to == nullptr)
    refuse(", or with that unit");
  else if (from == nullptr || from->quantity != to->quantity)
    refuse(", or one with a unit of " + listed(own));
  else
    x = converted(written->number, *from, *to);
  if (!x || !std::isfinite(*x)) refuse("");
  return *x;
}

}  // namespace vericone::input
