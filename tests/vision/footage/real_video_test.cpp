// SPDX-License-Identifier: BSD-3-Clause
//
// Real videos, which are not part of the project: the tests skip where they are not there.
#include <gtest/gtest.h>
#include <vericone/vision/footage/footage.h>
#include <vericone/vision/tracker.h>
#include <Eigen/Dense>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace vericone::vision::real_video_test {

namespace fs = std::filesystem;

fs::path video_folder() {
  const char* data = std::getenv("VERICONE_DATA_DIR");
  return fs::path(data ? data : VERICONE_DEFAULT_DATA_DIR) / "video";
}

std::vector<std::vector<double>> rows(const fs::path& file) {
  std::vector<std::vector<double>> result;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    result.emplace_back();
    for (std::string word; std::getline(words, word, ',');) result.back().push_back(std::stod(word));
  }
  return result;
}

TEST(RealVideo, ACarAtNightFromAbove) {
  const fs::path video = video_folder() / "uavdt_S1301.mp4", truth = video_folder() / "uavdt_S1301.txt";
  if (!fs::exists(video) || !fs::exists(truth)) GTEST_SKIP() << video << " is not there";
  const auto boxes = rows(truth);
  const auto box = [&](std::size_t k) { return Box{boxes[k][0], boxes[k][1], boxes[k][2], boxes[k][3]}; };
  const auto reader = open_footage(video, 1, "video");
  const auto follower = tracker();
  Image image;
  double precise = 0, success = 0;
  std::size_t frame = 0;
  for (; reader->next(image); ++frame) {
    ASSERT_LT(frame, boxes.size());
    if (frame == 0) {
      const Box first = box(0);
      follower->start(image, std::span(&first, 1));
      continue;
    }
    const Sighting& s = follower->step(image, {}, {})[0];
    if (!s.measured) continue;
    const double o = overlap(s.box, box(frame));
    EXPECT_GT(o, 0) << "a wrong claim at picture " << frame + 1;
    precise += (s.box.centre() - box(frame).centre()).norm() <= 20;
    for (int k = 0; k <= 20; ++k) success += (o > 0.05 * k) / 21.0;
  }
  ASSERT_EQ(frame, boxes.size());
  const double all = double(frame - 1);
  EXPECT_GE(precise / all, 0.95);
  EXPECT_GE(success / all, 0.5);
}

/// The homography of foot points to metres, fitted to all true boxes by the direct linear method.
Eigen::Matrix3d metres_of(const std::vector<std::vector<double>>& truth) {
  Eigen::MatrixXd a(2 * Eigen::Index(truth.size()), 9);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto& r = truth[k];
    const Eigen::RowVector3d p((r[2] + r[4] / 2) / 500, (r[3] + r[5]) / 500, 1), none(0, 0, 0);
    a.row(2 * Eigen::Index(k)) << p, none, -r[7] * p;
    a.row(2 * Eigen::Index(k) + 1) << none, p, -r[8] * p;
  }
  const Eigen::VectorXd h = Eigen::JacobiSVD<Eigen::MatrixXd>(a, Eigen::ComputeFullV).matrixV().col(8);
  Eigen::Matrix3d result;
  for (int i = 0; i < 9; ++i) result(i / 3, i % 3) = h(i);
  return result;
}

TEST(RealVideo, WalkersAcrossEachOther) {
  const fs::path video = video_folder() / "vtest.avi", file = video_folder() / "vtest_gt.txt";
  if (!fs::exists(video) || !fs::exists(file)) GTEST_SKIP() << video << " is not there";
  const auto truth = rows(file);
  const Eigen::Matrix3d metres = metres_of(truth);
  const auto foot = [&](const Box& b) -> Eigen::Vector2d {
    return (metres * Eigen::Vector3d((b.x + b.w / 2) / 500, (b.y + b.h) / 500, 1)).hnormalized();
  };
  const auto reader = open_footage(video, 1, "video");
  const auto follower = tracker({.frame_seconds = 0.1});
  std::vector<Sighting> sightings;
  std::map<double, std::size_t> number;
  int later = 0, claims = 0, near = 0;
  Image image;
  for (int frame = 1; frame <= 69; ++frame) {
    ASSERT_TRUE(reader->next(image));
    if (!number.empty()) sightings = follower->step(image, {}, {});
    for (const auto& r : truth) {
      if (int(r[0]) != frame) continue;
      const Box box{r[2], r[3], r[4], r[5]};
      if (const auto it = number.find(r[1]); it != number.end()) {
        ++later;
        const Sighting& s = sightings[it->second];
        if (!s.measured) continue;
        ++claims;
        EXPECT_GT(overlap(s.box, box), 0) << "a wrong claim at picture " << frame;
        near += (foot(s.box) - foot(box)).norm() <= 0.5;
      } else {
        if (number.empty()) {
          follower->start(image, std::span(&box, 1));
        } else {
          follower->add(box);
        }
        number.emplace(r[1], number.size());
      }
    }
  }
  EXPECT_EQ(later, 32);
  EXPECT_GE(claims, 16);
  EXPECT_EQ(near, claims) << "claims further than 0.5 m from the true foot point";
}

}  // namespace vericone::vision::real_video_test
