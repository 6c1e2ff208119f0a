// SPDX-License-Identifier: BSD-3-Clause
//
// Two ellipsoids: exact.
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <algorithm>
#include <cmath>

#include "ellipsoids/velocity_difference.h"
#include "ellipsoids/within.h"
#include "pairs/cones.h"

namespace vericone::pairs {
namespace {

using Eigen::Vector3d;

class Ellipsoids : public Family {
 public:
  Ellipsoids(const Ellipsoid& agent, const Ellipsoid& obstacle)
      : oracle_(agent, obstacle), frame_(agent, obstacle) {}

  Guarantee guarantee() const override { return {true, 0, "ellipsoids"}; }
  const ConeOracle* ellipsoids() const override { return &oracle_; }
  std::optional<Relation> relation() const override { return oracle_.relation(); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return oracle_.verdict(v_a, v_b);
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return oracle_.verdict(v_a, v_b, horizon);
  }
  double gap(const Vector3d& n) const override { return triage_gap<3>(oracle_.a(), oracle_.b(), n); }
  std::optional<NearestPlane> nearest_plane(const Vector3d& start, const Vector3d& end) const override {
    return vericone::nearest_plane(frame_, start, end);
  }

  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact contact;
    const auto enclosure = enclose_time_to_contact(oracle_, v_a, v_b);
    if (enclosure && !enclosure->finite()) {
      // Its end is past the largest double, and it is a few units in the last place wide.
      contact.earliest = std::numeric_limits<double>::max() * (1 - 0x1p-48);
      contact.time = std::numeric_limits<double>::quiet_NaN();
      return contact;
    }
    contact.earliest = enclosure ? std::max(enclosure->lo(), 0.0) : 0;
    contact.latest = enclosure ? enclosure->hi() : std::numeric_limits<double>::infinity();
    const auto time = time_to_contact(oracle_, v_a, v_b);
    // Grazing, the estimate has few digits.
    contact.time = std::max(contact.earliest, std::min(time.value_or(contact.earliest), contact.latest));
    const Vector3d w = v_a - v_b;
    // The closest points just before: at the contact itself rounding may make them overlap.
    for (double before = 0x1p-50; before < 1e-3 && std::isfinite(contact.time); before *= 32) {
      const Vector3d way = (1 - before) * contact.time * w;
      if (!way.allFinite()) break;
      const Separation near = separation(oracle_.a().translated(way), oracle_.b());
      if (near.normal.isZero(0)) continue;
      contact.normal = near.normal;
      contact.point = in_world_at(oracle_.b().support_point(-near.normal), contact.time, v_b);
      break;
    }
    return contact;
  }

  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    const Ellipsoid &a = oracle_.a(), &b = oracle_.b();
    if (line.from == a.center() && line.to == b.center()) return true_sector(a, b, e);
    return sector_by_arcs(*this, line, e);
  }

  std::optional<Passing> passing(const Vector3d& w) const override {
    const Clearance c = clearance(oracle_.a(), oracle_.b(), w);
    const Vector3d on_b = oracle_.b().support_point(-c.normal);
    return Passing{oracle_.a().support_point(c.normal), on_b, c.normal};
  }

  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    Rung rung = oracle_.relation_rung();  // of bodies that are not disjoint
    static_cast<void>(oracle_.verdict(v_a, v_b, &rung));
    return rung;
  }

  /// The numbers of clearance_ahead() and of its brackets.
  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    const Ellipsoid &a = oracle_.a(), &b = oracle_.b();
    constexpr double kLeast = std::numeric_limits<double>::min();  // rounding must not contradict the verdict
    const Verdict verdict = oracle_.verdict(v_a, v_b);
    const Vector3d w = VelocityDifference(v_a, v_b).w;  // its length does not matter but for the time
    const double stretched = std::ldexp(1.0, VelocityDifference(v_a, v_b).exponent);
    Miss miss;
    if (verdict != Verdict::out) {
      if (w.isZero(0)) {
        miss.depth = std::numeric_limits<double>::quiet_NaN();
        return miss;
      }
      const Clearance c = clearance(a, b, w);
      miss.distance = verdict == Verdict::in            ? std::min(c.distance, -kLeast)
                      : verdict == Verdict::overlapping ? std::min(c.distance, 0.0)
                                                        : 0;
      miss.depth = -miss.distance;
      miss.normal = c.normal;
      miss.time = std::max(c.time, 0.0) / stretched;
      return miss;
    }
    const Separation now = separation(a, b);
    const bool receding = w.isZero(0) || !(now.normal.dot(w) > 0);
    if (receding) {
      miss.distance = now.distance;
      miss.normal = now.normal;
    } else {
      const Clearance c = clearance(a, b, w);
      miss.distance = c.distance;
      miss.normal = c.normal;
      miss.time = std::max(c.time, 0.0) / stretched;
    }
    miss.distance = std::max(miss.distance, kLeast);
    const Interval bracket = receding ? enclose_separation(a, b) : enclose_clearance(a, b, w);
    miss.least = std::max(bracket.lo(), 0.0);
    miss.most = std::max(bracket.hi(), kLeast);
    return miss;
  }

  std::shared_ptr<const DirectionClassifier> directions() const override {
    return std::make_shared<EllipsoidClassifier>(oracle_.a(), oracle_.b());
  }

  Cone cone(const ConeOptions& options) const override {
    return cone_of_ellipsoids(oracle_.a(), oracle_.b(), options);
  }
  Vector3d axis() const override { return oracle_.b().center() - oracle_.a().center(); }

 private:
  ConeOracle oracle_;
  ContactFrame<3> frame_;
};

}  // namespace

FamilyPointer ellipsoid_family(const Ellipsoid& agent, const Ellipsoid& obstacle) {
  return std::make_shared<Ellipsoids>(agent, obstacle);
}

}  // namespace vericone::pairs
