// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/vision/tracker.h>
#include <Eigen/Dense>
#include <cmath>

#include "appearance.h"
#include "street.h"

namespace vericone::vision::tracker_test {

using street::Bar;
using street::Camera;
using street::Car;

constexpr double kStep = 0.04;  // s

struct Played {
  double rms = 0;              // px, of measured centres of cars that are seen
  int measured = 0, seen = 0;  // of cars that are seen
  int wrong = 0;               // measurements more than half a car off
  int hidden_claims = 0;       // measurements of cars that are all hidden
  int latest_total = 0;        // pictures after a car is all hidden until TOTAL is said
  int latest_regained = 0;     // pictures after a car is seen again until it is measured
  std::vector<Sighting> last;
  std::vector<std::vector<Sighting>> all;
};

struct Play {
  double seconds = 4;
  double turn_rate = 0;    // rad/s, of the cars
  double camera_turn = 0;  // rad/s
  double grow = 0;         // of the pixel, 1/s
  bool ground_known = true;
  bool decoys = false;
  std::vector<Bar> bars = {};
  double give_up = 5;
};

Played play(Tracker& tracker, const Play& script) {
  Played result;
  double sum = 0;
  constexpr double kSpeed = 15;
  int targets = 2;
  std::vector<int> hidden(2, 0), back(2, 0);
  std::vector<char> waiting(2, 0);
  Eigen::Matrix3d before;
  for (int frame = 0; frame * kStep < script.seconds; ++frame) {
    const double t = frame * kStep;
    std::vector<Car> cars(2);
    Camera camera;
    for (int i = 0; i < targets; ++i) {
      const double a = script.turn_rate * t, r = script.turn_rate != 0 ? kSpeed / script.turn_rate : 0;
      cars[i].heading = a;
      cars[i].look = i;
      cars[i].position = script.turn_rate != 0 ? Eigen::Vector2d(r * std::sin(a), r * (1 - std::cos(a)))
                                               : Eigen::Vector2d(kSpeed * t, 0);
      if (i == 0)
        camera.above = cars[0].position + Eigen::Vector2d(2 * std::sin(2 * t), 0.5 * std::cos(3 * t));
      cars[i].position += Eigen::Vector2d(8.0 * i, 7.0 * i + std::sin(t));
    }
    const std::vector<Car> own = cars;
    if (script.decoys)
      for (const double side : {-9.0, 9.0}) {
        Car decoy = cars[0];
        decoy.position += Eigen::Vector2d(side + 0.5 * t, -1);
        cars.push_back(decoy);
      }
    camera.turn = script.camera_turn * t;
    camera.pixel *= std::exp(script.grow * t);
    const Image image = street::picture(camera, cars, script.bars, std::uint64_t(frame));
    const Eigen::Matrix3d now = camera.picture_of_ground();
    if (frame == 0) {
      std::vector<Box> boxes;
      for (const Car& car : own) boxes.push_back(street::box_of(camera, car));
      tracker.start(image, boxes);
    } else {
      std::optional<Eigen::Matrix3d> ground;
      if (script.ground_known) ground = now * before.inverse();
      result.last = tracker.step(image, ground, {});
      result.all.push_back(result.last);
      for (int i = 0; i < targets; ++i) {
        const Sighting& s = result.last[i];
        double clear = 1;
        for (const Bar& b : script.bars) {
          const double in =
              std::min(own[i].position.x() + 3, b.high.x()) - std::max(own[i].position.x() - 3, b.low.x());
          clear = std::min(clear, 1 - std::clamp(in / 6, 0.0, 1.0));
        }
        const double off = (s.box.centre() - street::box_of(camera, own[i]).centre()).norm();
        if (s.measured && off > 3 / camera.pixel) ++result.wrong;
        if (clear == 1) {
          hidden[i] = 0;
          ++result.seen;
          if (s.measured) {
            ++result.measured;
            sum += off * off;
            waiting[i] = 0;
          } else if (waiting[i]) {
            result.latest_regained = std::max(result.latest_regained, ++back[i]);
          }
        } else if (clear == 0) {
          ++hidden[i];
          waiting[i] = 1;
          back[i] = 0;
          if (s.measured) {
            ++result.hidden_claims;
            result.latest_total = std::max(result.latest_total, hidden[i]);
          }
        }
      }
    }
    before = now;
  }
  result.rms = std::sqrt(sum / std::max(1, result.measured));
  return result;
}

Played ours(const Play& script) {
  const auto follower = tracker({.frame_seconds = kStep, .give_up = script.give_up});
  return play(*follower, script);
}

TEST(Tracker, StaysOnCarsThatAreSeen) {
  const Played p = ours({});
  EXPECT_EQ(p.measured, p.seen);
  EXPECT_EQ(p.wrong, 0);
  EXPECT_LT(p.rms, 0.5);
}

TEST(Tracker, FindsTheGroundsMotionByItself) {
  const Played p = ours({.seconds = 3, .camera_turn = 0.2, .ground_known = false});
  EXPECT_EQ(p.measured, p.seen);
  EXPECT_LT(p.rms, 0.5);
}

TEST(Tracker, FollowsATurnAndAChangeOfScale) {
  // Half a turn, and the picture of a car to two thirds of its size.
  const Played p = ours({.seconds = 5, .turn_rate = 0.6, .grow = 0.08});
  EXPECT_EQ(p.measured, p.seen);
  EXPECT_LT(p.rms, 0.75);
}

TEST(Tracker, SaysTotalAndRegains) {
  const Played p = ours({.seconds = 6, .bars = {{{25, -20}, {62, 20}}}});
  EXPECT_EQ(p.wrong, 0);
  EXPECT_LE(p.latest_total, 3);
  EXPECT_LE(p.latest_regained, int(0.5 / kStep));
  EXPECT_LT(p.rms, 0.5);
  for (const Sighting& s : p.last) EXPECT_TRUE(s.measured);
}

TEST(Tracker, KeepsIdentityAmongLookalikes) {
  const Played p = ours({.seconds = 6, .decoys = true, .bars = {{{25, -20}, {62, 20}}}});
  EXPECT_EQ(p.wrong, 0);
  for (const Sighting& s : p.last) EXPECT_TRUE(s.measured);
}

TEST(Tracker, SaysLostWhenATargetStaysHidden) {
  const Played p = ours({.seconds = 5, .bars = {{{25, -40}, {500, 40}}}, .give_up = 1});
  for (const Sighting& s : p.last) {
    EXPECT_EQ(s.sight, Sight::lost);
    EXPECT_FALSE(s.measured);
    EXPECT_EQ(s.confidence, 0);
  }
  EXPECT_EQ(p.wrong, 0);
}

TEST(Tracker, DoesTheSameAgain) {
  const Play script{.seconds = 2, .ground_known = false, .decoys = true, .bars = {{{12, -20}, {20, 20}}}};
  const Played a = ours(script), b = ours(script);
  for (std::size_t k = 0; k < a.all.size(); ++k)
    for (std::size_t i = 0; i < a.all[k].size(); ++i) {
      EXPECT_EQ(a.all[k][i].box.x, b.all[k][i].box.x);
      EXPECT_EQ(a.all[k][i].box.w, b.all[k][i].box.w);
      EXPECT_EQ(a.all[k][i].confidence, b.all[k][i].confidence);
      EXPECT_EQ(a.all[k][i].sight, b.all[k][i].sight);
    }
}

TEST(Tracker, SearchesWhereItIsTold) {
  // A car that is put elsewhere while it is hidden is found by the caller's expectation, not by its own.
  Camera camera;
  Car car;
  const auto follower = tracker({.frame_seconds = kStep});
  const std::vector<Box> boxes{street::box_of(camera, car)};
  follower->start(street::picture(camera, {car}, {}, 0), boxes);
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  for (int frame = 1; frame < 5; ++frame)
    follower->step(street::picture(camera, {car}, {}, frame), still, {});
  for (int frame = 5; frame < 10; ++frame)
    EXPECT_FALSE(follower->step(street::picture(camera, {}, {}, frame), still, {})[0].measured);
  car.position = {20, 10};
  Expectation there;
  there.centre = street::box_of(camera, car).centre() + Eigen::Vector2d(3, -2);
  there.covariance = 9 * Eigen::Matrix2d::Identity();
  Sighting last;
  for (int frame = 10; frame < 20; ++frame) {
    last = follower->step(street::picture(camera, {car}, {}, frame), still, std::span(&there, 1))[0];
  }
  EXPECT_TRUE(last.measured);
  EXPECT_LT((last.box.centre() - street::box_of(camera, car).centre()).norm(), 0.5);
}

/// Pictures in which a car is not measured, or is 2 px off, that goes along `places`, m, seen by a small
/// camera at rest.
int missed(const std::vector<Eigen::Vector2d>& places) {
  Camera camera;
  camera.width = 160;
  camera.height = 120;
  const auto follower = tracker({.frame_seconds = kStep});
  int result = 0;
  for (std::size_t frame = 0; frame < places.size(); ++frame) {
    Car car;
    car.position = places[frame];
    const Image image = street::picture(camera, {car}, {}, frame);
    const Box box = street::box_of(camera, car);
    if (frame == 0) {
      follower->start(image, std::span(&box, 1));
      continue;
    }
    const Sighting s = follower->step(image, Eigen::Matrix3d::Identity(), {})[0];
    result += !s.measured || (s.box.centre() - box.centre()).norm() > 2;
  }
  return result;
}

TEST(Tracker, KeepsWhatStopsTurnsAndTurnsBackAtOnce) {
  // A metre and a half a picture, 5 px of a car of 20 x 8.
  const Eigen::Vector2d along(1.5, 0), across(0, 1.5), none(0, 0);
  for (const Eigen::Vector2d& after : {none, across, Eigen::Vector2d(-along)}) {
    std::vector<Eigen::Vector2d> places{{-15, -5}};
    for (int k = 0; k < 18; ++k) places.push_back(places.back() + (k < 12 ? along : after));
    EXPECT_EQ(missed(places), 0) << after.transpose();
  }
}

TEST(Tracker, KeepsWhatStartsAtOnceAndSpeedsUp) {
  std::vector<Eigen::Vector2d> starts(8, {-15, -5}), speeds{{-20, 5}};
  for (int k = 0; k < 10; ++k) starts.push_back(starts.back() + Eigen::Vector2d(2.1, 0));  // 7 px
  Eigen::Vector2d v(0.6, 0);
  for (int k = 0; k < 20; ++k, v.x() += 0.12) speeds.push_back(speeds.back() + v);  // 0.4 px/picture^2
  EXPECT_EQ(missed(starts), 0);
  EXPECT_EQ(missed(speeds), 0);
}

TEST(Appearance, ATwigIsNoDifference) {
  // A line across a thing of little contrast: all pixels together say that it is another one.
  cv::Mat plain(60, 60, CV_8U), line;
  for (int v = 0; v < 60; ++v)
    for (int u = 0; u < 60; ++u)
      plain.at<std::uint8_t>(v, u) = std::uint8_t(120 + 20 * street::hash(u / 4, v / 4, 1));
  plain.copyTo(line);
  line(cv::Rect(0, 28, 60, 3)) = 250;
  View view{{30, 30}, 1, 0};
  const Appearance looks(plain, view, {30, 30});
  const Agreement agreement = looks.align(line, view, nullptr);
  EXPECT_LT(agreement.correlation, 0.5);
  EXPECT_GT(agreement.alike, 0.75);
  EXPECT_LE(agreement.alike, agreement.visible);
}

TEST(SourceTracker, FollowsAndLosesWhatIsHidden) {
  const auto follower = source_tracker();
  const Played seen = play(*follower, {.seconds = 2});
  EXPECT_EQ(seen.measured, seen.seen);
  EXPECT_LT(seen.rms, 3);
  const Played p = play(*follower, {.seconds = 4, .bars = {{{25, -20}, {62, 20}}}});
  bool total = false;
  for (const auto& sightings : p.all)
    for (const Sighting& s : sightings) {
      EXPECT_NE(s.sight, Sight::lost);
      EXPECT_EQ(s.measured, s.sight != Sight::total);
      total = total || s.sight == Sight::total;
    }
  EXPECT_TRUE(total);
}

TEST(Boxes, Overlap) {
  EXPECT_DOUBLE_EQ(overlap({0, 0, 2, 2}, {1, 1, 2, 2}), 1.0 / 7);
  EXPECT_EQ(overlap({0, 0, 2, 2}, {2, 0, 2, 2}), 0);
  EXPECT_DOUBLE_EQ(overlap({3, 4, 5, 6}, {3, 4, 5, 6}), 1);
}

}  // namespace vericone::vision::tracker_test
