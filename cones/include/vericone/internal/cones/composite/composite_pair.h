// SPDX-License-Identifier: BSD-3-Clause
//
// The collision cone of two bodies that are both made of many convex parts: an assembly of pieces
// (assembly.h) that meets another one, or a delimited body (combined.h) that meets one. Meshes against
// meshes, a dented body against a cloud, and so on (docs/explanation/predicates/composite.md).
//
// The pair is asked with the delimited body, or the first assembly, as the agent. For the mirrored pair
// exchange the bodies and negate the velocity; times and distances stay, and of a contact `point` is where
// both bodies are, `normal` is to be negated.
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/pose.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/direction_cell.h>
#include <cstdint>
#include <memory>
#include <optional>

namespace vericone {

/// The first contact of the two, in the frame of the world. Nothing is touched before `earliest`; at `latest`
/// they touch or overlap (infinite where that is not proved).
struct CompositeContact : AssemblyContact {
  std::uint32_t agent_piece = 0;  // of an assembly, in the order given; 0 for a delimited body
};

/// The least distance from now on; `point` is of the obstacle, where it stands now.
struct CompositeMiss : AssemblyMiss {
  Eigen::Vector3d agent_point = Eigen::Vector3d::Zero();  // m, of the agent, where it stands now
  std::uint32_t agent_piece = 0;
};

/// Two such bodies prepared for many velocities. Immutable; may be used by several threads at once.
class CompositePair : public DirectionClassifier {
 public:
  /// A delimited body. Answers are proved, but near the boundary of the cone none is given: the body is
  /// resolved to `tolerance` (1e-6 to 0.5) parts of its extent. `pose`: of the obstacle, `agent_at`: where
  /// the agent's own origin stands, metres; where the pose turns, the body is taken into its frame, the
  /// numbers rounded, and answers hold for the rounded body. Throws InputError naming "tolerance", "agent"
  /// (axis ratio beyond 1e12) or "pose".
  CompositePair(const CombinedEllipsoid& agent, const Assembly& obstacle, const Pose& pose = {},
                double tolerance = 1e-3, const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero());

  /// Pieces against pieces: exact. Where the poses differ and one of them turns, the agent's coordinates are
  /// rounded. Throws InputError naming "pose".
  CompositePair(const Assembly& agent, const Pose& agent_pose, const Assembly& obstacle,
                const Pose& obstacle_pose = {});

  ~CompositePair() override;
  CompositePair(CompositePair&&) noexcept;
  CompositePair& operator=(CompositePair&&) noexcept;

  /// Whether every question is decided: pieces against pieces.
  [[nodiscard]] bool exact() const;
  [[nodiscard]] const Assembly& obstacle() const;

  /// Nothing where the two touch or nearly do, within the tolerance. Touching is known of pieces alone.
  [[nodiscard]] std::optional<Relation> relation() const;

  /// Of w = v_a - v_b, without rounding where the obstacle's pose is not turned. Of bodies that are not
  /// disjoint every w != 0 is `in`; w = 0 is `out`. Nothing: not decided; never for exact(). `on` is known of
  /// pieces alone (where they join: docs/explanation/predicates/composite.md, Seams). Throws InputError
  /// naming "agent_velocity[i]" or "obstacle_velocity[i]".
  [[nodiscard]] std::optional<Membership> membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                                     Effort* effort = nullptr) const;
  /// Relation and membership in one; `undecided` where either is not known.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// The same of contacts within a horizon alone, as Pair::verdict().
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon) const;

  /// Nothing where membership is proved `out`. Where it is undecided the contact is possible: `earliest` is
  /// finite and `latest` infinite. Time 0 where the relation is not disjoint. For a delimited body
  /// latest - earliest is about the time to move by the tolerance, and more where the contact grazes.
  [[nodiscard]] std::optional<CompositeContact> first_contact(const Eigen::Vector3d& w) const;

  /// For w = 0 the present distance. `tolerance` (1e-9 to 1): most - least, relative to most plus the agent's
  /// size; a delimited body is not resolved finer than its own. Throws InputError naming "tolerance".
  [[nodiscard]] CompositeMiss miss_distance(const Eigen::Vector3d& w, double tolerance = 1e-3) const;

  [[nodiscard]] Frontier start() const override;
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;
  bool misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

  struct State;

 private:
  std::unique_ptr<const State> state_;
};

}  // namespace vericone
