// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs made of pairs: moved, exchanged, and the union of several.
#include <vericone/internal/cones/map/classifiers.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "answers/stretch.h"
#include "pairs/cones.h"

namespace vericone::pairs {
namespace {

using Eigen::Vector3d;

class Mirrored : public Family {
 public:
  explicit Mirrored(FamilyPointer exchanged) : exchanged_(std::move(exchanged)) {}

  Guarantee guarantee() const override { return exchanged_->guarantee(); }
  std::optional<Relation> relation() const override { return exchanged_->relation(); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return exchanged_->verdict(v_b, v_a);
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return exchanged_->verdict(v_b, v_a, horizon);
  }
  double gap(const Vector3d& n) const override { return exchanged_->gap(-n); }
  std::optional<NearestPlane> nearest_plane(const Vector3d& start, const Vector3d& end) const override {
    auto plane = exchanged_->nearest_plane(-start, -end);
    if (plane) plane->normal *= -1;
    return plane;
  }
  std::optional<Vector3d> touching_plane(const Vector3d& w, const Horizon& horizon) const override {
    const auto normal = exchanged_->touching_plane(-w, horizon);
    return normal ? std::optional(Vector3d(-*normal)) : std::nullopt;
  }
  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    return exchanged_->rung(v_b, v_a);
  }
  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact contact = exchanged_->contact(v_b, v_a);
    if (contact.normal) *contact.normal *= -1;
    return contact;
  }
  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    Miss miss = exchanged_->miss(v_b, v_a);
    miss.normal *= -1;
    return miss;
  }
  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    auto own = exchanged_->sector({line.to, line.from}, -e);
    if (own) *own = mirror_image(std::move(*own));
    return own;
  }
  std::optional<Passing> passing(const Vector3d& w) const override {
    const auto own = exchanged_->passing(-w);
    return own ? std::optional(Passing{own->on_b, own->on_a, -own->normal}) : std::nullopt;
  }
  std::shared_ptr<const DirectionClassifier> directions() const override {
    return std::make_shared<MirroredClassifier>(exchanged_->directions());
  }
  Cone cone(const ConeOptions& options) const override { return mirror_image(exchanged_->cone(options)); }
  Vector3d axis() const override { return -exchanged_->axis(); }

 private:
  FamilyPointer exchanged_;
};

class Moved : public Family {
 public:
  Moved(FamilyPointer pair, const Vector3d& a, const Vector3d& b, const Vector3d& world_a,
        const Vector3d& world_b)
      : pair_(std::move(pair)), a_(a), b_(b), world_a_(world_a), world_b_(world_b) {}

  Guarantee guarantee() const override { return pair_->guarantee(); }
  std::optional<Relation> relation() const override { return pair_->relation(); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    return pair_->verdict(v_a, v_b);
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return pair_->verdict(v_a, v_b, horizon);
  }
  double gap(const Vector3d& n) const override { return pair_->gap(n); }
  std::optional<NearestPlane> nearest_plane(const Vector3d& start, const Vector3d& end) const override {
    return pair_->nearest_plane(start, end);
  }
  std::optional<Vector3d> touching_plane(const Vector3d& w, const Horizon& horizon) const override {
    return pair_->touching_plane(w, horizon);
  }
  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    return pair_->rung(v_a, v_b);
  }
  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact contact = pair_->contact(v_a, v_b);
    if (contact.point) *contact.point = world_b_ + (*contact.point - b_);
    return contact;
  }
  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override { return pair_->miss(v_a, v_b); }
  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    // A centre in the world is the centre here, bit for bit.
    return pair_->sector({a_ + (line.from - world_a_), b_ + (line.to - world_b_)}, e);
  }
  std::optional<Passing> passing(const Vector3d& w) const override {
    auto own = pair_->passing(w);
    if (!own) return own;
    own->on_a = world_a_ + (own->on_a - a_);
    own->on_b = world_b_ + (own->on_b - b_);
    return own;
  }
  std::shared_ptr<const DirectionClassifier> directions() const override { return pair_->directions(); }
  Cone cone(const ConeOptions& options) const override { return pair_->cone(options); }
  Vector3d axis() const override { return pair_->axis(); }

 private:
  FamilyPointer pair_;
  Vector3d a_, b_, world_a_, world_b_;
};

class AnyOf : public Family {
 public:
  explicit AnyOf(std::vector<FamilyPointer> all) : all_(std::move(all)) {
    bool unknown = false, touching = false, overlapping = false;
    for (const FamilyPointer& pair : all_) {
      const auto relation = pair->relation();
      unknown = unknown || !relation;
      touching = touching || relation == Relation::touching;
      overlapping = overlapping || relation == Relation::overlapping;
      const Guarantee own = pair->guarantee();
      guarantee_.exact = guarantee_.exact && own.exact;
      guarantee_.tolerance = std::max(guarantee_.tolerance, own.tolerance);
    }
    guarantee_.family = "union";
    if (overlapping)
      relation_ = Relation::overlapping;
    else if (!unknown)
      relation_ = touching ? Relation::touching : Relation::disjoint;
  }

  Guarantee guarantee() const override { return guarantee_; }
  std::optional<Relation> relation() const override { return relation_; }

  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const override {
    relative_velocity(v_a, v_b);  // names what is not finite
    if (!relation_) return Verdict::undecided;
    if (*relation_ != Relation::disjoint)
      return *relation_ == Relation::touching ? Verdict::touching : Verdict::overlapping;
    return together([&](const Family& pair) { return pair.verdict(v_a, v_b); });
  }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const override {
    return verdict_within(relation_, v_a, v_b, horizon, [&](const Stretch&) {
      return together([&](const Family& pair) { return pair.verdict(v_a, v_b, horizon); });
    });
  }
  double gap(const Vector3d& n) const override {
    double least = std::numeric_limits<double>::infinity();
    for (const FamilyPointer& pair : all_)
      if (const double own = pair->gap(n); !(own >= least)) least = own;
    return least;
  }

