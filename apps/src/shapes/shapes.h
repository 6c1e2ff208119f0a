// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone {

struct ShapesOptions : OutputOptions {
  ShapesOptions() { out = "out/shapes"; }
  std::vector<std::string> which;  // names of figures, docs/explanation/combined.md; empty: all
  double resolution = 0.09;        // of the surfaces, in parts of the semi-axes
  std::string mesh;                // also the bodies' surfaces as files: "obj" or "ply"
};

/// `vericone shapes`: pictures of combined quadrics and of their cones, with the data they are drawn from
/// (docs/explanation/combined.md). Writes NAME.json for each figure, shapes.json, provenance.json, the
/// pictures and meshes to `out`. Throws InputError naming "--figure", "--mesh" or "--resolution".
void run_shapes(const ShapesOptions& options, std::ostream& out);

}  // namespace vericone
