// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/solid.h"

#include <vericone/geometry/world_body.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <variant>

#include "certificate/octree.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The points of pieces, each once.
class Corners {
 public:
  explicit Corners(Solid& solid) : solid_(solid) {}

  void add(const std::vector<Vector3d>& points) {
    std::vector<std::uint32_t> piece;
    for (const Vector3d& x : points) {
      const auto [at, fresh] =
          known_.try_emplace({x.x(), x.y(), x.z()}, static_cast<std::uint32_t>(solid_.points.size()));
      if (fresh) solid_.points.push_back(x);
      piece.push_back(at->second);
    }
    solid_.pieces.push_back(std::move(piece));
  }

 private:
  Solid& solid_;
  std::map<std::tuple<double, double, double>, std::uint32_t> known_;
};

Solid of_hull(const HullBody& hull) {
  Solid solid;
  solid.kind = Solid::Kind::hull;
  solid.points = hull.points();
  solid.pieces.emplace_back(hull.points().size());
  std::iota(solid.pieces.front().begin(), solid.pieces.front().end(), 0);
  return solid;
}

/// In the order of its pieces, by their numbers.
template <typename T>
std::vector<T> in_order(const Assembly& body, const std::vector<T>& by_slot) {
  std::vector<T> list = by_slot;
  const auto order = body.hierarchy().order();
  for (std::size_t slot = 0; slot < by_slot.size(); ++slot) list[order[slot]] = by_slot[slot];
  return list;
}

/// Neighbours one after the other: halves along the widest extent of their middles, and so on.
std::vector<std::uint32_t> side_by_side(const Solid& solid) {
  std::vector<std::uint32_t> order(solid.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Vector3d> middles;
  for (const std::uint32_t k : order) middles.push_back(solid.bounds(k).center());
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, order.size()}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    if (last - first < 3) continue;
    Box box{middles[order[first]], middles[order[first]]};
    for (std::size_t k = first; k < last; ++k) box.include({middles[order[k]], middles[order[k]]});
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const std::size_t half = first + (last - first) / 2;
    const auto at = [&](std::size_t k) { return order.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(half), at(last), [&](std::uint32_t x, std::uint32_t y) {
      return std::pair(middles[x](axis), x) < std::pair(middles[y](axis), y);
    });
    open.insert(open.end(), {{first, half}, {half, last}});
  }
  return order;
}

void put_side_by_side(Solid& solid) {
  if (solid.size() <= kManyPieces) return;
  const std::vector<std::uint32_t> order = side_by_side(solid);
  const auto put = [&](auto& list) {
    if (list.empty()) return;
    auto sorted = list;
    for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = list[order[k]];
    list = std::move(sorted);
  };
  put(solid.boxes);
  put(solid.convexes);
  if (solid.kind == Solid::Kind::cloud)
    put(solid.points);  // a piece is the point of its number
  else
    put(solid.pieces);
}

OwnFrame of_boxes(std::vector<Box> boxes, bool upright) {
  OwnFrame own;
  Solid& solid = own.solid;
  solid.kind = upright ? Solid::Kind::boxes : Solid::Kind::hulls;
  const bool many = upright && boxes.size() > kManyPieces;
  if (many) {
    if (auto octree = octree_of(boxes)) {
      solid.kind = Solid::Kind::octree;
      solid.boxes = octree->boxes;
      own.rounding = octree->rounding;
      solid.octree = std::make_shared<Octree>(std::move(*octree));
      return own;
    }
  } else {
    Corners corners(solid);
    for (const Box& box : boxes) corners.add(HullBody::box(box.low, box.high).points());
  }
  if (upright) solid.boxes = std::move(boxes);
  return own;
}

