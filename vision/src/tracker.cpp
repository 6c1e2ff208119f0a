// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/vision/tracker.h>
#include <string>

#include "first_boxes.h"
#include "ground_motion.h"
#include "opencv_image.h"
#include "target.h"

namespace vericone::vision {
namespace {

class Ours : public Tracker {
 public:
  explicit Ours(const TrackerOptions& options) : options_(options) {}

  void start(const Image& image, std::span<const Box> boxes) override {
    check_picture(image, {});
    cv::Mat grey;
    to_grey(image, grey);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      check_first_box(grey, boxes[i], "boxes[" + std::to_string(i) + "]");
    before_ = grey;
    targets_.clear();
    moving_ = false;
    for (const Box& box : boxes) targets_.emplace_back(grey, box, options_, targets_.size());
  }

  void add(const Box& box) override {
    if (before_.empty()) throw InputError("image", "none", "a first picture before any box");
    check_first_box(before_, box, "boxes[" + std::to_string(targets_.size()) + "]");
    targets_.emplace_back(before_, box, options_, targets_.size());
  }

  const std::vector<Sighting>& step(const Image& image, const std::optional<Eigen::Matrix3d>& ground,
                                    std::span<const Expectation> expected) override {
    check_picture(image, before_);
    if (!expected.empty() && expected.size() != targets_.size())
      throw InputError("expected", std::to_string(expected.size()), "one a target, or none");
    to_grey(image, now_);
    Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
    if (ground) {
      motion = *ground;
      moving_ = false;
    } else {
      if (!moving_) ground_.start(before_);
      moving_ = true;
      std::vector<Box> boxes;
      for (const Target& target : targets_) boxes.push_back(target.box());
      motion = ground_.step(now_, boxes);
    }
    sightings_.resize(targets_.size());
    std::vector<bool> was_hidden;
    for (const Target& target : targets_) was_hidden.push_back(!target.seen());
    // Those that are seen first: what is theirs is no hidden one's.
    std::vector<Box> seen;
    for (const bool hidden : {false, true})
      for (std::size_t i = 0; i < targets_.size(); ++i) {
        if (was_hidden[i] != hidden) continue;
        sightings_[i] =
            targets_[i].step(before_, now_, motion, expected.empty() ? nullptr : &expected[i], seen);
        if (sightings_[i].measured) seen.push_back(sightings_[i].box);
      }
    std::swap(before_, now_);
    return sightings_;
  }

 private:
  TrackerOptions options_;
  cv::Mat before_, now_;
  GroundMotion ground_;
  bool moving_ = false;  // ground_ has seen before_
  std::vector<Target> targets_;
  std::vector<Sighting> sightings_;
};

}  // namespace

const char* to_string(Sight sight) {
  switch (sight) {
    case Sight::no_occlusion:
      return "no_occlusion";
    case Sight::partial:
      return "partial";
    case Sight::total:
      return "total";
    case Sight::lost:
      break;
  }
  return "lost";
}

std::unique_ptr<Tracker> tracker(const TrackerOptions& options) {
  if (!(options.frame_seconds > 0 && options.frame_seconds <= 10))
    throw InputError("frame_seconds", to_text(options.frame_seconds), "above 0 and at most 10 s");
  if (!(options.give_up > 0)) throw InputError("give_up", to_text(options.give_up), "above 0 s");
  return std::make_unique<Ours>(options);
}

}  // namespace vericone::vision
