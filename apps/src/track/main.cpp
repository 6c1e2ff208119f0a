// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-track`, which links OpenCV with its codecs (Apache-2.0; FFmpeg's are LGPL and GPL).
#include <iostream>

#include "command/output_line.h"
#include "command/program.h"
#include "track/track_command.h"

namespace {

int track_command(vericone::CommandLine& line) {
  vericone::TrackOptions track;
  line.option("video", track.video, "A video, or a folder of pictures in the order of their names")
      .required();
  line.option("--box", track.boxes,
              "Targets: X,Y,W,H in pixels, from the left and top edge; or X,Y,W,H,FRAME, from 1")
      .words(1, -1)
      .shown_type("X,Y,W,H[,FRAME]")
      .shown_default("");
  line.option(
      "--truth", track.truth,
      "File of the true boxes: x,y,w,h a frame, or frame,id,x,y,w,h; without --box it gives the first ones");
  line.option("--tracker", track.tracker, "source: as chapters 3 and 4 have it; or ours")
      .shown_default("ours, or that of --camera");
  const auto own =
      line.option("--own", track.own,
                  "Where the camera was at each picture, own.csv of vericone pursue --frames: also writes "
                  "estimates.csv, the targets on the ground");
  line.option("--camera", track.camera,
              "The camera of --own and what the filters need, camera.yaml of the same")
      .needs(own);
  line.option("--frames", track.frames, "Pictures to look at, at most");
  line.option("--rate", track.rate, "Pictures a second, where the video does not say it; 30 if nobody does");
  line.negative_flag("--no-video", track.video_out, "No video with the boxes");
  read_files_line(line, track);
  return vericone::run_track(track, std::cout);
}

}  // namespace

int main(int argc, char** argv) { return vericone::run_program(argc, argv, "track", track_command); }
