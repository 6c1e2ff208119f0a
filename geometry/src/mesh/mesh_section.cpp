// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/mesh/mesh_section.h>
#include <vericone/internal/geometry/requires.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Edge = std::uint64_t;  // its corners, the lesser one above

constexpr std::uint32_t kNoEdge = std::numeric_limits<std::uint32_t>::max();

Edge edge(std::uint32_t i, std::uint32_t j) { return Edge(std::min(i, j)) << 32 | std::max(i, j); }

class Plane {
 public:
  explicit Plane(const PlaneFrame& frame) : frame_(frame), normal_(frame.normal()) {}

  /// n.(x - origin), its sign exact: 0 exactly in the plane.
  double height(const Vector3d& x) const {
    const Vector3d d = x - frame_.origin;
    const double value = normal_.dot(d), size = normal_.cwiseAbs().dot(d.cwiseAbs());
    // Difference, product, two sums: four roundings. The constant covers products that underflow.
    if (std::abs(value) > 4.1 * 0x1p-53 * size + 1e-290) return value;
    const auto n = exact::direction_on_grid<3>(normal_);
    const auto v = exact::difference_on_grid<3>(x, frame_.origin);
    const exact::Integer exact = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    if (exact == 0) return 0;
    return std::copysign(std::max(std::abs(value), std::numeric_limits<double>::min()), exact > 0 ? 1 : -1);
  }

  Vector2d coordinates(const Vector3d& x) const { return frame_.direction_to_plane(x - frame_.origin); }

 private:
  const PlaneFrame& frame_;
  Vector3d normal_;
};

/// A cut triangle: from the edge along which its border goes down to the one along which it goes up.
struct Segment {
  std::array<Edge, 2> ends;
  std::uint32_t triangle = 0;
};

/// Segments joined over their edges.
class Chains {
 public:
  explicit Chains(std::vector<Segment> segments) : segments_(std::move(segments)) {
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
      for (const std::uint32_t end : {0U, 1U}) ends_.push_back({segments_[s].ends[end], s, end});
    std::sort(ends_.begin(), ends_.end(), [](const End& x, const End& y) {
      return x.at != y.at ? x.at < y.at : x.segment != y.segment ? x.segment < y.segment : x.end < y.end;
    });
    used_.assign(segments_.size(), false);
  }

  struct Chain {
    std::vector<Edge> nodes;
    std::vector<std::uint32_t> triangles;
  };

  std::vector<Chain> all() {
    std::vector<Chain> chains;
    // First what begins somewhere: edges with an odd number of cut triangles.
    for (std::size_t i = 0, next = 0; i < ends_.size(); i = next) {
      for (next = i; next < ends_.size() && ends_[next].at == ends_[i].at;) ++next;
      if ((next - i) % 2 == 1 && unused(ends_[i].at, 0) != kNoEdge) chains.push_back(walk(ends_[i].at));
    }
    for (std::uint32_t s = 0; s < segments_.size(); ++s)
      if (!used_[s]) chains.push_back(walk(segments_[s].ends[0]));
    return chains;
  }

 private:
  struct End {
    Edge at;
    std::uint32_t segment, end;
  };

  /// Index in ends_ of an unused segment at an edge, preferably one that has its end number `end` there.
  std::uint32_t unused(Edge at, std::uint32_t end) const {
    auto e = std::lower_bound(ends_.begin(), ends_.end(), at, [](const End& x, Edge y) { return x.at < y; });
    std::uint32_t other = kNoEdge;
    for (; e != ends_.end() && e->at == at; ++e) {
      if (used_[e->segment]) continue;
      other = static_cast<std::uint32_t>(e - ends_.begin());
      if (e->end == end) return other;
    }
    return other;
  }

  Chain walk(Edge from) {
    Chain chain{{from}, {}};
    bool reversed = false;
    for (std::uint32_t e = unused(from, 0); e != kNoEdge; e = unused(chain.nodes.back(), reversed ? 1 : 0)) {
      const End& end = ends_[e];
      if (chain.triangles.empty()) reversed = end.end == 1;
      used_[end.segment] = true;
      chain.triangles.push_back(segments_[end.segment].triangle);
      chain.nodes.push_back(segments_[end.segment].ends[1 - end.end]);
    }
    if (reversed) {
      std::reverse(chain.nodes.begin(), chain.nodes.end());
      std::reverse(chain.triangles.begin(), chain.triangles.end());
    }
    return chain;
  }

  std::vector<Segment> segments_;
  std::vector<End> ends_;  // by edge
  std::vector<bool> used_;
};

}  // namespace

std::vector<SectionLine> mesh_section(std::span<const Vector3d> points,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      const PlaneFrame& plane_frame) {
  VERICONE_REQUIRES(std::ranges::all_of(points, [](const Vector3d& x) { return x.allFinite(); }));
  VERICONE_REQUIRES(std::ranges::all_of(triangles, [&](const auto& t) {
    return std::max({t[0], t[1], t[2]}) < points.size();
  }));
  const Plane plane(plane_frame);
  std::vector<double> heights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) heights[i] = plane.height(points[i]);
  const auto above = [&](std::uint32_t i) { return heights[i] >= 0; };

  std::vector<Segment> segments;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& c = triangles[t];
    if (above(c[0]) == above(c[1]) && above(c[1]) == above(c[2])) continue;
    Segment segment{{}, t};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t i = c[k], j = c[(k + 1) % 3];
      if (above(i) != above(j)) segment.ends[above(j) ? 1 : 0] = edge(i, j);
    }
    segments.push_back(segment);
  }

  // The same for both triangles of an edge.
  const auto crossing = [&](Edge e) -> Vector2d {
    const auto i = static_cast<std::uint32_t>(e >> 32), j = static_cast<std::uint32_t>(e);
    const double part = heights[i] / (heights[i] - heights[j]);
    const Vector2d p = plane.coordinates(points[i]), q = plane.coordinates(points[j]);
    if (part == 0) return p;
    return part == 1 ? q : Vector2d(p + part * (q - p));
  };
  std::vector<SectionLine> lines;
  for (const Chains::Chain& chain : Chains(std::move(segments)).all()) {
    SectionLine line;
    line.closed = chain.nodes.front() == chain.nodes.back();
    line.points.push_back(crossing(chain.nodes.front()));
    for (std::size_t i = 0; i < chain.triangles.size(); ++i) {
      const Vector2d next = crossing(chain.nodes[i + 1]);
      if (next == line.points.back()) continue;
      line.points.push_back(next);
      line.triangles.push_back(chain.triangles[i]);
    }
    if (line.closed && line.points.size() > 1) line.points.pop_back();  // the first again
    lines.push_back(std::move(line));
  }
  return lines;
}

double signed_area(const SectionLine& line) {
  double twice = 0;
  const auto& p = line.points;
  // About the first point, for sections far from the plane's origin.
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Vector2d a = p[i] - p[0], b = p[i + 1] - p[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

}  // namespace vericone
