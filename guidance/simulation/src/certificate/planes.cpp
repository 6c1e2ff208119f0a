// SPDX-License-Identifier: BSD-3-Clause
//
// The search for planes, in doubles; what it finds counts only once `separates` has said so in integers.
#include "certificate/planes.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
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
constexpr std::size_t kMostGroups = 2000;

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
    if (side_->cover) {
      for (const Vector3d& x : *side_->cover) consider(x);
      if (solid.radius > 0) best += solid.radius * n.normalized();
      return best;
    }
    for (const std::uint32_t piece : *side_->group) {
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
    const Samples samples(a_, b_, from, to);
    const std::vector<Vector3d> normals = samples.normals(previous_);
    const auto better = [&](const Vector3d& x, const Vector3d& y) {
      return samples.least_gap(x) < samples.least_gap(y);
    };
    if (!normals.empty()) {
      const Vector3d& best = *std::max_element(normals.begin(), normals.end(), better);
      if (const auto plane = plane_along(samples, best, needed_);
          plane && separates(a_, b_, by_, from, to, *plane)) {
        previous_ = best;
        found_.times.push_back(to);
        found_.planes.push_back(*plane);
        return true;
      }
    }
    stuck_ = from;
    const auto there = [&](const Vector3d& n) { return samples.gap(n, kSamples / 2) > needed_; };
    // No plane in the middle either: no piece is short enough.
    if (std::none_of(normals.begin(), normals.end(), there) || to - from < kShortestPiece) return false;
    const double middle = middle_of(from, to);
    return piece(from, middle) && piece(middle, to);
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

Vector3d middle_of_piece(const Solid& solid, std::uint32_t piece) {
  if (!solid.rounds.empty()) return solid.rounds[piece].ellipsoid().center();
  Vector3d sum = Vector3d::Zero();
  for (const std::uint32_t i : solid.pieces[piece]) sum += solid.points[i];
  return sum / static_cast<double>(solid.pieces[piece].size());
}

/// Two halves, along the widest extent of the pieces' middles.
std::array<Group, 2> halves_of(const Solid& solid, const Group& group) {
  Vector3d low = middle_of_piece(solid, group.front()), high = low;
  for (const std::uint32_t piece : group) {
    low = low.cwiseMin(middle_of_piece(solid, piece));
    high = high.cwiseMax(middle_of_piece(solid, piece));
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  Group sorted = group;
  const auto half = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), half, sorted.end(), [&](std::uint32_t x, std::uint32_t y) {
    return middle_of_piece(solid, x)(axis) < middle_of_piece(solid, y)(axis);
  });
  std::array<Group, 2> halves{Group(sorted.begin(), half), Group(half, sorted.end())};
  for (Group& one : halves) std::sort(one.begin(), one.end());
  return halves;
}

/// Of many pieces, the corners of boxes that hold some of them each; of few, nothing.
std::optional<std::vector<Vector3d>> cover_of(const Solid& solid, const Group& group) {
  constexpr std::size_t kMany = 256, kBoxes = 128;
  if (group.size() <= kMany || !solid.rounds.empty()) return std::nullopt;
  std::vector<Group> parts{group};
  while (parts.size() < kBoxes) {
    std::vector<Group> finer;
    for (const Group& part : parts)
      for (Group& half : halves_of(solid, part)) finer.push_back(std::move(half));
    parts = std::move(finer);
  }
  std::vector<Vector3d> corners;
  for (const Group& part : parts) {
    Box box{solid.points[solid.pieces[part.front()].front()],
            solid.points[solid.pieces[part.front()].front()]};
    for (const std::uint32_t piece : part)
      for (const std::uint32_t i : solid.pieces[piece]) box.include({solid.points[i], solid.points[i]});
    const HullBody hull = HullBody::box(box.low, box.high);
    corners.insert(corners.end(), hull.points().begin(), hull.points().end());
  }
  return corners;
}

/// Divides groups of pieces until planes part them.
class ByGroups {
 public:
  explicit ByGroups(const PairQuestion& question) : question_(question) {}

  std::optional<std::string> prove(const Group& a, const Group& b) {
    const auto cover_a = cover_of(question_.a, a), cover_b = cover_of(question_.b, b);
    const Side of_a{&question_.a, &question_.track_a, &a, cover_a ? &*cover_a : nullptr},
        of_b{&question_.b, &question_.track_b, &b, cover_b ? &*cover_b : nullptr};
    if (const auto pieces = planes_between(of_a, of_b, question_.by, question_.from, question_.to, stuck_)) {
      if (!proves(of_a, of_b, question_.by, question_.from, question_.to, *pieces)) return std::nullopt;
      return text_of(*pieces);
    }
    if ((a.size() == 1 && b.size() == 1) || ++groups_ > kMostGroups) return std::nullopt;
    const bool agent = a.size() > b.size();
    const auto halves = halves_of(agent ? question_.a : question_.b, agent ? a : b);
    std::array<std::string, 2> proofs;
    for (std::size_t i = 0; i < 2; ++i) {
      auto proof = agent ? prove(halves[i], b) : prove(a, halves[i]);
      if (!proof) return std::nullopt;
      proofs[i] = std::move(*proof);
    }
    return std::string(R"({"rule": "groups", "of": ")") + (agent ? "agent" : "obstacle") +
           "\", \"proofs\": [" + proofs[0] + ", " + proofs[1] + "], \"runs\": [" +
           runs(agent ? a : b, halves[0]) + "]}";
  }

  [[nodiscard]] double stuck() const { return stuck_; }
  [[nodiscard]] bool too_many() const { return groups_ > kMostGroups; }

 private:
  static std::string runs(const Group& whole, const Group& first) {
    std::string text;
    std::size_t count = 0;
    int last = -1;
    const auto end = [&] {
      if (count > 0)
        text += (text.empty() ? "[" : ", [") + std::to_string(last) + ", " + std::to_string(count) + "]";
    };
    for (const std::uint32_t piece : whole) {
      const int k = std::binary_search(first.begin(), first.end(), piece) ? 0 : 1;
      if (k != last) {
        end();
        last = k;
        count = 0;
      }
      ++count;
    }
    end();
    return text;
  }

  const PairQuestion& question_;
  std::size_t groups_ = 0;
  double stuck_ = 0;
};

Group all_of(const Solid& solid) {
  Group group(solid.size());
  std::iota(group.begin(), group.end(), 0);
  return group;
}

}  // namespace

std::optional<StatedPieces> planes_between(const Side& a, const Side& b, double by, double from, double to,
                                           double& stuck) {
  Search search(a, b, by);
  if (search.run(from, to)) return std::move(search.found_);
  stuck = search.stuck_;
  return std::nullopt;
}

std::optional<std::string> proof_of_pair(const PairQuestion& question, std::string& reason) {
  ByGroups groups(question);
  auto proof = groups.prove(all_of(question.a), all_of(question.b));
  if (!proof)
    reason = groups.too_many()
                 ? "it takes more than " + std::to_string(kMostGroups) + " groups of pieces"
                 : "no plane is found from " + to_text(groups.stuck()) + " s on" +
                       (question.dents ? ", where a body with dents counts as its ellipsoid" : "");
  return proof;
}

}  // namespace vericone::simulation::certified
