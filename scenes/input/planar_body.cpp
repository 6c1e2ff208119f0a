// SPDX-License-Identifier: BSD-3-Clause
#include "input/planar_body.h"

#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

double read_angle(const Json& value, const std::string& path, const char* field) {
  return value.contains(field) ? read_number(value[field], path + "." + field, " (radians)") : 0.0;
}

/// An error of the library's, its field renamed to what stands in the input.
InputError renamed(const InputError& e, const std::string& from, const std::string& to) {
  if (!e.field().starts_with(from)) return e;
  return {to + e.field().substr(from.size()), e.value(), e.requirement()};
}

Delimiter<2> read_hyperbola(const Json& value, const std::string& path, double body_angle) {
  require_object(value, path);
  require_known(value, path, {"semi_axes", "rotation"});
  const Eigen::Vector2d axes =
      read_vector<2>(require_field(value, path, "semi_axes", "[a, b] in metres, a along its axis"),
                     path + ".semi_axes", " (metres)");
  const double angle = body_angle + read_angle(value, path, "rotation");
  return within(path, [&] { return hyperbola(axes, angle); });
}

CombinedEllipse read_axes(const Json& value, const std::string& path, const Eigen::Vector2d& center) {
  const Eigen::Vector2d axes = read_vector<2>(value["semi_axes"], path + ".semi_axes", " (metres)");
  const double angle = read_angle(value, path, "rotation");
  const Ellipse ellipse = within(path, [&] { return Ellipse::from_axes(center, axes, rotation_2d(angle)); });
  if (!value.contains("hyperbolas")) return ellipse;
  const Json& list = value["hyperbolas"];
  const std::string field = path + ".hyperbolas";
  if (!list.is_array()) throw InputError(field, quoted(list), "a list of hyperbolas, each with semi_axes");
  std::vector<Delimiter<2>> delimiters;
  for (std::size_t i = 0; i < list.size(); ++i)
    delimiters.push_back(read_hyperbola(list[i], at(field, i), angle));
  return within(path, [&] {
    try {
      return CombinedEllipse(ellipse, std::move(delimiters));
    } catch (const InputError& e) {
      std::string requirement = e.requirement();
      if (const auto at = requirement.find("ellipsoid"); at != std::string::npos)
        requirement.replace(at, 9, "ellipse");
      throw InputError(renamed(e, "hyperboloids", "hyperbolas").field(), "a curve that misses the ellipse",
                       requirement);
    }
  });
}

/// The source's conic (5.5).
CombinedEllipse read_dented_conic(const Json& value, const std::string& path, const Eigen::Vector2d& center) {
  const auto number = [&](const char* field, const char* requirement, const char* unit) {
    return read_number(require_field(value, path, field, requirement), path + "." + field, unit);
  };
  const double a = number("a_c", "a length in metres", " (metres)"),
               b = number("b_c", "a length in metres", " (metres)"),
               k = number("k", "a number between 0 and 1", ""), phi = read_angle(value, path, "phi");
  return within(path, [&] {
    try {
      return dented_conic(center, a, b, k, phi);
    } catch (const InputError& e) {
      throw renamed(renamed(e, "semi_axes[0]", "a_c"), "semi_axes[1]", "b_c");
    }
  });
}

}  // namespace

CombinedEllipse read_planar_body(const Json& value, const std::string& path) {
  require_object(value, path);
  require_known(value, path,
                {"center", "semi_axes", "rotation", "hyperbolas", "shape", "a_c", "b_c", "k", "phi"});
  const bool conic =
      value.contains("a_c") || value.contains("b_c") || value.contains("k") || value.contains("phi");
  const int kinds = value.contains("semi_axes") + value.contains("shape") + conic;
  if (kinds != 1)
    throw InputError(path, kinds == 0 ? "no shape" : "more than one shape",
                     "given by exactly one of semi_axes (with rotation), shape, a_c (with b_c, k, phi)");
  for (const char* other : {"rotation", "hyperbolas"})
    if (value.contains(other) && !value.contains("semi_axes"))
      throw InputError(path + "." + other, quoted(value[other]), "left out, or the body given by semi_axes");
  const Eigen::Vector2d center =
      read_vector<2>(require_field(value, path, "center", "[x, y] in metres"), path + ".center", " (metres)");
  if (conic) return read_dented_conic(value, path, center);
  if (value.contains("semi_axes")) return read_axes(value, path, center);
  const Eigen::Matrix2d shape = read_matrix<2>(value["shape"], path + ".shape", " (square metres)");
  return within(path, [&] { return Ellipse::from_shape(center, shape); });
}

}  // namespace vericone::input
