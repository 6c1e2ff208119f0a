// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of cars on a textured ground from straight above, with a bar that may hide them: nothing but what
// the tests of trackers need.
#pragma once

#include <vericone/vision/tracker.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vericone::vision::street {

/// A number from 0 to 1 that looks random, the same for the same whole numbers.
inline double hash(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t h = std::uint64_t(x) * 0x9e3779b97f4a7c15u ^ std::uint64_t(y) * 0xc2b2ae3d27d4eb4fu ^ seed;
  h = (h ^ (h >> 31)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return double((h ^ (h >> 31)) >> 11) / double(1ull << 53);
}

struct Car {
  Eigen::Vector2d position{0, 0};  // m
  double heading = 0;              // rad
  int look = 0;
};

struct Camera {
  Eigen::Vector2d above{0, 0};  // m
  double pixel = 0.3;           // m
  double turn = 0;              // rad
  int width = 400, height = 300;

  Eigen::Matrix3d picture_of_ground() const {
    const double c = std::cos(turn) / pixel, s = std::sin(turn) / pixel;
    Eigen::Matrix3d m;
    m << c, s, 0, s, -c, 0, 0, 0, 1;
    const Eigen::Vector2d at = (m * above.homogeneous()).hnormalized();
    m(0, 2) = 0.5 * (width - 1) - at.x();
    m(1, 2) = 0.5 * (height - 1) - at.y();
    return m;
  }
};

struct Bar {
  Eigen::Vector2d low{0, 0}, high{0, 0};  // m
};

inline double ground_at(const Eigen::Vector2d& p) {
  double value = 105;
  for (const double size : {8.0, 3.0, 1.2}) {
    const double x = p.x() / size, y = p.y() / size, i = std::floor(x), j = std::floor(y), a = x - i,
                 b = y - j;
    const auto h = [&](int k, int l) {
      return hash(std::int64_t(i) + k, std::int64_t(j) + l, std::uint64_t(size * 10));
    };
    value += 24 * ((1 - b) * ((1 - a) * h(0, 0) + a * h(1, 0)) + b * ((1 - a) * h(0, 1) + a * h(1, 1)) - 0.5);
  }
  return value;
}

/// 6 m x 2.5 m: a roof, two panes, two lamps.
inline double car_at(double along, double across, int look) {
  const double roof = look % 2 == 0 ? 210 : 40;
  if (std::abs(along - 1.2) < 0.4 && std::abs(across) < 0.95) return 20 + 10 * look;
  if (std::abs(along + 1.6) < 0.25 && std::abs(across) < 0.9) return 30 + 10 * look;
  if (along > 2.7 && std::abs(across) > 0.6) return 250;
  return roof + 20 * (look / 2);
}

inline Image picture(const Camera& camera, const std::vector<Car>& cars, const std::vector<Bar>& bars,
                     std::uint64_t frame, double noise = 2) {
  Image image(camera.width, camera.height, 1);
  const Eigen::Matrix3d back = camera.picture_of_ground().inverse();
  constexpr int kFine = 2;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      double sum = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const Eigen::Vector2d q(u + (k % kFine + 0.5) / kFine - 0.5, v + (k / kFine + 0.5) / kFine - 0.5);
        const Eigen::Vector2d p = (back * q.homogeneous()).hnormalized();
        double value = -1;
        for (const Bar& b : bars)
          if ((p.array() >= b.low.array()).all() && (p.array() <= b.high.array()).all()) value = 75;
        for (const Car& car : cars) {
          if (value >= 0) break;
          const Eigen::Vector2d d = Eigen::Rotation2Dd(-car.heading) * (p - car.position);
          if (std::abs(d.x()) < 3 && std::abs(d.y()) < 1.25) value = car_at(d.x(), d.y(), car.look);
        }
        sum += value >= 0 ? value : ground_at(p);
      }
      const double grain =
          noise * (hash(u, v, 3 * frame) + hash(u, v, 3 * frame + 1) + hash(u, v, 3 * frame + 2) - 1.5) * 2;
      image.data[std::size_t(v) * image.width + u] =
          std::uint8_t(std::clamp(sum / (kFine * kFine) + grain + 0.5, 0.0, 255.0));
    }
  return image;
}

inline Box box_of(const Camera& camera, const Car& car) {
  const double c = std::abs(std::cos(car.heading - camera.turn)),
               s = std::abs(std::sin(car.heading - camera.turn));
  const Eigen::Vector2d size = Eigen::Vector2d(6 * c + 2.5 * s, 6 * s + 2.5 * c) / camera.pixel;
  const Eigen::Vector2d at = (camera.picture_of_ground() * car.position.homogeneous()).hnormalized();
  return {at.x() - 0.5 * size.x(), at.y() - 0.5 * size.y(), size.x(), size.y()};
}

}  // namespace vericone::vision::street
