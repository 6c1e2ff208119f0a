// SPDX-License-Identifier: BSD-3-Clause
//
// Two combined quadrics, at least one of them delimited: certified.
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/internal/cones/combined/plane_sector.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "pairs/cones.h"

namespace vericone::pairs {
namespace {

using Eigen::Vector3d;

/// An oracle keeps scratch memory between calls, so each thread that asks at the same time gets one of its
/// own.
class OraclePool {
 public:
  OraclePool(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance)
      : a_(a), b_(b), tolerance_(tolerance) {
    free_.push_back(std::make_unique<CombinedOracle>(a_, b_, tolerance_));
  }

  template <typename Ask>
  auto with(const Ask& ask) const {
    struct Lease {
      const OraclePool& pool;
      std::unique_ptr<CombinedOracle> oracle;
      explicit Lease(const OraclePool& from) : pool(from), oracle(from.take()) {}
      ~Lease() {
        const std::lock_guard lock(pool.mutex_);
        pool.free_.push_back(std::move(oracle));
      }
    } lease(*this);
    return ask(*lease.oracle);
  }

 private:
  std::unique_ptr<CombinedOracle> take() const {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        auto oracle = std::move(free_.back());
        free_.pop_back();
        return oracle;
      }
      free_.reserve(free_.capacity() + 1);  // so that giving it back does not throw
    }
    return std::make_unique<CombinedOracle>(a_, b_, tolerance_);
  }

  CombinedEllipsoid a_, b_;
  double tolerance_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<CombinedOracle>> free_;
};

class Combined : public Family {
 public:
  Combined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance)
      : a_(a),
        b_(b),
        tolerance_(tolerance),
        pool_(a, b, tolerance),
        relation_(pool_.with([](const CombinedOracle& oracle) { return oracle.relation(); })),
        around_(ellipsoid_family(a.bounding_ellipsoid(), b.bounding_ellipsoid())) {
    const auto core_a = inner(a), core_b = inner(b);
    if (core_a && core_b) inside_ = ellipsoid_family(*core_a, *core_b);
  }

  Guarantee guarantee() const override { return {false, tolerance_, "combined"}; }
  std::optional<Relation> relation() const override { return relation_; }

  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return pool_.with([&](const CombinedOracle& oracle) { return oracle.verdict(v_a, v_b); });
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return pool_.with([&](const CombinedOracle& oracle) { return oracle.verdict(v_a, v_b, horizon); });
  }
  /// Of ellipsoids that contain them.
  double gap(const Vector3d& n) const override { return around_->gap(n); }

  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact contact;
    const Vector3d w = relative_velocity(v_a, v_b);
    if (relation_ && *relation_ != Relation::disjoint) {
      contact.latest = 0;
      return contact;
    }
    contact.time = std::numeric_limits<double>::quiet_NaN();
    const auto enclosure =
        pool_.with([&](const CombinedOracle& oracle) { return oracle.time_to_contact(w); });
    if (enclosure && enclosure->finite()) {
      contact.earliest = std::max(enclosure->lo(), 0.0);
      contact.latest = enclosure->hi();
      contact.time = enclosure->mid();
    } else if (around_->verdict(v_a, v_b) != Verdict::out) {
      contact.earliest = around_->contact(v_a, v_b).earliest;
    }
    return contact;
  }

  /// Between that of ellipsoids that contain the bodies and that of ellipsoids inside of them, or of the
  /// centres.
  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    const Verdict own = verdict(v_a, v_b);
    Miss miss = around_->miss(v_a, v_b);
    if (own != Verdict::out && own != Verdict::undecided) {
      miss.least = miss.most = 0;
      miss.distance = -miss.depth;
      return miss;
    }
    miss.depth = 0;
    if (inside_) {
      miss.most = inside_->miss(v_a, v_b).most;
    } else {
      const Vector3d w = relative_velocity(v_a, v_b), c = b_.center() - a_.center();
      const double ahead = w.isZero(0) ? 0 : std::max(0.0, c.dot(w) / w.squaredNorm());
      miss.most = (c - ahead * w).norm() * (1 + 1e-12);
    }
    miss.most = std::max(miss.most, miss.least);
    miss.distance = 0.5 * (miss.least + miss.most);
    return miss;
  }

  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    if (line.from != a_.center() || line.to != b_.center()) return sector_by_arcs(*this, line, e);
    return pool_.with([&](const CombinedOracle& oracle) {
      return combined_sector_on(oracle, e, std::max(1e-9, 0.1 * tolerance_));
    });
  }
  std::optional<Passing> passing(const Vector3d&) const override { return std::nullopt; }

  std::shared_ptr<const DirectionClassifier> directions() const override {
    return std::make_shared<CombinedClassifier>(combined_cone(a_, b_));
  }

  Cone cone(const ConeOptions& options) const override { return cone_of_combined(a_, b_, options); }
  Vector3d axis() const override { return b_.center() - a_.center(); }

 private:
  static std::optional<Ellipsoid> inner(const CombinedEllipsoid& body) {
    return body.is_ellipsoid() ? body.ellipsoid() : body.inscribed_ellipsoid();
  }

  CombinedEllipsoid a_, b_;
  double tolerance_;
  OraclePool pool_;
  std::optional<Relation> relation_;
  FamilyPointer around_, inside_;
};

}  // namespace

FamilyPointer combined_family(const CombinedEllipsoid& agent, const CombinedEllipsoid& obstacle,
                              double tolerance) {
  return std::make_shared<Combined>(agent, obstacle, tolerance);
}

}  // namespace vericone::pairs
