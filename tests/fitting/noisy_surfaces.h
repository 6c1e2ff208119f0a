// SPDX-License-Identifier: BSD-3-Clause
//
// Random bodies and noisy samples of their surfaces.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/geometry/combined.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "support/random.h"

namespace vericone::testing {

/// What a fit is to find.
struct KnownSurface {
  CombinedEllipsoid body;
  Eigen::Vector3d semi_axes;  // decreasing

  double size() const { return semi_axes.mean(); }
};

/// Axes between 1 and 4 in any pose; `sheets`: 0 no delimiter, 2 dents, 1 a waist, about any axis.
inline KnownSurface random_surface(Random& random, int sheets) {
  using Eigen::Vector3d;
  KnownSurface known;
  const Vector3d center = random.vector<3>();
  Eigen::Matrix3d axes = random.rotation<3>();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  for (int i = 0; i < 3; ++i) known.semi_axes(i) = std::exp(random.uniform(0, std::log(4.0)));
  std::sort(known.semi_axes.data(), known.semi_axes.data() + 3, std::greater<>());
  std::vector<Delimiter<3>> delimiters;
  if (sheets > 0) {
    const int k = random.integer(0, 2);
    Eigen::Matrix3d turned;
    Vector3d factors, lengths;
    for (int i = 0; i < 3; ++i) {
      turned.col(i) = axes.col((k + i) % 3);
      lengths(i) = known.semi_axes((k + i) % 3);
      factors(i) = random.uniform(0.5, 1);
    }
    if (sheets == 2) {
      factors(0) = random.uniform(0.4, 0.7);
    } else {
      factors(1) = random.uniform(0.4, 0.7);
      factors(2) = factors(1) * random.uniform(0.8, 1.2);
    }
    delimiters.push_back(hyperboloid(sheets, lengths.cwiseProduct(factors), turned));
  }
  known.body = CombinedEllipsoid(Ellipsoid::from_axes(center, known.semi_axes, axes), delimiters);
  return known;
}

struct NoisySample {
  int points = 1000;
  double noise = 0;     // standard deviation along the normal, of the mean semi-axis
  double outliers = 0;  // share, evenly spread in a box three times as large
  bool half = false;    // only where the outward normal faces a viewpoint
};

/// Points even over an ellipsoid's area; where there are delimiters, directions are even where the ellipsoid
/// is a ball.
inline fitting::Sample noisy_sample(Random& random, const KnownSurface& known, const NoisySample& how) {
  using Eigen::Matrix3d, Eigen::Vector3d;
  const Ellipsoid& e = known.body.ellipsoid();
  const Matrix3d inverse = e.shape().inverse();
  const Vector3d view = random.vector<3>().normalized();
  const double widest = known.semi_axes(0) * known.semi_axes(1);
  fitting::Sample sample;
  const int inliers = static_cast<int>(std::lround(how.points * (1 - how.outliers)));
  while (static_cast<int>(sample.points.size()) < inliers) {
    const Vector3d u = random.vector<3>().normalized();
    Vector3d y = e.factor() * u;
    if (known.body.is_ellipsoid()) {
      const double area = known.semi_axes.prod() * (inverse * y).norm();
      if (random.uniform(0, 1) * widest > area) continue;
    } else {
      y /= known.body.gauge(y);
    }
    Vector3d normal = inverse * y;
    double largest = y.dot(normal) - 1;
    for (const Delimiter<3>& d : known.body.delimiters())
      if (d.value(y) > largest) {
        largest = d.value(y);
        normal = d.matrix * y;
      }
    normal.normalize();
    if (how.half && normal.dot(view) <= 0) continue;
    sample.points.push_back(e.center() + y + how.noise * known.size() * random.normal() * normal);
  }
  while (static_cast<int>(sample.points.size()) < how.points) {
    Vector3d box;
    for (int i = 0; i < 3; ++i) box(i) = random.uniform(-3, 3);
    sample.points.push_back(e.center() + e.factor() * box);
  }
  return sample;
}

}  // namespace vericone::testing
