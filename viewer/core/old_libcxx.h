// SPDX-License-Identifier: BSD-3-Clause
//
// What the library uses and the standard library of Debian's Emscripten 3.1.6 (libc++ 14) has not yet:
// included before every source that is compiled to WebAssembly. A newer one needs none of it.
#pragma once

#include <version>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <system_error>

namespace std {

#ifndef __cpp_lib_bit_cast
template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

/// The shortest digits that are read back as x.
inline to_chars_result to_chars(char* first, char* last, double x) {
  char text[32];
  for (int digits = 1; digits <= 17; ++digits) {
    snprintf(text, sizeof text, "%.*g", digits, x);
    if (strtod(text, nullptr) == x) break;
  }
  const size_t length = strlen(text);
  if (last - first < ptrdiff_t(length)) return {last, errc::value_too_large};
  memcpy(first, text, length);
  return {first + length, errc{}};
}

namespace ranges {

template <typename Range, typename Predicate>
bool all_of(Range&& range, Predicate predicate) {
  return std::all_of(std::begin(range), std::end(range), predicate);
}
template <typename Range, typename Predicate>
bool any_of(Range&& range, Predicate predicate) {
  return std::any_of(std::begin(range), std::end(range), predicate);
}
template <typename Range, typename T>
auto find(Range&& range, const T& value) {
  return std::find(std::begin(range), std::end(range), value);
}
template <typename Range>
auto max_element(Range&& range) {
  return std::max_element(std::begin(range), std::end(range));
}
template <typename Range>
void sort(Range&& range) {
  std::sort(std::begin(range), std::end(range));
}

}  // namespace ranges
}  // namespace std

#endif
