// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/vision/tracker.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>

#include "first_boxes.h"
#include "opencv_image.h"
#include "target_filter.h"

namespace vericone::vision {
namespace {

using Points = std::vector<cv::Point2f>;

constexpr int kBlock = 5, kIterations = 10;
constexpr double kEpsilon = 0.01;
// Errors above this one that stand out against the least are made worse, so that they count as bad.
constexpr double kSuspect = 11.25, kStandsOut = 100, kWorse = 10;

struct Followed {
  Box box;
  Points points;                 // in the newest picture
  Points offsets;                // of the points from their centroid, at the start
  Eigen::Vector2d to_centre;     // from the centroid to the box's centre, at the start
  std::vector<cv::Mat> patches;  // about each point, at the start
  std::vector<cv::Mat> descriptors;
  TargetFilter filter;
  Sight sight = Sight::no_occlusion;
};

Eigen::Vector2d centroid(const Points& points, const std::vector<char>& use) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (use[i]) sum += Eigen::Vector2d(points[i].x, points[i].y), ++count;
  return sum / std::max(1, count);
}

class SourceTracker : public Tracker {
 public:
  explicit SourceTracker(const SourceTrackerOptions& options)
      : options_(options), sift_(cv::SIFT::create()) {}

  void start(const Image& image, std::span<const Box> boxes) override {
    check_picture(image, {});
    cv::Mat grey;
    to_grey(image, grey);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      check_first_box(grey, boxes[i], "boxes[" + std::to_string(i) + "]");
    before_ = grey;
    targets_.clear();
    for (const Box& box : boxes) targets_.push_back(follow(box));
  }

  void add(const Box& box) override {
    if (before_.empty()) throw InputError("image", "none", "a first picture before any box");
    check_first_box(before_, box, "boxes[" + std::to_string(targets_.size()) + "]");
    targets_.push_back(follow(box));
  }

  const std::vector<Sighting>& step(const Image& image, const std::optional<Eigen::Matrix3d>& ground,
                                    std::span<const Expectation> expected) override {
    check_picture(image, before_);
    if (!expected.empty() && expected.size() != targets_.size())
      throw InputError("expected", std::to_string(expected.size()), "one a target, or none");
    to_grey(image, now_);
    sightings_.resize(targets_.size());
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      Followed& target = targets_[i];
      target.filter.predict(ground ? *ground : Eigen::Matrix3d::Identity());
      const Eigen::Vector2d predicted = expected.empty() ? target.filter.centre() : expected[i].centre;
      const Eigen::Vector2d was = target.box.centre();
      advance(target, predicted);
      Sighting& s = sightings_[i];
      s.sight = target.sight;
      s.measured = target.sight != Sight::total;
      const Eigen::Vector2d centre = s.measured ? target.box.centre() : predicted;
      // Its filter is told what is measured, with the metre of the source's R at any scale: a point's error.
      if (s.measured && (centre - was).allFinite()) target.filter.update(centre, Eigen::Matrix2d::Identity());
      target.box.x = centre.x() - 0.5 * target.box.w;
      target.box.y = centre.y() - 0.5 * target.box.h;
      s.box = target.box;
      s.covariance = Eigen::Matrix2d::Identity();
      s.confidence = target.sight == Sight::no_occlusion ? 1 : target.sight == Sight::partial ? 0.5 : 0;
    }
    std::swap(before_, now_);
    return sightings_;
  }

 private:
  cv::Rect patch_at(const cv::Point2f& p, int side) const {
    return cv::Rect(int(std::lround(p.x)) - side / 2, int(std::lround(p.y)) - side / 2, side, side);
  }
  int side(const Followed& target) const {
    return std::max(5, int(std::lround(options_.patch * std::max(target.box.w, target.box.h))) | 1);
  }
  cv::Rect picture() const { return {0, 0, before_.cols, before_.rows}; }

