// SPDX-License-Identifier: BSD-3-Clause
#include "input/errors.h"

#include "input/fields.h"
#include "input/spatial_body.h"

namespace vericone::input {
namespace {

/// One of {"ball": r}, {"semi_axes": [a, b, c], "rotation": ...}, {"box": [hx, hy, hz]}.
ErrorSet read_set(const Json& value, const std::string& path, const char* unit) {
  require_object(value, path);
  require_known(value, path, {"ball", "semi_axes", "rotation", "box"});
  const int kinds = value.contains("ball") + value.contains("semi_axes") + value.contains("box");
  if (kinds != 1)
    throw InputError(path, kinds == 0 ? "no set" : "more than one set",
                     "given by exactly one of ball, semi_axes (with rotation), box");
  if (value.contains("rotation") && !value.contains("semi_axes"))
    throw InputError(path + ".rotation", quoted(value["rotation"]), "left out, or beside semi_axes");
  if (value.contains("ball")) {
    const double radius = read_number(value["ball"], path + ".ball", unit);
    return within(path, [&] { return ErrorSet::ball(radius); });
  }
  if (value.contains("box")) {
    const Eigen::Vector3d half = read_vector<3>(value["box"], path + ".box", unit);
    return within(path, [&] { return ErrorSet::box(half); });
  }
  const Eigen::Vector3d axes = read_vector<3>(value["semi_axes"], path + ".semi_axes", unit);
  const Eigen::Matrix3d rotation = read_rotation(value, path);
  return within(path, [&] { return ErrorSet::ellipsoid(axes, rotation); });
}

}  // namespace

Horizon read_horizon(const Json& value) {
  Horizon horizon;
  if (!value.contains("horizon")) return horizon;
  const Json& given = value["horizon"];
  const char* const right = "positive (seconds), or [from, until] with 0 <= from <= until";
  if (given.is_array()) {
    const Eigen::Vector2d ends = read_vector<2>(given, "horizon", " (seconds)");
    horizon = {ends(0), ends(1)};
    if (!(horizon.from >= 0 && horizon.until >= horizon.from))
      throw InputError("horizon", quoted(given), right);
    return horizon;
  }
  horizon.until = read_number(given, "horizon", " (seconds)");
  if (!(horizon.until > 0)) throw InputError("horizon", quoted(given), right);
  return horizon;
}

std::optional<RelativeErrors> read_errors(const Json& value, const Horizon& horizon) {
  if (!value.contains("position_error") && !value.contains("velocity_error")) return std::nullopt;
  if (horizon.from > 0 || horizon.until == 0)
    throw InputError("horizon", quoted(value["horizon"]),
                     "seconds from now (one positive number) beside position_error or velocity_error");
  RelativeErrors errors;
  errors.horizon = horizon.until;
  if (value.contains("position_error"))
    errors.position = read_set(value["position_error"], "position_error", " (metres)");
  if (value.contains("velocity_error"))
    errors.velocity = read_set(value["velocity_error"], "velocity_error", " (m/s)");
  return errors;
}

}  // namespace vericone::input
