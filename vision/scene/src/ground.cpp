// SPDX-License-Identifier: BSD-3-Clause
#include "ground.h"

#include <vericone/geometry/error.h>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "look.h"
#include "polygon.h"

namespace vericone::vision {
namespace {

constexpr int kSize = 2048;  // px of a ground of our own making
constexpr int kMore = 2304;  // px, by which a level is continued so that a view needs no border

int type_of(int channels) { return channels == 1 ? CV_8UC1 : CV_8UC3; }

/// Draws at a place and at those that come to the same on a ground that repeats.
template <typename Draw>
void again(const Draw& draw) {
  for (const int dx : {0, -kSize})
    for (const int dy : {0, -kSize}) draw(cv::Point(dx, dy));
}

/// Smooth and periodic, of features `cell` px wide.
cv::Mat waves(cv::RNG& random, int cell, double size) {
  constexpr int kBorder = 2;
  const int n = kSize / cell;
  cv::Mat coarse(n, n, CV_32F), bordered, fine;
  random.fill(coarse, cv::RNG::NORMAL, 0, size);
  cv::copyMakeBorder(coarse, bordered, kBorder, kBorder, kBorder, kBorder, cv::BORDER_WRAP);
  cv::resize(bordered, fine, {}, cell, cell, cv::INTER_CUBIC);
  return fine(cv::Rect(kBorder * cell, kBorder * cell, kSize, kSize));
}

/// Fields, woods, roofs and roads, with detail at every size from 0.25 to 100 m.
cv::Mat made(std::uint64_t seed) {
  cv::RNG random(mixed(seed, 1));
  cv::Mat picture(kSize, kSize, CV_8UC3, cv::Scalar(80, 115, 105));
  const auto number = [&](int low, int high) { return random.uniform(low, high + 1); };
  const auto earth = [&] {
    const int light = number(70, 150);
    return cv::Scalar(light * 0.72, light * number(95, 115) / 100.0, light * number(85, 110) / 100.0);
  };
  const auto boxes = [&](int count, int least, int most, auto colour) {
    for (int i = 0; i < count; ++i) {
      const cv::Rect at(number(0, kSize - 1), number(0, kSize - 1), number(least, most), number(least, most));
      const cv::Scalar c = colour();
      again([&](const cv::Point& by) { cv::rectangle(picture, at + by, c, cv::FILLED); });
    }
  };
  boxes(60, 150, 600, earth);
  // Roofs, and what grows.
  boxes(60, 24, 80, [&] { return cv::Scalar::all(number(50, 215)); });
  for (int i = 0; i < 900; ++i) {
    const cv::Point at(number(0, kSize - 1), number(0, kSize - 1));
    const int radius = number(2, 14), light = number(30, 75);
    again([&](const cv::Point& by) {
      cv::circle(picture, at + by, radius, cv::Scalar(light * 0.7, light, light * 0.8), cv::FILLED,
                 cv::LINE_AA);
    });
  }
  cv::Mat rough = waves(random, 64, 8);
  for (const auto& [cell, size] : {std::pair{16, 9.0}, {8, 9.0}, {4, 8.0}, {2, 6.0}, {1, 5.0}})
    rough += waves(random, cell, size);
  cv::Mat three, light;
  cv::merge(std::array{rough, rough, rough}, three);
  picture.convertTo(light, CV_32F);
  light += three;
  light.convertTo(picture, CV_8U);
  // Roads over all of it: 10 m wide, with lines of 0.25 m.
  const cv::Scalar asphalt(86, 84, 82), paint(225, 228, 228);
  constexpr int kWide = 40, kDash = 24;
  for (const bool north : {false, true})
    for (int i = 0; i < 3; ++i) {
      const int at = i * kSize / 3 + number(60, kSize / 3 - 60);
      const auto strip = [&](int from, int width, int begin, int length, const cv::Scalar& colour) {
        const cv::Rect along(begin, at + from, length, width);
        cv::rectangle(picture, north ? cv::Rect(along.y, along.x, along.height, along.width) : along, colour,
                      cv::FILLED);
      };
      strip(0, kWide, 0, kSize, asphalt);
      strip(2, 1, 0, kSize, paint);
      strip(kWide - 3, 1, 0, kSize, paint);
      for (int dash = 0; dash < kSize; dash += 3 * kDash) strip(kWide / 2, 1, dash, kDash, paint);
    }
  return picture;
}

cv::Mat plain(const Ground& ground) {
  const double light = 96 + double(mixed(ground.seed, 2) % 48);
  cv::Mat picture(kSize, kSize, CV_8UC3, cv::Scalar(light * 0.8, light * 1.05, light));
  cv::RNG random(mixed(ground.seed, 3));
  const double m = ground.metres_per_pixel, side = kSize * m;
  const long count = std::lround(ground.marks * side * side * 1e-6);
  const int length = std::max(1, int(std::lround(15 / m))), width = std::max(1, int(std::lround(0.5 / m)));
  for (long i = 0; i < count; ++i) {
    const cv::Rect at(random.uniform(0, kSize), random.uniform(0, kSize), length, width);
    const cv::Scalar colour = cv::Scalar::all(random.uniform(150, 240));
    again([&](const cv::Point& by) { cv::rectangle(picture, at + by, colour, cv::FILLED); });
  }
  return picture;
}

}  // namespace

struct GroundPicture::Level {
  cv::Mat picture;
  double x = 1, y = 1;  // m of a pixel
  float mean = 0;
  mutable cv::Mat continued;  // made when first needed
};

struct GroundPicture::Parts {
  double metres_per_pixel;
  std::vector<Level> levels;  // each half as fine as the one before
};

GroundPicture::GroundPicture(const Ground& ground, int channels) : parts_(std::make_unique<Parts>()) {
  const double m = parts_->metres_per_pixel = ground.metres_per_pixel;
  cv::Mat picture;
  if (!ground.picture.empty())
    picture = cv::Mat(ground.picture.height, ground.picture.width, type_of(ground.picture.channels),
                      const_cast<std::uint8_t*>(ground.picture.data.data()))
                  .clone();
  else
    picture = ground.plain ? plain(ground) : made(ground.seed);
  if (picture.channels() != channels)
    cv::cvtColor(picture, picture, channels == 1 ? cv::COLOR_BGR2GRAY : cv::COLOR_GRAY2BGR);
  const double wide = m * picture.cols, high = m * picture.rows;
  const cv::Scalar means = cv::mean(picture);
  const auto mean =
      channels == 1 ? float(means[0]) : grey({float(means[0]), float(means[1]), float(means[2])});
  while (true) {
    parts_->levels.push_back({picture, wide / picture.cols, high / picture.rows, mean, {}});
    if (picture.cols < 32 || picture.rows < 32) break;
    cv::Mat half;
    cv::resize(picture, half, {picture.cols / 2, picture.rows / 2}, 0, 0, cv::INTER_AREA);
    picture = half;
  }
}

GroundPicture::~GroundPicture() = default;

const GroundPicture::Level& GroundPicture::level(double metres) const {
  const double finer = std::log2(std::max(1e-9, metres / parts_->metres_per_pixel));
  const long k = std::clamp(std::lround(finer), 0L, long(parts_->levels.size()) - 1);
  return parts_->levels[std::size_t(k)];
}

void GroundPicture::draw(const Camera& camera, const Pose& pose, Image& image) const {
  cv::Mat out(camera.height, camera.width, type_of(image.channels), image.data.data());
  const Eigen::Vector3d ahead = pose.rotation.col(2);
  const double height = std::max(pose.position.z(), 1e-3);
  // Steeper than this a pixel's size says little.
  const double depth = height / std::max(0.1, -ahead.z());
  const Level& now = level(depth / camera.focal);
  // Pixels to the level's pixels. Its rows go south from its northern edge, where a tile ends.
  Eigen::Matrix3d tile;
  tile << 1 / now.x, 0, -0.5, 0, -1 / now.y, -0.5, 0, 0, 1;
  Eigen::Matrix3d map = tile * plane_homography(camera, pose).inverse();
  Eigen::Array2d low = Eigen::Array2d::Constant(1e300), high = -low;
  bool sky = false;
  // How far below the horizon rays have to be for ground to be drawn.
  constexpr double kLevel = 0.02;
  for (const double u : {0.0, camera.width - 1.0})
    for (const double v : {0.0, camera.height - 1.0}) {
      const Eigen::Vector3d at = map * Eigen::Vector3d(u, v, 1);
      low = low.min(at.head<2>().array() / at.z());
      high = high.max(at.head<2>().array() / at.z());
      const Eigen::Vector3d ray = pose.rotation * camera.ray({u, v});
      sky |= !(ray.z() < -kLevel * ray.norm());
    }
  const Eigen::Array2d size(now.picture.cols, now.picture.rows);
  bool fits = !sky && ((high - low) < double(kMore - 4)).all();
  if (fits) {
    const Eigen::Array2d by = (low / size).floor() * size;
    map = (Eigen::Matrix3d() << 1, 0, -by.x(), 0, 1, -by.y(), 0, 0, 1).finished() * map;
    if (now.continued.empty())
      cv::copyMakeBorder(now.picture, now.continued, 0, kMore, 0, kMore, cv::BORDER_WRAP);
  }
  map /= map(2, 2);
  const cv::Mat& from = fits ? now.continued : now.picture;
  constexpr int kHow = cv::INTER_LINEAR | cv::WARP_INVERSE_MAP;
  if (map(2, 0) == 0 && map(2, 1) == 0) {
    const cv::Matx23d affine(map(0, 0), map(0, 1), map(0, 2), map(1, 0), map(1, 1), map(1, 2));
    cv::warpAffine(from, out, affine, out.size(), kHow, cv::BORDER_WRAP);
  } else {
    const cv::Matx33d projective(map(0, 0), map(0, 1), map(0, 2), map(1, 0), map(1, 1), map(1, 2), map(2, 0),
                                 map(2, 1), map(2, 2));
    cv::warpPerspective(from, out, projective, out.size(), kHow, cv::BORDER_WRAP);
  }
  if (!sky) return;
  const Colour blue(225, 205, 190);
  const Eigen::Vector3d up = pose.rotation.row(2).transpose();
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.ray({double(u), double(v)});
      if (up.dot(ray) < -kLevel * ray.norm()) continue;
      if (image.channels == 1)
        out.at<std::uint8_t>(v, u) = std::uint8_t(grey(blue));
      else
        out.at<cv::Vec3b>(v, u) = {225, 205, 190};
    }
}

float GroundPicture::relief(double x, double y, double metres) const {
  const Level& now = level(metres);
  const int w = now.picture.cols, h = now.picture.rows;
  const double u = x / now.x - 0.5, v = -y / now.y - 0.5, left = std::floor(u), top = std::floor(v);
  const auto wrapped = [](double i, int n) { return int(i - n * std::floor(i / n)); };
  const auto at = [&](int dx, int dy) {
    const int i = wrapped(left + dx, w), j = wrapped(top + dy, h);
    if (now.picture.channels() == 1) return float(now.picture.at<std::uint8_t>(j, i));
    const auto c = now.picture.at<cv::Vec3b>(j, i);
    return grey({float(c[0]), float(c[1]), float(c[2])});
  };
  const auto a = float(u - left), b = float(v - top);
  const float value = (1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1));
  return (value - now.mean) / 128;
}

}  // namespace vericone::vision
