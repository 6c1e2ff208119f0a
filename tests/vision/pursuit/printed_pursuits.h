// SPDX-License-Identifier: BSD-3-Clause
//
// The four printed pursuits (source 3.4, 4.3; gains, roads and bars of errata 4.3), as the YAML files of the
// paper have them.
#pragma once

#include <vericone/vehicles/quadrotor.h>
#include <vericone/vision/pursuit/pursuit.h>
#include <numbers>
#include <string>

namespace vericone::vision::testing {

inline void cameras(Pursuit& p, int width, int height, double degrees) {
  const Camera camera = Camera::of_field_of_view(width, height, degrees * std::numbers::pi / 180);
  for (View* view : {&p.source_view, &p.perspective_view}) {
    view->camera = camera;
    view->scene.channels = 1;
  }
  p.source_view.scene.ground.plain = true;
  View& real = p.perspective_view;
  real.mount.kind = MountKind::gimbal;
  real.mount.rate = std::numbers::pi / 3;
  real.scene.noise = 3;
  real.scene.blur = 0.6;
}

/// 3.4.1: lane changes.
inline Pursuit lanes() {
  Pursuit p;
  p.name = "3.4.1";
  p.duration = 149;
  p.step = p.picture_step = 0.1;
  p.start.position = {0, 0, 150};
  p.start.velocity = {31.31, 0, 0};
  p.source_steps = true;
  p.source_law = SourceLaw::rendezvous;
  std::vector<simulation::LaneChange> changes;
  for (const auto& [at, sign] : {std::pair(5.0, -1.0),
                                 {15.0, 1.0},
                                 {25.0, -1.0},
                                 {35.0, -1.0},
                                 {55.0, 1.0},
                                 {75.0, -1.0},
                                 {105.0, 1.0}})
    changes.push_back({at, 2, sign});
  Car car{"B", simulation::lane_road({50, -30}, {22.22, 0}, changes), {}, true};
  car.look.size = {6, 2.5, 0};
  p.cars = {car};
  cameras(p, 800, 600, 47);
  p.source_view.bars = {2, {15, 0}, 0, 0};
  p.perspective_view.bars = {2, {15, 0}, 5, 0};
  return p;
}

/// 3.4.2: one vehicle on a squircle.
inline Pursuit squircle() {
  Pursuit p = lanes();
  p.name = "3.4.2";
  p.duration = 671;
  p.start.position = {0, 0, 350};
  p.rendezvous.cone = 1.4;
  p.rendezvous.speed = 0.09;
  p.cars[0].road = simulation::squircle_road({0, -20}, 1000, 0.9, 360);
  p.source_view.bars.count = p.perspective_view.bars.count = 0;
  return p;
}

/// 4.3.0.1: three vehicles that change lanes.
inline Pursuit three_lanes() {
  Pursuit p;
  p.name = "4.3.0.1";
  p.duration = 150;
  p.step = 0.01;
  p.picture_step = 0.04;
  p.start.position = {0, 0, 425};
  p.start.velocity = {31.31, 0, 0};
  p.vehicle = vehicles::quadrotor({});
  const Eigen::Vector2d starts[] = {{100, -150}, {100, -120}, {90, -135}};
  const double flags[] = {0.09, 0, -0.135};
  for (std::uint32_t i = 0; i < 3; ++i) {
    std::vector<simulation::LaneChange> changes;
    if (flags[i] != 0)
      for (const auto& [at, sign] :
           {std::pair(35.0, -1.0), {55.0, -1.0}, {75.0, 1.0}, {105.0, 1.0}, {125.0, -1.0}})
        changes.push_back({at, 5, sign * flags[i]});
    Car car{"B" + std::to_string(i + 1), simulation::lane_road(starts[i], {22.22, 0}, changes), {}, true};
    car.look.seed = i + 1;
    p.cars.push_back(car);
  }
  cameras(p, 1000, 800, 50);
  p.perspective_view.height = 0.8;
  p.source_view.bars = {2, {40, 125}, 0, 25};
  p.perspective_view.bars = {2, {40, 125}, 5, 25};
  p.vertical.emplace();
  return p;
}

/// 4.3.0.2: three vehicles on squircles.
inline Pursuit three_squircles() {
  Pursuit p = three_lanes();
  p.name = "4.3.0.2";
  p.duration = 390;
  p.start.position = {0, 0, 450};
  const Eigen::Vector2d starts[] = {{100, -160}, {100, -130}, {90, -145}};
  for (std::size_t i = 0; i < 3; ++i) p.cars[i].road = simulation::squircle_road(starts[i], 1000, 0.9, 360);
  p.source_view.bars = {5, {10, 15}, 0, 0};
  p.perspective_view.bars = {5, {10, 15}, 5, 0};
  p.focal.cone = 1.4;
  p.focal.speed = 0.1;
  p.focal.singular = 1000;
  p.focal.sight = 0.3;
  p.focal.distance = 0.03;
  p.vertical->size = 230;
  return p;
}

}  // namespace vericone::vision::testing
