// SPDX-License-Identifier: BSD-3-Clause
//
// A body at an instant, as guidance sees it.
#pragma once

#include <vericone/cones/combined/sector.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/hull_body.h>
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace vericone::guidance {

/// In world coordinates. Planar bodies lie in the plane z = 0 and move in it. An ellipsoid is a combined body
/// without delimiters. Rigid bodies of any kind (meshes, clouds, maps, unions) are placed: moving and turning
/// them copies no points.
using Shape = std::variant<CombinedEllipse, CombinedEllipsoid, HullBody, Placed>;

/// What Pair takes. Requires a spatial body; allocates where it is not placed already.
[[nodiscard]] Placed placed(const Shape& shape);

/// The body where it is a placed one; otherwise null.
[[nodiscard]] const Placed* if_placed(const Shape& shape);
[[nodiscard]] bool is_hull(const Shape& shape);

/// Two bodies of any kinds. Throws InputError like Pair, and naming "bodies" for one of the plane and one of
/// space.
[[nodiscard]] Pair pair_of(const Shape& agent, const Shape& obstacle, const PairOptions& options = {});

/// The point farthest along n of an ellipsoid or a hull, in space, rounded; nothing of other bodies.
[[nodiscard]] std::optional<Eigen::Vector3d> support_point(const Shape& shape, const Eigen::Vector3d& n);

/// How a spatial delimiter changes beyond moving and turning with its body.
struct SpatialDelimiterRate {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();  // 1 / (m^2 s)
  double level = 0;                                  // 1 / s
};

/// Rates of a shape beyond moving and turning; nothing for rigid ones.
struct ShapeRate {
  Eigen::Matrix3d shape =
      Eigen::Matrix3d::Zero();                   // of the ellipsoid's S, m^2/s; upper left 2 x 2 in the plane
  std::vector<SpatialDelimiterRate> delimiters;  // missing ones are zero
};

/// Whether a body's orientation follows its velocity.
enum class Turning : std::uint8_t {
  none,          // as omega says, whatever it commands
  with_heading,  // omega = v x a / |v|^2 for its own acceleration a (a body without roll)
};

struct BodyState {
  Shape shape;  // its centre is `position`; of hulls, the reference point
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega =
      Eigen::Vector3d::Zero();  // rad/s; of a body that turns with its heading, beyond that
  Turning turning = Turning::none;
  ShapeRate rate;

  [[nodiscard]] bool planar() const { return std::holds_alternative<CombinedEllipse>(shape); }
};

}  // namespace vericone::guidance
