// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone {

struct TrackOptions : OutputOptions {
  TrackOptions() { out = "out/track"; }
  std::string video;
  std::vector<std::string> boxes;
  std::string truth;
  std::string tracker;         // empty: ours, or the one of `camera`
  std::string own, camera;     // own.csv and camera.yaml of a pursuit; empty: nothing is known of the camera
  std::optional<int> frames;   // how many, at most
  std::optional<double> rate;  // pictures a second, where the file does not say it or is wrong
  bool video_out = true;
};

/// `vericone track`: targets followed through a video or a folder of pictures. Writes tracks.csv, claims.txt,
/// metrics.json, provenance.json (with `own` estimates.csv too: where the targets are on the ground), a video
/// with the boxes and a picture of the tracks to `out` (docs/howto/track.md). Throws InputError naming an
/// option; of a video that is cut off after what could be read is written. Returns the exit status.
int run_track(const TrackOptions& options, std::ostream& out);

}  // namespace vericone
