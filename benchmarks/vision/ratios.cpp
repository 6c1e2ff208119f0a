// SPDX-License-Identifier: BSD-3-Clause
//
// The tracker's time a picture over that of OpenCV's pyramidal Lucas-Kanade on the same pictures and as many
// points, both pyramids built within it, one thread: 1000 x 800 px, three cars, images in memory. With the
// ground's motion given by the camera, and found in the pictures. Times are of the processor, so that other
// work counts little; two columns a row: the medians' ratio (asked for: under 1.5), and the 99 % quantile
// over Lucas-Kanade's median (under 4).
#include <time.h>

#include <vericone/vision/tracker.h>
#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

namespace {

using namespace vericone::vision;

double milliseconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

constexpr int kWidth = 1000, kHeight = 800, kTargets = 3, kFrames = 300;
constexpr int kOnTarget = 12, kOnGround = 108;  // points of Lucas-Kanade, as many as the tracker's

struct Street {
  cv::Mat ground = cv::Mat(2000, 4000, CV_8U), car = cv::Mat(8, 17, CV_8U);
  Street() {
    cv::RNG random(7);
    cv::Mat rough(ground.size() / 8, CV_8U), fine(ground.size() / 2, CV_8U), large, small;
    random.fill(rough, cv::RNG::UNIFORM, 60, 160);
    random.fill(fine, cv::RNG::UNIFORM, 90, 130);
    cv::resize(rough, large, ground.size(), 0, 0, cv::INTER_CUBIC);
    cv::resize(fine, small, ground.size(), 0, 0, cv::INTER_CUBIC);
    cv::addWeighted(large, 0.5, small, 0.5, 0, ground);
    car.setTo(200);
    car.colRange(4, 6).setTo(30);
    car.colRange(11, 13).setTo(50);
  }
  Box box(int target, int frame) const {
    return {400.0 + 60 * target + 0.37 * frame * (target - 1), 340.0 + 50 * target, 17, 8};
  }
  cv::Mat picture(int frame, cv::RNG& random) const {
    cv::Mat result;
    const cv::Matx23d shift(1, 0, 20 + 2.3 * frame, 0, 1, 30 + 1.1 * frame);
    cv::warpAffine(ground, result, shift, {kWidth, kHeight}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    for (int i = 0; i < kTargets; ++i) {
      const Box b = box(i, frame);
      const cv::Matx23d place(1, 0, b.x, 0, 1, b.y);
      cv::warpAffine(car, result, place, result.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
    }
    cv::Mat noise(result.size(), CV_8U);
    random.fill(noise, cv::RNG::UNIFORM, 0, 7);
    result += noise;
    return result;
  }
};

void measure(bool given) {
  const Street street;
  cv::RNG random(3);
  const auto follower = tracker();
  std::vector<double> ours, theirs;
  cv::Mat before;
  int measured = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Mat picture = street.picture(frame, random);
    Image image(kWidth, kHeight, 1);
    std::copy_n(picture.data, image.data.size(), image.data.begin());
    if (frame == 0) {
      std::vector<Box> boxes;
      for (int i = 0; i < kTargets; ++i) boxes.push_back(street.box(i, 0));
      follower->start(image, boxes);
    } else {
      std::optional<Eigen::Matrix3d> ground;
      if (given) {
        ground = Eigen::Matrix3d::Identity();
        (*ground)(0, 2) = -2.3;
        (*ground)(1, 2) = -1.1;
      }
      double start = milliseconds();
      const auto& sightings = follower->step(image, ground, {});
      ours.push_back(milliseconds() - start);
      for (const Sighting& s : sightings) measured += s.measured;
      std::vector<cv::Point2f> from, to;
      for (int i = 0; i < kTargets; ++i) {
        const Box b = street.box(i, frame - 1);
        for (int k = 0; k < kOnTarget; ++k)
          from.emplace_back(float(b.x + b.w * (k % 4 + 0.5) / 4), float(b.y + b.h * (k / 4 + 0.5) / 3));
      }
      for (int k = 0; k < (given ? 0 : kOnGround); ++k)
        from.emplace_back(float(kWidth * (k % 12 + 0.5) / 12), float(kHeight * (k / 12 + 0.5) / 9));
      std::vector<std::uint8_t> found;
      std::vector<float> error;
      start = milliseconds();
      cv::calcOpticalFlowPyrLK(before, picture, from, to, found, error);
      theirs.push_back(milliseconds() - start);
    }
    before = picture;
  }
  const double base = quantile(theirs, 0.5);
  std::printf("%-28s %8.2f ms %8.2f ms %8.2f %8.2f   measured %d of %d\n",
              given ? "ground's motion given" : "ground's motion found", quantile(ours, 0.5), base,
              quantile(ours, 0.5) / base, quantile(ours, 0.99) / base, measured, kTargets * (kFrames - 1));
}

}  // namespace

int main() {
  cv::setNumThreads(1);
  std::printf("%-28s %11s %11s %8s %8s\n", "", "ours", "LK", "median", "99 %");
  measure(true);
  measure(false);
}
