// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/outline.h>
#include <algorithm>
#include <cmath>
#include <map>

namespace vericone::files {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using Ring = std::vector<Vector2d>;
using outlines::meet, outlines::turn;

std::size_t after(std::size_t i, std::size_t count) { return i + 1 < count ? i + 1 : 0; }
std::size_t before(std::size_t i, std::size_t count) { return i > 0 ? i - 1 : count - 1; }

/// Whether b and c lie in the same direction from a.
bool same_way(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  if (turn(a, b, c) != 0) return false;
  for (int k = 0; k < 2; ++k)
    if (a(k) != b(k) && a(k) != c(k)) return (a(k) < b(k)) == (a(k) < c(k));
  return true;  // one of them is a
}

/// Of a point that is on no edge.
bool inside(const Ring& ring, const Vector2d& x) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &a = ring[i], &b = ring[after(i, ring.size())];
    if ((a.y() > x.y()) != (b.y() > x.y()) && (turn(a, b, x) > 0) == (b.y() > a.y())) odd = !odd;
  }
  return odd;
}

std::string of(const std::string& name, std::size_t i) { return name + "[" + std::to_string(i) + "]"; }

void require_ring(const Ring& ring, const std::string& name) {
  if (ring.size() < 3)
    throw InputError(name, std::to_string(ring.size()) + " corners", "three corners or more");
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!ring[i].allFinite()) throw InputError(of(name, i), "not finite", "two finite numbers (metres)");
  outlines::require_simple(ring, name);
}

void require_apart(const Ring& hole, const std::string& name, const Ring& other, const std::string& what) {
  for (std::size_t i = 0; i < hole.size(); ++i)
    for (std::size_t j = 0; j < other.size(); ++j)
      if (meet(hole[i], hole[after(i, hole.size())], other[j], other[after(j, other.size())]))
        throw InputError(of(name, i), "an edge that meets " + what,
                         "a hole apart from the outline and from the others");
}

void require_sound(const Polygon& polygon) {
  require_ring(polygon.outline, "outline");
  const auto& holes = polygon.holes;
  for (std::size_t h = 0; h < holes.size(); ++h) require_ring(holes[h], of("holes", h));
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const std::string name = of("holes", h);
    require_apart(holes[h], name, polygon.outline, "the outline");
    for (std::size_t k = 0; k < h; ++k) require_apart(holes[h], name, holes[k], of("holes", k));
    if (!inside(polygon.outline, holes[h].front()))
      throw InputError(name, "beyond the outline", "a hole within the outline");
    for (std::size_t k = 0; k < holes.size(); ++k)
      if (k != h && inside(holes[k], holes[h].front()))
        throw InputError(name, "within " + of("holes", k), "a hole within no other");
  }
}

bool is_counter_clockwise(const Ring& ring) {
  const std::size_t i = outlines::leftmost(ring);
  return turn(ring[before(i, ring.size())], ring[i], ring[after(i, ring.size())]) > 0;
}

/// Outline and holes as one outline that goes to each hole and back by a bridge.
class Joined {
 public:
  explicit Joined(const Polygon& polygon) {
    ring_ = added(polygon.outline, true);
    for (const Ring& hole : polygon.holes) holes_.push_back(added(hole, false));
    while (!holes_.empty())
      if (!join(true) && !join(false))
        throw InputError("holes", "no bridge to a hole", "holes within the outline");
  }

  const std::vector<Vector2d>& points() const { return points_; }
  const Face& ring() const { return ring_; }

 private:
  Face added(const Ring& ring, bool counter_clockwise) {
    Face face;
    for (const Vector2d& x : ring) {
      face.push_back(std::uint32_t(points_.size()));
      points_.push_back(x);
    }
    if (is_counter_clockwise(ring) != counter_clockwise) std::reverse(face.begin(), face.end());
    return face;
  }

