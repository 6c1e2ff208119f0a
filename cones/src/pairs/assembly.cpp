// SPDX-License-Identifier: BSD-3-Clause
//
// A convex agent against hulls and assemblies: exact.
#include <vericone/internal/cones/assembly/assembly_sectors.h>
#include <vericone/internal/cones/hulls/hull_sectors.h>
#include <vericone/internal/cones/round/round_oracle.h>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "assembly/passing.h"
#include "pairs/cones.h"
#include "pairs/tight_plane.h"

namespace vericone::pairs {
namespace {

using Eigen::Vector3d;

class AssemblyFamily : public Family {
 public:
  template <typename Agent>
  AssemblyFamily(const Standing<Agent>& agent, const Assembly& obstacle, const Pose& pose)
      : oracle_(std::make_shared<AssemblyOracle>(agent.body, obstacle, pose, agent.at)),
        axis_(pose.to_world(obstacle.bounds().center()) - (middle(agent.body) + agent.at)),
        size_(size_of(agent.body)) {}

  Guarantee guarantee() const override { return {oracle_->decided(), 0, "assembly"}; }
  std::optional<Relation> relation() const override {
    return oracle_->decided() ? std::optional(oracle_->relation()) : std::nullopt;
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return oracle_->verdict(v_a, v_b);
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return oracle_->verdict(v_a, v_b, horizon);
  }
  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    Effort effort;
    if (oracle_->relation() != Relation::disjoint) return Rung::exact;
    static_cast<void>(oracle_->membership(v_a, v_b, &effort));
    return effort.exact > 0 ? Rung::exact : Rung::triage;
  }

  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact contact;
    if (oracle_->relation() != Relation::disjoint) {
      if (oracle_->decided()) contact.latest = 0;
      return contact;
    }
    contact.time = std::numeric_limits<double>::quiet_NaN();
    // A verdict of the unrounded difference may be known where the rounded one misses.
    const Vector3d w = relative_velocity(v_a, v_b);
    const auto found = oracle_->first_contact(w);
    if (!found) return contact;
    contact.earliest = found->earliest;
    contact.latest = found->latest;
    if (!is_known(*found, w, oracle_->verdict(v_a, v_b) == Verdict::on)) return contact;
    contact.time = found->time;
    contact.normal = found->normal;
    contact.point = in_world_at(found->point, found->time, v_b);
    return contact;
  }

  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    const AssemblyMiss found = oracle_->miss_distance(relative_velocity(v_a, v_b));
    Miss miss;
    miss.least = found.least;
    miss.most = found.most;
    miss.distance = 0.5 * (found.least + found.most);
    miss.normal = found.normal;
    miss.time = found.time;
    if (!(miss.most > 0)) miss.depth = std::numeric_limits<double>::quiet_NaN();
    return miss;
  }

  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    return assembly_sector(*oracle_, line.from, line.to, e);
  }
  std::optional<Passing> passing(const Vector3d& w) const override { return assembly_passing(*oracle_, w); }

  std::shared_ptr<const DirectionClassifier> directions() const override { return oracle_; }

  Cone cone(const ConeOptions& options) const override { return cone_by_map(*this, axis_, options); }
  Vector3d axis() const override { return axis_; }

 protected:
  /// Whether the contact is known to a thousandth of the time or a hundredth of the agent's size. It is not
  /// where a piece is so large that its coordinates are rounded by more. What grazes has no time at which
  /// they surely overlap.
  bool is_known(const AssemblyContact& contact, const Vector3d& w, bool grazes) const {
    constexpr double kOfTime = 1e-3, kOfSize = 1e-2, kLargest = 1e7;
    if (grazes) return oracle_->obstacle().bounds().half_widths().maxCoeff() <= kLargest * size_;
    const double open = contact.latest - contact.earliest;
    return std::isfinite(open) && (open <= kOfTime * contact.latest || open * w.norm() <= kOfSize * size_);
  }

  static double size_of(const Convex& agent) { return agent.bounds().half_widths().maxCoeff(); }
  static double size_of(const Ellipsoid& agent) { return agent.factor().rowwise().norm().maxCoeff(); }
  static double size_of(const HullBody& agent) {
    Vector3d low = agent.points().front(), high = low;
    for (const Vector3d& x : agent.points()) low = low.cwiseMin(x), high = high.cwiseMax(x);
    return 0.5 * (high - low).maxCoeff();
  }

  static Vector3d middle(const Convex& agent) { return agent.middle(); }
  static Vector3d middle(const Ellipsoid& agent) { return agent.center(); }
  /// In the hull, even where it has few points.
  static Vector3d middle(const HullBody& agent) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& x : agent.points()) sum += x / static_cast<double>(agent.size());
    return sum;
  }

  std::shared_ptr<const AssemblyOracle> oracle_;
  Vector3d axis_;  // from the agent towards the obstacle
  double size_;    // half the agent's largest width
};

/// Verdicts and sectors by the hulls' own predicate, which is several times faster; all else as an assembly
/// of one hull.
template <typename Agent>
class Hulls : public AssemblyFamily {
 public:
  Hulls(const Standing<Agent>& agent, const Standing<HullBody>& obstacle)
      : AssemblyFamily(agent, Assembly::polyhedra({obstacle.body}), Pose{obstacle.at}),
        agent_(agent.in_world()),
        obstacle_(obstacle.in_world()),
        hulls_(agent.body, obstacle.body, agent.at, obstacle.at) {
    axis_ = middle(obstacle_) - middle(agent_);
  }

