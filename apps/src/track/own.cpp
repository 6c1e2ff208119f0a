// SPDX-License-Identifier: BSD-3-Clause
#include "track/own.h"

#include <vericone/geometry/error.h>
#include <vericone/simulation/run_tables.h>
#include <array>
#include <cmath>
#include <fstream>

#include "input/scene.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "pursuits/read_pursuit.h"

namespace vericone::tracking {

Own read_own(const std::string& own, const std::string& camera) {
  Own result;
  const pursuit::SeenBy seen = pursuit::read_perception(input::read_scene_fields(camera));
  result.perception = seen.perception;
  result.seconds = seen.picture_step;
  if (!std::ifstream(own)) throw InputError("--own", own, "a file that can be read");
  const simulation::Table table = simulation::table_of_csv(content_of(own), own);
  constexpr std::array<const char*, 13> kColumns{"t",    "x",    "y",    "z",    "r_11", "r_12", "r_13",
                                                 "r_21", "r_22", "r_23", "r_31", "r_32", "r_33"};
  std::array<const simulation::Column*, 13> columns{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    columns[i] = table.find(kColumns[i]);
    if (columns[i] == nullptr || columns[i]->text)
      throw InputError("--own", own, std::string("a table with a column ") + kColumns[i]);
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto value = [&](std::size_t i) {
      const double x = columns[i]->numbers[row];
      if (!std::isfinite(x))
        throw InputError("--own", own + ", row " + std::to_string(row + 1),
                         std::string("a number in the column ") + kColumns[i]);
      return x;
    };
    OwnPose pose;
    pose.t = value(0);
    if (row > 0 && !(pose.t > result.poses.back().t))
      throw InputError("--own", own + ", row " + std::to_string(row + 1), "times that rise");
    pose.camera.position = {value(1), value(2), value(3)};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) pose.camera.rotation(i, j) = value(std::size_t(4 + 3 * i + j));
    const double defect =
        (pose.camera.rotation.transpose() * pose.camera.rotation - Eigen::Matrix3d::Identity()).norm();
    if (!(defect < 1e-6))
      throw InputError("--own", own + ", row " + std::to_string(row + 1),
                       "an attitude r_11 ... r_33 that is a rotation");
    result.poses.push_back(pose);
  }
  if (result.poses.empty()) throw InputError("--own", own, "a table with a row for each picture");
  return result;
}

}  // namespace vericone::tracking
