// SPDX-License-Identifier: BSD-3-Clause
#include "input/fields.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "input/field_table.h"

namespace vericone::input {
namespace {

/// What a person would have written: in degrees, say, without what the conversion has rounded.
double plain(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.14g", x);
  return std::strtod(text, nullptr);
}

/// A number for which `holds`, refused as "REQUIREMENT UNIT".
Value<double> bounded(Json schema, const char* requirement, bool (*holds)(double), const char* unit,
                      double scale) {
  return {[=, words = unit_words(unit)](const Json& value, const std::string& path) {
            const double x = read_number(value, path, words.c_str());
            if (!holds(x)) throw InputError(path, quoted(value), requirement + words);
            return scale * x;
          },
          with_unit(std::move(schema), unit),
          [scale](const double& x) {
            const double written = plain(x / scale);
            return written == std::floor(written) && std::abs(written) < 1e15 ? Json(std::int64_t(written))
                                                                              : Json(written);
          }};
}

}  // namespace

Json with_unit(Json schema, const std::string& unit) {
  if (unit.empty()) return schema;
  schema["unit"] = unit;
  if (units_for(unit).empty()) return schema;
  if (const auto type = schema.find("type"); type != schema.end() && *type == "number")
    *type = {"number", "string"};
  const auto named = schema.find("$ref");
  if (named == schema.end()) return schema;
  std::string to = named->get<std::string>();
  for (const auto& [numbers, quantities] :
       {std::pair("/positive", "/positive_quantity"), std::pair("/vector", "/quantities")})
    if (const std::size_t at = to.rfind(numbers); at != std::string::npos && to.find('_', at) == to.npos)
      to.replace(at, std::string(numbers).size(), quantities);
  *named = to;
  return schema;
}

void refuse_list(const Json& value, const std::string& path, int count, const char* unit) {
  const bool geographic = value.is_object() && value.contains("latitude");
  throw InputError(path, quoted(value),
                   "a list of " + std::to_string(count) + " numbers" + unit +
                       (geographic ? "; a place by latitude and longitude beside an origin of the file, with "
                                     "altitude in space"
                                   : ""));
}

std::string quoted(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

std::string plain_value(const Json& value) {
  return value.is_number() ? to_text(value.get<double>()) : quoted(value);
}

std::string unit_words(const std::string& unit) {
  if (unit.empty()) return "";
  if (unit == "m") return " (metres)";
  std::string words;
  for (std::size_t i = 0; i < unit.size(); ++i) {  // UTF-8: the squares and cubes have two bytes
    if (unit.compare(i, 2, "²") == 0)
      words += "^2", ++i;
    else if (unit.compare(i, 2, "³") == 0)
      words += "^3", ++i;
    else
      words += unit[i];
  }
  return " (" + words + ")";
}

Value<double> number(const char* unit, double scale) {
  return bounded(
      {{"type", "number"}}, "a finite number", [](double) { return true; }, unit, scale);
}

Value<double> positive(const char* unit, double scale) {
  return bounded(
      {{"$ref", "body.schema.json#/$defs/positive"}}, "a positive number", [](double x) { return x > 0; },
      unit, scale);
}

Value<double> not_negative(const char* unit, double scale) {
  return bounded(
      {{"type", "number"}, {"minimum", 0}}, "a number, 0 or more", [](double x) { return x >= 0; }, unit,
      scale);
}

Value<int> count(int low, int high) {
  return {
      [=](const Json& value, const std::string& path) {
        const double x = value.is_number() ? value.get<double>() : low - 1.0;
        if (!(x >= low && x <= high) || x != std::floor(x))
          throw InputError(path, quoted(value),
                           "a whole number between " + std::to_string(low) + " and " + std::to_string(high));
        return int(x);
      },
      Json{{"type", "integer"}, {"minimum", low}, {"maximum", high}}, [](const int& x) { return Json(x); }};
}

Value<bool> flag() {
  return {[](const Json& value, const std::string& path) {
            if (!value.is_boolean()) throw InputError(path, quoted(value), "true or false");
            return value.get<bool>();
          },
          Json{{"type", "boolean"}}, [](const bool& x) { return Json(x); }};
}

Value<std::string> text(const char* what) {
  return {[what](const Json& value, const std::string& path) {
            if (!value.is_string() || value.get<std::string>().empty())
              throw InputError(path, quoted(value), std::string(what) + ", as text");
            return value.get<std::string>();
          },
          Json{{"type", "string"}}, [](const std::string& x) { return Json(x); }};
}

Value<std::string> file_name() {
  return {[](const Json& value, const std::string& path) {
            if (!value.is_string() || value.get<std::string>().empty())
              throw InputError(path, quoted(value), "the name of a file, relative to the file that names it");
            return value.get<std::string>();
          },
          Json{{"type", "string"}, {"title", "file"}},
          {}};
}

template <int N>
Value<Eigen::Matrix<double, N, 1>> vector(const char* unit) {
  using Vector = Eigen::Matrix<double, N, 1>;
  return {[words = unit_words(unit)](const Json& value, const std::string& path) -> Vector {
            return read_vector<N>(value, path, words.c_str());
          },
          with_unit({{"$ref", "body.schema.json#/$defs/vector" + std::to_string(N)}}, unit),
          [](const Vector& x) {
            Json list = Json::array();
            for (const double c : x) list.push_back(c == std::floor(c) ? Json(std::int64_t(c)) : Json(c));
            return list;
          }};
}
template Value<Eigen::Vector2d> vector<2>(const char* unit);
template Value<Eigen::Vector3d> vector<3>(const char* unit);

}  // namespace vericone::input
