// SPDX-License-Identifier: BSD-3-Clause
//
// Clouds without a header, as the KITTI and nuScenes data sets have them: float32 x, y, z, intensity, and
// with nuScenes the ring.
#include "binary.h"

#include <vericone/geometry/error.h>
#include "source.h"

namespace vericone::files {

Parsed parse_kitti(const Source& source) {
  const bool nuscenes = source.path.ends_with(".pcd.bin");
  const std::size_t stride = nuscenes ? 20 : 16, count = source.bytes.size() / stride;
  if (source.bytes.size() % stride != 0)
    source.refuse(std::to_string(source.bytes.size()) + " bytes",
                  "a multiple of " + std::to_string(stride) + ", as " + (nuscenes ? "nuScenes" : "KITTI") +
                      " clouds of " + std::to_string(stride / 4) + " floats a point take");
  Parsed parsed{.format = nuscenes ? "nuScenes" : "KITTI"};
  parsed.points.resize(count);
  const char* at = source.bytes.data();
  std::size_t read = 0;
  for (Eigen::Vector3d& p : parsed.points) {
    if (++read % 4096 == 0) checkpoint();
    for (std::ptrdiff_t i = 0; i < 3; ++i) p(i) = little_endian<float>(at + 4 * i);
    at += stride;
  }
  return parsed;
}

}  // namespace vericone::files