OwnFrame of_assembly(const Assembly& body, bool upright) {
  OwnFrame own;
  Solid& solid = own.solid;
  Corners corners(solid);
  const Assembly::Storage& storage = body.by_slot();
  switch (body.kind()) {
    case PieceKind::triangle:
      solid.kind = Solid::Kind::mesh;
      for (const auto& t : in_order(body, storage.triangles)) corners.add({t[0], t[1], t[2]});
      break;
    case PieceKind::ball:
      solid.kind = Solid::Kind::cloud;
      solid.radius = body.radius();
      solid.points = in_order(body, storage.balls);
      for (std::uint32_t i = 0; i < solid.points.size(); ++i) solid.pieces.push_back({i});
      break;
    case PieceKind::box:
      own = of_boxes(in_order(body, storage.boxes), upright);
      break;
    case PieceKind::convex:
      solid.kind = Solid::Kind::convexes;
      solid.convexes = in_order(body, storage.convexes);
      break;
    case PieceKind::hull:
      solid.kind = Solid::Kind::hulls;
      for (const HullBody& hull : in_order(body, storage.hulls)) corners.add(hull.points());
      break;
  }
  if (solid.kind != Solid::Kind::octree) put_side_by_side(solid);
  return own;
}

OwnFrame of_placed(const Placed& placed) {
  const Pose& pose = placed.pose;
  const bool upright = pose.rotation == Matrix3d::Identity() && pose.position.isZero(0);
  OwnFrame own;
  if (const CombinedEllipsoid* body = placed.body.quadric())
    own.solid.rounds = {*body};
  else if (const HullBody* hull = placed.body.hull())
    own.solid = of_hull(*hull);
  else if (const Assembly* assembly = placed.body.assembly())
    own = of_assembly(*assembly, upright);
  else if (const vericone::Convex* convex = placed.body.convex()) {
    own.solid.kind = Solid::Kind::convexes;
    own.solid.convexes = {*convex};
  } else
    own.solid.rounds = *placed.body.quadrics();
  if (upright) return own;
  for (Vector3d& x : own.solid.points) x = pose.to_world(x);
  for (CombinedEllipsoid& x : own.solid.rounds) x = in_world(x, pose);
  for (vericone::Convex& x : own.solid.convexes) x = in_world(x, pose);
  const Box bounds = placed.body.bounds();
  own.rounding += 1e-14 * (pose.position.norm() + bounds.low.norm() + bounds.high.norm());
  return own;
}

/// A body of space of which it is the section by z = 0, as high as it is narrow.
CombinedEllipsoid of_flat(const CombinedEllipse& flat) {
  const Eigen::Matrix2d& f = flat.ellipsoid().factor();
  return raised(flat, f.colwise().norm().minCoeff());
}

constexpr double kPinched = 0.99;  // k of dents

OwnFrame of_shape(const ShapeInTime& shape, double from, double to) {
  const WorldBody body =
      shape.rigid() ? *shape.rigid() : shape_over(shape, from, to, Vector3d::Zero(), Matrix3d::Identity());
  if (body.placed()) return of_placed(*body.placed());
  OwnFrame own;
  if (body.hull()) {
    own.solid = of_hull(*body.hull());
    return own;
  }
  const CombinedEllipsoid quadric = body.flat() ? of_flat(*body.flat()) : *body.quadric();
  // Rounding moves a pinched waist by far more than its last digit: there the ellipsoid alone.
  const bool pinched = !shape.rigid() && shape.k()->range(from, to).low > kPinched;
  own.solid.rounds = {pinched ? CombinedEllipsoid(quadric.ellipsoid()) : quadric};
  if (!shape.rigid() || body.flat()) own.rounding = 1e-14 * body.reach();
  return own;
}

}  // namespace

OwnFrame in_own_frame(const ShapeInTime& shape, double from, double to) {
  OwnFrame own = of_shape(shape, from, to);
  const auto& rounds = own.solid.rounds;
  own.dents = !shape.rigid() || std::any_of(rounds.begin(), rounds.end(),
                                            [](const CombinedEllipsoid& one) { return !one.is_ellipsoid(); });
  return own;
}

}  // namespace vericone::simulation::certified
