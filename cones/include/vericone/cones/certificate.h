// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict, in a form that a program checks which knows nothing of this library
// (docs/reference/certificates.md).
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/cones/pair.h>
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
/// delimited bodies need more than planes and few multipliers, or where the common plane of touching pieces
/// is not found. Throws InputError like verdict(). Cost: two ellipsoids 10 us, dents 2 ms, a mesh
/// of 5,000 triangles 3 ms.
[[nodiscard]] Certificate certificate(const Pair& pair, const Eigen::Vector3d& v_a,
                                      const Eigen::Vector3d& v_b, const Horizon& horizon = {},
                                      const std::string& id = {});

}  // namespace vericone
