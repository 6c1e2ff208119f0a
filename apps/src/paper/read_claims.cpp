// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "input/field_table.h"
#include "input/fields.h"
#include "paper/claim.h"
#include "paper/paper_fields.h"

namespace vericone::paper {
namespace {

using input::at, input::quoted, input::require_field, input::require_object;
using input::if_given, input::join;

/// A name that YAML reads as a number would lose its last zeros.
std::string read_name(const Json& value, const std::string& path, const char* what) {
  if (value.is_number()) throw InputError(path, quoted(value), std::string(what) + ", in quotes");
  return input::text(what).read(value, path);
}

std::string required_text(const Json& fields, const std::string& path, const char* field, const char* what) {
  return read_name(require_field(fields, path, field, what), join(path, field), what);
}

/// What `fields` takes from the mapping that it is like.
Json completed(const Json& fields, const Json& templates, const std::string& path, int depth) {
  if (depth > 20) throw InputError(path, "templates that are like each other", "templates that end");
  if (fields.is_array()) {
    Json list = Json::array();
    for (std::size_t i = 0; i < fields.size(); ++i)
      list.push_back(completed(fields[i], templates, at(path, i), depth));
    return list;
  }
  if (!fields.is_object()) return fields;
  Json own = fields;
  if (const auto like = fields.find("like"); like != fields.end()) {
    const std::string place = join(path, "like");
    own = Json::object();
    for (const Json& one : like->is_array() ? *like : Json::array({*like})) {
      const std::string name = input::text("the name of a template").read(one, place);
      if (!templates.is_object() || !templates.contains(name))
        throw InputError(place, name, "the name of one of templates");
      require_object(templates[name], "templates." + name);
      own.merge_patch(completed(templates[name], templates, "templates." + name, depth + 1));
    }
    Json more = fields;
    more.erase("like");
    own.merge_patch(more);
  }
  Json result = Json::object();
  for (const auto& [key, value] : own.items())
    result[key] = completed(value, templates, join(path, key.c_str()), depth);
  return result;
}

/// The entry of a body stands for a claim of each number that is printed of it.
std::vector<Json> claims_of_body(const Json& entry, const std::string& path) {
  body_claim_fields().require_known(entry, path);
  const std::string body = required_text(entry, path, "body", "the name of a body"),
                    run = required_text(entry, path, "run", "the name of a scenario"),
                    section = required_text(entry, path, "section", "a section of the source");
  std::vector<Json> claims;
  const auto add = [&](const char* field, const char* what, const char* unit,
                       const std::vector<Json>& values) {
    if (!entry.contains(field)) return;
    const Json printed = entry[field].is_array() ? entry[field] : Json::array({entry[field]});
    if (printed.empty() || printed.size() > values.size())
      throw InputError(join(path, field), quoted(entry[field]),
                       values.size() == 1 ? "a number" : "a list of as many numbers as printed");
    Json claim{{"id", section + "/" + run + "/" + body + "-" + what},
               {"section", section},
               {"figures", require_field(entry, path, "figures", "a list of figures")},
               {"what", body + ", " + what},
               {"given", true},
               {"printed", printed},
               {"unit", unit},
               {"ours", Json::array()},
               {"values", Json::object()}};
    for (std::size_t i = 0; i < printed.size(); ++i) {
      const std::string name = "number_" + std::to_string(i);
      claim["ours"].push_back(name);
      claim["values"][name] = values[i];
      claim["values"][name]["run"] = run;
    }
    claims.push_back(std::move(claim));
  };
  const auto first = [&](const char* formula) {
    return Json{{"table", "bodies"}, {"body", body}, {"first", formula}};
  };
  std::vector<Json> axes;
  for (const char* i : {"0", "1", "2"}) {
    Json paths = Json::array();
    for (const std::string& place : {"bodies." + body + ".shape.", "bodies." + body + "."}) {
      paths.push_back(place + "semi_axes." + i);
      paths.push_back(place + "dented." + i);
      if (*i != '2') paths.push_back(place + (*i == '0' ? "a_c" : "b_c"));
    }
    axes.push_back({{"field", paths}});
  }
  add("semi_axes", "axes", "m", axes);
  add("k", "k", "", {first("k")});
  add("position", "position", "m", {first("x"), first("y"), first("z")});
  add("speed", "speed", "m/s", {first("speed")});
  add("heading_deg", "heading", "deg", {first("degrees(azimuth)"), first("degrees(elevation)")});
  add("appears", "appears", "s", {first("t")});
  if (claims.empty())
    throw InputError(path, "nothing printed", "semi_axes, k, position, speed, heading_deg or appears");
  return claims;
}

std::vector<std::string> read_ids(const Json& given, const std::string& path) {
  std::vector<std::string> figures;
  if (!given.is_array() || given.empty()) throw InputError(path, quoted(given), "a list of figures");
  for (std::size_t i = 0; i < given.size(); ++i)
    figures.push_back(read_name(given[i], at(path, i), "the id of a figure"));
  return figures;
}

/// The printed value, and the Json of half a unit of its last digit, from the text as printed.
void read_printed(const Json& fields, const std::string& path, ClaimEntry& entry, Json& values) {
  const std::string place = path + ".printed";
  const Json& printed = require_field(fields, path, "printed", "what the source prints, as text in quotes");
  if (printed.is_array()) {
    for (std::size_t i = 0; i < printed.size(); ++i)
      entry.printed.push_back(input::read_number(printed[i], at(place, i), ""));
    if (entry.printed.empty()) throw InputError(place, "[]", "a list of numbers, or text");
    std::string list;
    for (const double v : entry.printed) list.append(list.empty() ? "" : ", ").append(short_text(v));
    entry.claim.printed = entry.printed.size() > 1 ? "(" + list + ")" : list;
    if (entry.printed.size() == 1) entry.claim.printed_value = entry.printed[0];
  } else {
    entry.claim.printed = read_name(printed, place, "what the source prints, as text");
    if (entry.ours.empty()) {
      entry.printed_text = Text(printed, place);
      return;
    }
    const std::regex number(R"([-+]?\d+(\.(\d+))?)");
    std::smatch found;
    const std::string& text = entry.claim.printed;
    if (!std::regex_search(text, found, number) ||
        std::distance(std::sregex_iterator(text.begin(), text.end(), number), std::sregex_iterator()) != 1)
      throw InputError(place, quoted(printed), "text with one number, as printed");
    entry.claim.printed_value = std::stod(found[0].str());
    values["half_digit"] = 0.5 * std::pow(10.0, -double(found[2].length()));
  }
  if (!entry.unit.empty()) entry.claim.printed += " " + entry.unit;
}

void read_tolerance(const Json& fields, const std::string& path, ClaimEntry& entry) {
  const std::string place = path + ".tolerance";
  if (!fields.contains("tolerance")) {
    entry.tolerance.emplace("half_digit", place);
    entry.tolerance_reason = Text("half a unit of the last printed digit", place);
    return;
  }
  const Json& given = fields["tolerance"];
  require_object(given, place);
  tolerance_fields().require_known(given, place);
  entry.tolerance.emplace(require_field(given, place, "value", "a number or a formula"), place + ".value");
  entry.tolerance_reason = Text(require_field(given, place, "reason", "why, as text"), place + ".reason");
  if_given(given, place, "one_sided",
           [&](const Json& v, const std::string& p) { entry.claim.later = input::flag().read(v, p); });
}

/// The numbers of a list, or one.
std::vector<double> read_numbers(const Json& value, const std::string& path) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < (value.is_array() ? value.size() : 1); ++i)
    numbers.push_back(
        input::read_number(value.is_array() ? value[i] : value, value.is_array() ? at(path, i) : path, ""));
  return numbers;
}

