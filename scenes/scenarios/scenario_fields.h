// SPDX-License-Identifier: BSD-3-Clause
//
// Fields of scenarios beyond those of scenes: optional ones, signs, choices.
#pragma once

#include <initializer_list>
#include <utility>

#include "input/fields.h"

namespace vericone::scenario {

inline std::string join(const std::string& path, const char* field) {
  return path.empty() ? field : path + "." + field;
}

/// Hands the field and its path to `read` where it is given.
template <typename Read>
void if_given(const Json& value, const std::string& path, const char* field, Read read) {
  if (const auto it = value.find(field); it != value.end()) read(*it, join(path, field));
}

/// The same where it is one value: to = read(field, its path, more...).
template <typename T, typename Read, typename... More>
void take(const Json& value, const std::string& path, const char* field, T& to, Read read, More... more) {
  if_given(value, path, field, [&](const Json& v, const std::string& p) { to = read(v, p, more...); });
}

inline double read_positive(const Json& value, const std::string& path, const char* unit) {
  const double x = input::read_number(value, path, unit);
  if (!(x > 0)) throw InputError(path, input::quoted(value), std::string("a positive number") + unit);
  return x;
}

inline double read_not_negative(const Json& value, const std::string& path, const char* unit) {
  const double x = input::read_number(value, path, unit);
  if (!(x >= 0)) throw InputError(path, input::quoted(value), std::string("a number, 0 or more") + unit);
  return x;
}

/// A whole number between `low` and `high`.
inline int read_count(const Json& value, const std::string& path, int low, int high) {
  const double x = value.is_number() ? value.get<double>() : low - 1.0;
  if (!(x >= low && x <= high) || x != std::floor(x))
    throw InputError(path, input::quoted(value),
                     "a whole number between " + std::to_string(low) + " and " + std::to_string(high));
  return static_cast<int>(x);
}

inline bool read_flag(const Json& value, const std::string& path) {
  if (!value.is_boolean()) throw InputError(path, input::quoted(value), "true or false");
  return value.get<bool>();
}

inline std::string read_text(const Json& value, const std::string& path, const char* what) {
  if (!value.is_string() || value.get<std::string>().empty())
    throw InputError(path, input::quoted(value), std::string(what) + ", as text");
  return value.get<std::string>();
}

/// One of the names listed.
template <typename Choice>
Choice read_choice(const Json& value, const std::string& path,
                   std::initializer_list<std::pair<const char*, Choice>> choices) {
  std::string list;
  for (const auto& [name, choice] : choices) {
    if (value.is_string() && value.get<std::string>() == name) return choice;
    list.append(list.empty() ? "" : ", ").append(name);
  }
  throw InputError(path, input::quoted(value), "one of " + list);
}

}  // namespace vericone::scenario