  cv::Mat descriptor(const cv::Mat& grey, const cv::Point2f& p, int size) {
    std::vector<cv::KeyPoint> keypoints{cv::KeyPoint(p, float(size))};
    cv::Mat result;
    const cv::Rect area = patch_at(p, 8 * size + 1) & picture();  // SIFT looks no further
    keypoints[0].pt -= cv::Point2f(area.tl());
    sift_->compute(grey(area), keypoints, result);
    return result;
  }

  Followed follow(const Box& box) {
    Followed target;
    target.box = box;
    const cv::Rect area = cv::Rect(cv::Point(int(std::lround(box.x)), int(std::lround(box.y))),
                                   cv::Size(int(std::lround(box.w)), int(std::lround(box.h)))) &
                          picture();
    cv::goodFeaturesToTrack(before_(area), target.points, options_.corners, options_.quality,
                            options_.distance, {}, kBlock);
    for (cv::Point2f& p : target.points) p += cv::Point2f(area.tl());
    if (target.points.empty()) target.points.emplace_back(float(box.centre().x()), float(box.centre().y()));
    const Eigen::Vector2d c = centroid(target.points, std::vector<char>(target.points.size(), 1));
    target.to_centre = box.centre() - c;
    for (const cv::Point2f& p : target.points) {
      target.offsets.emplace_back(float(p.x - c.x()), float(p.y - c.y()));
      target.patches.push_back(before_(patch_at(p, side(target)) & picture()).clone());
      target.descriptors.push_back(descriptor(before_, p, side(target)));
    }
    const double size = std::sqrt(box.w * box.h);
    target.filter = TargetFilter(box.centre(), 1, 0.1 * size, 0.01 * size);
    return target;
  }

  void set_centre(Followed& target, const Eigen::Vector2d& at) {
    const Eigen::Vector2d c = at + target.to_centre;
    target.box.x = c.x() - 0.5 * target.box.w;
    target.box.y = c.y() - 0.5 * target.box.h;
  }

  /// Which points are found again within the predicted box, by their patch and by their descriptor; both must
  /// agree. Moves those there.
  std::vector<char> recover(Followed& target, const Eigen::Vector2d& predicted) {
    std::vector<char> found(target.points.size(), 0);
    const int margin = side(target) / 2 + 1;
    const cv::Rect area =
        cv::Rect(int(std::floor(predicted.x() - 0.5 * target.box.w)) - margin,
                 int(std::floor(predicted.y() - 0.5 * target.box.h)) - margin,
                 int(std::ceil(target.box.w)) + 2 * margin, int(std::ceil(target.box.h)) + 2 * margin) &
        picture();
    if (area.width < 8 || area.height < 8) return found;
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    sift_->detectAndCompute(now_(area), {}, keypoints, descriptors);
    for (std::size_t i = 0; i < target.points.size(); ++i) {
      const cv::Mat& patch = target.patches[i];
      if (patch.cols > area.width || patch.rows > area.height) continue;
      cv::Mat score;
      cv::matchTemplate(now_(area), patch, score, cv::TM_CCOEFF_NORMED);
      double most = 0;
      cv::Point at;
      cv::minMaxLoc(score, nullptr, &most, nullptr, &at);
      if (!(most > options_.template_score)) continue;
      double least = 1e300;
      for (int k = 0; k < descriptors.rows && !target.descriptors[i].empty(); ++k)
        least = std::min(least, cv::norm(descriptors.row(k), target.descriptors[i], cv::NORM_L2));
      if (!(least < options_.descriptor_distance)) continue;
      found[i] = 1;
      target.points[i] =
          cv::Point2f(float(area.x + at.x + patch.cols / 2), float(area.y + at.y + patch.rows / 2));
    }
    return found;
  }

