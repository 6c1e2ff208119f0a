// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a moving body went through a moving opening, proved: apart from its rim, and from its wall if it
// has one, at all times and not only at the steps; on one side of it before and on the other after.
#pragma once

#include <vericone/cones/mesh_window.h>
#include <vericone/simulation/moving_orifice.h>
#include <vericone/simulation/proof.h>
#include <cstdint>

namespace vericone::simulation {

enum class PassageVerdict : std::uint8_t {
  passed,     // proved apart all the time, and through the opening at least once
  touched,    // proved to touch the rim or the wall at a time
  missed,     // proved apart all the time, and never through
  undecided,  // nearer to rim or wall than the proof resolves
};
[[nodiscard]] const char* to_string(PassageVerdict verdict);

struct PassageProof {
  PassageVerdict verdict = PassageVerdict::missed;
  /// passed: when the body's middle crosses the opening, the first time that it goes through: wholly on one
  /// side before, wholly on the other after. touched: `to`. Otherwise when body and rim are nearest, about. s
  double time = 0;
  /// passed: 1 along the opening's normal, -1 against it. 0 otherwise.
  int direction = 0;
  /// touched: apart before `from`, proved; meeting at `to`, proved. undecided: the first piece of time
  /// without proof. Otherwise the interval asked about.
  double from = 0, to = 0;  // s
  /// Metres. passed: where the middle crosses. touched: a point that body and rim or wall have in common.
  /// Otherwise the point of the rim next to the body, about.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// passed, missed: the distance of the body from the rim was never below this, proved, metres; and when
  /// they came nearest, about. Within 1 % of the least distance (1e-6 m) of ellipsoids and hulls; of other
  /// bodies that of what contains them.
  double least_distance = 0, least_time = 0;
  std::uint64_t pieces = 0;  // pieces of time that were proved separately
};

/// Over [from, to], within the life of the track and not before the opening appears. Ellipsoids and hulls as
/// they are. A delimited body is proved to pass or to miss by its ellipsoid, a mesh, a cloud, boxes or a
/// union by the ellipsoid that contains it; `touched` is said of the body itself, so of the latter never. The
/// proof holds for all motions of the body within the padding of the track (ProofOptions); the opening moves
/// exactly as it says. Throws InputError naming "agent" (a body of the plane), "from", "to", "padding",
/// "resolution" or "drift". Method: docs/explanation/proof-of-runs.md. Cost: about 1 ms, most of it for the
/// least distance (docs/measured/guidance.md).
[[nodiscard]] PassageProof prove_passage(const Track& agent, const MovingOrifice& orifice, double from,
                                         double to, const ProofOptions& options = {});

/// The same of a window of a mesh: apart from all of the mesh (prove()), and clear of the fan that spans the
/// window at two times between which the way of its middle crosses that, signs counted. `mesh`: how
/// window.mesh() moves, its own frame being that in which the window is (a window made without a pose).
/// `least_distance` is from the mesh; `direction` is 1 towards the side from which the rim runs
/// counterclockwise. The agent: an ellipsoid, a delimited body or a hull; InputError naming "agent" for
/// others, and as prove() does.
[[nodiscard]] PassageProof prove_passage(const Track& agent, const MeshWindow& window, const Track& mesh,
                                         double from, double to, const ProofOptions& options = {});

}  // namespace vericone::simulation