  Guarantee guarantee() const override { return {true, 0, "hulls"}; }
  std::optional<Relation> relation() const override { return hulls_.relation(); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return hulls_.verdict(v_a, v_b);
  }
  /// What never meets is told by the hulls; when the others do, by the assembly.
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    const bool ahead = horizon.from == 0 && hulls_.relation() == Relation::disjoint;
    if (ahead && hulls_.surely_out(v_a, v_b, horizon)) return Verdict::out;
    return AssemblyFamily::verdict(v_a, v_b, horizon);
  }
  double gap(const Vector3d& n) const override { return hulls_.gap(n); }
  std::optional<NearestPlane> nearest_plane(const Vector3d& start, const Vector3d& end) const override {
    return oracle_->nearest_plane(start, end);
  }
  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    Rung rung = hulls_.relation_rung();
    static_cast<void>(hulls_.verdict(v_a, v_b, &rung));
    return rung;
  }
  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    if constexpr (std::is_same_v<Agent, Ellipsoid>) {
      if (line.from == agent_.center())
        if (auto own = HullSectors(agent_, obstacle_, hulls_).on(line.to, e)) return own;
    }
    return AssemblyFamily::sector(line, e);
  }
  Cone cone(const ConeOptions& options) const override { return cone_of_hulls(*oracle_, axis_, options); }

 private:
  // As searches read them: rounded.
  Agent agent_;
  HullBody obstacle_;
  HullOracle hulls_;
};

/// Verdicts and relation by the predicate of convex bodies; all else as an assembly of one of them.
class Convexes : public AssemblyFamily {
 public:
  Convexes(const Standing<Convex>& agent, const Standing<Convex>& obstacle)
      : AssemblyFamily(agent, Assembly::convexes({obstacle.body}), Pose{obstacle.at}),
        convexes_(agent.body, obstacle.body, agent.at, obstacle.at),
        plane_(agent.body, agent.at, obstacle.body, obstacle.at) {
    axis_ = (middle(obstacle.body) + obstacle.at) - (middle(agent.body) + agent.at);
  }

  Guarantee guarantee() const override { return {convexes_.relation().has_value(), 0, "convex"}; }
  std::optional<Relation> relation() const override { return convexes_.relation(); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return convexes_.verdict(v_a, v_b);
  }
  /// What the predicate does not tell in doubles is told by the assembly.
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    const bool ahead = horizon.from == 0 && convexes_.relation() == Relation::disjoint;
    if (ahead && convexes_.surely_out(v_a, v_b, horizon)) return Verdict::out;
    if (ahead || horizon.from > 0)
      if (const auto found = convexes_.triage_within(v_a, v_b, horizon)) return to_verdict(*found);
    return AssemblyFamily::verdict(v_a, v_b, horizon);
  }
  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    const auto found = first_contact(v_a, v_b);
    if (!found) return AssemblyFamily::contact(v_a, v_b);
    const double time = 0.5 * (found->earliest + found->latest);
    return {found->earliest, found->latest, time, in_world_at(found->point, time, v_b), found->normal};
  }
  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    const auto found = first_contact(v_a, v_b);
    if (!found) return AssemblyFamily::miss(v_a, v_b);
    Miss miss;
    miss.depth = std::numeric_limits<double>::quiet_NaN();
    miss.normal = found->normal;
    miss.time = 0.5 * (found->earliest + found->latest);
    return miss;
  }
  double gap(const Vector3d& n) const override { return convexes_.gap(n); }
  std::optional<NearestPlane> nearest_plane(const Vector3d& start, const Vector3d& end) const override {
    const auto meeting = convexes_.meeting(start, end);
    if (meeting && meeting->inside) return std::nullopt;
    if (meeting && meeting->touching) return NearestPlane{meeting->normal, meeting->part};
    if (const auto found = oracle_->nearest_plane(start, end)) return plane_.tightened(*found, start, end);
    return plane_.found(start, end, meeting ? std::optional(meeting->normal) : std::nullopt);
  }
  std::optional<Vector3d> touching_plane(const Vector3d& w, const Horizon& horizon) const override {
    return convexes_.touching_plane(w, horizon);
  }
  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    Rung rung = convexes_.relation_rung();
    static_cast<void>(convexes_.verdict(v_a, v_b, &rung));
    return rung;
  }
  Cone cone(const ConeOptions& options) const override { return cone_of_hulls(*oracle_, axis_, options); }

 private:
  std::optional<RoundOracle::FirstContact> first_contact(const Vector3d& v_a, const Vector3d& v_b) const {
    return convexes_.first_contact(relative_velocity(v_a, v_b));
  }

  RoundOracle convexes_;
  TightPlane plane_;
};

}  // namespace

FamilyPointer convex_family(const Standing<Convex>& agent, const Standing<Convex>& obstacle) {
  return std::make_shared<Convexes>(agent, obstacle);
}
FamilyPointer assembly_family(const Standing<Convex>& agent, const Assembly& obstacle, const Pose& pose) {
  return std::make_shared<AssemblyFamily>(agent, obstacle, pose);
}
FamilyPointer hull_family(const Standing<Ellipsoid>& agent, const Standing<HullBody>& obstacle) {
  return std::make_shared<Hulls<Ellipsoid>>(agent, obstacle);
}
FamilyPointer hull_family(const Standing<HullBody>& agent, const Standing<HullBody>& obstacle) {
  return std::make_shared<Hulls<HullBody>>(agent, obstacle);
}
FamilyPointer assembly_family(const Standing<Ellipsoid>& agent, const Assembly& obstacle, const Pose& pose) {
  return std::make_shared<AssemblyFamily>(agent, obstacle, pose);
}
FamilyPointer assembly_family(const Standing<HullBody>& agent, const Assembly& obstacle, const Pose& pose) {
  return std::make_shared<AssemblyFamily>(agent, obstacle, pose);
}

}  // namespace vericone::pairs