std::vector<std::string> read_texts(const Json& value, const std::string& path, const char* what) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < (value.is_array() ? value.size() : 1); ++i)
    texts.push_back(
        input::text(what).read(value.is_array() ? value[i] : value, value.is_array() ? at(path, i) : path));
  return texts;
}

/// How many numbers, or where they stand and between what.
Chosen read_chosen(const Json& fields, const std::string& path, const std::string& name) {
  Chosen chosen;
  chosen.name = name;
  if (!fields.is_object()) {
    chosen.numbers = input::count(1, 1000).read(fields, path);
    return chosen;
  }
  fit_fields().require_known(fields, path);
  chosen.files = read_texts(require_field(fields, path, "in", "files of the paper"), path + ".in",
                            "a file of the paper's folder");
  chosen.paths =
      read_texts(require_field(fields, path, "at", "paths of numbers"), path + ".at", "the path of a number");
  chosen.numbers = int(chosen.paths.size());
  const auto from = read_numbers(require_field(fields, path, "from", "a number of each"), path + ".from"),
             to = read_numbers(require_field(fields, path, "to", "a number of each"), path + ".to");
  if_given(fields, path, "whole",
           [&](const Json& v, const std::string& p) { chosen.whole = input::flag().read(v, p); });
  if_given(fields, path, "logarithmic",
           [&](const Json& v, const std::string& p) { chosen.logarithmic = input::flag().read(v, p); });
  if (from.size() != chosen.paths.size() || to.size() != chosen.paths.size())
    throw InputError(path + ".at", std::to_string(chosen.paths.size()) + " paths",
                     "as many as from and to have numbers");
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!(from[i] < to[i]) || (chosen.logarithmic && !(from[i] > 0)))
      throw InputError(path + ".to", to_text(to[i]),
                       chosen.logarithmic ? "above from, both positive" : "above from");
    chosen.ranges.emplace_back(from[i], to[i]);
  }
  return chosen;
}

