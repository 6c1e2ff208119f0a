// SPDX-License-Identifier: BSD-3-Clause
//
// A file of points, a mesh or a map as a sample, for fits.
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/fitting/hull.h>
#include <cstddef>
#include <filesystem>
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

// A fitted hull as files (docs/reference/formats.md, fits).

/// fit.json, body.yaml, hull.obj and hull.ply into `folder`, which must exist. `options` are those that the
/// result was made with; `seconds` what it took. Throws std::system_error naming the path that cannot be
/// written, and as body_text().
void write_fit(const Scan& scan, const fitting::FitOptions& options, const fitting::FitResult& result,
               double seconds, const std::filesystem::path& folder);

}  // namespace vericone::fits