  int turn_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return turn(points_[a], points_[b], points_[c]);
  }

  /// Whether x is seen from the corner number v into the polygon; `strict`: not along one of its edges.
  bool faces(std::size_t v, std::uint32_t x, bool strict) const {
    const std::uint32_t a = ring_[before(v, ring_.size())], u = ring_[v], b = ring_[after(v, ring_.size())];
    const int left = turn_of(a, u, x), right = turn_of(u, b, x);
    if (strict && (left == 0 || right == 0)) return false;
    return turn_of(a, u, b) > 0 ? left > 0 && right > 0 : left > 0 || right > 0;
  }

  bool blocks(const Face& face, std::uint32_t u, std::uint32_t m) const {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t a = face[i], b = face[after(i, face.size())];
      const std::uint32_t shared = a == u || b == u ? u : a == m || b == m ? m : kNone;
      if (shared == kNone) {
        if (meet(points_[u], points_[m], points_[a], points_[b])) return true;
      } else if (same_way(points_[shared], points_[shared == u ? m : u], points_[a == shared ? b : a])) {
        return true;
      }
    }
    return false;
  }

  bool sees(std::uint32_t u, std::uint32_t m) const {
    return !blocks(ring_, u, m) &&
           std::none_of(holes_.begin(), holes_.end(), [&](const Face& hole) { return blocks(hole, u, m); });
  }

  bool join(bool strict) {
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      Face& hole = holes_[h];
      for (std::size_t k = 0; k < hole.size(); ++k)
        for (std::size_t v = 0; v < ring_.size(); ++v)
          if (faces(v, hole[k], strict) && sees(ring_[v], hole[k])) {
            std::rotate(hole.begin(), hole.begin() + std::ptrdiff_t(k), hole.end());
            hole.insert(hole.end(), {hole.front(), ring_[v]});
            ring_.insert(ring_.begin() + std::ptrdiff_t(v) + 1, hole.begin(), hole.end());
            holes_.erase(holes_.begin() + std::ptrdiff_t(h));
            return true;
          }
    }
    return false;
  }

  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  std::vector<Vector2d> points_;
  Face ring_;
  std::vector<Face> holes_;
};

/// Convex polygons, put together along common edges.
class Merged {
 public:
  Merged(const std::vector<Vector2d>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles)
      : points_(points) {
    for (const auto& t : triangles) {
      if (turn(points[t[0]], points[t[1]], points[t[2]]) == 0) continue;
      for (std::size_t k = 0; k < 3; ++k) left_of_[{t[k], t[(k + 1) % 3]}] = pieces_.size();
      owner_.push_back(pieces_.size());
      pieces_.emplace_back(t.begin(), t.end());
    }
    for (const auto& [ends, piece] : left_of_)
      if (const auto other = left_of_.find({ends.second, ends.first}); other != left_of_.end())
        if (ends.first < ends.second) put_together(find(piece), find(other->second), ends.first, ends.second);
  }

  std::vector<Ring> rings() const {
    std::vector<Ring> rings;
    for (const Face& piece : pieces_) {
      if (piece.empty()) continue;
      Ring& ring = rings.emplace_back();
      for (const std::uint32_t c : piece) ring.push_back(points_[c]);
    }
    return rings;
  }

 private:
  std::size_t find(std::size_t piece) const {
    while (owner_[piece] != piece) piece = owner_[piece];
    return piece;
  }

  /// The edge goes from a to b along p, and back along q.
  void put_together(std::size_t p, std::size_t q, std::uint32_t a, std::uint32_t b) {
    if (p == q) return;
    Face &first = pieces_[p], &second = pieces_[q];
    std::rotate(first.begin(), std::find(first.begin(), first.end(), b), first.end());      // b ... a
    std::rotate(second.begin(), std::find(second.begin(), second.end(), a), second.end());  // a ... b
    const auto way = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return turn(points_[x], points_[y], points_[z]);
    };
    if (way(first[first.size() - 2], a, second[1]) < 0 || way(second[second.size() - 2], b, first[1]) < 0)
      return;
    first.insert(first.end(), second.begin() + 1, second.end() - 1);
    second.clear();
    owner_[q] = p;
  }

  const std::vector<Vector2d>& points_;
  std::vector<Face> pieces_;
  std::vector<std::size_t> owner_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> left_of_;
};

}  // namespace

std::vector<Ring> convex_pieces(const Polygon& polygon) {
  require_sound(polygon);
  const Joined joined(polygon);
  // About 1 m large, by a power of two: the areas by which a polygon is looked at do not vanish.
  double size = 0;
  for (const Vector2d& x : joined.points()) size = std::max(size, x.cwiseAbs().maxCoeff());
  const int exponent = -std::ilogb(size);
  std::vector<Vector3d> points;
  for (const Vector2d& x : joined.points())
    points.emplace_back(std::ldexp(x.x(), exponent), std::ldexp(x.y(), exponent), 0);
  return Merged(joined.points(), triangles_of(points, {joined.ring()})).rings();
}

Body raised(const Polygon& polygon, double height) {
  if (!(std::isfinite(height) && height > 0))
    throw InputError("height", to_text(height), "a finite number > 0 (metres)");
  std::vector<HullBody> prisms;
  for (const Ring& piece : convex_pieces(polygon)) {
    std::vector<Vector3d> corners;
    for (const Vector2d& x : piece)
      corners.insert(corners.end(), {{x.x(), x.y(), -height}, {x.x(), x.y(), height}});
    prisms.emplace_back(std::move(corners));
  }
  if (prisms.size() == 1) return prisms.front();
  return Assembly::polyhedra(std::move(prisms));
}

}  // namespace vericone::files
