// SPDX-License-Identifier: BSD-3-Clause
//
// A field of a file is one row: its name, where it goes, its unit and bounds, one sentence. The reader, the
// list of known fields, the refusals and the JSON schema, hence the tables of pages, come from the rows.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::input {

/// How a T is written in a file.
template <typename T>
struct Value {
  std::function<T(const Json& value, const std::string& path)> read;  // throws InputError naming the path
  Json schema;                                                        // type, bounds and unit
  std::function<Json(const T&)> write;                                // as a default; none: schemas have none
};

/// A schema with its unit, "m²"; text too where that unit may be written out (units.h).
Json with_unit(Json schema, const std::string& unit);

/// A finite number times `scale`. Units as in schemas, "m²".
Value<double> number(const char* unit = "", double scale = 1);
Value<double> positive(const char* unit = "", double scale = 1);
Value<double> not_negative(const char* unit = "", double scale = 1);
Value<int> count(int low, int high);
Value<bool> flag();
/// Not empty; refused as "WHAT, as text".
Value<std::string> text(const char* what);
/// The name of a file, relative to the file that names it.
Value<std::string> file_name();
template <int N>
Value<Eigen::Matrix<double, N, 1>> vector(const char* unit = "");
extern template Value<Eigen::Vector2d> vector<2>(const char* unit);
extern template Value<Eigen::Vector3d> vector<3>(const char* unit);

/// The same where it `holds`, refused as REQUIREMENT.
template <typename T>
Value<T> checked(const Value<T>& value, const char* requirement, bool (*holds)(const T&)) {
  return {[=, read = value.read](const Json& given, const std::string& path) {
            const T x = read(given, path);
            if (!holds(x)) throw InputError(path, plain_value(given), requirement);
            return x;
          },
          value.schema, value.write};
}
/// The same, which the schema has otherwise; its unit and default stay.
template <typename T>
Value<T> shown_as(Value<T> value, Json schema) {
  const auto unit = value.schema.find("unit");
  value.schema = unit == value.schema.end() ? std::move(schema) : with_unit(std::move(schema), *unit);
  return value;
}

/// `unit` as refusals have it: "m²" is " (m^2)", "m" is " (metres)".
std::string unit_words(const std::string& unit);

/// One of the names listed.
template <typename Choice>
Value<Choice> choice(std::vector<std::pair<const char*, Choice>> choices) {
  Json names = Json::array();
  for (const auto& [name, meant] : choices) names.push_back(name);
  return {[choices](const Json& value, const std::string& path) {
            std::string list;
            for (const auto& [name, meant] : choices) {
              if (value == name) return meant;
              list.append(list.empty() ? "" : ", ").append(name);
            }
            throw InputError(path, quoted(value), "one of " + list);
          },
          Json{{"enum", std::move(names)}},
          [choices](const Choice& one) {
            for (const auto& [name, meant] : choices)
              if (meant == one) return Json(name);
            return Json();
          }};
}

/// What holds where a field is left out: `absent` in words; else the default that a new S has.
struct Otherwise {
  const char* required = nullptr;  // refused, and told what is to be given
  const char* absent = nullptr;
  bool silent = false;
};
inline Otherwise required(const char* what) { return {what, nullptr}; }
inline Otherwise absent(const char* words) { return {nullptr, words}; }
/// Of fields that say the same in several ways: a rule says which are given.
inline Otherwise alternative() { return {nullptr, nullptr, true}; }

/// The fields of a mapping that is read into an S.
template <typename S>
class Fields {
 public:
  using Read = std::function<void(const Json& value, const std::string& path, S& to)>;

  /// `kind`: the field, if any, that decides which of the others are read (only_of).
  explicit Fields(const char* title, const char* kind = nullptr) : title_(title), kind_(kind) {}

  /// The row before this is read only where the field `kind` is one of these; `words` say that in schemas.
  Fields& only_of(std::vector<std::string> kinds, const char* words) {
    rows_.back().kinds = std::move(kinds);
    if (words) rows_.back().schema["read_by"] = words;
    return *this;
  }

  /// `member` is a pointer to a member of S, or a function that finds one.
  template <typename Member, typename T>
  Fields& row(const char* name, Member member, const Value<T>& value, const char* sentence,
              const Otherwise& otherwise = {}) {
    Json schema = value.schema;
    if constexpr (std::is_convertible_v<decltype(std::invoke(member, std::declval<S&>())), const T&>) {
      S fresh{};
      if (value.write && !otherwise.required && !otherwise.absent && !otherwise.silent)
        schema["default"] = value.write(static_cast<T>(std::invoke(member, fresh)));
    }
    return special(
        name, std::move(schema),
        [member, read = value.read](const Json& given, const std::string& path, S& to) {
          std::invoke(member, to) = read(given, path);
        },
        sentence, otherwise);
  }

