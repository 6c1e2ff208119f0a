// SPDX-License-Identifier: BSD-3-Clause
//
// The search for planes, in doubles; what it finds counts only once `separates` has said so in integers.
#include "certificate/planes.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "certificate/tube.h"
#include "proof/least_point.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Vector3d;

constexpr int kSamples = 9;                 // of a piece of time
constexpr double kNormalUnits = 16384;      // of a normal, which is written as whole numbers
constexpr double kShortestPiece = 0x1p-13;  // s

/// Where a side's body is at a time, and its support there.
class Posed {
 public:
  Posed(const Side& side, std::size_t segment, double t)
      : side_(&side), placement_(placement(*side.track, segment, t)) {}

  [[nodiscard]] const Vector3d& position() const { return placement_.position; }
  /// The largest n.R b of the points b of the body.
  [[nodiscard]] double support(const Vector3d& n) const {
    const Vector3d m = placement_.rotation.transpose() * n;
    return m.dot(farthest(m));
  }
  [[nodiscard]] Vector3d support_point(const Vector3d& n) const {
    return placement_.position + placement_.rotation * farthest(placement_.rotation.transpose() * n);
  }
  /// The only piece, where it is round.
  [[nodiscard]] std::optional<Ellipsoid> ellipsoid() const {
    const Solid& solid = *side_->solid;
    if (solid.rounds.empty() || side_->group->size() != 1) return std::nullopt;
    return in_world(solid.rounds[side_->group->front()].ellipsoid(),
                    Pose{placement_.position, placement_.rotation});
  }

 private:
  [[nodiscard]] Vector3d farthest(const Vector3d& n) const {
    const Solid& solid = *side_->solid;
    Vector3d best = Vector3d::Zero();
    double most = -std::numeric_limits<double>::infinity();
    const auto consider = [&](const Vector3d& x) {
      if (const double value = n.dot(x); value > most) {
        most = value;
        best = x;
      }
    };
    for (const std::uint32_t piece : *side_->group) {
      if (!solid.convexes.empty()) {
        consider(solid.convexes[piece].support_point(n));
        continue;
      }
      if (solid.rounds.empty()) {
        for (const std::uint32_t i : solid.pieces[piece]) consider(solid.points[i]);
        continue;
      }
      const Ellipsoid& body = solid.rounds[piece].ellipsoid();
      const Vector3d along = body.shape() * n;
      const double rho = std::sqrt(std::max(0.0, n.dot(along)));
      consider(rho > 0 ? Vector3d(body.center() + along / rho) : body.center());
    }
    if (solid.radius > 0) best += solid.radius * n.normalized();
    return best;
  }

  const Side* side_;
  Placement placement_;
};

/// Both bodies at times of a piece.
class Samples {
 public:
  Samples(const Side& a, const Side& b, double from, double to) {
    const std::size_t of_a = a.track->segment_of(from, to), of_b = b.track->segment_of(from, to);
    for (int i = 0; i < kSamples; ++i) {
      const double t = from + (to - from) * i / (kSamples - 1);
      a_.emplace_back(a, of_a, t);
      b_.emplace_back(b, of_b, t);
    }
  }

  /// Normals that may part the bodies, unit, from A to B.
  [[nodiscard]] std::vector<Vector3d> normals(const std::optional<Vector3d>& previous) const {
    std::vector<Vector3d> found;
    if (previous) found.push_back(*previous);
    const Posed &a = a_[kSamples / 2], &b = b_[kSamples / 2];
    const Vector3d w = between(0) - between(kSamples - 1);
    const auto with_across = [&](const Vector3d& n) {
      if (n.isZero(0)) return;
      found.push_back(n.normalized());
      if (w.squaredNorm() == 0) return;
      const Vector3d across = n - n.dot(w) / w.squaredNorm() * w;
      if (across.norm() > 1e-9 * n.norm()) found.push_back(across.normalized());
    };
    const std::optional<Ellipsoid> one = a.ellipsoid(), other = b.ellipsoid();
    if (one && other) {
      with_across(separation(*one, *other).normal);
      if (w.squaredNorm() > 0) with_across(clearance(*one, *other, w).normal);
    } else {
      const auto farthest = [&](const Vector3d& d) -> Vector3d {
        return b.support_point(d) - a.support_point(-d);
      };
      with_across(least_point(farthest, b.position() - a.position()));
    }
    return found;
  }

  /// n.(B - A) between the bodies, at a sample.
  [[nodiscard]] double gap(const Vector3d& n, int i) const {
    return n.dot(between(i)) - a_[i].support(n) - b_[i].support(-n);
  }
  [[nodiscard]] double least_gap(const Vector3d& n) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSamples; i += 2) least = std::min(least, gap(n, i));
    return least;
  }
  [[nodiscard]] Vector3d between(int i) const { return b_[i].position() - a_[i].position(); }
  [[nodiscard]] const std::vector<Posed>& a() const { return a_; }
  [[nodiscard]] const std::vector<Posed>& b() const { return b_; }

 private:
  std::vector<Posed> a_, b_;
};

