// SPDX-License-Identifier: BSD-3-Clause
#include "fit/cone/cone_agent.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector3d;

constexpr const char* kForms =
    "x,y,z,radius in metres, around:N with N from 1 to 10000, around:N:DISTANCE in radii of the scan, or a "
    "file with an ellipsoid";

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

ConeRequest parse_around(const std::string& argument) {
  const auto parts = split(argument, ':');
  const auto count = number(parts[1]);
  const auto distance = parts.size() == 3 ? number(parts[2]) : 2.0;
  if (parts.size() > 3 || !count || !(*count >= 1 && *count <= 10'000) || *count != std::floor(*count) ||
      !distance || !(*distance > 1.25 && *distance <= 1e6))
    throw InputError(
        "--cone", argument,
        "around:N or around:N:DISTANCE, N from 1 to 10000, DISTANCE above 1.25 radii of the scan");
  ConeRequest request;
  request.around = static_cast<int>(*count);
  request.distance = *distance;
  return request;
}

std::string ball_text(const Vector3d& center, double radius) {
  char text[160];
  std::snprintf(text, sizeof text, "ball of radius %.5g m at (%.5g, %.5g, %.5g)", radius, center.x(),
                center.y(), center.z());
  return text;
}

ConeAgent ball(const Vector3d& center, double radius) {
  return {Ellipsoid::from_axes(center, Vector3d::Constant(radius)), ball_text(center, radius)};
}

}  // namespace

std::optional<ConeRequest> parse_cone_request(const std::string& argument) {
  if (argument.empty()) throw InputError("--cone", "nothing", kForms);
  if (argument.starts_with("around:")) return parse_around(argument);
  const auto parts = split(argument, ',');
  if (parts.size() != 4) return std::nullopt;
  double value[4];
  for (int i = 0; i < 4; ++i) {
    const auto x = number(parts[static_cast<std::size_t>(i)]);
    if (!x) return std::nullopt;
    value[i] = *x;
  }
  if (!(value[3] > 0)) throw InputError("--cone", argument, "x,y,z,radius with a positive radius (m)");
  ConeRequest request;
  try {
    request.agents.push_back(ball({value[0], value[1], value[2]}, value[3]));
  } catch (const InputError&) {
    throw InputError("--cone", argument, kForms);
  }
  return request;
}

std::vector<ConeAgent> agents_of(const ConeRequest& request, const fitting::Sample& scan) {
  if (request.around == 0) return request.agents;
  Vector3d low = scan.points.front(), high = low;
  const auto include = [&](const Vector3d& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  };
  const auto each = [&](const auto& use) {
    if (!scan.is_mesh()) {
      for (const Vector3d& x : scan.points) use(x);
    } else {
      for (const auto& t : scan.triangles)
        for (const std::uint32_t i : t) use(scan.points[i]);
    }
  };
  if (scan.is_mesh()) low = high = scan.points[scan.triangles.front()[0]];
  each(include);
  const Vector3d center = 0.5 * (low + high);
  double radius = 0;
  each([&](const Vector3d& x) { radius = std::max(radius, (x - center).norm()); });
  std::vector<ConeAgent> agents;
  for (int i = 0; i < request.around; ++i) {
    const double z = 1 - (2 * i + 1.0) / request.around, across = std::sqrt(1 - z * z);
    const double azimuth = 2 * std::numbers::pi * i / std::numbers::phi;
    const Vector3d direction(across * std::cos(azimuth), across * std::sin(azimuth), z);
    agents.push_back(ball(center + request.distance * radius * direction, 0.25 * radius));
  }
  return agents;
}

}  // namespace vericone
