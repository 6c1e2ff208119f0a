// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict, in a form that a program checks which knows nothing of this library
// (docs/reference/certificates.md).
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/uncertain/robust.h>
#include <string>

namespace vericone {

/// A claim, the bodies and velocities that it is about with all their digits, and its proof.
struct Certificate {
  std::string text;    // one JSON object, on one line; empty where there is none
  std::string reason;  // why there is none; empty where there is one
};

/// Of what pair.verdict(v_a, v_b, horizon) says; velocities m/s, horizon s. It was checked in exact
/// arithmetic before it is returned: there is a right one, or none. Bodies stand in it as the verdict takes
/// them; those of a turned assembly have each coordinate rounded once. `id`: JSON, a text in quotes or a
/// number, that stands in the claim; empty: none. There is none where the verdict is `undecided`, where
/// dents are so near to what is in them that multipliers in some hundred parts of time and space do not do,
/// where bodies of flat, round and straight parts meet one with dents or touch along a normal that is not
/// rational, or where pieces collide only together. Throws InputError like verdict(). Cost: two ellipsoids
/// 10 us, such bodies 1 ms, dents 2 ms, a mesh of 5,000 triangles 3 ms.
[[nodiscard]] Certificate certificate(const Pair& pair, const Eigen::Vector3d& v_a,
                                      const Eigen::Vector3d& v_b, const Horizon& horizon = {},
                                      const std::string& id = {});

/// Of what robust_verdict(pair, v_a, v_b, errors) says of all errors: `out`, `in`, or `depends` with an error
/// of each kind. Without any error it is that of the verdict within the errors' horizon. There is none of
/// errors of attitude, size or acceleration, of sums of sets, and of grazes that take more than some thousand
/// parts of the sphere of normals. Throws InputError like robust_verdict(). Cost beyond that: `out` and
/// `depends` 0.1 ms, `in` 0.3 ms, near grazes 100 times as much.
[[nodiscard]] Certificate certificate(const Pair& pair, const Eigen::Vector3d& v_a,
                                      const Eigen::Vector3d& v_b, const RelativeErrors& errors,
                                      const std::string& id = {});

}  // namespace vericone
