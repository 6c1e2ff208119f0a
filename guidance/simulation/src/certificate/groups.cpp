// SPDX-License-Identifier: BSD-3-Clause
//
// Groups of pieces of the two bodies, each with its planes. Of many pieces, boxes that hold some of them each
// stand for them: neighbours stand side by side in the body, so a box is of a run of them.
#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "certificate/planes.h"
#include "certificate/solid.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostGroups = 2000;
constexpr std::array<std::size_t, 2> kBoxes{4, 32};  // of a cover: tried one after the other

double extent(const Box& box) { return (box.high - box.low).sum(); }

/// Pieces first to last of a group, without last.
struct Range {
  std::size_t first, last;
  [[nodiscard]] std::size_t size() const { return last - first; }
};

Box bounds(const Solid& solid, const Group& group, Range range) {
  Box box = solid.bounds(group[range.first]);
  for (std::size_t k = range.first + 1; k < range.last; ++k) box.include(solid.bounds(group[k]));
  return box;
}

/// Where the boxes of the two parts are smallest, in the middle half.
std::array<Range, 2> halves_of(const Solid& solid, const Group& group, Range range) {
  if (!solid.rounds.empty()) {
    const std::size_t middle = range.first + range.size() / 2;
    return {Range{range.first, middle}, {middle, range.last}};
  }
  std::vector<double> before(range.size());
  Box box = solid.bounds(group[range.first]);
  for (std::size_t k = 0; k < range.size(); ++k) {
    box.include(solid.bounds(group[range.first + k]));
    before[k] = extent(box);
  }
  box = solid.bounds(group[range.last - 1]);
  std::size_t best = range.size() / 2;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = range.size() - 1; k >= std::max<std::size_t>(1, range.size() / 4); --k) {
    box.include(solid.bounds(group[range.first + k]));
    if (4 * k > 3 * range.size() && range.size() > 4) continue;
    if (const double both = before[k - 1] + extent(box); both < least) {
      least = both;
      best = k;
    }
  }
  return {Range{range.first, range.first + best}, {range.first + best, range.last}};
}

/// A number of few digits beside x by one to two units, below or above it.
double beside(double x, double unit, int sign) {
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", std::max(0, -static_cast<int>(std::lround(std::log10(unit)))),
                (sign < 0 ? std::floor(x / unit) - 1 : std::ceil(x / unit) + 1) * unit);
  return std::strtod(digits, nullptr);
}

/// A box around, of few digits: larger by far more than what faces of cells are rounded by.
Box around(const Box& box) {
  const double size = (box.high - box.low).norm(), far = box.low.norm() + box.high.norm();
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(1e-4 * size, 1e-9 * (1 + far)))));
  Box wide;
  for (int i = 0; i < 3; ++i) {
    wide.low(i) = beside(box.low(i), unit, -1);
    wide.high(i) = beside(box.high(i), unit, 1);
  }
  return wide;
}

Group all_of(const Solid& solid) {
  Group group(solid.size());
  std::iota(group.begin(), group.end(), 0);
  return group;
}

/// What stands for a group of a body's pieces: itself, or boxes that hold runs of it.
class Stand {
 public:
  Stand(const Solid& solid, const StatedTrack& track, const Group& group, std::size_t boxes)
      : solid_(&solid), track_(&track), group_(&group) {
    if (boxes == 0) return;
    std::vector<std::pair<double, Range>> runs;
    const auto put = [&](Range range) { runs.emplace_back(extent(bounds(solid, group, range)), range); };
    put({0, group.size()});
    while (runs.size() < std::min(boxes, group.size())) {
      const auto largest = std::max_element(runs.begin(), runs.end(), [](const auto& x, const auto& y) {
        return std::pair(x.second.size() > 1, x.first) < std::pair(y.second.size() > 1, y.first);
      });
      const auto halves = halves_of(solid, group, largest->second);
      runs.erase(largest);
      for (const Range half : halves) put(half);
    }
    std::sort(runs.begin(), runs.end(),
              [](const auto& x, const auto& y) { return x.second.first < y.second.first; });
    std::vector<Box> list;
    for (const auto& [size, range] : runs) {
      counts_.push_back(range.size());
      list.push_back(around(bounds(solid, group, range)));
    }
    boxes_ = solid_of(std::move(list));
    all_ = all_of(boxes_);
  }