  /// The row before this is read by its former name too.
  Fields& formerly(const char* name) {
    rows_.back().former = name;
    return *this;
  }

  /// A field that says which of several mappings this is; its reader has looked.
  Fields& kind(const char* name, const char* word, const char* sentence) {
    return special(name, Json{{"enum", Json::array({word})}}, {}, sentence, required(word));
  }

  /// A field with a reader of its own.
  Fields& special(const char* name, Json schema, Read read, const char* sentence,
                  const Otherwise& otherwise = {}) {
    if (otherwise.absent) schema["absent"] = otherwise.absent;
    if (sentence) schema["description"] = sentence;
    rows_.push_back({name, otherwise.required, std::move(schema), std::move(read)});
    return *this;
  }

  bool has(const std::string& name) const {
    return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
      return name == row.name || (row.former && name == row.former);
    });
  }
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names;
    for (const Row& row : rows_) names.emplace_back(row.name);
    return names;
  }
  void require_known(const Json& value, const std::string& path) const {
    for (const auto& [field, given] : value.get_ref<const Json::object_t&>())
      if (!has(field)) refuse_unknown(path, field, names());
  }

  /// Reads what is given over what `to` has, in the order of the rows.
  void read(const Json& value, const std::string& path, S& to) const {
    require_object(value, path);
    require_known(value, path);
    read_known(value, path, to);
  }
  /// The same of fields that are known to be known.
  void read_known(const Json& value, const std::string& path, S& to) const {
    for (const Row& row : rows_) {
      require_read(row, value, path);
      const char* name = row.former && value.contains(row.former) ? row.former : row.name;
      if (name != row.name && value.contains(row.name))
        throw InputError(join(path, name), quoted(value[name]), "left out beside " + std::string(row.name));
      const auto given = value.find(name);
      if (given == value.end()) {
        if (row.required) require_field(value, path, name, row.required);
      } else if (row.read) {
        row.read(*given, join(path, name), to);
      }
    }
  }
  S read(const Json& value, const std::string& path) const {
    S fresh{};
    read(value, path, fresh);
    return fresh;
  }

  /// In JSON Schema, with `unit`, `default` or `absent`, and `description` of each field.
  Json schema() const {
    Json properties = Json::object(), needed = Json::array();
    for (const Row& row : rows_) {
      properties[row.name] = row.schema;
      if (row.required) needed.push_back(row.name);
    }
    Json all{{"title", title_}, {"type", "object"}, {"properties", std::move(properties)}};
    if (!needed.empty()) all["required"] = std::move(needed);
    all["additionalProperties"] = false;
    return all;
  }

 private:
  struct Row {
    const char* name;
    const char* required;
    Json schema;
    Read read;
    std::vector<std::string> kinds = {};  // none: all
    const char* former = nullptr;
  };

  void require_read(const Row& row, const Json& value, const std::string& path) const {
    if (row.kinds.empty() || !value.contains(row.name)) return;
    std::string list;
    for (const std::string& kind : row.kinds) {
      if (value[kind_] == kind) return;
      list.append(list.empty() ? "" : ", ").append(kind);
    }
    throw InputError(join(path, row.name), quoted(value[row.name]), "left out: only " + list + " reads it");
  }

  const char* title_;
  const char* kind_;
  std::vector<Row> rows_;
};

/// A mapping with fields of its own.
template <typename T>
Value<T> mapping(const Fields<T>& fields) {
  return {[&fields](const Json& value, const std::string& path) { return fields.read(value, path); },
          fields.schema(),
          {}};
}
/// The same, where the schema has it as #/$defs/NAME.
template <typename T>
Value<T> mapping(const char* name, const Fields<T>& fields) {
  return {mapping(fields).read, Json{{"$ref", std::string("#/$defs/") + name}}, {}};
}

/// A list of WHAT.
template <typename T>
Value<std::vector<T>> list(const char* what, const Value<T>& one, std::size_t least = 0) {
  Json schema{{"type", "array"}, {"items", one.schema}, {"title", std::string("list of ") + what}};
  if (least > 0) schema["minItems"] = least;
  return {[what, least, read = one.read](const Json& value, const std::string& path) {
            if (!value.is_array() || value.size() < least)
              throw InputError(path, quoted(value), std::string("a list of ") + what);
            std::vector<T> all;
            for (std::size_t i = 0; i < value.size(); ++i) all.push_back(read(value[i], at(path, i)));
            return all;
          },
          std::move(schema),
          {}};
}

/// A member of a member.
template <typename S, typename Part, typename T>
auto within_part(Part S::*part, T Part::*member) {
  return [=](S& s) -> T& { return s.*part.*member; };
}

}  // namespace vericone::input
