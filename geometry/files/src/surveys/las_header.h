// SPDX-License-Identifier: BSD-3-Clause
//
// The header of LAS files, and the points of compressed ones.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "../source.h"

namespace vericone::files {

struct LasHeader {
  int minor = 0, point_format = 0;
  bool is_compressed = false;
  std::size_t header_size = 0, points_at = 0, record = 0;
  std::uint64_t count = 0;
  Eigen::Array3d scale, offset;

  /// One rounding, of the exact sum.
  [[nodiscard]] Eigen::Vector3d place(std::int32_t x, std::int32_t y, std::int32_t z) const;
};

/// Its points, decompressed a chunk after the other. Memory: the points and what is known of one chunk.
void append_laz(const Source& source, const LasHeader& header, std::vector<Eigen::Vector3d>& points);

}  // namespace vericone::files
