// SPDX-License-Identifier: BSD-3-Clause
#include "motion/meet.h"

#include <vericone/cones/pair.h>
#include <vericone/cones/penetration.h>
#include <vericone/geometry/world_body.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace vericone::motion {
namespace {

using Eigen::Vector3d;

/// Of pairs that are certified: features below this part of a body's size may stay undecided.
constexpr double kTouchTolerance = 1e-8;

/// Pairs of pieces asked at most.
constexpr std::size_t kMostPairs = 20'000;

bool common(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// Around a box in the frame of a pose; widened by some roundings.
Box posed(const Box& box, const Pose& pose) {
  const Vector3d center = pose.to_world(box.center());
  const Vector3d half = pose.rotation.cwiseAbs() * box.half_widths();
  const Vector3d wide = half + 1e-14 * (center.cwiseAbs() + half);
  return {center - wide, center + wide};
}

/// A convex piece of a body that stands somewhere.
struct Piece {
  Placed placed;
  Box box;
};

Piece piece_of(const Body& body, const Pose& pose) { return {{body, pose}, posed(body.bounds(), pose)}; }

/// The convex pieces of a body that may reach into a box; of an assembly those of its leaves that do.
std::vector<Piece> pieces_within(const Placed& body, const Box& box) {
  const Assembly* assembly = body.body.assembly();
  if (!assembly) return {piece_of(body.body, body.pose)};
  std::vector<Piece> pieces;
  const auto nodes = assembly->hierarchy().nodes();
  std::vector<std::size_t> open;
  if (!nodes.empty()) open.push_back(0);
  while (!open.empty()) {
    const Hierarchy::Node& node = nodes[open.back()];
    open.pop_back();
    if (!common(posed(node.box(), body.pose), box)) continue;
    if (!node.is_leaf()) {
      open.push_back(node.first);
      open.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
      Piece piece = piece_of(assembly->convex_piece(assembly->hierarchy().order()[slot]), body.pose);
      if (common(piece.box, box)) pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

Box around(const std::vector<Piece>& pieces) {
  Box box = pieces.front().box;
  for (const Piece& piece : pieces) box.include(piece.box);
  return box;
}

/// All points c + (1 - k) (x - c) of a convex body or a star about c.
Body shrunk(const Body& body, const Vector3d& c, double k) {
  if (const auto* quadric = body.quadric()) return quadric->translated(-c).scaled(1 - k).translated(c);
  if (const auto* hull = body.hull()) return hull->translated(-c).scaled(1 - k).translated(c);
  return body.convex()->translated(-c).scaled(1 - k).translated(c);
}

/// By how much to shrink a body, at least, so that balls of radius `error` about the points of what is left
/// are in it; about its middle. Infinite where it is flat.
double shrinking(const Body& body, double error) {
  if (const auto* quadric = body.quadric()) {
    // Of a point y, |v| <= error: (1 - k) y + v is in the ellipsoid where k is error / its least semi-axis,
    // and
    //   ((1 - k) y + v)^T M ((1 - k) y + v) <= (1 - k) level + 2 error |M y| + error^2 |M|.
    const Vector3d axes = quadric->ellipsoid().semi_axes();
    double k = error / axes.minCoeff();
    for (const Delimiter<3>& d : quadric->delimiters()) {
      const double size = d.matrix.norm();
      k = std::max(k, (2 * error * size * axes.maxCoeff() + error * error * size) / d.level);
    }
    return k;
  }
  const auto within = penetration(Placed(Body(Convex::point(body.middle()))), Placed(body));
  return within && within->least > 0 ? error / within->least : std::numeric_limits<double>::infinity();
}

/// The body without what is nearer to its surface than `error`, or less; nothing where that is not found.
std::optional<Placed> narrowed(const Placed& placed, double error) {
  const double k = shrinking(placed.body, error) * (1 + 1e-9);
  if (!(k < 0.5)) return std::nullopt;
  return Placed(shrunk(placed.body, placed.body.middle(), k), placed.pose);
}

bool touch(const Placed& a, const Placed& b) {
  std::optional<Relation> relation;
  if (a.body.quadric() && b.body.quadric())
    relation = relation_of(in_world(*a.body.quadric(), a.pose), in_world(*b.body.quadric(), b.pose),
                           kTouchTolerance);
  else
    relation = Pair(a, b).relation();
  return relation && *relation != Relation::disjoint;
}

/// Neither is an assembly.
bool solid_meet(const Placed& a, const Placed& b, double error) {
  // What shrinking rounds is in it too.
  if (const auto narrow = narrowed(a, 2 * error)) return touch(*narrow, b);
  if (const auto narrow = narrowed(b, 2 * error)) return touch(a, *narrow);
  return false;
}

/// Two convex bodies.
bool convex_meet(const Placed& a, const Placed& b, double error) {
  const auto depth = penetration(a, b);
  if (depth && depth->least > error) return true;
  // Nearer to touching the relation is slow.
  return depth && depth->most > 4 * error && solid_meet(a, b, error);
}

/// Of bodies of convex pieces: two of them, deep in each other.
bool pieces_meet(const Placed& a, const Placed& b, double error) {
  std::vector<Piece> of_b = pieces_within(b, posed(a.body.bounds(), a.pose));
  if (of_b.empty()) return false;
  const std::vector<Piece> of_a = pieces_within(a, around(of_b));
  std::size_t asked = 0;
  for (const Piece& one : of_a)
    for (const Piece& other : of_b) {
      if (!common(one.box, other.box)) continue;
      if (++asked > kMostPairs) return false;
      if (convex_meet(one.placed, other.placed, error)) return true;
    }
  return false;
}

bool delimited(const Placed& body) { return body.body.quadric() && !body.body.quadric()->is_ellipsoid(); }

bool parts_meet(const Placed& a, const Placed& b, double error) {
  if (!delimited(a) && !delimited(b)) return pieces_meet(a, b, error);
  const auto narrow = narrowed(delimited(a) ? a : b, 2 * error);
  return narrow && (delimited(a) ? touch(*narrow, b) : touch(a, *narrow));
}

}  // namespace

bool meet(const Path& a, const Path& b, double t) {
  const double error = 2 * (a.rounding(t) + b.rounding(t));
  if (!std::isfinite(error)) return false;
  const auto all_b = b.parts(t);
  for (const Placed& one : a.parts(t))
    for (const Placed& other : all_b)
      if (parts_meet(one, other, error)) return true;
  return false;
}

}  // namespace vericone::motion