ClaimEntry read_entry(const Json& fields, const std::string& path, const ClaimsFile& file) {
  claim_fields().require_known(fields, path);
  ClaimEntry entry;
  Claim& claim = entry.claim;
  claim.id = required_text(fields, path, "id", "a name of the claim's own");
  claim.section = required_text(fields, path, "section", "a section of the source");
  claim.what = required_text(fields, path, "what", "what is printed, in words");
  claim.figures = read_ids(require_field(fields, path, "figures", "a list of figures"), path + ".figures");
  for (const auto& [field, kind] : {std::pair("given", Kind::given), std::pair("code", Kind::code)})
    if_given(fields, path, field, [&, k = kind](const Json& v, const std::string& p) {
      if (input::flag().read(v, p)) claim.kind = k;
    });
  if_given(fields, path, "needs",
           [&](const Json& v, const std::string& p) { entry.needs = input::text("a command").read(v, p); });
  if_given(fields, path, "unit", [&](const Json& v, const std::string& p) {
    if (!v.is_string()) throw InputError(p, quoted(v), "a unit, as text");
    entry.unit = v.get<std::string>();
  });
  if (fields.contains("ours") == fields.contains("holds"))
    throw InputError(path, fields.contains("ours") ? "ours and holds" : "nothing measured",
                     "ours (a number) or holds (whether a statement does)");
  if_given(fields, path, "holds", [&](const Json& v, const std::string& p) { entry.holds.emplace(v, p); });
  if_given(fields, path, "ours", [&](const Json& v, const std::string& p) {
    for (std::size_t i = 0; i < (v.is_array() ? v.size() : 1); ++i)
      entry.ours.emplace_back(v.is_array() ? v[i] : v, v.is_array() ? at(p, i) : p);
  });
  Json values = Json::object();
  if_given(fields, path, "values", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    for (const auto& [name, value] : v.items())
      values[name] = with_defaults(value, fields.value("of", Json::object()));
  });
  read_printed(fields, path, entry, values);
  if (!entry.ours.empty() && entry.ours.size() != std::max<std::size_t>(1, entry.printed.size()))
    throw InputError(path + ".ours", std::to_string(entry.ours.size()) + " formulas",
                     "as many as numbers are printed");
  if (!entry.ours.empty() && entry.printed.empty()) read_tolerance(fields, path, entry);
  entry.values = std::make_shared<Scope>(values, path + ".values", file.values.get());
  if_given(fields, path, "engaged",
           [&](const Json& v, const std::string& p) { entry.engaged.emplace(v, p); });
  if_given(fields, path, "otherwise",
           [&](const Json& v, const std::string& p) { entry.otherwise = otherwise_verdict().read(v, p); });
  if_given(fields, path, "text", [&](const Json& v, const std::string& p) { entry.text = Text(v, p); });
  if_given(fields, path, "note", [&](const Json& v, const std::string& p) { entry.note = Text(v, p); });
  if_given(fields, path, "fit", [&](const Json& v, const std::string& p) {
    for (const std::string& name : read_texts(v, p, "the name of a fit")) {
      const auto found = std::find_if(file.fits.begin(), file.fits.end(),
                                      [&](const auto& fit) { return fit->name == name; });
      if (found == file.fits.end()) throw InputError(p, name, "the name of one of fits");
      claim.fits.push_back(*found);
    }
  });
  // What measures nothing could not have failed by anything of ours.
  std::vector<std::string> names = entry.text.names();
  std::vector<Expression> formulas = entry.ours;
  if (entry.holds) formulas.push_back(*entry.holds);
  for (const Expression& formula : formulas)
    names.insert(names.end(), formula.names().begin(), formula.names().end());
  claim.origins = entry.values->origins(names);
  if (claim.kind == Kind::result && claim.origins.none()) claim.kind = Kind::arithmetic;
  return entry;
}

}  // namespace