using Line = std::array<double, 2>;
double at_sample(const Line& line, int i) { return line[0] + (line[1] - line[0]) * i / (kSamples - 1); }

/// The chord of a support, raised until no sample is above it.
Line line_above(const std::vector<Posed>& body, const Vector3d& n) {
  Line line{body.front().support(n), body.back().support(n)};
  double rise = 0;
  for (int i = 1; i + 1 < kSamples; ++i)
    rise = std::max(rise, body[static_cast<std::size_t>(i)].support(n) - at_sample(line, i));
  for (double& x : line) x += rise;
  return line;
}

/// Few digits, not below x, by no more than about `spare`.
double few_digits_above(double x, double spare) {
  const double unit = std::pow(10.0, std::floor(std::log10(spare)));
  const double units = std::ceil(x / unit);
  if (!(std::abs(units) < 1e15) || !(unit > 0)) return x + spare;
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", std::max(0, -static_cast<int>(std::lround(std::log10(unit)))),
                units * unit);
  return std::strtod(digits, nullptr);
}

/// A plane with this normal; nothing where the samples leave no room.
std::optional<StatedPlane> plane_along(const Samples& samples, const Vector3d& unit, double needed) {
  StatedPlane plane{};
  Vector3d n;
  for (int i = 0; i < 3; ++i) {
    plane.normal[static_cast<std::size_t>(i)] = std::llround(kNormalUnits * unit(i));
    n(i) = static_cast<double>(plane.normal[static_cast<std::size_t>(i)]);
  }
  plane.length = static_cast<std::int64_t>(std::floor(n.norm())) + 1;
  const Line a = line_above(samples.a(), n), b = line_above(samples.b(), -n);
  double room = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSamples; ++i)
    room = std::min(room, n.dot(samples.between(i)) - at_sample(a, i) - at_sample(b, i));
  room -= needed * static_cast<double>(plane.length);
  if (!(room > 0)) return std::nullopt;
  const double spare = 0.2 * room;
  for (std::size_t i = 0; i < 2; ++i) {
    plane.most_a[i] = few_digits_above(a[i] + spare, spare);
    plane.most_b[i] = few_digits_above(b[i] + spare, spare);
  }
  return plane;
}

/// A body with delimiters within another ellipsoid, that multipliers give.
class Narrowed {
 public:
  /// The one that reaches least along n, in the body's own axes, of few digits; the body's own where it has
  /// no delimiter.
  Narrowed(const Side& side, const Vector3d& n) {
    if (side.group->size() != 1 || side.solid->rounds.empty()) return;
    const CombinedEllipsoid& body = side.solid->rounds[side.group->front()];
    if (body.is_ellipsoid()) return;
    multipliers_.assign(body.delimiters().size() + 1, 0);
    multipliers_[0] = 1;
    double least = reach(body, n);
    for (int round = 0; round < 2; ++round)
      for (std::size_t k = 1; k < multipliers_.size(); ++k) {
        const double own = multipliers_[k];
        double best = own;
        for (int step = -24; step <= 24; ++step) {
          multipliers_[k] = std::ldexp(1.0 + 0.25 * (step & 3), step >> 2);
          if (const double now = reach(body, n); now < least) {
            least = now;
            best = multipliers_[k];
          }
        }
        multipliers_[k] = best;
      }
    solid_.rounds = {CombinedEllipsoid(Ellipsoid::from_shape(body.ellipsoid().center(), shape(body)))};
    narrowed_ = true;
  }

  [[nodiscard]] bool is_narrowed() const { return narrowed_; }
  [[nodiscard]] const std::vector<double>& multipliers() const { return multipliers_; }
  [[nodiscard]] Side side(const Side& own) const {
    return narrowed_ ? Side{&solid_, own.track, &group_} : own;
  }

 private:
  /// L Q^-1.
  [[nodiscard]] Eigen::Matrix3d shape(const CombinedEllipsoid& body) const {
    Eigen::Matrix3d q = multipliers_[0] * body.ellipsoid().shape().inverse();
    double level = multipliers_[0];
    for (std::size_t k = 1; k < multipliers_.size(); ++k) {
      q += multipliers_[k] * body.delimiters()[k - 1].matrix;
      level += multipliers_[k] * body.delimiters()[k - 1].level;
    }
    const Eigen::Matrix3d s = level * q.inverse();
    return 0.5 * (s + s.transpose());
  }
  [[nodiscard]] double reach(const CombinedEllipsoid& body, const Vector3d& n) const {
    const Eigen::Matrix3d s = shape(body);
    const bool definite = s.allFinite() && Eigen::LLT<Eigen::Matrix3d>(s).info() == Eigen::Success;
    return definite ? std::sqrt(n.dot(s * n)) : std::numeric_limits<double>::infinity();
  }

