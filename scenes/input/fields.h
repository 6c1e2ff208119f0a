// SPDX-License-Identifier: BSD-3-Clause
//
// Checked access to the fields of JSON values; every mistake is an InputError that names the field's path.
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "json/json_value.h"
#include "units/units.h"

namespace vericone::input {

/// A value as it stands in a message: one line, at most 60 characters.
std::string quoted(const Json& value);

/// The same of a number without what YAML adds: -1 and not -1.0.
std::string plain_value(const Json& value);

inline std::string join(const std::string& path, const char* field) {
  return path.empty() ? field : path + "." + field;
}
inline std::string at(const std::string& path, std::size_t i) { return path + "[" + std::to_string(i) + "]"; }

inline bool is_finite_number(const Json& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

/// `unit`: as refusals have it, " (metres)"; text with a unit of its dimension is converted (units.h).
inline double read_number(const Json& value, const std::string& path, const char* unit) {
  return is_finite_number(value) ? value.get<double>() : read_quantity(value, path, unit);
}

/// "a list of COUNT numbers", said of what is none, and how a place by latitude and longitude is one.
[[noreturn]] void refuse_list(const Json& value, const std::string& path, int count, const char* unit);

template <int N>
Eigen::Matrix<double, N, 1> read_vector(const Json& value, const std::string& path, const char* unit) {
  if (!value.is_array() || value.size() != N) refuse_list(value, path, N, unit);
  Eigen::Matrix<double, N, 1> v;
  for (int i = 0; i < N; ++i)  // a path is written for an error only
    v(i) = is_finite_number(value[i]) ? value[i].get<double>() : read_number(value[i], at(path, i), unit);
  return v;
}

template <int N>
Eigen::Matrix<double, N, N> read_matrix(const Json& value, const std::string& path, const char* unit) {
  if (!value.is_array() || value.size() != N)
    throw InputError(path, quoted(value),
                     "a list of " + std::to_string(N) + " rows of " + std::to_string(N) + " numbers" + unit);
  Eigen::Matrix<double, N, N> m;
  for (int i = 0; i < N; ++i) m.row(i) = read_vector<N>(value[i], at(path, i), unit).transpose();
  return m;
}

inline void require_object(const Json& value, const std::string& path) {
  if (!value.is_object()) throw InputError(path, quoted(value), "a mapping of fields");
}

[[noreturn]] inline void refuse_unknown(const std::string& path, const std::string& field,
                                        std::span<const std::string_view> known) {
  std::string list;
  for (const auto& k : known) list.append(list.empty() ? "" : ", ").append(k);
  throw InputError(join(path, field.c_str()), "an unknown field", "one of " + list);
}

inline void require_known(const Json& value, const std::string& path,
                          std::span<const std::string_view> known) {
  for (const auto& item : value.items())
    if (std::find(known.begin(), known.end(), item.key()) == known.end())
      refuse_unknown(path, item.key(), known);
}

inline void require_known(const Json& value, const std::string& path,
                          std::initializer_list<std::string_view> known) {
  require_known(value, path, std::span(known.begin(), known.size()));
}

inline void require_known(const Json& value, const std::string& path, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  require_known(value, path, std::span<const std::string_view>(names));
}

inline const Json& require_field(const Json& value, const std::string& path, const char* field,
                                 const char* requirement) {
  const auto it = value.find(field);
  if (it == value.end()) throw InputError(join(path, field), "nothing", requirement);
  return *it;
}

/// Hands the field and its path to `read` where it is given.
template <typename Read>
void if_given(const Json& value, const std::string& path, const char* field, Read read) {
  if (const auto it = value.find(field); it != value.end()) read(*it, join(path, field));
}

/// `make()` with the path before the field of an error.
template <typename Make>
auto within(const std::string& path, Make make) -> decltype(make()) {
  try {
    return make();
  } catch (const InputError& e) {
    if (path.empty()) throw;
    throw e.within(path);
  }
}

}  // namespace vericone::input
