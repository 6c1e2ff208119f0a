// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone {

struct GalleryOptions : OutputOptions {
  GalleryOptions() { out = "out/gallery"; }
  std::vector<std::string> files;  // or folders: all meshes, clouds and maps in them
  int half_planes = 64;
  double tolerance = 1e-4;   // radians
  double resolution = 0.05;  // of the cone map, radians; 0: none
  double radius = 0.005;     // of a cloud's points, in parts of its largest side
};

/// `vericone gallery`: the cone of each file's body before a ball of a tenth of its largest side, which
/// stands off its middle by one and a half of that side; of octree maps also around a ball of four cells
/// within known free space. Writes a folder a cone, gallery.json, gallery.md (a table) and provenance.json. A
/// file that cannot be read is named and passed over. Returns the exit status: 0; 2 if there was one; 130
/// interrupted.
int run_gallery(const GalleryOptions& options, std::ostream& out);

}  // namespace vericone
