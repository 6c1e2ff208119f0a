// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/map/cell.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>

namespace vericone {
namespace {

using Eigen::Vector3d;

/// Corners of the icosahedron are multiples of it. Each level halves: 33 levels fit a double, and 28 make the
/// edges shorter than kFinest.
constexpr double kGrid = 0x1p-20;
constexpr double kFinest = 1e-8;
/// Divided between two calls of `progress`, whatever the number of threads.
constexpr std::size_t kBatch = 4096;

constexpr int kRoots = 20;
constexpr std::array<std::array<std::uint32_t, 3>, kRoots> kFaces = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

std::array<Vector3d, 12> icosahedron() {
  const auto on_grid = [](double x) { return std::trunc(x / kGrid) * kGrid; };
  const double length = std::sqrt(std::numbers::phi + 2);
  const double p = on_grid(1 / length), q = on_grid(std::numbers::phi / length);
  return {{{-p, q, 0},
           {p, q, 0},
           {-p, -q, 0},
           {p, -q, 0},
           {0, -p, q},
           {0, p, q},
           {0, -p, -q},
           {0, p, -q},
           {q, 0, -p},
           {q, 0, p},
           {-q, 0, -p},
           {-q, 0, p}}};
}

/// Without rounding; the same for both cells at an edge.
Vector3d middle(const Vector3d& a, const Vector3d& b) { return 0.5 * (a + b); }

/// The parts of a triangle whose edges have the middles m: three at the corners, then that in the middle.
template <typename Corner>
std::array<std::array<Corner, 3>, 4> parts(const std::array<Corner, 3>& c, const std::array<Corner, 3>& m) {
  return {{{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[0], m[1], m[2]}}};
}

std::array<DirectionCell, 4> parts(const DirectionCell& c) {
  return parts<Vector3d>(c, {middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[0])});
}

double longest_edge(const DirectionCell& cell) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d &a = cell[i], &b = cell[(i + 1) % 3];
    longest = std::max(longest, std::atan2(a.cross(b - a).norm(), a.dot(b)));
  }
  return longest;
}

/// A cell of the tree; the four parts of a divided one follow each other.
struct Node {
  std::uint32_t parts = 0;  // index of the first; 0: not divided
  Certified label = Certified::undecided;
};

/// An undecided cell that is to be divided.
struct Undecided {
  DirectionCell cell;
  std::uint32_t node = 0;
  Frontier frontier;
};

/// Runs f(0) ... f(count - 1), each once, in any order; rethrows what one of them throws. Asked to stop,
/// throws Interrupted after those that are under way.
template <typename F>
void for_all(std::size_t count, int threads, const F& f) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&next, &f, count, stop = stop_of_this_thread()] {
    const StopScope scope(stop);
    for (std::size_t i = next++; i < count; i = next++) {
      checkpoint();
      f(i);
    }
  };
  std::vector<std::future<void>> others;
  for (int t = 1; t < std::min<int>(threads, static_cast<int>(count)); ++t)
    others.push_back(std::async(std::launch::async, work));
  work();
  for (auto& other : others) other.get();
}

class Divider {
 public:
  Divider(const DirectionClassifier& classifier, const ConeMapOptions& options)
      : classifier_(classifier), options_(options) {
    if (options_.threads == 0)
      options_.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }

  /// Whether the resolution was reached.
  bool run() {
    const auto corners = icosahedron();
    nodes_.resize(kRoots);
    std::vector<Undecided> level;
    const Frontier start = classifier_.start();
    for (std::uint32_t i = 0; i < kRoots; ++i) {
      const DirectionCell cell = {corners[kFaces[i][0]], corners[kFaces[i][1]], corners[kFaces[i][2]]};
      if (auto undecided = ask(cell, i, start)) level.push_back(std::move(*undecided));
      count_decided(i, cell);
    }
    while (!level.empty()) {
      std::vector<Undecided> next;
      for (std::size_t first = 0; first < level.size(); first += kBatch) {
        if (options_.progress && !options_.progress(decided_ / (4 * std::numbers::pi))) return false;
        const std::size_t affordable = (options_.most_cells - nodes_.size()) / 4;
        const std::size_t count = std::min(kBatch, level.size() - first);
        divide(level.data() + first, std::min(count, affordable), next);
        if (affordable < count) return false;
      }
      level = std::move(next);
    }
    return true;
  }

  std::vector<Node>& nodes() { return nodes_; }

 private:
  void divide(Undecided* cells, std::size_t count, std::vector<Undecided>& next) {
    const auto base = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 4 * count);
    std::vector<std::array<std::optional<Undecided>, 4>> found(count);
    for_all(count, options_.threads, [&](std::size_t i) {
      const auto four = parts(cells[i].cell);
      const std::uint32_t first = base + 4 * static_cast<std::uint32_t>(i);
      nodes_[cells[i].node].parts = first;
      for (std::uint32_t k = 0; k < 4; ++k) found[i][k] = ask(four[k], first + k, cells[i].frontier);
      Frontier().swap(cells[i].frontier);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto four = parts(cells[i].cell);
      for (std::uint32_t k = 0; k < 4; ++k) {
        count_decided(base + 4 * static_cast<std::uint32_t>(i) + k, four[k]);
        if (found[i][k]) next.push_back(std::move(*found[i][k]));
      }
    }
  }

  /// For progress().
  void count_decided(std::uint32_t node, const DirectionCell& cell) {
    if (options_.progress && nodes_[node].label != Certified::undecided) decided_ += solid_angle(cell);
  }

