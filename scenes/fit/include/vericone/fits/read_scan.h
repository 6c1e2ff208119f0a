// SPDX-License-Identifier: BSD-3-Clause
//
// A file of points, a mesh or a map as a sample, for fits.
#pragma once

#include <vericone/fitting/sample.h>
#include <cstddef>
#include <string>
#include <vector>

namespace vericone::fits {

/// What a file had.
enum class ScanKind { mesh, cloud, octree };

/// A sample, and where it came from.
struct Scan {
  std::string file;  // as given
  std::string format;
  ScanKind kind = ScanKind::cloud;
  fitting::Sample sample;
  /// Of an octree map: its occupied cells, whose corners are the points.
  std::size_t cells = 0;
  /// What was left out or changed in reading.
  std::vector<std::string> notes;
  double seconds = 0;  // it took to read
};

/// A mesh (equal points made one) where the file has faces, a cloud otherwise; of an octree map the corners
/// of its occupied cells, unknown space taken for free. Throws InputError naming the file. Linear in its
/// size.
[[nodiscard]] Scan read_scan(const std::string& file);

/// "mesh of 5558 triangles and 2775 points", "cloud of ... points", "... corners of ... occupied cells".
[[nodiscard]] std::string describe(const Scan& scan);

}  // namespace vericone::fits
