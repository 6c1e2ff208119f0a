// SPDX-License-Identifier: BSD-3-Clause
//
// Containing bodies of least volume as a constrained minimisation: variables, constraints, derivatives.
#pragma once

#include "containing/star_volume.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone::fitting {

/// Which eigenvalues of a delimiter are negative.
enum class Delimit {
  dents,  // two: a two-sheeted hyperboloid
  waist,  // one: a one-sheeted hyperboloid
};

/// { y : (y-p)^T A (y-p) <= 1, (y-p)^T M_i (y-p) <= 1 }.
struct StarBody {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d ellipsoid = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Matrix3d> delimiters;

  const Eigen::Matrix3d& form(int surface) const {
    return surface == 0 ? ellipsoid : delimiters[std::size_t(surface - 1)];
  }
  Eigen::Matrix3d& form(int surface) {
    return surface == 0 ? ellipsoid : delimiters[std::size_t(surface - 1)];
  }
  int surfaces() const { return 1 + int(delimiters.size()); }
};

using Variables = Eigen::VectorXd;  // center (3), then 6 numbers a surface: 00, 11, 22, 01, 02, 12
Variables to_variables(const StarBody& body);
StarBody to_body(const Variables& variables);

/// In coordinates in which the semi-axes of the least ellipsoid are 1.
class HullProblem {
 public:
  /// What a surface must contain, or how an eigenvalue is bounded. The greatest value on a triangle or a ball
  /// has kinks where its place jumps; a cut is the fixed place that once was the greatest one.
  struct Constraint {
    enum Kind : char { point, triangle, cut, eigenvalue } kind = point;
    int surface = 0;
    std::uint32_t index = 0;  // of a point, a triangle, a cut, or an eigenvalue in increasing order
    bool operator==(const Constraint&) const = default;
    auto operator<=>(const Constraint&) const = default;
  };

  /// Balls of radius `margin` in the unit of x = map * y about the points are to be inside; the map matters
  /// only with a margin.
  HullProblem(std::vector<Eigen::Vector3d> points, std::vector<std::array<std::uint32_t, 3>> triangles,
              std::vector<Delimit> delimits, double margin, const Eigen::Matrix3d& map);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  const std::vector<Delimit>& delimits() const { return delimits_; }

  /// The same without kinks near `body`: of a triangle or a ball a cut at the place where the surface's form
  /// is greatest on it.
  Constraint smooth(const Constraint& c, const StarBody& body);
  Constraint cut_of(const Constraint& c) const { return c.kind == Constraint::cut ? cuts_[c.index].of : c; }

  /// A place of the ball about the origin, along a unit vector.
  Eigen::Vector3d in_ball(const Eigen::Vector3d& direction) const { return margin_ * to_unit_ * direction; }
  bool has_margin() const { return margin_ > 0; }

  /// Value, not to be positive; with `gradient` its derivative is added to it, times `factor`.
  double constraint(const Constraint& c, const StarBody& body, Variables* gradient = nullptr,
                    double factor = 1) const;

  /// The bounds of eigenvalues, which keep ellipsoid and delimiters what they are.
  std::vector<Constraint> signature() const;

  /// log volume and its gradient; false where the ellipsoid is none.
  bool volume(const StarBody& body, double& log, Variables* gradient) const;

  /// The greatest value on each surface over all points and triangles. `worst` (if given): the constraints
  /// above `above`, those of each surface in decreasing order.
  std::vector<double> greatest(const StarBody& body, double above,
                               std::vector<std::vector<std::pair<double, Constraint>>>* worst) const;

  /// The same body, each surface moved so that everything is inside by at least `slack`, eigenvalues too.
  void make_feasible(StarBody& body, double slack) const;

 private:
  int negative_eigenvalues(int surface) const;
  /// Where the form of a surface is greatest, relative to the centre: on a triangle; on the ball about a
  /// place.
  Eigen::Vector3d place_on(std::uint32_t triangle, int surface, const StarBody& body) const;
  Eigen::Vector3d place_of(const Constraint& c, const StarBody& body) const;
  /// Of the balls about any place.
  struct BallForm {
    Eigen::Matrix3d pull, push;  // half gradient and place in the eigenbasis of the form on the ball
    Eigen::Vector3d eigenvalues;
  };
  BallForm ball_form(const Eigen::Matrix3d& form) const;
  Eigen::Vector3d place_in_ball(const Eigen::Vector3d& y, const BallForm& ball) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Delimit> delimits_;
  double margin_;
  struct Cut {
    Eigen::Vector3d place;
    Constraint of;
  };
  std::vector<Cut> cuts_;
  Eigen::Matrix3d to_unit_;  // inverse of the map
};

}  // namespace vericone::fitting
