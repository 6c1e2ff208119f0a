// SPDX-License-Identifier: BSD-3-Clause
#include "cone/pieces_picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include "cone/answer.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "pieces/decimate.h"
#include "work/provenance.h"

namespace vericone {
namespace {

using std::numbers::pi;

constexpr int kPixels = 201;                                // across the view along the axis
constexpr int kPanoramaWidth = 360, kPanoramaHeight = 180;  // one degree a pixel

Json agent_json(const scenes::Scene& scene) {
  if (const Ellipsoid* ellipsoid = scene.agent.ellipsoid()) {
    Json factor = Json::array();
    for (int i = 0; i < 3; ++i) factor.push_back(vector_json(ellipsoid->factor().row(i)));
    return {{"center", vector_json(ellipsoid->center())}, {"factor", factor}};
  }
  Json points = Json::array();
  const HullBody hull = in_world(*scene.agent.hull(), scene.agent.placed.pose);
  for (const Eigen::Vector3d& x : hull.points()) points.push_back(vector_json(x));
  return {{"center", vector_json(agent_center(scene))}, {"points", points}};
}

/// Metres to the first contact in each direction, row by row; null where none comes.
template <typename Direction>
Json distances(const AssemblyOracle& oracle, int rows, int columns, int thread_count, Direction direction) {
  std::vector<std::vector<double>> found(static_cast<std::size_t>(rows));
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int row = next++; row < rows; row = next++) {
      auto& line = found[static_cast<std::size_t>(row)];
      for (int column = 0; column < columns; ++column) {
        const auto contact = oracle.first_contact(direction(row, column));
        line.push_back(contact ? contact->time : -1);
      }
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 1; i < thread_count; ++i) threads.emplace_back(work);
  work();
  threads.clear();
  Json all = Json::array();
  for (const auto& line : found) {
    Json row = Json::array();
    // Four digits are plenty for a colour.
    for (const double x : line) row.push_back(x < 0 ? Json(nullptr) : Json(std::stod(std::to_string(x))));
    all.push_back(std::move(row));
  }
  return all;
}

/// Directions around the axis, equally far from it as from the middle of the picture, whose upwards and right
/// are those of who looks along the axis.
Json view_along_axis(const AssemblyCone& cone, const Eigen::Vector3d& w, int threads) {
  const Eigen::Vector3d& axis = cone.frame.axis;
  Eigen::Vector3d right = axis.cross(Eigen::Vector3d::UnitZ());
  right = right.norm() > 1e-9 ? right.normalized() : Eigen::Vector3d(cone.frame.e1);
  const Eigen::Vector3d up = right.cross(axis);
  // The velocity as well where it is not far beyond.
  const double widest = cone.widest(),
               away = std::acos(std::clamp(w.dot(cone.frame.axis) / w.norm(), -1.0, 1.0));
  const double reach =
      std::min(away < 1.8 * widest ? std::max(1.15 * widest, 1.05 * away) : 1.15 * widest, pi);
  const auto direction = [&](int row, int column) -> Eigen::Vector3d {
    const double x = reach * (2.0 * column / (kPixels - 1) - 1), y = reach * (2.0 * row / (kPixels - 1) - 1);
    const double angle = std::hypot(x, y);
    if (!(angle > 0)) return axis;
    const Eigen::Vector3d across = (x * right + y * up) / angle;
    return std::cos(angle) * axis + std::sin(angle) * across;
  };
  return {{"reach", reach},
          {"up", vector_json(up)},
          {"right", vector_json(right)},
          {"distances", distances(cone.oracle, kPixels, kPixels, threads, direction)}};
}

/// All directions by azimuth (-180 to 180 degrees from x towards y) and elevation (-90 to 90).
Json panorama(const AssemblyCone& cone, int threads) {
  const auto direction = [](int row, int column) -> Eigen::Vector3d {
    const double elevation = pi * ((row + 0.5) / kPanoramaHeight - 0.5),
                 azimuth = 2 * pi * ((column + 0.5) / kPanoramaWidth - 0.5);
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
  };
  return distances(cone.oracle, kPanoramaHeight, kPanoramaWidth, threads, direction);
}

/// As course_json() of course.h; null where the velocities are equal.
Json course_of(const AssemblyCone& cone, const scenes::Scene& scene) {
  const Eigen::Vector3d w = scene.relative_velocity();
  if (!(w.norm() > 0)) return nullptr;
  Json result{{"velocity", vector_json(w)},
              {"verdict", to_string(cone.oracle.membership(scene.agent.velocity, scene.obstacle.velocity))}};
  if (const auto contact = cone.oracle.first_contact(w)) {
    result["contact_time"] = contact->time;
    result["contact_point"] = vector_json(contact->point);
  } else {
    const AssemblyMiss miss = cone.oracle.miss_distance(w);
    const double distance = 0.5 * (miss.least + miss.most);
    result["miss_distance"] = distance;
    result["nearest_time"] = miss.time;
    result["nearest_on_agent"] = vector_json(miss.point - distance * miss.normal);
    result["nearest_on_obstacle"] = vector_json(miss.point);
  }
  return result;
}

}  // namespace

std::string write_pieces_picture(const AssemblyCone& cone, const scenes::Scene& scene,
                                 const std::filesystem::path& folder, int threads) {
  const Box agent = bounds_of_agent(scene);
  const Assembly& pieces = *scene.obstacle.pieces();
  const Pose& pose = scene.obstacle.placed.pose;
  const bool within = pieces.bounds().contains(pose.to_body(agent.center()));
  Json data = to_json(cone, scene);
  data["title"] = scene.obstacle.name;
  data["agent"] = agent_json(scene);
  data["course"] = course_of(cone, scene);
  if (within) {
    data["top"] = top_view(pieces, pose, agent.low.z(), agent.high.z());
    data["heights"] = {agent.low.z(), agent.high.z()};
    data["panorama"] = panorama(cone, threads);
  } else {
    data["body"] = shown_pieces(pieces, pose);
    data["view"] = view_along_axis(cone, scene.relative_velocity(), threads);
  }
  write_whole(folder / "pieces.json", data.dump() + "\n");
  return within ? "panorama.py" : "pieces.py";
}

}  // namespace vericone
