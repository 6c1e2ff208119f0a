// SPDX-License-Identifier: BSD-3-Clause
#include "input/field_table.h"
#include "input/fields.h"
#include "measures/measure.h"
#include "measures/series_fields.h"

namespace vericone::paper {
namespace {

using input::at, input::quoted, input::require_field, input::require_object;
using input::if_given, input::join;

constexpr std::pair<const char*, Value::Kind> kTaken[] = {
    {"first", Value::Kind::first},       {"last", Value::Kind::last}, {"least", Value::Kind::least},
    {"greatest", Value::Kind::greatest}, {"mean", Value::Kind::mean}, {"sum", Value::Kind::sum},
    {"count", Value::Kind::count}};
constexpr const char* kWords[] = {"body", "agent", "obstacle", "orifice", "event", "status"};

Named read_named(const Json& given, const std::string& path) {
  require_object(given, path);
  Named list;
  for (const auto& [name, formula] : given.items()) {
    if (!is_name(name)) throw InputError(path, name, "a name: letters, digits and _, no digit first");
    list.emplace_back(name, Expression(formula, path + "." + name));
  }
  return list;
}

Trial read_trial(const Json& given, const std::string& path) {
  require_object(given, path);
  trial_fields().require_known(given, path);
  Trial trial{
      0, {}, {}, Expression(require_field(given, path, "command", "a formula, m/s^2"), path + ".command")};
  trial.until = input::positive("s").read(require_field(given, path, "until", "a positive number (s)"),
                                          path + ".until");
  const Json& sets = require_field(given, path, "sets", "a list of mappings of names and numbers");
  if (!sets.is_array() || sets.empty())
    throw InputError(path + ".sets", quoted(sets), "a list of mappings of names and numbers");
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string place = at(path + ".sets", i);
    require_object(sets[i], place);
    std::map<std::string, double> set;
    for (const auto& [name, x] : sets[i].items()) set[name] = input::read_number(x, place + "." + name, "");
    for (const auto& [name, unused] : trial.sets.empty() ? set : trial.sets[0])
      if (!set.contains(name))
        throw InputError(place + "." + name, "nothing", "a number, as in the other sets");
    trial.sets.push_back(std::move(set));
  }
  if_given(given, path, "with", [&](const Json& v, const std::string& p) { trial.with = read_named(v, p); });
  return trial;
}

}  // namespace

std::string Series::word(const std::string& column) const {
  for (const auto& [name, word] : words)
    if (name == column) return word;
  return "";
}

Series read_series(const Json& given, const std::string& path) {
  Series series;
  series.path = path;
  const auto text = [&](const char* field, std::string& target) {
    if_given(given, path, field,
             [&](const Json& v, const std::string& p) { target = input::text("a name").read(v, p); });
  };
  text("run", series.run);
  text("command", series.command);
  text("table", series.table);
  for (const char* column : kWords)
    if_given(given, path, column, [&](const Json& v, const std::string& p) {
      series.words.emplace_back(column, input::text("a name").read(v, p));
    });
  if_given(given, path, "trial",
           [&](const Json& v, const std::string& p) { series.trial = read_trial(v, p); });
  if_given(given, path, "ascent",
           [&](const Json& v, const std::string& p) { series.ascent = ascent_fields().read(v, p); });
  if_given(given, path, "range", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    range_fields().require_known(v, p);
    series.range.emplace(Expression(require_field(v, p, "from", "a number"), p + ".from"),
                         Expression(require_field(v, p, "to", "a number"), p + ".to"));
    series.count =
        input::count(2, 100000).read(require_field(v, p, "count", "a whole number, 2 or more"), p + ".count");
  });
  if_given(given, path, "beside", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    for (const auto& [name, fields] : v.items()) {
      const std::string place = p + "." + name;
      require_object(fields, place);
      series_fields().require_known(fields, place);
      series.beside.emplace_back(name, read_series(fields, place));
    }
  });
  if_given(given, path, "with", [&](const Json& v, const std::string& p) { series.with = read_named(v, p); });
  if_given(given, path, "where", [&](const Json& v, const std::string& p) { series.where.emplace(v, p); });
  if (!series.run.empty() && !series.command.empty())
    throw InputError(join(path, "command"), series.command, "given without run");
  const bool whole = series.range || series.ascent || (series.trial && !series.run.empty()) ||
                     (!series.table.empty() && !(series.run.empty() && series.command.empty()));
  if (!whole)
    throw InputError(
        path, "no table",
        "of a run (run and table), of a command (command and table), a trial with its run, an ascent, or a "
        "range");
  return series;
}

