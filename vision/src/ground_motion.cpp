// SPDX-License-Identifier: BSD-3-Clause
#include "ground_motion.h"

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "opencv_image.h"

namespace vericone::vision {
namespace {

constexpr int kCellsAcross = 12, kCellsDown = 9;  // one corner each, so that they spread over the picture
constexpr int kEvery = 5;                         // pictures after which empty cells get new corners
constexpr int kWindow = 15, kLevels = 3;          // reaches 15 * 2^3 px at half resolution
constexpr double kReturn = 0.5;  // px, forward and backward: a corner that was really followed
constexpr double kOffPlane = 1;  // px from the plane's motion
constexpr int kLeastPlane = 16, kLeastSimilarity = 5;

cv::Point2f moved(const Eigen::Matrix3d& h, const cv::Point2f& p) {
  const Eigen::Vector3d q = h * Eigen::Vector3d(p.x, p.y, 1);
  return {float(q.x() / q.z()), float(q.y() / q.z())};
}

/// Half resolution: full pixel (u, v) is ((u - 0.5) / 2, (v - 0.5) / 2), where the middle of four is.
Eigen::Matrix3d half_of_full() {
  Eigen::Matrix3d h = Eigen::Matrix3d::Identity();
  h(0, 0) = h(1, 1) = 0.5;
  h(0, 2) = h(1, 2) = -0.25;
  return h;
}

bool covered(const cv::Point2f& p, std::span<const Box> targets) {
  for (const Box& b : targets) {
    const Eigen::Vector2d c = b.centre();  // a box once again as large: shadows, and where it is next
    if (std::abs(2 * p.x + 0.5 - c.x()) < b.w && std::abs(2 * p.y + 0.5 - c.y()) < b.h) return true;
  }
  return false;
}

/// Near enough to a similarity to be what a camera far above sees from one picture to the next; a fit to few
/// corners on one side is often not.
bool plausible(const Eigen::Matrix3d& h, const cv::Size& size) {
  for (const double u : {0.0, double(size.width)})
    for (const double v : {0.0, double(size.height)}) {
      const double z = (h.row(2) * Eigen::Vector3d(u, v, 1)).value() / h(2, 2);
      if (!(z > 0.8 && z < 1.25)) return false;
    }
  const double det = h.topLeftCorner<2, 2>().determinant() / (h(2, 2) * h(2, 2));
  return det > 0.5 && det < 2;
}

}  // namespace

void GroundMotion::start(const cv::Mat& grey) {
  cv::resize(grey, half_, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::buildOpticalFlowPyramid(half_, before_, {kWindow, kWindow}, kLevels);
  corners_.clear();
  last_.setIdentity();
  since_ = 0;
}

void GroundMotion::find_corners(std::span<const Box> targets) {
  // Derivatives lie between the levels of the pyramid; level 1 is a quarter of the full resolution. A small
  // picture has none.
  const bool coarse = before_.size() > 2;
  const cv::Mat& level = before_[coarse ? 2 : 0];
  const float scale = coarse ? 2 : 1;
  cv::Mat strength;
  cv::cornerMinEigenVal(level, strength, 3, 3);
  std::vector<char> taken(kCellsAcross * kCellsDown, 0);
  const auto cell_of = [&](const cv::Point2f& p) {
    const int x = std::clamp(int(p.x * kCellsAcross / float(half_.cols)), 0, kCellsAcross - 1),
              y = std::clamp(int(p.y * kCellsDown / float(half_.rows)), 0, kCellsDown - 1);
    return y * kCellsAcross + x;
  };
  for (const cv::Point2f& p : corners_) taken[cell_of(p)] = 1;
  for (int cy = 0; cy < kCellsDown; ++cy)
    for (int cx = 0; cx < kCellsAcross; ++cx) {
      if (taken[cy * kCellsAcross + cx]) continue;
      const cv::Rect cell(
          cv::Point(cx * level.cols / kCellsAcross, cy * level.rows / kCellsDown),
          cv::Point((cx + 1) * level.cols / kCellsAcross, (cy + 1) * level.rows / kCellsDown));
      if (cell.empty()) continue;
      double most = 0;
      cv::Point at;
      cv::minMaxLoc(strength(cell), nullptr, &most, nullptr, &at);
      const cv::Point2f p(scale * float(cell.x + at.x), scale * float(cell.y + at.y));
      // Whether a corner is one is seen when it is followed there and back: at night all are weak.
      if (most > 0 && p.x > 4 && p.y > 4 && p.x < float(half_.cols - 5) && p.y < float(half_.rows - 5) &&
          !covered(p, targets))
        corners_.push_back(p);
    }
}

Eigen::Matrix3d GroundMotion::step(const cv::Mat& grey, std::span<const Box> targets) {
  if (since_++ % kEvery == 0) find_corners(targets);
  cv::resize(grey, half_, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::buildOpticalFlowPyramid(half_, now_, {kWindow, kWindow}, kLevels);
  std::vector<cv::Point2f> there, back, from, to;
  std::vector<std::uint8_t> found, returned;
  if (!corners_.empty()) {
    for (const cv::Point2f& p : corners_) there.push_back(moved(last_, p));
    back = corners_;
    std::vector<float> error;
    const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 15, 0.03);
    cv::calcOpticalFlowPyrLK(before_, now_, corners_, there, found, error, {kWindow, kWindow}, kLevels, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    cv::calcOpticalFlowPyrLK(now_, before_, there, back, returned, error, {kWindow, kWindow}, 1, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (found[i] && returned[i] && cv::norm(back[i] - corners_[i]) < kReturn && there[i].x > 1 &&
          there[i].y > 1 && there[i].x < float(half_.cols - 2) && there[i].y < float(half_.rows - 2)) {
        from.push_back(corners_[i]);
        to.push_back(there[i]);
      }
  }
  std::swap(before_, now_);
  corners_.clear();

  Eigen::Matrix3d h = last_;
  std::vector<std::uint8_t> on;
  bool known = false;
  if (from.size() >= std::size_t(kLeastPlane)) {
    const cv::Mat fit = cv::findHomography(from, to, cv::RANSAC, kOffPlane, on, 300, 0.995);
    Eigen::Matrix3d plane;
    if (!fit.empty()) cv::cv2eigen(fit, plane);
    known = !fit.empty() && 2 * cv::countNonZero(on) > int(from.size()) && plausible(plane, half_.size());
    if (known) h = plane / plane(2, 2);
  }
  if (!known && from.size() >= std::size_t(kLeastSimilarity)) {
    const cv::Mat fit = cv::estimateAffinePartial2D(from, to, on, cv::RANSAC, kOffPlane, 300, 0.99);
    Eigen::Matrix<double, 2, 3> similarity;
    if (!fit.empty()) cv::cv2eigen(fit, similarity);
    known = !fit.empty() && cv::countNonZero(on) >= std::max(kLeastSimilarity, int(from.size()) / 3);
    if (known) {
      h.setIdentity();
      h.topRows<2>() = similarity;
      known = plausible(h, half_.size());
    }
  }
  if (!known) {
    h = last_;
    since_ = 0;
  }
  last_ = h;
  for (std::size_t i = 0; i < to.size(); ++i)
    if ((!known || on[i]) && !covered(to[i], targets)) corners_.push_back(to[i]);
  const Eigen::Matrix3d scale = half_of_full();
  return scale.inverse() * h * scale;
}

}  // namespace vericone::vision
