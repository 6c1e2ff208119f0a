// SPDX-License-Identifier: BSD-3-Clause
//
// The file that `vericone fit` is given, as a sample.
#pragma once

#include <vericone/fitting/sample.h>
#include <filesystem>
#include <string>
#include <vector>

namespace vericone::fit {

enum class ScanKind { mesh, cloud, octree };

struct Scan {
  std::string file;  // as given
  std::string format;
  ScanKind kind = ScanKind::cloud;
  fitting::Sample sample;
  /// Of an octree map: its occupied cells, whose corners are the points.
  std::size_t cells = 0;
  /// What was left out or changed in reading.
  std::vector<std::string> notes;
  double seconds = 0;
};

/// A mesh (equal points made one) where the file has faces, a cloud otherwise; of an octree map the corners
/// of its occupied cells. Throws InputError naming the file.
Scan read_scan(const std::string& file);

/// "mesh of 5558 triangles and 2775 points", "cloud of ... points", "... corners of ... occupied cells".
std::string describe(const Scan& scan);

}  // namespace vericone::fit
