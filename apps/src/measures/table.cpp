// SPDX-License-Identifier: BSD-3-Clause
#include "measures/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <tuple>

namespace vericone::paper {
namespace {

constexpr double kSameTime = 1e-9;  // s

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"')
        cells.back() += line[++i];
      else
        quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

/// Nothing where the text is no number; NaN of empty text.
std::optional<double> number_of(const std::string& text) {
  if (text.empty()) return kNothing;
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return x;
}

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

Table table_of_csv(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && line.starts_with('#')) {
  }
  const std::vector<std::string> names = cells_of(line);
  std::vector<std::vector<std::string>> columns(names.size());
  Table table;
  for (; std::getline(lines, line); ++table.rows) {
    std::vector<std::string> cells = cells_of(line);
    cells.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) columns[i].push_back(std::move(cells[i]));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = names[i].substr(0, names[i].find(" ["));
    std::vector<double> numbers;
    for (const std::string& cell : columns[i])
      if (const auto x = number_of(cell)) numbers.push_back(*x);
    if (numbers.size() == table.rows)
      table.numbers[name] = std::move(numbers);
    else
      table.words[name] = std::move(columns[i]);
  }
  return table;
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
