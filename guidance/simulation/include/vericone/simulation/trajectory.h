// SPDX-License-Identifier: BSD-3-Clause
//
// Tracks that somebody else made: polynomials, splines and time-stamped poses, and what is proved of bodies
// that follow them.
#pragma once

#include <vericone/simulation/certificate.h>
#include <vericone/simulation/proof.h>
#include <vericone/simulation/track.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation {

/// A vector that is a polynomial of time, of degree 9 at most, piece by piece.
struct Piecewise {
  std::vector<double> times;  // ascending, one more than there are pieces, s
  /// Of each piece its Bernstein coefficients (control points) over its time.
  std::vector<std::vector<Eigen::Vector3d>> points;
  /// What the points may be off, by rounding, from what they were made of; in their unit.
  double error = 0;

  /// NaN without times.
  [[nodiscard]] double from() const;
  [[nodiscard]] double to() const;
  /// from() <= t <= to(); between two pieces the later one. `derivative` 0 to 9, per second each. Throws
  /// InputError naming "t", "derivative", or "times" or "points[i]" where these are no pieces.
  [[nodiscard]] Eigen::Vector3d at(double t, int derivative = 0) const;
};

/// Of coefficients of 1, s, s^2, ... with s = t - times[piece], as minimum-snap planners write them. Throws
/// InputError naming "times" or "powers[piece][power]".
[[nodiscard]] Piecewise piecewise_of_powers(const std::vector<double>& times,
                                            const std::vector<std::vector<Eigen::Vector3d>>& powers);

/// A B-spline over its domain, from knots[degree] to knots[size - 1 - degree]: points.size() + degree + 1
/// knots, not descending, clamped or not. Knots may coincide, inside as often as the degree. Throws
/// InputError naming "degree", "knots" or "points[i]".
[[nodiscard]] Piecewise piecewise_of_spline(int degree, const std::vector<double>& knots,
                                            const std::vector<Eigen::Vector3d>& points);

/// From point to point on straight lines. Throws InputError naming "times" or "points[i]".
[[nodiscard]] Piecewise piecewise_through(const std::vector<double>& times,
                                          const std::vector<Eigen::Vector3d>& points);

/// Cubics with these points and velocities (Hermite). Without velocities those of Catmull and Rom: from the
/// neighbour before to the one after, at the ends from the end to its neighbour. Throws InputError naming
/// "times", "points[i]" or "velocities[i]".
[[nodiscard]] Piecewise piecewise_through(const std::vector<double>& times,
                                          const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<Eigen::Vector3d>& velocities);
/// Metres a second, of Catmull and Rom. Throws as the last.
[[nodiscard]] std::vector<Eigen::Vector3d> velocities_through(const std::vector<double>& times,
                                                              const std::vector<Eigen::Vector3d>& points);

/// Where a body is and how it is turned, over a time.
struct Trajectory {
  Piecewise position;  // m
  /// The body's rotation is Exp(turned(t)) rotation; none: it does not turn. rad
  std::optional<Piecewise> turned;
  /// Of its frame in the world: one, or one for each piece of `turned`, from whose end to the next one's
  /// beginning it may then not jump.
  std::vector<Eigen::Matrix3d> rotation{Eigen::Matrix3d::Identity()};
};

/// The same, turned from rotation to rotation the shortest way at a constant rate (slerp). Throws InputError
/// naming "times", or "rotations[i]" where that and the one before are half a turn apart, within 1e-6 rad.
[[nodiscard]] Trajectory turned_through(Trajectory trajectory, const std::vector<double>& times,
                                        const std::vector<Eigen::Matrix3d>& rotations);

/// The same, its x axis along the velocity, its y axis level: by slerps that are `within` (rad) of that,
/// which counts as error, beside what two pieces of the position may turn at once, 1e-6 at most. Throws
/// InputError naming "within", or "position" where the velocity may be zero or vertical, or turns at once.
/// Cost: 1 us a slerp, of which a second takes some 300 at 1 rad/s.
[[nodiscard]] Trajectory turned_along(Trajectory trajectory, double within = 1e-5);

/// A trajectory as a track, that is as curves of degree 5, and what that and rounding change.
struct FittedTrack {
  Track track;
  double position_error = 0;  // m, of the position at any time
  double turn_error = 0;      // rad
};

/// Exact, but for rounding, up to degree 5; above, Hermite's quintics within 1e-9 m and rad. Ends of pieces
/// may miss each other by `join` (m, rad), which counts half as error. Throws InputError naming "position" or
/// "turned" where they miss by more, where these do not cover the same time or an entry is not finite.
/// Cost: 2 us a piece.
[[nodiscard]] FittedTrack fitted_track(const ShapeInTime& shape, const Trajectory& trajectory,
                                       double join = 1e-6);

