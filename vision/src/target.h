// SPDX-License-Identifier: BSD-3-Clause
//
// One target of tracker(): what it looks like, where it goes, how much of it is seen.
#pragma once

#include <vericone/vision/tracker.h>
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "appearance.h"
#include "target_filter.h"

namespace vericone::vision {

class Target {
 public:
  /// `number`: of the target, from 0.
  Target(const cv::Mat& grey, const Box& box, const TrackerOptions& options, std::size_t number);

  /// The target in `now`, `before` being the picture before.
  Sighting step(const cv::Mat& before, const cv::Mat& now, const Eigen::Matrix3d& ground,
                const Expectation* expected, std::span<const Box> others);
  /// Where it is, or is expected, in the newest picture.
  [[nodiscard]] Box box() const;
  [[nodiscard]] bool seen() const { return hidden_ == 0; }

 private:
  struct Flow {
    View view;
    int points = 0;  // that agree with it
  };
  struct Candidate {
    View view;
    double cost = 0;  // squared standard deviations from what is expected, of place and looks
    double far = 0;   // the same of its place
    int seen = 0;
    Eigen::Vector2d moved = Eigen::Vector2d::Zero();  // px over the ground, of late
  };
  /// Points of the target followed from picture to picture, there and back, and the similarity of most of
  /// them.
  std::optional<Flow> flow(const cv::Mat& before, const cv::Mat& now, const Eigen::Matrix3d& ground,
                           const View& was, const View& guess);
  void seed(const cv::Mat& grey);
  struct Match {
    View view;
    Agreement agreement;
  };
  bool was_there_before(const Match& match) const;
  /// Where a picture shows what looks like the target (like_itself), up to `reach` px to each side of a view.
  std::vector<Match> look_alikes(const cv::Mat& grey, const View& about, double reach, int slack) const;
  /// Those beside the target, which are taken to go on beside it.
  void remember_rivals(const cv::Mat& grey);
  std::optional<Candidate> search(const cv::Mat& now, const Eigen::Matrix2d& gate,
                                  std::span<const Box> others) const;
  /// Where it is if it stopped, turned or sped up at once: what looks like it near `still`, where it would be
  /// had it stayed where it was. `tried`: a place that is not where it was expected.
  std::optional<Match> manoeuvre(const cv::Mat& now, const View& still, const View& guess,
                                 const std::optional<Match>& tried, std::span<const Box> others);
  /// Follows the candidate into this picture; `expected`: px over the ground that the target was to move.
  std::optional<Match> follow_candidate(const cv::Mat& now, const Eigen::Matrix3d& ground,
                                        const Eigen::Vector2d& expected);
  /// Whether another one that looks the same is expected nearer to a place than `far`, the target being at
  /// `own`; squared standard deviations, by the inverse of a covariance.
  [[nodiscard]] bool is_rival(const View& own, const Eigen::Vector2d& centre, const Eigen::Matrix2d& inverse,
                              double far) const;
  Form form_about(const View& view, double times) const;
  /// `slack`: 1 for what is found anywhere, up to 3 for what is where it is expected.
  [[nodiscard]] bool like_itself(const Agreement& agreement, int slack) const;
  [[nodiscard]] double deviation() const;  // px, of a measured centre
  bool settle(const cv::Mat& now, const View& guess, View& view, Agreement& agreement, int points);
  [[nodiscard]] Box box_at(const View& view) const;
  Sighting hidden(const Eigen::Matrix2d& gate);
  /// `velocity`: over the ground, px a picture, where what was expected of it is wrong.
  void accept(const cv::Mat& now, const View& view, const Agreement& agreement,
              const std::optional<Eigen::Vector2d>& velocity);

  TrackerOptions options_;
  int confirmed_;  // pictures that a regained target must go on as expected
  Box first_;
  View view_;
  Appearance anchor_, recent_;
  TargetFilter filter_;
  std::vector<cv::Point2f> points_;  // in the newest picture
  std::optional<Candidate> candidate_;
  struct LastSeen {
    cv::Mat picture;
    View view;
    Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();  // from there to the newest picture
  };
  LastSeen last_seen_;
  /// How it looked when it was measured last, and what was expected then.
  struct Told {
    View view;
    double scale, turn;
  };
  std::optional<Told> told_;
  struct Rival {
    Eigen::Vector2d beside;  // first-picture px from the target, turned with it
    int seen;                // age_ then
  };
  std::vector<Rival> rivals_;
  int age_ = 0;         // pictures
  int phase_ = 0;       // of the pictures in which rivals are looked for: not all targets in the same
  double turning_ = 0;  // rad a picture over the ground
  double unrest_ = 1;   // squared deviations from what was expected, of late, against what they should be
  int hidden_ = 0;      // pictures since the last measurement
  int followed_ = 0;    // pictures in a row with one
  double usual_ = 0.8, usual_visible_ = 0.85,
         usual_correlation_ = 0.9;  // of late; at first what a faint one has
};

}  // namespace vericone::vision
