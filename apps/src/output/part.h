// SPDX-License-Identifier: BSD-3-Clause
//
// A part of a command's rows, on one machine of many: --part K/N. `vericone merge` puts the parts together.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vericone {

struct Part {
  std::uint64_t number = 1, of = 1;
  [[nodiscard]] std::string text() const;  // "3/8"
};

/// Words of a command line but these options: those of `with_value` take the next word, or stand before a =.
[[nodiscard]] std::vector<std::string> words_without(const std::vector<std::string>& words,
                                                     std::initializer_list<std::string_view> with_value,
                                                     std::initializer_list<std::string_view> flags);

/// What --part says; nothing where it says nothing. Throws InputError naming it.
[[nodiscard]] std::optional<Part> part_of(const std::string& text);

/// Of `count` things in a row those of the part, from the first to before the second: as near to count/N as
/// may be.
[[nodiscard]] std::pair<std::uint64_t, std::uint64_t> share_of(std::uint64_t count, const Part& part);

}  // namespace vericone
