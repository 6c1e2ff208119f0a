// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "ground_motion.h"
#include "opencv_image.h"
#include "street.h"

namespace vericone::vision::ground_motion_test {

using street::Camera;

cv::Mat grey(const Image& image) { return as_mat(image).clone(); }

TEST(GroundMotion, IsTheCameras) {
  Camera camera;
  GroundMotion ground;
  ground.start(grey(street::picture(camera, {}, {}, 0)));
  Eigen::Matrix3d before = camera.picture_of_ground();
  for (int frame = 1; frame < 12; ++frame) {
    camera.above += Eigen::Vector2d(0.8, -0.4);
    camera.turn += 0.02;
    camera.pixel *= 1.005;
    const Eigen::Matrix3d now = camera.picture_of_ground(), truth = now * before.inverse();
    const Eigen::Matrix3d found = ground.step(grey(street::picture(camera, {}, {}, frame)), {});
    before = now;
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(60, 60), Eigen::Vector2d(340, 60), Eigen::Vector2d(200, 240)}) {
      const Eigen::Vector2d a = (truth * p.homogeneous()).hnormalized(),
                            b = (found * p.homogeneous()).hnormalized();
      EXPECT_LT((a - b).norm(), 0.3) << "picture " << frame;
    }
  }
}

TEST(GroundMotion, IsNotThatOfTheTargets) {
  // Two thirds of the picture move otherwise: targets, and what is near them.
  Camera camera;
  GroundMotion ground;
  const auto draw = [&](int frame) {
    cv::Mat picture = grey(street::picture(camera, {}, {}, frame));
    Camera other = camera;
    other.above.x() -= 0.9 * frame;
    grey(street::picture(other, {}, {}, frame)).rowRange(0, 200).copyTo(picture.rowRange(0, 200));
    return picture;
  };
  ground.start(draw(0));
  const Box boxes[] = {{100, 50, 200, 100}};
  for (int frame = 1; frame < 6; ++frame) {
    const Eigen::Matrix3d found = ground.step(draw(frame), boxes);
    const Eigen::Vector2d p(200, 260), q = (found * p.homogeneous()).hnormalized();
    EXPECT_LT((q - p).norm(), 0.3);
  }
}

TEST(GroundMotion, OfASmallPicture) {
  Camera camera;
  camera.width = 64;
  camera.height = 48;
  GroundMotion ground;
  ground.start(grey(street::picture(camera, {}, {}, 0)));
  camera.above.x() += 0.6;  // 2 px
  const Eigen::Matrix3d found = ground.step(grey(street::picture(camera, {}, {}, 1)), {});
  const Eigen::Vector2d p(32, 24), q = (found * p.homogeneous()).hnormalized();
  EXPECT_LT((q - p + Eigen::Vector2d(2, 0)).norm(), 0.4);
}

TEST(GroundMotion, GoesOnWhereNothingIsSeen) {
  Camera camera;
  GroundMotion ground;
  ground.start(grey(street::picture(camera, {}, {}, 0)));
  camera.above.x() += 0.9;  // 3 px
  const Eigen::Matrix3d seen = ground.step(grey(street::picture(camera, {}, {}, 1)), {});
  EXPECT_NEAR(seen(0, 2), -3, 0.2);
  const cv::Mat dark(300, 400, CV_8U, cv::Scalar(7));
  EXPECT_EQ(ground.step(dark, {}), seen);
}

}  // namespace vericone::vision::ground_motion_test