  Solid solid_;
  Group group_{0};
  std::vector<double> multipliers_;
  bool narrowed_ = false;
};

class Search {
 public:
  Search(const Side& a, const Side& b, double by)
      : a_(a), b_(b), by_(by), needed_(by + a.track->radius + b.track->radius) {}

  bool run(double from, double to) {
    std::vector<double> times{from, to};
    for (const StatedTrack* track : {a_.track, b_.track})
      for (const double t : track->times)
        if (t > from && t < to) times.push_back(t);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    found_.times.push_back(from);
    for (std::size_t k = 0; k + 1 < times.size(); ++k)
      if (!piece(times[k], times[k + 1])) return false;
    return true;
  }

  StatedPieces found_;
  double stuck_ = 0;

 private:
  bool piece(double from, double to) {
    checkpoint();
    bool there = false;
    if (part(Samples(a_, b_, from, to), {}, from, to, there) || part_narrowed(from, to, there)) return true;
    stuck_ = from;
    // No plane in the middle either: no piece is short enough.
    if (!there || to - from < kShortestPiece) return false;
    const double middle = middle_of(from, to);
    return piece(from, middle) && piece(middle, to);
  }

  /// `there`: set if one is found in the middle at least.
  bool part(const Samples& samples, const std::array<std::vector<double>, 2>& multipliers, double from,
            double to, bool& there) {
    const std::vector<Vector3d> normals = samples.normals(previous_);
    const auto better = [&](const Vector3d& x, const Vector3d& y) {
      return samples.least_gap(x) < samples.least_gap(y);
    };
    if (normals.empty()) return false;
    const Vector3d& best = *std::max_element(normals.begin(), normals.end(), better);
    if (auto plane = plane_along(samples, best, needed_)) {
      plane->multipliers = multipliers;
      if (separates(a_, b_, by_, from, to, *plane)) {
        previous_ = best;
        found_.times.push_back(to);
        found_.planes.push_back(std::move(*plane));
        return true;
      }
    }
    there = there || std::any_of(normals.begin(), normals.end(),
                                 [&](const Vector3d& n) { return samples.gap(n, kSamples / 2) > needed_; });
    return false;
  }

  /// With bodies that have delimiters in narrower ellipsoids, for the normal of the nearest points of their
  /// hulls in the middle.
  bool part_narrowed(double from, double to, bool& there) {
    if (!Narrowed(a_, Vector3d::UnitX()).is_narrowed() && !Narrowed(b_, Vector3d::UnitX()).is_narrowed())
      return false;
    const double middle = 0.5 * (from + to);
    const auto narrowed = [&](const Side& side, const Vector3d& n) {
      const Placement at = placement(*side.track, side.track->segment_of(from, to), middle);
      return Narrowed(side, at.rotation.transpose() * n);
    };
    const auto farthest_of = [&](const Side& side, const Vector3d& n) -> Vector3d {
      const Narrowed body = narrowed(side, n);
      return Posed(body.side(side), side.track->segment_of(from, to), middle).support_point(n);
    };
    const auto farthest = [&](const Vector3d& d) -> Vector3d {
      return farthest_of(b_, d) - farthest_of(a_, -d);
    };
    const Samples samples(a_, b_, from, to);
    const Vector3d nearest = least_point(farthest, samples.between(kSamples / 2));
    if (nearest.isZero(0)) return false;
    const Vector3d n = nearest.normalized();
    const Narrowed a = narrowed(a_, n), b = narrowed(b_, -n);
    const Side of_a = a.side(a_), of_b = b.side(b_);
    previous_ = n;
    return part(Samples(of_a, of_b, from, to), {a.multipliers(), b.multipliers()}, from, to, there);
  }

  /// A time of few digits about the middle.
  static double middle_of(double from, double to) {
    const double unit = std::exp2(std::floor(std::log2(to - from)) - 1);
    const double middle = std::round(0.5 * (from + to) / unit) * unit;
    return middle > from && middle < to ? middle : 0.5 * (from + to);
  }

  const Side &a_, &b_;
  double by_, needed_;
  std::optional<Vector3d> previous_;
};

}  // namespace

double reach_at(const Side& side, double t, const Vector3d& n) {
  const Posed body(side, std::min(side.track->segment_of(t, t), side.track->segments.size() - 1), t);
  return n.dot(body.position()) + body.support(n);
}

std::optional<StatedPieces> planes_between(const Side& a, const Side& b, double by, double from, double to,
                                           double& stuck) {
  Search search(a, b, by);
  if (search.run(from, to)) return std::move(search.found_);
  stuck = search.stuck_;
  return std::nullopt;
}

}  // namespace vericone::simulation::certified
