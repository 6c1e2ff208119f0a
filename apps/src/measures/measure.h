// SPDX-License-Identifier: BSD-3-Clause
//
// What papers measure: numbers taken from tables (docs/reference/papers.md, "Values").
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "measures/expression.h"
#include "measures/sources.h"

namespace vericone::paper {

using Named = std::vector<std::pair<std::string, Expression>>;

/// Two bodies of a scenario fly by a law that is written as a formula, once for each set of parameters.
struct Trial {
  double until = 0;  // s
  std::vector<std::map<std::string, double>> sets;
  Named with;
  Expression command;  // of the agent, m/s^2
};

/// Ellipses of least area around the corners of boxes of 5 by 2 m that lie anyhow in a square of 100 m, by
/// Khachiyan's ascent, so that its operations can be counted.
struct Ascent {
  std::vector<int> boxes;
  int draws = 1;         // of each number of boxes
  double tolerance = 0;  // of the area, relative
  int seed = 1;
};

/// Rows of a table: some by their words, with more columns, where a condition holds.
struct Series {
  std::string path;
  std::string run, command, table;                         // of a run or of a command
  std::vector<std::pair<std::string, std::string>> words;  // column and word
  std::optional<Trial> trial;
  std::optional<Ascent> ascent;
  std::optional<std::pair<Expression, Expression>> range;  // column s from one number to the other ...
  int count = 0;                                           // ... in so many
  std::vector<std::pair<std::string, Series>> beside;
  Named with;
  std::optional<Expression> where;

  std::string word(const std::string& column) const;  // empty: any
};

/// One number.
struct Value {
  enum class Kind { formula, first, last, least, greatest, mean, sum, count, field, length, course };
  Kind kind = Kind::formula;
  std::string path;
  std::optional<Expression> formula;  // of rows, for what is taken from a series; of course the time
  std::optional<Series> series;
  std::vector<std::string> fields;  // the first that is there
};

/// Its fields may stand beside others. Throws InputError.
Series read_series(const Json& fields, const std::string& path);
Value read_value(const Json& given, const std::string& path);

/// Values by name, each measured when it is asked for; then those of `outer`.
class Scope {
 public:
  /// `values`: a mapping of names and values.
  Scope(const Json& values, const std::string& path, Scope* outer = nullptr);

  /// The runs and commands that the values of these names rest on: scenarios, and words of commands.
  struct Origins {
    std::set<std::string> runs, commands, others;

    [[nodiscard]] bool none() const { return runs.empty() && commands.empty() && others.empty(); }
  };
  [[nodiscard]] Origins origins(std::vector<std::string> names) const;

 private:
  friend class Measures;
  Scope* outer_;
  std::map<std::string, Value> values_;
  std::map<std::string, double> known_;
  std::set<std::string> open_;  // being measured
};

/// The columns of a series, and which of its rows count.
struct Rows {
  Table table;
  std::vector<bool> counts;
};

class Measures {
 public:
  explicit Measures(Sources& sources) : sources_(sources) {}

  double value(const Value& value, Scope& scope);
  double value(const Expression& formula, Scope& scope);
  Rows rows(const Series& series, Scope& scope);
  /// The words in a column of the series' table, each once, in the order of their first row.
  std::vector<std::string> words(const Series& series, const std::string& column, Scope& scope);
  /// One number a row.
  std::vector<double> column(const Expression& formula, Rows& rows, Scope& scope);

 private:
  double named(const std::string& name, Scope* scope, const Expression& formula);
  Table table_of(const Series& series, Scope& scope);

  Sources& sources_;
};

/// A row for each draw: boxes, points, steps, products (all multiplications but the few of one inverse of 3
/// by 3 a step), and ratio: of the area to the least one, at most. Throws Interrupted.
Table ascend(const Ascent& ascent);

/// A row a set of parameters, with them as columns, and touched, avoided (1 or 0) and to (s, first contact).
/// `named`: the value of a name that is none of the law's.
Table fly_trials(const PaperRun& run, const std::string& agent, const std::string& obstacle,
                 const Trial& trial, const std::string& path,
                 const std::function<double(const std::string&, const Expression&)>& named);

}  // namespace vericone::paper
