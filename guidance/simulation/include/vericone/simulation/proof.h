// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two moving bodies met, proved: exact disjointness at the ends of every piece of time, and between
// them a separation with a margin that covers what the bodies can have moved, turned and changed meanwhile.
#pragma once

#include <vericone/cones/mesh_window.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/guidance/orifice_law.h>
#include <vericone/simulation/track.h>
#include <cstdint>
#include <memory>
#include <string>

namespace vericone::simulation {

enum class ProofVerdict : std::uint8_t {
  avoided,    // proved apart all the time
  touched,    // proved to touch or overlap at a time
  undecided,  // they come closer than the proof resolves
};
[[nodiscard]] const char* to_string(ProofVerdict verdict);

struct ProofOptions {
  /// Metres. The proof holds for all motions whose positions are within this of the track's: rounding and the
  /// integrator's error.
  double padding = 1e-8;
  /// Seconds. A piece of time shorter than this is not divided further: `undecided`.
  double resolution = 1e-7;
  /// m/s. The padding grows by as much since the start of the tracks: the proof holds for every constant
  /// current of at most this speed that carries the bodies, or some of them, off their tracks.
  double drift = 0;
};

struct PairProof {
  ProofVerdict verdict = ProofVerdict::avoided;
  /// touched: apart before `from`, proved; meeting at `to`, proved. undecided: the first piece of time
  /// without proof. avoided: the interval asked about.
  double from = 0, to = 0;  // s
  /// Metres. touched: a point near both bodies at `to`. Otherwise where they come nearest.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// avoided: the distance was never below this, proved, metres; and when they came nearest, about. Within 1
  /// % of the least distance of the convex hulls (1e-6 m) in nearly all runs; a rougher bound where one is in
  /// the other's dent, and by a few % for placed bodies that turn.
  double least_distance = 0, least_time = 0;
  std::uint64_t pieces = 0;  // pieces of time that were proved separately
};

/// Over [from, to], within the life of both tracks. Any two bodies that Pair serves: both planar, or both
/// spatial, otherwise throws InputError naming "bodies". Throws InputError naming "from", "to", "padding",
/// "resolution" or "drift". Method: docs/explanation/proof-of-runs.md. Cost: 0.1 ms for two ellipsoids, 0.3
/// ms with hulls and delimited bodies, milliseconds to tens of them where those meet; a placed body, or a
/// hull and one with dents, a distance and at most two misses of the Pair a piece.
[[nodiscard]] PairProof prove(const Track& a, const Track& b, double from, double to,
                              const ProofOptions& options = {});

// An opening that moves: what agents pass through.

/// A flat opening with a constant velocity that turns about its centre at a constant rate. With s = t -
/// appears its centre is position + velocity s and its rotation Exp(spin s) rotation; the opening lies in the
/// first two columns of that, and its normal is the third.
struct MovingOrifice {
  std::string name;
  Opening opening = Opening::circle(1);
  Eigen::Vector3d position = Eigen::Vector3d::Zero(),
                  velocity = Eigen::Vector3d::Zero();      // when it appears; m, m/s
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // the same
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();          // rad/s, in world axes
  double appears = 0;                                      // s: neither passed nor touched before
  bool wall = true;  // an infinite thin wall about the opening; false: its rim alone

  /// Of a window of a mesh: the mesh is its wall, its frame the orifice's, and `opening`, with this centre
  /// and these axes in that frame, the flat one that stands for it (MeshWindow::flat()); `wall` is not read.
  std::shared_ptr<const MeshWindow> window;
  Eigen::Vector3d flat_center = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> flat_axes = Eigen::Matrix<double, 3, 2>::Identity();

  /// As laws see it, which foresee the turning of a window as if it were about its own middle.
  [[nodiscard]] guidance::OrificeState at(double t) const;
};

// Whether a moving body went through a moving opening, proved: apart from its rim, and from its wall if it
// has one, at all times and not only at the steps; on one side of it before and on the other after.

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