  /// Points that were lost are put back where they were against the others, and what they looked like into
  /// the picture, so that the flow goes on.
  void put_back(Followed& target, const std::vector<char>& good, const Eigen::Vector2d& at) {
    for (std::size_t i = 0; i < target.points.size(); ++i) {
      if (good[i]) continue;
      target.points[i] = cv::Point2f(float(at.x()), float(at.y())) + target.offsets[i];
      const cv::Mat& patch = target.patches[i];
      const cv::Rect there(int(std::lround(target.points[i].x)) - patch.cols / 2,
                           int(std::lround(target.points[i].y)) - patch.rows / 2, patch.cols, patch.rows);
      if ((there & picture()) == there) patch.copyTo(now_(there));
    }
  }

  void advance(Followed& target, const Eigen::Vector2d& predicted) {
    const std::size_t n = target.points.size();
    if (target.sight == Sight::total) {
      const std::vector<char> found = recover(target, predicted);
      settle_recovered(target, found);
      return;
    }
    const Points was = target.points;
    Points now;
    std::vector<std::uint8_t> status;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(before_, now_, was, now, status, error, {options_.window, options_.window},
                             options_.levels,
                             {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kIterations, kEpsilon});
    const float least = *std::min_element(error.begin(), error.end());
    std::vector<char> good(n, 1);
    for (std::size_t i = 0; i < n; ++i) {
      if (error[i] > kSuspect && error[i] > kStandsOut * least) error[i] *= float(kWorse);
      good[i] = status[i] && error[i] < options_.most_error;
    }
    const auto count = std::count(good.begin(), good.end(), 1);
    const bool gone =
        std::find(status.begin(), status.end(), 0) != status.end() || least >= options_.most_error;
    target.points = now;
    if (target.sight == Sight::no_occlusion && count == std::ptrdiff_t(n)) {
      set_centre(target, centroid(now, good));
      return;
    }
    if (target.sight == Sight::no_occlusion && (gone || count == 0)) {
      target.sight = Sight::total;
      return;
    }
    if (target.sight == Sight::partial) {
      Followed again = target;
      const std::vector<char> found = recover(again, predicted);
      const auto matched = std::count(found.begin(), found.end(), 1);
      if (matched == std::ptrdiff_t(n) || count == 0) {
        target = again;
        settle_recovered(target, found);
        return;
      }
    }
    // Centroid adjustment: that of the good points, and where the centroid of all was against theirs before.
    target.sight = Sight::partial;
    const std::vector<char> all(n, 1);
    const Eigen::Vector2d at = centroid(now, good) + centroid(was, all) - centroid(was, good);
    set_centre(target, at);
    put_back(target, good, at);
  }

  void settle_recovered(Followed& target, const std::vector<char>& found) {
    const auto matched = std::count(found.begin(), found.end(), 1);
    if (matched == 0) {
      target.sight = Sight::total;
      return;
    }
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i])
        at += (Eigen::Vector2d(target.points[i].x, target.points[i].y) -
               Eigen::Vector2d(target.offsets[i].x, target.offsets[i].y)) /
              double(matched);
    target.sight = matched == std::ptrdiff_t(found.size()) ? Sight::no_occlusion : Sight::partial;
    set_centre(target, at);
    put_back(target, found, at);
  }

  SourceTrackerOptions options_;
  cv::Ptr<cv::SIFT> sift_;
  cv::Mat before_, now_;
  std::vector<Followed> targets_;
  std::vector<Sighting> sightings_;
};

}  // namespace

std::unique_ptr<Tracker> source_tracker(const SourceTrackerOptions& options) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0 && value <= 1e6)) throw InputError(name, to_text(value), "positive, at most 1e6");
  };
  positive("corners", options.corners);
  positive("quality", options.quality);
  positive("distance", options.distance);
  positive("most_error", options.most_error);
  positive("descriptor_distance", options.descriptor_distance);
  positive("patch", options.patch);
  if (options.window < 3 || options.window % 2 == 0)
    throw InputError("window", std::to_string(options.window), "an odd number from 3 up");
  if (options.levels < 0) throw InputError("levels", std::to_string(options.levels), "0 or more");
  return std::make_unique<SourceTracker>(options);
}

}  // namespace vericone::vision
