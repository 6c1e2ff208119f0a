// SPDX-License-Identifier: BSD-3-Clause
//
// How near an ellipsoid that moves comes to a body: what courses are judged by, in doubles (near), and what
// is proved of the one that is taken (surely_apart).
#pragma once

#include <vericone/geometry/body.h>
#include <limits>

namespace vericone::guidance::courses {

/// An ellipsoid that goes straight on without turning, seen from a body at rest.
struct Sweep {
  Ellipsoid agent;        // where it starts
  Eigen::Vector3d along;  // m, how far it goes
  /// m: so much wider it is at the start, and at the end, and no wider between than a cone from one to the
  /// other.
  double wider_from = 0, wider_to = 0;
  [[nodiscard]] double widest() const { return wider_from > wider_to ? wider_from : wider_to; }
};

/// What is wanted of a sweep that meets the body.
enum class Meeting : std::uint8_t { whether, when, depth };

/// When to stop looking.
struct Wanted {
  double enough = std::numeric_limits<double>::infinity();  // m: what is farther does not count
  double stop = 0;                                          // m: something as near as this is all
  Meeting meeting = Meeting::whether;
  double reach = 0;  // m, of the ball about the agent's centre
  /// Of what is nearer than `enough` the part by which the answer may be too much.
  double rough = 1e-3;
  /// From the sweep to an ellipsoid: where to begin; becomes what was found. Zero: anywhere.
  Eigen::Vector3d* normal = nullptr;
};

struct Near {
  /// Metres on the way; of many pieces at most a hundredth too much; 0 where they meet. What is `enough` or
  /// more may be anything from `enough` on.
  double distance = std::numeric_limits<double>::infinity();
  double part = 1;  // of the way at the first contact, where Meeting asks for it
  /// Metres, where Meeting asks for it: the least shift of the ellipsoid across its way with which it would
  /// pass the convex piece that it meets first.
  double depth = 0;
};

[[nodiscard]] Near near(const Sweep& sweep, const Ellipsoid& body, const Wanted& wanted);

/// Meshes, clouds, maps, hulls, bodies of flat, round and straight parts and unions as they are; of combined
/// quadrics what their delimiters cut away counts too. No allocation.
[[nodiscard]] Near near(const Sweep& sweep, const Placed& body, Wanted wanted);

/// Metres that the sweep surely keeps from the body, at most `enough`, negative where it may meet it: the gap
/// of a plane between both with all that rounding may take; of many pieces each has one, or a box about many
/// has. `normal`: as Wanted::normal.
[[nodiscard]] double surely_apart(const Sweep& sweep, const Ellipsoid& body, double enough,
                                  Eigen::Vector3d& normal);
[[nodiscard]] double surely_apart(const Sweep& sweep, const Placed& body, double enough);

}  // namespace vericone::guidance::courses