Json with_templates(const Json& fields) {
  if (!fields.is_object()) return fields;
  const Json templates = fields.value("templates", Json::object());
  Json rest = fields;
  rest.erase("templates");
  return completed(rest, templates, "", 0);
}

Json with_defaults(const Json& series, const Json& of) {
  if (!series.is_object() || !of.is_object()) return series;
  Json all = series;
  const bool bodies = series.contains("table") && series["table"] == "bodies";
  const bool fields = series.contains("field") || series.contains("length");
  for (const auto& [key, value] : of.items()) {
    const bool fits = key == "run"    ? !series.contains("command") && !series.contains("range")
                      : fields        ? false
                      : key == "body" ? bodies
                                      : !bodies && !series.contains("command");
    if (fits && !series.contains(key)) all[key] = value;
  }
  if (series.contains("beside"))
    for (auto& [name, other] : all["beside"].items()) other = with_defaults(other, of);
  return all;
}

ClaimsFile read_claims(const Json& given) {
  require_object(given, "claims.yaml");
  const Json fields = with_templates(given);
  claims_file_fields().require_known(fields, "");
  ClaimsFile file;
  if_given(fields, "", "fits", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    for (const auto& [name, all] : v.items()) {
      const auto fit = std::make_shared<Fit>();
      fit->name = name;
      require_object(all, p + "." + name);
      for (const auto& [one, what] : all.items())
        fit->chosen.push_back(read_chosen(what, p + "." + name + "." + one, one));
      file.fits.push_back(fit);
    }
  });
  file.values = std::make_shared<Scope>(fields.value("values", Json()), "values");
  const Json& list = require_field(fields, "", "claims", "a list of claims");
  if (!list.is_array()) throw InputError("claims", quoted(list), "a list of claims");
  std::set<std::string> ids;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = at("claims", i);
    require_object(list[i], path);
    for (const Json& one :
         list[i].contains("body") ? claims_of_body(list[i], path) : std::vector<Json>{list[i]}) {
      file.entries.push_back(read_entry(one, path, file));
      if (!ids.insert(file.entries.back().claim.id).second)
        throw InputError(path + ".id", file.entries.back().claim.id,
                         "a name of the claim's own: another claim has it");
    }
  }
  return file;
}

}  // namespace vericone::paper