Value read_value(const Json& given, const std::string& path) {
  Value value;
  value.path = path;
  if (!given.is_object()) {
    value.formula.emplace(given, path);
    return value;
  }
  value_fields().require_known(given, path);
  int kinds = 0;
  for (const auto& [name, kind] : kTaken)
    if_given(given, path, name, [&, k = kind](const Json& v, const std::string& p) {
      value.kind = k;
      value.formula.emplace(v, p);
      ++kinds;
    });
  for (const auto& [name, kind] :
       {std::pair("field", Value::Kind::field), std::pair("length", Value::Kind::length)})
    if_given(given, path, name, [&, k = kind](const Json& v, const std::string& p) {
      value.kind = k;
      for (const Json& one : v.is_array() ? v : Json::array({v}))
        value.fields.push_back(input::text("the path of a field").read(one, p));
      ++kinds;
    });
  if_given(given, path, "course", [&](const Json& v, const std::string& p) {
    value.kind = Value::Kind::course;
    value.formula.emplace(v, p);
    ++kinds;
  });
  if (kinds != 1)
    throw InputError(path, std::to_string(kinds) + " of them",
                     "one of first, last, least, greatest, mean, sum, count, field, length and course");
  Json fields = given;
  // These need no table: the run or the command is enough.
  const bool tableless = value.kind == Value::Kind::field || value.kind == Value::Kind::length ||
                         value.kind == Value::Kind::course;
  if (tableless && !given.contains("table")) fields["table"] = "none";
  value.series = read_series(fields, path);
  if (value.kind == Value::Kind::course &&
      (value.series->word("agent").empty() || value.series->word("obstacle").empty() ||
       value.series->run.empty()))
    throw InputError(path + ".course", "no pair", "given with run, agent and obstacle");
  return value;
}

Scope::Scope(const Json& values, const std::string& path, Scope* outer) : outer_(outer) {
  if (values.is_null()) return;
  require_object(values, path);
  for (const auto& [name, given] : values.items()) {
    if (!is_name(name)) throw InputError(path, name, "a name: letters, digits and _, no digit first");
    values_.emplace(name, read_value(given, path + "." + name));
  }
}

namespace {

void add_names(const Expression& formula, std::vector<std::string>& names) {
  names.insert(names.end(), formula.names().begin(), formula.names().end());
}

/// What a series is taken from, and the names that it uses.
void add_origins(const Series& series, Scope::Origins& origins, std::vector<std::string>& names) {
  if (!series.run.empty()) origins.runs.insert(series.run);
  if (!series.command.empty()) origins.commands.insert(series.command);
  if (series.ascent) origins.others.insert("an ascent");
  for (const auto& [name, formula] : series.with) add_names(formula, names);
  if (series.where) add_names(*series.where, names);
  for (const auto& [name, other] : series.beside) add_origins(other, origins, names);
}

}  // namespace

Scope::Origins Scope::origins(std::vector<std::string> names) const {
  // Where a series' formula has a name of a column, the column is meant: there an outer scope is not asked.
  struct Open {
    std::string name;
    const Scope* at;
    bool outer;
  };
  Origins origins;
  std::vector<Open> open;
  for (std::string& name : names) open.push_back({std::move(name), this, true});
  std::set<const Value*> seen;
  while (!open.empty()) {
    const Open one = open.back();
    open.pop_back();
    for (const Scope* at = one.at; at != nullptr; at = one.outer ? at->outer_ : nullptr) {
      const auto found = at->values_.find(one.name);
      if (found == at->values_.end()) continue;
      const Value& value = found->second;
      if (!seen.insert(&value).second) break;
      std::vector<std::string> more;
      if (value.series) add_origins(*value.series, origins, more);
      if (value.formula) add_names(*value.formula, more);
      for (std::string& name : more) open.push_back({std::move(name), at, !value.series});
      break;
    }
  }
  return origins;
}

}  // namespace vericone::paper
