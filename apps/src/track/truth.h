// SPDX-License-Identifier: BSD-3-Clause
//
// Boxes as they are given: the first ones, and the true ones.
#pragma once

#include <vericone/vision/tracker.h>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace vericone::tracking {

/// Where a target is marked. Frames count from 1.
struct FirstBox {
  std::size_t frame = 1;
  vision::Box box;
};
/// Of words "X,Y,W,H" or "X,Y,W,H,FRAME". Throws InputError naming "--box".
[[nodiscard]] std::vector<FirstBox> read_boxes(const std::vector<std::string>& words);

/// The true boxes of each target by frame. A target may be absent from a frame: out of the picture, or all
/// hidden.
struct Truth {
  std::vector<std::string> names;  // as the file calls the targets, in the order in which they come
  std::vector<std::map<std::size_t, vision::Box>> boxes;
  std::vector<std::set<std::size_t>> absent;  // frames, of each target, that the file says so of
  bool every_frame = false;                   // one row a frame, of one target
  [[nodiscard]] std::size_t last_frame() const;
  /// The first box of each.
  [[nodiscard]] std::vector<FirstBox> first() const;
};
/// One "x,y,w,h" a frame of one target, or rows "frame,id,x,y,w,h,..." as MOTChallenge has them, of which
/// those with a seventh number of 0 do not count; "nan,nan,nan,nan" for x,y,w,h, as UAV123 has it, says that
/// the target is absent. Throws InputError naming "--truth" and the line.
[[nodiscard]] Truth read_truth(const std::filesystem::path& file);

}  // namespace vericone::tracking
