// SPDX-License-Identifier: BSD-3-Clause
#include "measures/measure.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "input/fields.h"

namespace vericone::paper {
namespace {

double taken(Value::Kind kind, const std::vector<double>& values) {
  if (kind == Value::Kind::count)
    return double(
        std::count_if(values.begin(), values.end(), [](double x) { return !std::isnan(x) && x != 0; }));
  double sum = 0;
  if (kind == Value::Kind::sum || kind == Value::Kind::mean) {
    for (const double x : values) sum += x;
    return kind == Value::Kind::sum ? sum : values.empty() ? kNothing : sum / double(values.size());
  }
  if (values.empty()) return kNothing;
  if (kind == Value::Kind::first) return values.front();
  if (kind == Value::Kind::last) return values.back();
  // Rows without the number do not count.
  double extreme = kNothing;
  for (const double x : values)
    if (std::isnan(extreme) || (kind == Value::Kind::least ? x < extreme : x > extreme)) extreme = x;
  return extreme;
}

std::string columns_of(const Table& table) {
  std::string list;
  for (const auto& [name, unused] : table.numbers) list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

}  // namespace

double Measures::named(const std::string& name, Scope* scope, const Expression& formula) {
  for (Scope* at = scope; at != nullptr; at = at->outer_) {
    const auto found = at->values_.find(name);
    if (found == at->values_.end()) continue;
    if (const auto known = at->known_.find(name); known != at->known_.end()) return known->second;
    if (!at->open_.insert(name).second)
      throw InputError(formula.path(), name, "a value that does not rest on itself");
    const double x = value(found->second, *at);
    at->open_.erase(name);
    return at->known_[name] = x;
  }
  throw InputError(formula.path(), name, "a name of values or a column of the table");
}

double Measures::value(const Expression& formula, Scope& scope) {
  std::vector<double> values;
  for (const std::string& name : formula.names()) values.push_back(named(name, &scope, formula));
  return formula.value(values);
}

double Measures::value(const Value& value, Scope& scope) {
  switch (value.kind) {
    case Value::Kind::formula:
      return this->value(*value.formula, scope);
    case Value::Kind::course: {
      const double t = this->value(*value.formula, scope);
      const Series& s = *value.series;
      return sources_.run(s.run, s.path + ".run").on_course(s.word("agent"), s.word("obstacle"), t, s.path);
    }
    case Value::Kind::field:
    case Value::Kind::length: {
      const Series& s = *value.series;
      const Json& fields = s.run.empty() ? sources_.answer(s.command, s.path + ".command")
                                         : sources_.run(s.run, s.path + ".run").fields;
      for (const std::string& path : value.fields) {
        const auto there = pointer_to(fields, path);
        if (!there) continue;
        const Json& found = fields.at(*there);
        if (value.kind == Value::Kind::length && found.is_array()) return double(found.size());
        if (value.kind == Value::Kind::field && found.is_number()) return found.get<double>();
        if (value.kind == Value::Kind::field && found.is_boolean()) return found.get<bool>();
        throw InputError(value.path, path,
                         value.kind == Value::Kind::length ? "the path of a list" : "the path of a number");
      }
      return kNothing;
    }
    default:
      break;
  }
  Rows rows = this->rows(*value.series, scope);
  const std::vector<double> all = column(*value.formula, rows, scope);
  std::vector<double> counted;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (rows.counts[i]) counted.push_back(all[i]);
  return taken(value.kind, counted);
}

std::vector<double> Measures::column(const Expression& formula, Rows& rows, Scope& scope) {
  std::vector<const std::vector<double>*> columns;
  std::vector<double> values;
  for (const std::string& name : formula.names()) {
    columns.push_back(rows.table.find(name));
    if (columns.back() == nullptr && name.find('.') != std::string::npos)
      throw InputError(formula.path(), name, "a column beside the table: " + columns_of(rows.table));
    values.push_back(columns.back() ? 0 : named(name, &scope, formula));
  }
  std::vector<double> result(rows.table.rows);
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (columns[j]) values[j] = (*columns[j])[i];
    result[i] = formula.value(values);
  }
  return result;
}

namespace {

/// The rows with the words of a series.
Table with_words(Table table, const Series& series) {
  for (const auto& [column, word] : series.words) {
    if (!table.words.contains(column) && table.rows > 0)
      throw InputError(series.path + "." + column, word, "left out: " + series.table + " has no such column");
    if (table.rows > 0) table = table.with(column, word);
  }
  return table;
}

}  // namespace

Table Measures::table_of(const Series& series, Scope& scope) {
  if (series.range) {
    const double from = value(series.range->first, scope), to = value(series.range->second, scope);
    Table table;
    table.rows = std::size_t(series.count);
    for (int i = 0; i < series.count; ++i)
      table.numbers["s"].push_back(from + i * (to - from) / (series.count - 1));
    return table;
  }
  if (series.ascent) return ascend(*series.ascent);
  if (!series.command.empty())
    return with_words(sources_.table(series.command, series.table, series.path + ".table"), series);
  const PaperRun& run = sources_.run(series.run, series.path + ".run");
  for (const auto& [column, word] : series.words)
    if (column == "body" || column == "agent" || (column == "obstacle" && series.table != "events"))
      run.index_of(word, series.path + "." + column);
  const std::string agent = series.word("agent"), obstacle = series.word("obstacle");
  if (series.trial || series.table == "looks") {
    if (agent.empty() || obstacle.empty())
      throw InputError(series.path, "no pair", "given with agent and obstacle");
    if (!series.trial) return run.looks(agent, obstacle, series.path);
    return fly_trials(
        run, agent, obstacle, *series.trial, series.path,
        [&](const std::string& name, const Expression& formula) { return named(name, &scope, formula); });
  }
  return with_words(run.table(series.table, series.path + ".table"), series);
}

std::vector<std::string> Measures::words(const Series& series, const std::string& column, Scope& scope) {
  const Table table = table_of(series, scope);
  const auto found = table.words.find(column);
  if (found == table.words.end() && table.rows > 0)
    throw InputError(series.path + ".each", column, "a column of words of " + series.table);
  std::vector<std::string> list;
  if (found != table.words.end())
    for (const std::string& word : found->second)
      if (std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
  return list;
}

Rows Measures::rows(const Series& series, Scope& scope) {
  Rows rows{table_of(series, scope), {}};
  for (const auto& [name, other] : series.beside) {
    const Rows right = this->rows(other, scope);
    if (!rows.table.numbers.contains("t") || !right.table.numbers.contains("t"))
      throw InputError(other.path, "no column t", "tables over time, on both sides");
    put_beside(rows.table, name, right.table, right.counts);
  }
  for (const auto& [name, formula] : series.with) rows.table.numbers[name] = column(formula, rows, scope);
  rows.counts.assign(rows.table.rows, true);
  if (series.where) {
    const std::vector<double> holds = column(*series.where, rows, scope);
    for (std::size_t i = 0; i < holds.size(); ++i) rows.counts[i] = holds[i] != 0 && !std::isnan(holds[i]);
  }
  return rows;
}

}  // namespace vericone::paper