  [[nodiscard]] Side side() const {
    return counts_.empty() ? Side{solid_, track_, group_} : Side{&boxes_, track_, &all_};
  }
  /// The proof of this side's own pieces, from one of what stands for them.
  [[nodiscard]] std::string proof(const char* who, std::string inner) const {
    if (counts_.empty()) return inner;
    std::string runs;
    for (std::size_t k = 0; k < counts_.size(); ++k)
      runs += (k > 0 ? ", [" : "[") + std::to_string(k) + ", " + std::to_string(counts_[k]) + "]";
    return std::string(R"({"rule": "cover", "of": ")") + who + R"(", "boxes": )" + text_of(boxes_.boxes) +
           ", \"runs\": [" + runs + "], \"proof\": " + inner + "}";
  }

 private:
  static Solid solid_of(std::vector<Box> boxes) {
    Solid solid;
    solid.kind = Solid::Kind::boxes;
    for (const Box& box : boxes) {
      std::vector<std::uint32_t> piece;
      const HullBody hull = HullBody::box(box.low, box.high);
      for (const Vector3d& x : hull.points()) {
        piece.push_back(static_cast<std::uint32_t>(solid.points.size()));
        solid.points.push_back(x);
      }
      solid.pieces.push_back(std::move(piece));
    }
    solid.boxes = std::move(boxes);
    return solid;
  }

  const Solid* solid_;
  const StatedTrack* track_;
  const Group* group_;
  std::vector<std::size_t> counts_;
  Solid boxes_;
  Group all_;
};

/// Divides groups of pieces until planes part them.
class ByGroups {
 public:
  explicit ByGroups(const PairQuestion& question) : question_(question) {}

  std::optional<std::string> prove(const Group& a, const Group& b) {
    for (const std::size_t boxes : kBoxes) {
      const bool covers_a = is_many(question_.a, a), covers_b = is_many(question_.b, b);
      const Stand of_a(question_.a, question_.track_a, a, covers_a ? boxes : 0),
          of_b(question_.b, question_.track_b, b, covers_b ? boxes : 0);
      if (auto proof = by_planes(of_a, of_b)) return proof;
      if (!covers_a && !covers_b) break;
    }
    if ((a.size() == 1 && b.size() == 1) || ++groups_ > kMostGroups) return std::nullopt;
    const bool agent = a.size() > b.size();
    const Group& whole = agent ? a : b;
    const auto halves = halves_of(agent ? question_.a : question_.b, whole, {0, whole.size()});
    std::array<std::string, 2> proofs;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto at = [&](std::size_t k) { return whole.begin() + static_cast<std::ptrdiff_t>(k); };
      const Group half(at(halves[i].first), at(halves[i].last));
      auto proof = agent ? prove(half, b) : prove(a, half);
      if (!proof) return std::nullopt;
      proofs[i] = std::move(*proof);
    }
    return std::string(R"({"rule": "groups", "of": ")") + (agent ? "agent" : "obstacle") +
           "\", \"proofs\": [" + proofs[0] + ", " + proofs[1] + "], \"runs\": [[0, " +
           std::to_string(halves[0].size()) + "], [1, " + std::to_string(halves[1].size()) + "]]}";
  }

  [[nodiscard]] double stuck() const { return stuck_; }
  [[nodiscard]] bool too_many() const { return groups_ > kMostGroups; }

 private:
  /// Boxes stand for them; those of which only the boxes are known have no other way.
  static bool is_many(const Solid& solid, const Group& group) {
    return solid.cornered() && (group.size() > kManyPieces || solid.pieces.empty());
  }

  std::optional<std::string> by_planes(const Stand& a, const Stand& b) {
    const double by = question_.by, from = question_.from, to = question_.to;
    const auto pieces = planes_between(a.side(), b.side(), by, from, to, stuck_);
    if (!pieces || !proves(a.side(), b.side(), by, from, to, *pieces)) return std::nullopt;
    return a.proof("agent", b.proof("obstacle", text_of(*pieces)));
  }

  const PairQuestion& question_;
  std::size_t groups_ = 0;
  double stuck_ = 0;
};

}  // namespace

std::optional<std::string> proof_of_pair(const PairQuestion& question, std::string& reason) {
  ByGroups groups(question);
  auto proof = groups.prove(all_of(question.a), all_of(question.b));
  if (!proof)
    reason = groups.too_many() ? "it takes more than " + std::to_string(kMostGroups) + " groups of pieces"
                               : "no plane is found from " + to_text(groups.stuck()) + " s on" +
                                     (question.dents ? "; planes do not reach into dents" : "");
  return proof;
}

std::optional<std::string> proof_by_times(const PairQuestion& question, const std::vector<double>& cuts,
                                          std::string& reason) {
  std::vector<double> ends{question.from};
  for (const double t : cuts)
    if (t > ends.back() && t < question.to) ends.push_back(t);
  ends.push_back(question.to);
  std::string times, proofs;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    PairQuestion part = question;
    part.from = ends[k];
    part.to = ends[k + 1];
    const auto proof = proof_of_pair(part, reason);
    if (!proof) return std::nullopt;
    if (k > 0) times.append(k > 1 ? ", " : "").append(text_of(part.from));
    proofs.append(k > 0 ? ", " : "").append(*proof);
  }
  if (ends.size() == 2) return proofs;
  return R"({"rule": "times", "cuts": [)" + times + "], \"proofs\": [" + proofs + "]}";
}

}  // namespace vericone::simulation::certified