/// The largest length of a derivative over all pieces, enclosed within 1e-9 of itself, and when, about.
struct Greatest {
  double least = 0, most = 0;  // in the unit of the derivative; `least` is reached
  double time = 0;             // s
  double jump = 0;             // the largest jump, between pieces, of the derivative before
};
/// `derivative` 1 for speed, 2 for acceleration, up to 9. Throws InputError naming "derivative" or "times".
[[nodiscard]] Greatest greatest(const Piecewise& polynomial, int derivative);

/// A body on its track, which is known within a radius: no point of it is farther than that from where its
/// trajectory puts it. Without a trajectory it has a constant velocity and spin for ever.
struct TrackedBody {
  std::string name;
  ShapeInTime shape;
  std::optional<Trajectory> trajectory;
  Motion start;                                                        // without a trajectory; at t = 0
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                      // rad/s, in world axes
  double radius = 0;                                                   // m
  double most_speed = std::numeric_limits<double>::infinity();         // m/s
  double most_acceleration = std::numeric_limits<double>::infinity();  // m/s^2
};

struct CertifyOptions {
  double required = 0;                             // m: pairs are to be farther apart
  std::optional<double> from;                      // s; otherwise as early and as late as trajectories go
  std::optional<double> to;                        // s
  double join = 1e-6;                              // m, rad, m/s: by what ends of pieces may miss each other
  double resolution = 1e-7;                        // s: shorter pieces of time are not divided
  std::function<bool(double share)> goes_on = {};  // asked before each pair; false ends it there
};

/// The worst first.
enum class TrackVerdict : std::uint8_t {
  contact,    // on the tracks themselves they meet: proved
  nearer,     // some motions within the radii come nearer than required, or meet: proved
  undecided,  // nearer to one of these than the proof resolves
  apart,      // farther apart than required all the time, whatever the motions within the radii: proved
};
[[nodiscard]] const char* to_string(TrackVerdict verdict);

struct PairOnTracks {
  std::size_t a = 0, b = 0;
  TrackVerdict verdict = TrackVerdict::undecided;
  /// apart: the time that both are there, all of it. Otherwise apart before `from`, as required, proved; and
  /// contact or nearer at `to`, proved. undecided: the first piece of time without proof. s
  double from = 0, to = 0;
  /// Metres. contact: a point near both bodies at `to`. Otherwise where they come nearest, or are undecided.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// apart: never nearer than this, whatever the motions within the radii, m; when that is, about, s.
  double least_distance = 0, least_time = 0;
  /// Not apart: what is proved of the tracks themselves, without radii and the required distance.
  std::optional<PairProof> stated;
  std::uint64_t pieces = 0;  // pieces of time that were proved separately
};

enum class LimitVerdict : std::uint8_t { kept, broken, undecided };
[[nodiscard]] const char* to_string(LimitVerdict verdict);

struct LimitOnTrack {
  std::size_t body = 0;
  int derivative = 1;  // 1: speed, m/s; 2: acceleration, m/s^2
  double limit = 0;
  LimitVerdict verdict = LimitVerdict::undecided;
  /// Of the trajectory as stated. An acceleration is broken as well where the velocity jumps by more than
  /// `join`.
  Greatest greatest;
};

struct CertifiedTracks {
  std::vector<FittedTrack> tracks;  // one for each body
  std::vector<PairOnTracks> pairs;  // all that are there together
  std::vector<LimitOnTrack> limits;
  bool interrupted = false;

  /// The worst of all pairs.
  [[nodiscard]] TrackVerdict verdict() const;
};

/// Every pair of bodies of which one has a trajectory, over the time that both are there, and every limit.
/// Proved of all motions, positions and orientations together, within the bodies' radii; by prove(), so of
/// any two bodies that Pair serves. Throws InputError naming "bodies[i].trajectory.position",
/// "bodies[i].radius", "required", "to", ... Cost: that of prove() for each pair, twice where they are not
/// apart.
[[nodiscard]] CertifiedTracks certify(const std::vector<TrackedBody>& bodies,
                                      const CertifyOptions& options = {});

/// Of pairs that are apart or in contact, in the format of runs, each body's track with its radius. Of those
/// nearer than required that the tracks themselves come as near as both radii and the required distance
/// together. What has none says certificates() of a run. Throws InputError naming "certified" where that is
/// not of these bodies.
[[nodiscard]] RunCertificates certificates(const std::vector<TrackedBody>& bodies,
                                           const CertifiedTracks& certified,
                                           const CertifyOptions& options = {});

}  // namespace vericone::simulation