  /// The last of those that any part needed.
  std::optional<Rung> rung(const Vector3d& v_a, const Vector3d& v_b) const override {
    Rung last = Rung::triage;
    for (const FamilyPointer& pair : all_) {
      const auto own = pair->rung(v_a, v_b);
      if (!own) return std::nullopt;
      last = std::max(last, *own);
    }
    return last;
  }

  Contact contact(const Vector3d& v_a, const Vector3d& v_b) const override {
    Contact first;
    if (relation_ && *relation_ != Relation::disjoint) {
      first.latest = 0;
      return first;
    }
    first.earliest = first.time = first.latest;  // none yet
    for (const FamilyPointer& pair : all_) {
      if (pair->verdict(v_a, v_b) == Verdict::out) continue;
      const Contact own = pair->contact(v_a, v_b);
      if (own.time < first.time) {
        first.time = own.time;
        first.point = own.point;
        first.normal = own.normal;
      }
      first.earliest = std::min(first.earliest, own.earliest);
      first.latest = std::min(first.latest, own.latest);
    }
    if (!(first.time <= first.latest)) first.time = std::numeric_limits<double>::quiet_NaN();
    return first;
  }

  Miss miss(const Vector3d& v_a, const Vector3d& v_b) const override {
    Miss nearest = all_.front()->miss(v_a, v_b);
    double least = nearest.least;
    for (std::size_t i = 1; i < all_.size(); ++i) {
      const Miss own = all_[i]->miss(v_a, v_b);
      least = std::min(least, own.least);
      if (own.most < nearest.most || (own.most == 0 && own.depth > nearest.depth)) nearest = own;
    }
    nearest.least = least;
    nearest.distance = std::max(nearest.distance, nearest.most > 0 ? least : nearest.distance);
    // To avoid one piece may be to meet another: the whole's depth is for Pair to say.
    if (!(nearest.most > 0) && all_.size() > 1) nearest.depth = std::numeric_limits<double>::quiet_NaN();
    return nearest;
  }

  /// That of each pair on its own line of centres, which keeps its closed form, would be on other planes; so
  /// on each side the farthest edge of the pairs is taken.
  std::optional<PlaneSector> sector(const SightLine& line, const Vector3d& e) const override {
    std::optional<PlaneSector> whole;
    for (const FamilyPointer& pair : all_) {
      const auto own = pair->sector(line, e);
      if (!own) continue;
      if (!whole) {
        whole = own;
        continue;
      }
      const auto farther = [](GrazingEdge& edge, const GrazingEdge& other) {
        const double beyond = std::max(edge.angle + edge.error, other.angle + other.error),
                     inside = std::max(edge.angle - edge.error, other.angle - other.error);
        if (other.angle > edge.angle) edge = other;
        // Where two edges cannot be told apart, the contact may be of either.
        if (std::abs(0.5 * (beyond + inside) - edge.angle) > 1e-9) edge = {};
        edge.angle = 0.5 * (beyond + inside);
        edge.error = 0.5 * (beyond - inside);
      };
      farther(whole->left, own->left);
      farther(whole->right, own->right);
    }
    return whole;
  }
  std::optional<Passing> passing(const Vector3d& w) const override {
    std::optional<Passing> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const FamilyPointer& pair : all_) {
      const auto own = pair->passing(w);
      if (!own) return std::nullopt;
      const double distance = (own->on_b - own->on_a).dot(own->normal);
      if (distance < least) {
        least = distance;
        nearest = own;
      }
    }
    return nearest;
  }

  std::shared_ptr<const DirectionClassifier> directions() const override {
    std::vector<std::shared_ptr<const DirectionClassifier>> classifiers;
    for (const FamilyPointer& pair : all_) classifiers.push_back(pair->directions());
    return std::make_shared<AnyOfClassifier>(std::move(classifiers));
  }
  Cone cone(const ConeOptions& options) const override { return cone_by_map(*this, axis(), options); }
  Vector3d axis() const override {
    Vector3d sum = Vector3d::Zero();
    for (const FamilyPointer& pair : all_) sum += pair->axis() / static_cast<double>(all_.size());
    return sum;
  }

 private:
  template <typename Ask>
  Verdict together(const Ask& verdict_of) const {
    Verdict whole = Verdict::out;
    for (const FamilyPointer& pair : all_) {
      const Verdict one = verdict_of(*pair);
      if (one == Verdict::in) return one;
      if (one == Verdict::undecided || whole == Verdict::out) whole = one;
    }
    return whole;
  }

  std::vector<FamilyPointer> all_;
  Guarantee guarantee_;
  std::optional<Relation> relation_;
};

}  // namespace

FamilyPointer moved(FamilyPointer pair, const Vector3d& a, const Vector3d& b, const Vector3d& world_a,
                    const Vector3d& world_b) {
  if (a == world_a && b == world_b) return pair;
  return std::make_shared<Moved>(std::move(pair), a, b, world_a, world_b);
}
FamilyPointer mirrored(FamilyPointer exchanged) { return std::make_shared<Mirrored>(std::move(exchanged)); }
FamilyPointer any_of(std::vector<FamilyPointer> all) {
  return all.size() == 1 ? all.front() : std::make_shared<AnyOf>(std::move(all));
}

}  // namespace vericone::pairs
