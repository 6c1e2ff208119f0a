// SPDX-License-Identifier: BSD-3-Clause
//
// Tracks for tests of proofs.
#pragma once

#include <gtest/gtest.h>
#include <vericone/simulation/proof.h>
#include <algorithm>

#include "random.h"

namespace vericone::simulation {

using Eigen::Matrix3d;
using Eigen::Vector3d;

inline ShapeInTime ellipsoid(const Vector3d& axes) {
  return RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes))};
}
inline ShapeInTime ball(double radius) { return ellipsoid(Vector3d::Constant(radius)); }

inline Track straight(const ShapeInTime& shape, const Vector3d& position, const Vector3d& velocity,
                      double end, const Matrix3d& rotation = Matrix3d::Identity()) {
  Track track(shape, {position, velocity, rotation}, Orientation::fixed, 0);
  track.advance(Vector3d::Zero(), end);
  return track;
}

/// Turns with its heading, a new acceleration every `step` seconds.
inline Track turning(Random& random, const ShapeInTime& shape, const Motion& start, double most, double end,
                     double step = 0.05) {
  Track track(shape, start, Orientation::heading, 0);
  Vector3d a = Vector3d::Zero();
  for (int i = 1; track.end() < end; ++i) {
    if (i % 10 == 1) a = planar(shape) ? random.flat_vector(most) : random.vector(most);
    track.advance(a, std::min(end, i * step));
  }
  return track;
}

/// A velocity that brings the body near a point in about half of `end`.
inline Vector3d towards(Random& random, const Vector3d& position, double end, double miss) {
  return (random.vector(miss) - position) / (end * random.uniform(0.3, 0.9));
}

/// The verdict, held against what bodies are sampled to do; sampled overlap contradicts `avoided` and its
/// absence `touched`.
template <typename Overlap>
void expect_sampled(const PairProof& proof, double end, const Overlap& overlap) {
  bool any = false;
  double first = end;
  for (int j = 0; j <= 1000 && !any; ++j) {
    const double t = end * j / 1000;
    if (overlap(t)) {
      any = true;
      first = t;
    }
  }
  if (any) {
    EXPECT_EQ(proof.verdict, ProofVerdict::touched);
    EXPECT_LE(proof.to, first);
  }
  if (proof.verdict == ProofVerdict::touched) {
    EXPECT_TRUE(overlap(proof.to));
    if (proof.from > 0) {
      EXPECT_FALSE(overlap(proof.from));
    }
  }
}

}  // namespace vericone::simulation
