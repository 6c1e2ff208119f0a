// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of many parts against each other: pieces exactly, delimited bodies certified.
#include <vericone/internal/cones/composite/composite_pair.h>
#include <cmath>
#include <cstdint>
#include <functional>

#include "pairs/cones.h"

namespace vericone::pairs {
namespace {

using Eigen::Vector3d;

class Composite : public Family {
 public:
  /// Of pieces against pieces: the pair of two of them.
  using PieceOfEach = std::function<FamilyPointer(std::uint32_t agent, std::uint32_t obstacle)>;

  Composite(std::shared_ptr<const CompositePair> pair, double tolerance, const Vector3d& axis,
            PieceOfEach piece = {})
      : pair_(std::move(pair)), tolerance_(tolerance), axis_(axis), piece_(std::move(piece)) {}

  Guarantee guarantee() const override {
    const bool exact = pair_->exact() && pair_->relation();
    return {exact, exact ? 0 : tolerance_, "composite"};
  }
  std::optional<Relation> relation() const override { return pair_->relation(); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return pair_->verdict(v_a, v_b);
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return pair_->verdict(v_a, v_b, horizon);
  }

  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    if (!pair_->exact()) return std::nullopt;
    if (pair_->relation() != Relation::disjoint) return Rung::exact;
    Effort effort;
    static_cast<void>(pair_->membership(v_a, v_b, &effort));
    return effort.exact > 0 ? Rung::exact : Rung::triage;
  }

  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact contact;
    const auto relation = pair_->relation();
    if (relation && *relation != Relation::disjoint) {
      contact.latest = 0;
      return contact;
    }
    contact.time = std::numeric_limits<double>::quiet_NaN();
    const auto found = pair_->first_contact(relative_velocity(v_a, v_b));
    if (!found) return contact;
    contact.earliest = found->earliest;
    contact.latest = found->latest;
    contact.time = found->time;
    if (found->normal.isZero(0) || !std::isfinite(found->time)) return contact;
    contact.normal = found->normal;
    contact.point = in_world_at(found->point, found->time, v_b);
    return contact;
  }

  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    const Vector3d w = relative_velocity(v_a, v_b);
    const CompositeMiss found = pair_->miss_distance(w);
    Miss miss;
    miss.least = found.least;
    miss.most = found.most;
    miss.distance = 0.5 * (found.least + found.most);
    miss.time = found.time;
    const Vector3d between = found.point - (found.agent_point + found.time * w);
    if (!between.isZero(0)) miss.normal = between.normalized();
    if (!(miss.most > 0)) miss.depth = std::numeric_limits<double>::quiet_NaN();
    return miss;
  }

  /// A delimited body is not resolved finely enough.
  std::optional<Passing> passing(const Vector3d& w) const override {
    if (!pair_->exact()) return std::nullopt;
    const CompositeMiss found = pair_->miss_distance(w);
    if (!(found.most > 0)) return std::nullopt;
    return piece_(found.agent_piece, found.piece)->passing(w);
  }

  std::shared_ptr<const DirectionClassifier> directions() const override { return pair_; }
  Cone cone(const ConeOptions& options) const override { return cone_by_map(*this, axis_, options); }
  Vector3d axis() const override { return axis_; }

 private:
  std::shared_ptr<const CompositePair> pair_;
  double tolerance_;
  Vector3d axis_;
  PieceOfEach piece_;
};

/// One of its pieces as a body of its own.
Body piece_of(const Assembly& assembly, std::uint32_t i) {
  if (assembly.kind() == PieceKind::convex) return assembly.convex_piece(i);
  HullBody points = assembly.piece(i);
  if (!(assembly.radius() > 0)) return points;
  return Ellipsoid::from_axes(points.points().front(), Vector3d::Constant(assembly.radius()));
}

Vector3d middle(const Assembly& body, const Pose& pose) { return pose.to_world(body.bounds().center()); }

}  // namespace

FamilyPointer composite_family(const Standing<CombinedEllipsoid>& agent, const Assembly& obstacle,
                               const Pose& pose, double tolerance) {
  return std::make_shared<Composite>(
      std::make_shared<CompositePair>(agent.body, obstacle, pose, tolerance, agent.at), tolerance,
      middle(obstacle, pose) - (agent.body.center() + agent.at));
}

FamilyPointer composite_family(const Assembly& agent, const Pose& agent_pose, const Assembly& obstacle,
                               const Pose& pose) {
  const auto piece = [=](std::uint32_t i, std::uint32_t j) {
    return family_of({piece_of(agent, i), agent_pose}, {piece_of(obstacle, j), pose}, {});
  };
  return std::make_shared<Composite>(std::make_shared<CompositePair>(agent, agent_pose, obstacle, pose), 0,
                                     middle(obstacle, pose) - middle(agent, agent_pose), piece);
}

}  // namespace vericone::pairs
