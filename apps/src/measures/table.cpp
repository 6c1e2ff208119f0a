// SPDX-License-Identifier: BSD-3-Clause
#include "measures/table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>

namespace vericone::paper {
namespace {

constexpr double kSameTime = 1e-9;  // s

}  // namespace

const std::vector<double>* Table::find(const std::string& name) {
  if (const auto it = numbers.find(name); it != numbers.end()) return &it->second;
  constexpr const char* kBefore = "_before";
  const std::size_t length = name.size() - std::min(name.size(), std::string(kBefore).size());
  const auto it = numbers.find(name.substr(0, length));
  if (!name.ends_with(kBefore) || it == numbers.end()) return nullptr;
  std::vector<double> shifted(rows, kNothing);
  if (rows > 1) std::copy(it->second.begin(), it->second.end() - 1, shifted.begin() + 1);
  return &numbers.emplace(name, std::move(shifted)).first->second;
}

Table Table::with(const std::string& column, const std::string& word) const {
  const std::vector<std::string>& own = words.at(column);
  Table part;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < rows; ++i)
    if (own[i] == word) kept.push_back(i);
  part.rows = kept.size();
  for (const auto& [name, values] : numbers)
    for (const std::size_t i : kept) part.numbers[name].push_back(values[i]);
  for (const auto& [name, values] : words)
    for (const std::size_t i : kept) part.words[name].push_back(values[i]);
  if (kept.empty()) {
    for (const auto& [name, unused] : numbers) part.numbers[name] = {};
    for (const auto& [name, unused] : words) part.words[name] = {};
  }
  part.words.erase(column);
  return part;
}

Table table_of(simulation::Table table) {
  Table made;
  made.rows = table.rows();
  for (simulation::Column& column : table.columns)
    if (column.text)
      made.words[column.name] = std::move(column.words);
    else
      made.numbers[column.name] = std::move(column.numbers);
  return made;
}

void put_beside(Table& left, const std::string& name, const Table& right, const std::vector<bool>& counts) {
  std::vector<std::string> shared;
  for (const auto& [column, unused] : left.words)
    if (right.words.contains(column) && column != "status") shared.push_back(column);
  const auto key = [&](const Table& table, std::size_t i) {
    std::vector<std::string> words;
    for (const std::string& column : shared) words.push_back(table.words.at(column)[i]);
    return words;
  };
  const auto tick = [](double t) { return std::int64_t(std::llround(t / kSameTime)); };
  std::map<std::pair<std::int64_t, std::vector<std::string>>, std::size_t> row_at;
  for (std::size_t i = 0; i < right.rows; ++i)
    if (counts[i]) row_at.try_emplace({tick(right.numbers.at("t")[i]), key(right, i)}, i);
  std::vector<std::optional<std::size_t>> match(left.rows);
  for (std::size_t i = 0; i < left.rows; ++i) {
    const std::int64_t t = tick(left.numbers.at("t")[i]);
    for (const std::int64_t near : {t, t - 1, t + 1})
      if (const auto it = row_at.find({near, key(left, i)}); !match[i] && it != row_at.end())
        match[i] = it->second;
  }
  for (const auto& [column, values] : right.numbers) {
    std::vector<double>& here = left.numbers[name + "." + column];
    here.assign(left.rows, kNothing);
    for (std::size_t i = 0; i < left.rows; ++i)
      if (match[i]) here[i] = values[*match[i]];
  }
}

}  // namespace vericone::paper