  /// The cell where it is to be divided.
  std::optional<Undecided> ask(const DirectionCell& cell, std::uint32_t node, const Frontier& parent) {
    Undecided result{cell, node, {}};
    nodes_[node].label = classifier_.classify(cell, parent, result.frontier);
    if (nodes_[node].label != Certified::undecided || longest_edge(cell) <= options_.resolution)
      return std::nullopt;
    result.frontier.shrink_to_fit();
    return result;
  }

  const DirectionClassifier& classifier_;
  ConeMapOptions options_;
  std::vector<Node> nodes_;
  double decided_ = 0;
};

/// Four parts of one label become one cell.
void merge(std::vector<Node>& nodes) {
  for (std::size_t i = nodes.size(); i-- > 0;) {  // parts come after their whole
    Node& node = nodes[i];
    if (node.parts == 0) continue;
    const Node* part = &nodes[node.parts];
    const bool same =
        std::all_of(part, part + 4, [&](const Node& p) { return p.parts == 0 && p.label == part->label; });
    if (same) node = *part;
  }
}

/// The leaves of the tree with corners of their own.
class Writer {
 public:
  Writer(const std::vector<Node>& nodes, ConeMap& map) : nodes_(nodes), map_(map) {}

  void write() {
    for (const Vector3d& corner : icosahedron()) {
      const auto i = static_cast<std::uint32_t>(map_.corners.size());
      map_.corners.push_back(corner);
      map_.between.push_back({i, i});
    }
    Areas sum{};
    for (std::uint32_t i = 0; i < kRoots; ++i) add(sum, write(i, kFaces[i]));
    map_.colliding = sum[static_cast<int>(Certified::in)];
    map_.safe = sum[static_cast<int>(Certified::out)];
    map_.undecided = sum[static_cast<int>(Certified::undecided)];
  }

 private:
  using Areas = std::array<double, 3>;
  static void add(Areas& sum, const Areas& more) {
    for (int k = 0; k < 3; ++k) sum[k] += more[k];
  }

  // Sums along the tree: the error grows with its depth, not with the number of cells.
  Areas write(std::uint32_t index, const std::array<std::uint32_t, 3>& corners) {
    if (++written_ % 4096 == 0) checkpoint();
    const Node& node = nodes_[index];
    Areas sum{};
    if (node.parts == 0) {
      map_.cells.push_back({corners, node.label});
      sum[static_cast<int>(node.label)] = solid_angle(map_.cell(map_.cells.size() - 1));
      return sum;
    }
    const auto four =
        parts<std::uint32_t>(corners, {middle_of(corners[0], corners[1]), middle_of(corners[1], corners[2]),
                                       middle_of(corners[2], corners[0])});
    for (std::uint32_t k = 0; k < 4; ++k) add(sum, write(node.parts + k, four[k]));
    return sum;
  }

  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [entry, fresh] = middles_.try_emplace(key, static_cast<std::uint32_t>(map_.corners.size()));
    const std::uint32_t result = entry->second;
    if (fresh) {
      map_.corners.push_back(middle(map_.corners[a], map_.corners[b]));
      map_.between.push_back({std::min(a, b), std::max(a, b)});
    } else {
      middles_.erase(entry);  // an edge has two sides
    }
    return result;
  }

  const std::vector<Node>& nodes_;
  ConeMap& map_;
  std::uint64_t written_ = 0;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

double solid_angle(const DirectionCell& cell) {
  // Van Oosterom and Strackee 1983, with differences of corners: exact for near ones.
  const auto& [a, b, c] = cell;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot((b - a).cross(c - a)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

std::size_t cell_at(const ConeMap& map, const Vector3d& direction) {
  if (map.cells.empty()) throw InputError("map.cells", "none", "those of cone_map()");
  if (!direction.allFinite() || direction.isZero(0))
    throw InputError(
        "direction",
        "[" + to_text(direction.x()) + ", " + to_text(direction.y()) + ", " + to_text(direction.z()) + "]",
        "finite and not zero");
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  const Vector3d d = direction.stableNormalized();
  for (std::size_t i = 0; i < map.cells.size() && !(most >= 0); ++i) {
    if (std::ranges::any_of(map.cells[i].corners, [&map](auto k) { return k >= map.corners.size(); }))
      throw InputError("map.cells[" + std::to_string(i) + "]", "a corner that there is not",
                       "of corners of the map, as cone_map() returns it");
    const auto [a, b, c] = map.cell(i);
    const double least = std::min({d.dot(a.cross(b - a)), d.dot(b.cross(c - b)), d.dot(c.cross(a - c))});
    if (least > most) {
      most = least;
      best = i;
    }
  }
  return best;
}

ConeMap cone_map(const DirectionClassifier& classifier, const ConeMapOptions& options) {
  if (!(options.resolution >= kFinest && options.resolution <= 2))
    throw InputError("resolution", to_text(options.resolution), "between 1e-8 and 2 (radians)");
  if (options.most_cells < kRoots || options.most_cells > 4'000'000'000)
    throw InputError("most_cells", std::to_string(options.most_cells), "between 20 and 4000000000");
  if (options.threads < 0 || options.threads > 1024)
    throw InputError("threads", std::to_string(options.threads), "between 0 and 1024");
  ConeMap map;
  Divider divider(classifier, options);
  map.complete = divider.run();
  map.asked = divider.nodes().size();
  merge(divider.nodes());
  Writer(divider.nodes(), map).write();
  return map;
}

}  // namespace vericone
