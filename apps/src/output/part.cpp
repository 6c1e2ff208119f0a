// SPDX-License-Identifier: BSD-3-Clause
#include "output/part.h"

#include <vericone/geometry/error.h>
#include <algorithm>

namespace vericone {
namespace {

std::optional<std::uint64_t> count_of(const std::string& text) {
  constexpr std::size_t kMostDigits = 9;
  const bool digits = !text.empty() && text.size() <= kMostDigits &&
                      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? std::optional<std::uint64_t>(std::stoull(text)) : std::nullopt;
}

}  // namespace

std::vector<std::string> words_without(const std::vector<std::string>& words,
                                       std::initializer_list<std::string_view> with_value,
                                       std::initializer_list<std::string_view> flags) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    if (std::find(flags.begin(), flags.end(), name) != flags.end()) continue;
    if (std::find(with_value.begin(), with_value.end(), name) == with_value.end())
      kept.push_back(words[i]);
    else if (name == words[i])
      ++i;
  }
  return kept;
}

std::string Part::text() const { return std::to_string(number) + "/" + std::to_string(of); }

std::optional<Part> part_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t slash = text.find('/');
  const auto number = count_of(text.substr(0, slash)),
             of = slash == std::string::npos ? std::nullopt : count_of(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of)
    throw InputError("--part", text, "K/N, the K-th of N parts, such as 3/8");
  return Part{*number, *of};
}

std::pair<std::uint64_t, std::uint64_t> share_of(std::uint64_t count, const Part& part) {
  const std::uint64_t each = count / part.of, more = count % part.of;
  const auto begin = [&](std::uint64_t parts) { return parts * each + std::min(parts, more); };
  return {begin(part.number - 1), begin(part.number)};
}

}  // namespace vericone
