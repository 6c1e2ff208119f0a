// SPDX-License-Identifier: BSD-3-Clause
//
// What LiDARs saw and what it came to, as files (docs/reference/formats.md).
#pragma once

#include <vericone/cones/slices/visible_cone.h>
#include <vericone/scanning/study.h>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace vericone::scanning {

/// One look of the LiDARs, the study of finer ones, and the source's sectors of the first (source, 6.3.3) on
/// the setup's planes: nothing where its scans could not be fused.
struct Findings {
  Seen seen;
  Study study;
  std::optional<VisibleCone> cone;
};
/// Throws and costs as study(). `told` hears a line now and then.
[[nodiscard]] Findings scan_and_study(const Setup& setup,
                                      const std::function<void(const std::string& line)>& told = {});

/// scan.json. `v_agent`, `v_obstacle`: the bodies' velocities in the world, m/s, for the y of each sector.
[[nodiscard]] std::string scan_text(const Setup& setup, const Findings& found, const Eigen::Vector3d& v_agent,
                                    const Eigen::Vector3d& v_obstacle);

/// cloud.ply, scan.json and section.json, the picture on the plane at `azimuth` (radians), into `folder`,
/// which must exist. Throws std::system_error naming the path that cannot be written, and as study().
void write_scan(const Setup& setup, const Findings& found, const Eigen::Vector3d& v_agent,
                const Eigen::Vector3d& v_obstacle, double azimuth, const std::filesystem::path& folder);

}  // namespace vericone::scanning
