// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <vericone/geometry/error.h>
#include <vericone/vision/tracker.h>

#include "street.h"

namespace vericone::vision::first_boxes_test {

using street::Camera;
using street::Car;

std::string refusal(const auto& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FirstBoxes, OnesThatCannotBeFollowedAreNamed) {
  const Camera camera;
  const Car car;
  const Image image = street::picture(camera, {car}, {}, 1);
  const Box good = street::box_of(camera, car);
  Image plain(100, 80, 1);
  std::fill(plain.data.begin(), plain.data.end(), 90);
  for (const auto& make : {+[] { return tracker(); }, +[] { return source_tracker(); }}) {
    const auto follower = make();
    const auto starts = [&](const Image& on, std::vector<Box> boxes) {
      return refusal([&] { follower->start(on, boxes); });
    };
    EXPECT_EQ(starts(image, {good}), "");
    EXPECT_EQ(starts(image, {good, good}), "");
    EXPECT_EQ(starts(image, {good, {-9, 5, 20, 20}}),
              "boxes[1]: got -9,5,20,20, must be within the picture of 400 x 300 px");
    EXPECT_EQ(starts(image, {{10, 10, 20, -3}}),
              "boxes[0]: got 10,10,20,-3, must be X,Y,W,H of a box in pixels, with W and H above 0");
    EXPECT_THAT(starts(image, {{10, 10, 4, 4}}),
                testing::StartsWith("boxes[0]: got 10,10,4,4, must be at least 5 px long"));
    EXPECT_THAT(starts(plain, {{10, 10, 20, 20}}),
                testing::HasSubstr("must be around something with texture"));
    EXPECT_THAT(starts(Image(), {}), testing::StartsWith("image: got 0 x 0 px"));
  }
}

TEST(FirstBoxes, PicturesKeepTheirSizeAndTargetsTheirExpectations) {
  const Camera camera;
  const Car car;
  const Image image = street::picture(camera, {car}, {}, 1);
  for (const auto& make : {+[] { return tracker(); }, +[] { return source_tracker(); }}) {
    const auto follower = make();
    const std::vector<Box> boxes{street::box_of(camera, car)};
    EXPECT_THAT(refusal([&] { follower->add(boxes[0]); }), testing::StartsWith("image: got none"));
    follower->start(image, boxes);
    EXPECT_EQ(refusal([&] { follower->step(Image(40, 30, 1), {}, {}); }),
              "image: got 40 x 30 px, must be as large as the first one, 400 x 300 px");
    const std::vector<Expectation> two(2);
    EXPECT_EQ(refusal([&] { follower->step(image, {}, two); }),
              "expected: got 2, must be one a target, or none");
  }
}

TEST(FirstBoxes, OptionsOutOfRangeAreNamed) {
  EXPECT_THAT(refusal([] { return tracker({.frame_seconds = 0}); }),
              testing::StartsWith("frame_seconds: got 0"));
  EXPECT_THAT(refusal([] { return tracker({.give_up = -1}); }), testing::StartsWith("give_up: got -1"));
  EXPECT_THAT(refusal([] { return source_tracker({.window = 4}); }), testing::StartsWith("window: got 4"));
  EXPECT_THAT(refusal([] { return source_tracker({.quality = 0}); }), testing::StartsWith("quality: got 0"));
}

}  // namespace vericone::vision::first_boxes_test
