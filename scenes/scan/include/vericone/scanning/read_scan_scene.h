// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes with LiDARs from files (docs/reference/formats.md).
#pragma once

#include <vericone/scanning/study.h>
#include <vericone/scenes/scene.h>
#include <filesystem>

namespace vericone::scanning {

/// A scene, and what its agent's LiDARs are to study of it.
struct ScanScene {
  scenes::Scene scene;
  Setup setup;
};

/// Reads a scene whose agent is an ellipsoid, whose obstacle is a mesh, and which has `lidars`. Throws
/// InputError naming the file or the field.
[[nodiscard]] ScanScene read_scan_scene(const std::filesystem::path& file);

}  // namespace vericone::scanning
