// SPDX-License-Identifier: BSD-3-Clause
#include "input/body.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/quadric.h>
#include <algorithm>
#include <cmath>

namespace vericone::input {
namespace {

std::string at(const std::string& path, std::size_t i) { return path + "[" + std::to_string(i) + "]"; }

double read_number(const Json& value, const std::string& path, const char* unit) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InputError(path, quoted(value), std::string("a finite number") + unit);
  return value.get<double>();
}

template <int N>
Eigen::Matrix<double, N, 1> read_vector(const Json& value, const std::string& path, const char* unit) {
  if (!value.is_array() || value.size() != N)
    throw InputError(path, quoted(value), "a list of " + std::to_string(N) + " numbers" + unit);
  Eigen::Matrix<double, N, 1> v;
  for (int i = 0; i < N; ++i) v(i) = read_number(value[i], at(path, i), unit);
  return v;
}

template <int N>
Eigen::Matrix<double, N, N> read_matrix(const Json& value, const std::string& path, const char* unit) {
  if (!value.is_array() || value.size() != N)
    throw InputError(path, quoted(value),
                     "a list of " + std::to_string(N) + " rows of " + std::to_string(N) + " numbers" + unit);
  Eigen::Matrix<double, N, N> m;
  for (int i = 0; i < N; ++i) m.row(i) = read_vector<N>(value[i], at(path, i), unit).transpose();
  return m;
}

void require_object(const Json& value, const std::string& path) {
  if (!value.is_object()) throw InputError(path, quoted(value), "a mapping of fields");
}

void require_known(const Json& value, const std::string& path, const std::vector<std::string>& known) {
  for (const auto& [key, unused] : value.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const auto& k : known) list.append(list.empty() ? "" : ", ").append(k);
    throw InputError(path.empty() ? key : path + "." + key, "an unknown field", "one of " + list);
  }
}

const Json& require_field(const Json& value, const std::string& path, const char* field,
                          const char* requirement) {
  const auto it = value.find(field);
  if (it == value.end()) throw InputError(path.empty() ? field : path + "." + field, "nothing", requirement);
  return *it;
}

Eigen::Matrix3d read_rotation(const Json& value, const std::string& path) {
  if (value.is_array() && value.size() == 4) return rotation_3d(read_vector<4>(value, path, ""));
  if (value.is_array() && value.size() == 3) return read_matrix<3>(value, path, "");
  throw InputError(path, quoted(value), "a quaternion [w, x, y, z] or a 3x3 matrix");
}

Ellipsoid read_body(const Json& value, const std::string& path) {
  require_object(value, path);
  require_known(value, path, {"center", "semi_axes", "rotation", "shape", "quadric"});
  const int kinds = value.contains("semi_axes") + value.contains("shape") + value.contains("quadric");
  if (kinds != 1)
    throw InputError(path, kinds == 0 ? "no shape" : "more than one shape",
                     "given by exactly one of semi_axes (with rotation), shape, quadric");
  for (const char* other : {"center", "rotation"})
    if (value.contains("quadric") && value.contains(other))
      throw InputError(path + "." + other, quoted(value[other]), "left out: the quadric matrix contains it");
  if (value.contains("shape") && value.contains("rotation"))
    throw InputError(path + ".rotation", quoted(value["rotation"]), "left out: the shape matrix contains it");

  if (value.contains("quadric")) {
    const Eigen::Matrix4d q = read_matrix<4>(value["quadric"], path + ".quadric", "");
    try {
      return Ellipsoid::from_quadric(Quadric(q));
    } catch (const InputError& e) {
      throw e.within(path);
    }
  }
  const Eigen::Vector3d center = read_vector<3>(require_field(value, path, "center", "[x, y, z] in metres"),
                                                path + ".center", " (metres)");
  if (value.contains("shape")) {
    const Eigen::Matrix3d shape = read_matrix<3>(value["shape"], path + ".shape", " (square metres)");
    try {
      return Ellipsoid::from_shape(center, shape);
    } catch (const InputError& e) {
      throw e.within(path);
    }
  }
  const Eigen::Vector3d axes = read_vector<3>(value["semi_axes"], path + ".semi_axes", " (metres)");
  try {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    if (value.contains("rotation")) rotation = read_rotation(value["rotation"], "rotation");
    return Ellipsoid::from_axes(center, axes, rotation);
  } catch (const InputError& e) {
    throw e.within(path);
  }
}

}  // namespace

std::string quoted(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

Engagement read_engagement(const Json& value, Velocities velocities,
                           std::initializer_list<const char*> also) {
  if (!value.is_object()) throw InputError("engagement", quoted(value), "a mapping with agent and obstacle");
  std::vector<std::string> known{"agent", "obstacle", "agent_velocity", "obstacle_velocity"};
  known.insert(known.end(), also.begin(), also.end());
  require_known(value, "", known);
  Engagement e;
  const char* kBody = "a body: center with semi_axes and rotation, or with shape; or quadric";
  e.agent = read_body(require_field(value, "", "agent", kBody), "agent");
  e.obstacle = read_body(require_field(value, "", "obstacle", kBody), "obstacle");
  const auto velocity = [&](const char* field) -> Eigen::Vector3d {
    if (velocities == Velocities::optional && !value.contains(field)) return Eigen::Vector3d::Zero();
    return read_vector<3>(require_field(value, "", field, "[x, y, z] in m/s"), field, " (m/s)");
  };
  e.agent_velocity = velocity("agent_velocity");
  e.obstacle_velocity = velocity("obstacle_velocity");
  return e;
}

}  // namespace vericone::input
