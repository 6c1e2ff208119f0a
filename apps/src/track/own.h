// SPDX-License-Identifier: BSD-3-Clause
//
// What a UAS knows of its own camera: own.csv and camera.yaml of a pursuit (docs/reference/pursuits.md).
#pragma once

#include <vericone/vision/pursuit/perception.h>
#include <string>
#include <vector>

namespace vericone::tracking {

struct OwnPose {
  double t = 0;  // s
  Pose camera;
};

struct Own {
  vision::PerceptionOptions perception;
  double seconds = 0;  // from picture to picture
  std::vector<OwnPose> poses;
};

/// Throws InputError naming the option and, of what is in the files, the column or field.
Own read_own(const std::string& own, const std::string& camera);

}  // namespace vericone::tracking
