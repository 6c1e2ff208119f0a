// SPDX-License-Identifier: BSD-3-Clause
//
// Every pair of bodies of the library as a classifier of directions, for cone maps. Assemblies are their own
// (assembly_oracle.h); a convex polyhedron is an assembly of one hull.
//
// Bodies that are not disjoint collide in every direction, touching ones too.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/direction_cell.h>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace vericone {

/// Two ellipsoids. Their cone is convex: a cell is `in` iff its corners are, which is decided exactly; it is
/// `out` where a plane through the apex separates it from both bodies, found by a search along one angle and
/// proved exactly. What stays undecided is mixed, or grazes closer than 1e-8 rad.
class EllipsoidClassifier : public DirectionClassifier {
 public:
  EllipsoidClassifier(const Ellipsoid& agent, const Ellipsoid& obstacle) : oracle_(agent, obstacle) {}
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> normal_along(const Eigen::Vector3d& direction) const;
  [[nodiscard]] bool proved_out(Eigen::Vector3d normal, const DirectionCell& cell) const;

  ConeOracle oracle_;
};

/// Two combined quadrics, by their certified cone (combined_cone()): `in` where the cell is inside its inner
/// polygon, `out` where it is outside its outer one; what lies between them stays undecided however small the
/// cells are. Margins of 1e-12 rad cover all rounding.
class CombinedClassifier : public DirectionClassifier {
 public:
  explicit CombinedClassifier(const CombinedCone& cone);
  [[nodiscard]] Frontier start() const override;
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

 private:
  struct Part {
    DirectionCell corners;  // axis, then two successive directions of the polygon
    DirectionCell inwards;  // unit normals of the sides, that of the polygon's side in the middle
    bool outer, wide;       // wide: nearly a half-plane, taken to meet every cell
  };
  [[nodiscard]] bool apart(const Part& part, const DirectionCell& cell, const DirectionCell& inwards) const;

  std::optional<Relation> relation_;
  std::vector<Part> parts_;  // star-shaped polygons, cut into triangles with the axis
};

/// An agent and an infinite thin wall with one opening of any outline. `in`: it hits the wall or touches the
/// rim; `out`: it passes through, or never reaches the wall. region_around() a direction through the opening
/// gives the orifice cone: of a convex outline the passing directions are convex, and connected with no
/// others; of another they may be any number of regions. An agent that the wall's plane cuts stays undecided:
/// it may be within the opening.
///
/// Proofs: of convex outlines three corners that pass, exactly (orifice.h); of others one corner, and a plane
/// for each edge that keeps it apart from the agent in all directions of the cell. Or a point of the agent
/// that hits the wall in all of them, beyond one tangent of a round rim, or in a disc outside of a polygon.
/// In intervals. Of a polygon a cell takes the square of the vertices.
class OrificeClassifier : public DirectionClassifier {
 public:
  OrificeClassifier(const Ellipsoid& agent, const Orifice& orifice) : oracle_(agent, orifice) {}
  OrificeClassifier(const Ellipsoid& agent, const PlacedOpening& opening) : oracle_(agent, opening) {}
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

 private:
  [[nodiscard]] bool hits_wall(const DirectionCell& cell) const;
  [[nodiscard]] bool lands_outside(const DirectionCell& cell) const;  // hits_wall of a PlacedOpening
  [[nodiscard]] bool misses_rim(const DirectionCell& cell) const;     // of a polygon

  OrificeOracle oracle_;
};

/// Several obstacles at once: `in` where one of the classifiers says so, `out` where all do.
class AnyOfClassifier : public DirectionClassifier {
 public:
  explicit AnyOfClassifier(std::vector<std::shared_ptr<const DirectionClassifier>> all)
      : all_(std::move(all)) {}
  [[nodiscard]] Frontier start() const override;
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;
  bool misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

 private:
  template <typename Ask>
  Certified each(const Frontier& parent, Frontier& own, const Ask& ask) const;

  std::vector<std::shared_ptr<const DirectionClassifier>> all_;
};

/// Agent and obstacle exchanged: the directions of w for -w.
class MirroredClassifier : public DirectionClassifier {
 public:
  explicit MirroredClassifier(std::shared_ptr<const DirectionClassifier> exchanged)
      : exchanged_(std::move(exchanged)) {}
  [[nodiscard]] Frontier start() const override { return exchanged_->start(); }
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;
  bool misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

 private:
  std::shared_ptr<const DirectionClassifier> exchanged_;
};

}  // namespace vericone
