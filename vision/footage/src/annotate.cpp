// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/vision/whole.h>
#include <vericone/vision/footage/footage.h>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "codecs.h"

namespace vericone::vision {
namespace {

cv::Scalar colour_of(Sight sight) {
  switch (sight) {
    case Sight::no_occlusion:
      return {80, 220, 60};
    case Sight::partial:
      return {0, 220, 255};
    case Sight::total:
      return {60, 60, 255};
    case Sight::lost:
      break;
  }
  return {255, 60, 200};
}

void dashed(cv::Mat& picture, const cv::Point& a, const cv::Point& b, const cv::Scalar& colour) {
  const double length = cv::norm(b - a);
  for (double s = 0; s < length; s += 8) {
    const auto at = [&](double t) {
      return a + cv::Point(cv::Point2d(b - a) * (std::min(t, length) / length));
    };
    cv::line(picture, at(s), at(s + 4), colour, 1, cv::LINE_AA);
  }
}

}  // namespace

Image grey_of(const Image& image) {
  require_whole(image);
  if (image.channels == 1) return image;
  const cv::Mat seen(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.data.data()));
  return to_image(seen, 1);
}

void draw_sighting(Image& image, const Sighting& sighting, const std::string& name) {
  require_whole(image);
  if (image.channels != 3) throw InputError("image", "one of 1 channel", "of 3 channels, to draw in colour");
  cv::Mat picture(image.height, image.width, CV_8UC3, image.data.data());
  // A box that is expected far away is no line to draw.
  const Box& b = sighting.box;
  const double most = 4.0 * std::max(image.width, image.height);
  if (!(std::abs(b.x) < most && std::abs(b.y) < most && b.w < most && b.h < most)) return;
  const cv::Scalar colour = colour_of(sighting.sight);
  const cv::Point p(int(std::lround(b.x)), int(std::lround(b.y))),
      q(int(std::lround(b.x + b.w)), int(std::lround(b.y + b.h)));
  if (sighting.measured) {
    cv::rectangle(picture, p, q, colour, 1, cv::LINE_AA);
  } else {
    const cv::Point r(q.x, p.y), s(p.x, q.y);
    dashed(picture, p, r, colour);
    dashed(picture, r, q, colour);
    dashed(picture, q, s, colour);
    dashed(picture, s, p, colour);
  }
  const std::string text = name + (sighting.measured ? " " + cv::format("%.2f", sighting.confidence)
                                                     : std::string(" ") + to_string(sighting.sight));
  for (const auto& [ink, width] : {std::pair(cv::Scalar(0, 0, 0), 3), std::pair(colour, 1)})
    cv::putText(picture, text, p - cv::Point(0, 4), cv::FONT_HERSHEY_SIMPLEX, 0.4, ink, width, cv::LINE_AA);
}

}  // namespace vericone::vision
