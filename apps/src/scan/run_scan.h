// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "command/default_seed.h"
#include "output/output_options.h"

namespace vericone {

struct ScanOptions : OutputOptions {
  ScanOptions() { out = "out/scan"; }
  std::string scene;
  int planes = 36;
  int levels = 5;
  double azimuth = 0;  // of the plane of the picture, radians
  std::uint64_t seed = kDefaultSeed;
};

/// `vericone scan`: the lidars of a scene see its mesh, their scans are fused by ICP, and the source's
/// sectors are found on planes through what is seen (source, 6.3.3). Writes cloud.ply, scan.json,
/// section.json, provenance.json and pictures to `out` (docs/reference/formats.md). Throws InputError naming
/// a field or an option.
void run_scan(const ScanOptions& options, std::ostream& out);

}  // namespace vericone
