// SPDX-License-Identifier: BSD-3-Clause
//
// Least distances by the algorithm of Gilbert, Johnson and Keerthi (1988) on the sweep, which is convex, and
// each convex piece; a descent of the hierarchy of boxes leaves out the pieces that cannot be nearer.
#include "near.h"

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace vericone::guidance::courses {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRelative = 1e-3;  // of a distance
constexpr int kMostSupports = 48;

/// Points, a box, an ellipsoid, or a body of flat, round and straight parts; rounded by a radius.
class Piece {
 public:
  static Piece points(const Vector3d* points, std::size_t count, double radius = 0) {
    Piece piece;
    piece.points_ = points;
    piece.count_ = count;
    piece.radius_ = radius;
    return piece;
  }
  static Piece box(const Box& box) {
    Piece piece;
    piece.box_ = &box;
    return piece;
  }
  static Piece ellipsoid(const Ellipsoid& ellipsoid) {
    Piece piece;
    piece.ellipsoid_ = &ellipsoid;
    return piece;
  }
  static Piece convex(const Convex& convex) {
    Piece piece;
    piece.convex_ = &convex;
    piece.radius_ = convex.margin();
    return piece;
  }

  /// A direction from x towards the piece, of what may be nearest.
  Vector3d towards(const Vector3d& x) const {
    if (box_) return x.cwiseMax(box_->low).cwiseMin(box_->high) - x;
    if (ellipsoid_) return ellipsoid_->shape().inverse() * (ellipsoid_->center() - x);
    if (convex_) return convex_->middle() - x;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < count_; ++i) sum += points_[i];
    return sum / double(count_) - x;
  }
  /// The point with the least n.x, without the rounding.
  Vector3d lowest(const Vector3d& n) const {
    if (box_) return (n.array() > 0).select(box_->low, box_->high);
    if (ellipsoid_) return lowest(ellipsoid_->center(), ellipsoid_->factor(), n);
    if (convex_) {
      Vector3d best = Vector3d::Zero();
      double least = kNever;
      for (const Convex::Piece& piece : convex_->pieces()) {
        const Vector3d x = lowest(piece.center, piece.factor, n);
        if (const double here = n.dot(x); here < least) {
          least = here;
          best = x;
        }
      }
      return best;
    }
    std::size_t best = 0;
    double least = n.dot(points_[0]);
    for (std::size_t i = 1; i < count_; ++i)
      if (const double here = n.dot(points_[i]); here < least) {
        least = here;
        best = i;
      }
    return points_[best];
  }
  double radius() const { return radius_; }
  /// Surely no more than the least n.(x - from) over the piece.
  double surely_lowest(const Vector3d& n, const Vector3d& from) const;

 private:
  static Vector3d lowest(const Vector3d& center, const Matrix3d& factor, const Vector3d& n) {
    const Vector3d u = factor.transpose() * n;
    const double length = u.norm();
    if (!(length > 0)) return center;
    return center - factor * (u / length);
  }

  const Vector3d* points_ = nullptr;
  const Box* box_ = nullptr;
  const Ellipsoid* ellipsoid_ = nullptr;
  const Convex* convex_ = nullptr;
  std::size_t count_ = 0;
  double radius_ = 0;
};

/// A sweep in the frame of the pieces.
struct Way {
  Vector3d from, along;
  Matrix3d factor;
  double wider_from = 0, wider_to = 0;  // m, as of Sweep
};

/// The point of the sweep with the most n.x.
Vector3d highest(const Way& sweep, const Vector3d& n) {
  const Vector3d u = sweep.factor.transpose() * n;
  const double length = u.norm();
  Vector3d x = sweep.from;
  if (length > 0) x += sweep.factor * (u / length);
  if (sweep.wider_from == 0 && sweep.wider_to == 0) {
    if (n.dot(sweep.along) > 0) x += sweep.along;
    return x;
  }
  const double size = n.norm();
  const bool at_end = n.dot(sweep.along) + size * (sweep.wider_to - sweep.wider_from) > 0;
  if (at_end) x += sweep.along;
  if (size > 0) x += (at_end ? sweep.wider_to : sweep.wider_from) / size * n;
  return x;
}

constexpr double kRoundings = 0x1p-49;  // of a sum of some products, relative to all their sizes

/// Surely no more than n.(x - from): the difference is rounded relative to itself.
double surely_along(const Vector3d& n, const Vector3d& x, const Vector3d& from) {
  const Vector3d d = x - from;
  return n.dot(d) - kRoundings * n.cwiseAbs().dot(d.cwiseAbs());
}

/// Surely no less than |F^T n|; of an ellipsoid that its shape matrix defines as well, of which the factor is
/// a rounded root.
double surely_radius(const Matrix3d& factor, const Vector3d& n) {
  return std::sqrt((factor.transpose() * n).squaredNorm() * (1 + kRoundings) +
                   0x1p-45 * factor.squaredNorm() * n.squaredNorm());
}

double Piece::surely_lowest(const Vector3d& n, const Vector3d& from) const {
  if (box_) return surely_along(n, (n.array() > 0).select(box_->low, box_->high), from);
  if (ellipsoid_) return surely_along(n, ellipsoid_->center(), from) - surely_radius(ellipsoid_->factor(), n);
  double least = kNever;
  for (std::size_t i = 0; i < count_; ++i) least = std::min(least, surely_along(n, points_[i], from));
  if (convex_)
    for (const Convex::Piece& piece : convex_->pieces()) {
      const double along = surely_along(n, piece.center, from);
      least = std::min(least, piece.rank == 0 ? along : along - surely_radius(piece.factor, n));
    }
  return least - radius_ * n.norm() * (1 + kRoundings);
}

/// Surely no more than the distance of the sweep from what lies beyond `lowest`, a bound of n.(x - from).
double surely_between(const Way& sweep, const Vector3d& n, double lowest) {
  const double size = n.norm();
  if (!(size > 0)) return -kNever;
  const double radius = surely_radius(sweep.factor, n),
               along = -surely_along(-n, sweep.along, Vector3d::Zero());
  const double highest = std::max(size * sweep.wider_from, along + size * sweep.wider_to);
  const double sizes =
      std::abs(lowest) + radius + std::abs(along) + size * (sweep.wider_from + sweep.wider_to);
  const double gap = lowest - radius - highest - kRoundings * sizes - 1e-290;
  return gap / size - kRoundings * std::abs(gap / size);
}

/// Up to four points; the point of their hull nearest to 0.
class Simplex {
 public:
  void add(const Vector3d& x) { of_[size_++] = x; }

  /// Keeps only the points that the nearest one is a combination of. The newest is one of them. Nothing
  /// else where 0 is inside.
  Vector3d nearest() {
    const int others = size_ - 1;
    const Vector3d newest = of_[others];
    Vector3d best = newest;
    double least = newest.squaredNorm();
    int kept = 0;
    for (int chosen = 1; chosen < 1 << others; ++chosen) {
      Matrix3d edges = Matrix3d::Zero();
      int n = 0;
      for (int i = 0; i < others; ++i)
        if (chosen >> i & 1) edges.col(n++) = of_[i] - newest;
      Vector3d weight = Vector3d::Zero();
      if (!weights(edges, n, newest, weight)) continue;
      const Vector3d x = newest + edges * weight;
      if (n < 3 && !(x.squaredNorm() < least)) continue;
      best = n == 3 ? Vector3d(Vector3d::Zero()) : x;
      least = best.squaredNorm();
      kept = chosen;
    }
    int n = 0;
    for (int i = 0; i < others; ++i)
      if (kept >> i & 1) of_[n++] = of_[i];
    of_[n++] = newest;
    size_ = n;
    return best;
  }

 private:
  /// Of the point nearest to 0 in the plane of newest + edges; false unless all are positive, that of the
  /// newest too.
  static bool weights(const Matrix3d& edges, int n, const Vector3d& newest, Vector3d& weight) {
    const auto e = [&](int i) { return edges.col(i); };
    if (n == 1) {
      const double square = e(0).squaredNorm();
      if (!(square > 0)) return false;
      weight(0) = -e(0).dot(newest) / square;
    } else if (n == 2) {
      const Vector3d normal = e(0).cross(e(1));
      const double square = normal.squaredNorm();
      if (!(square > 0)) return false;
      weight(0) = -newest.cross(e(1)).dot(normal) / square;
      weight(1) = -e(0).cross(newest).dot(normal) / square;
    } else {
      const double volume = e(0).cross(e(1)).dot(e(2));
      if (volume == 0) return false;
      weight(0) = -newest.cross(e(1)).dot(e(2)) / volume;
      weight(1) = -e(0).cross(newest).dot(e(2)) / volume;
      weight(2) = -e(0).cross(e(1)).dot(newest) / volume;
    }
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      if (!(weight(i) > 0)) return false;
      sum += weight(i);
    }
    return sum < 1;
  }

  std::array<Vector3d, 4> of_;
  int size_ = 0;
};

struct Apart {
  double distance, least;  // metres; the true one lies between; 0 where they meet
  Vector3d normal;         // unit, from the sweep to the piece
};

/// Stops where the distance is proved to be `enough`, or not to be more than `stop`. Begins with `first`, if
/// that is not zero.
Apart apart(const Way& sweep, const Piece& piece, double enough, double stop, double rough = kRelative,
            const Vector3d& first = Vector3d::Zero()) {
  const double size = sweep.factor.norm() + piece.radius(), meets = 1e-7 * size;
  Vector3d v = first.isZero(0) ? piece.towards(sweep.from + 0.5 * sweep.along) : first;
  Apart result{kNever, 0, Vector3d::Zero()};
  Simplex simplex;
  if (!(v.norm() > 0)) v = Vector3d::UnitX();
  double length = v.norm(), before = kNever;
  for (int i = 0; i < kMostSupports; ++i) {
    const Vector3d n = v / length;
    const Vector3d s = piece.lowest(n) - highest(sweep, n);
    if (const double least = n.dot(s) - piece.radius(); least > result.least) {
      result.least = least;
      result.normal = n;
      if (least >= enough) {
        result.distance = std::max(least, i > 0 ? length - piece.radius() : least);
        return result;
      }
    }
    if (i > 0 && length - piece.radius() <= stop) break;
    const double most = length - piece.radius();
    if (i > 0 && most - result.least <= (most < enough ? rough : kRelative) * most) break;
    simplex.add(s);
    v = simplex.nearest();
    length = v.norm();
    if (length - piece.radius() <= meets) return {0, 0, n};
    if (!(length < before)) break;  // rounding
    before = length;
  }
  result.distance = std::min(length, before) - piece.radius();
  if (!(result.normal.norm() > 0)) result.normal = v / length;
  return result;
}

/// Where it is at a part of its way.
Way at_part(const Way& sweep, double part) {
  const double wider = sweep.wider_from + part * (sweep.wider_to - sweep.wider_from);
  return {sweep.from + part * sweep.along, Vector3d::Zero(), sweep.factor, wider, wider};
}

/// Of a sweep that meets the piece: the part of the way until then. Newton's method from before, which never
/// passes the contact.
double first_contact(const Way& sweep, const Piece& piece) {
  const double size = sweep.factor.norm() + piece.radius();
  double part = 0;
  for (int i = 0; i < 40; ++i) {
    const Apart now = apart(at_part(sweep, part), piece, kNever, 0);
    const double closing = now.normal.dot(sweep.along) + sweep.wider_to - sweep.wider_from;
    if (!(now.distance > 1e-5 * size) || !(closing > 0)) break;
    part += std::max(now.least, 0.5 * now.distance) / closing;
    if (part >= 1) return 1;
  }
  return part;
}

/// How far across its way the sweep must be shifted, at least, to pass the piece.
double depth_across(const Way& sweep, const Piece& piece) {
  if (!(sweep.along.norm() > 0)) return 0;
  const AxisFrame frame(sweep.along);
  const auto gap = [&](double azimuth) {
    const Vector3d n = frame.across(azimuth);
    return n.dot(piece.lowest(n)) - piece.radius() - n.dot(highest(sweep, n));
  };
  constexpr int kAround = 64;
  double width = 2 * std::numbers::pi / kAround, best = 0, most = -kNever;
  for (int i = 0; i < kAround; ++i)
    if (const double here = gap(i * width); here > most) {
      most = here;
      best = i * width;
    }
  for (; width > 1e-4; width *= 0.5)
    for (const double azimuth : {best - 0.5 * width, best + 0.5 * width})
      if (const double here = gap(azimuth); here > most) {
        most = here;
        best = azimuth;
      }
  return std::max(0.0, -most);
}

/// The nearest of many pieces, looked at one after the other.
class Nearest {
 public:
  Nearest(const Way& sweep, const Wanted& wanted) : sweep_(sweep), wanted_(wanted) {
    near_.distance = wanted.enough;
    bound();
  }

  /// Nothing can change the answer.
  bool done() const {
    if (met_) return wanted_.meeting == Meeting::whether || near_.part == 0;
    return near_.distance <= wanted_.stop;
  }

  void look(const Piece& piece) {
    Vector3d& normal = wanted_.normal ? *wanted_.normal : normal_;
    const Apart found = apart(sweep_, piece, std::max(counts(), 1e-300), wanted_.stop, wanted_.rough, normal);
    normal = found.normal;
    if (found.distance > 0) {
      near_.distance = std::min(near_.distance, found.distance);
      return;
    }
    met_ = true;
    near_.distance = 0;
    if (wanted_.meeting == Meeting::whether) return;
    // From now on only what is met before counts.
    const double part = first_contact(sweep_, piece);
    near_.part *= part;
    if (wanted_.meeting == Meeting::depth) near_.depth = depth_across(sweep_, piece);
    sweep_.along *= part;
    sweep_.wider_to = sweep_.wider_from + part * (sweep_.wider_to - sweep_.wider_from);
    bound();
  }

  /// At most the distance to what is in the node; infinite where that does not count.
  double least(const Hierarchy::Node& node) const {
    const double most = counts();
    for (int k = 0; k < 3; ++k)
      if (node.low[k] - high_(k) > most || low_(k) - node.high[k] > most) return kNever;
    const Box box = node.box();
    const auto clamped = [&](const Vector3d& x) { return Vector3d(x.cwiseMax(box.low).cwiseMin(box.high)); };
    const Vector3d on_way = nearest_on_way(clamped(nearest_on_way(box.center())));
    const Vector3d n = clamped(on_way) - on_way;
    const double length = n.norm();
    if (!(length > 0)) return 0;
    double least = gap(box, n) / length;
    // Of what is beside the piece looked at last the plane between tells more, mostly.
    if (least <= most && !normal_.isZero(0)) least = std::max(least, gap(box, normal_));
    return least > most || (least > 0 && least == most) ? kNever : std::max(least, 0.0);
  }

  /// Whether a node with this least() still counts, by what was found since.
  bool may_count(const Hierarchy::Node& node, double least_before) const {
    return met_ ? least(node) < kNever : least_before < counts() || least_before == 0;
  }

  double along(const Hierarchy::Node& node) const { return node.box().center().dot(sweep_.along); }

  Near result() const { return near_; }

 private:
  double gap(const Box& box, const Vector3d& n) const {
    const Vector3d corner = (n.array() > 0).select(box.low, box.high);
    return n.dot(corner - highest(sweep_, n));
  }
  /// Of flat walls all pieces are as near: what is a hundredth nearer than the nearest does not count.
  double counts() const {
    return met_ ? 0 : near_.distance < wanted_.enough ? 0.99 * near_.distance : near_.distance;
  }
  void bound() {
    const Vector3d end = sweep_.from + sweep_.along;
    Vector3d extent = sweep_.factor.rowwise().norm();
    extent.array() += std::max(sweep_.wider_from, sweep_.wider_to);
    low_ = sweep_.from.cwiseMin(end) - extent;
    high_ = sweep_.from.cwiseMax(end) + extent;
  }
  Vector3d nearest_on_way(const Vector3d& x) const {
    const double square = sweep_.along.squaredNorm();
    if (!(square > 0)) return sweep_.from;
    return sweep_.from + std::clamp((x - sweep_.from).dot(sweep_.along) / square, 0.0, 1.0) * sweep_.along;
  }

  Way sweep_;
  Wanted wanted_;
  Near near_;
  Vector3d low_, high_;                 // of the sweep's box
  Vector3d normal_ = Vector3d::Zero();  // unit, to the piece that was looked at last
  bool met_ = false;
};

/// Of an assembly, by slot.
Piece piece_of(const Assembly& body, std::uint32_t slot) {
  const Assembly::Storage& pieces = body.by_slot();
  switch (body.kind()) {
    case PieceKind::triangle:
      return Piece::points(pieces.triangles[slot].data(), 3);
    case PieceKind::ball:
      return Piece::points(&pieces.balls[slot], 1, body.radius());
    case PieceKind::box:
      return Piece::box(pieces.boxes[slot]);
    case PieceKind::hull:
      return Piece::points(pieces.hulls[slot].points().data(), pieces.hulls[slot].size());
    case PieceKind::convex:
      break;
  }
  return Piece::convex(pieces.convexes[slot]);
}

void descend(const Assembly& body, Nearest& nearest) {
  const auto nodes = body.hierarchy().nodes();
  if (nodes.empty()) return;
  struct Item {
    std::uint32_t node;
    double least;
  };
  Item stack[128];
  int size = 0;
  stack[size++] = {0, 0};
  while (size > 0 && !nearest.done()) {
    const Item item = stack[--size];
    const Hierarchy::Node& node = nodes[item.node];
    if (!nearest.may_count(node, item.least)) continue;
    if (node.is_leaf()) {
      for (std::uint32_t slot = node.first; slot < node.first + node.count && !nearest.done(); ++slot)
        nearest.look(piece_of(body, slot));
      continue;
    }
    Item one{node.first, nearest.least(nodes[node.first])},
        two{node.first + 1, nearest.least(nodes[node.first + 1])};
    const bool first = one.least != two.least
                           ? one.least < two.least
                           : nearest.along(nodes[one.node]) < nearest.along(nodes[two.node]);
    if (first) std::swap(one, two);
    for (const Item& child : {one, two})
      if (child.least < kNever) stack[size++] = child;
  }
}

Way way_of(const Sweep& sweep) {
  return {sweep.agent.center(), sweep.along, sweep.agent.factor(), sweep.wider_from, sweep.wider_to};
}

/// In the frame of a body.
Way way_of(const Sweep& sweep, const Pose& pose) {
  const Matrix3d to_body = pose.rotation.transpose();
  return {pose.to_body(sweep.agent.center()), to_body * sweep.along, to_body * sweep.agent.factor(),
          sweep.wider_from, sweep.wider_to};
}

/// What is surely kept from pieces that are looked at one after the other.
class Kept {
 public:
  Kept(const Way& sweep, double enough) : sweep_(sweep), kept_(enough) {
    size_ = sweep.from.norm() + sweep.along.norm() + sweep.factor.norm();
  }

  void look(const Piece& piece, Vector3d& normal) {
    // A little more, which the proof loses by rounding.
    const double enough = std::max(kept_, 0.0) + 1e-12 * size_;
    normal = apart(sweep_, piece, enough, 0, kRelative, normal).normal;
    kept_ = std::min(kept_, surely_between(sweep_, normal, piece.surely_lowest(normal, sweep_.from)));
  }
  /// Whether what is in the box may be nearer than what was found. `normal`: to what was looked at last.
  bool matters(const Box& box, const Vector3d& normal) const {
    const auto by = [&](const Vector3d& n) {
      return surely_between(sweep_, n, Piece::box(box).surely_lowest(n, sweep_.from)) < kept_;
    };
    return by(towards(box)) && (normal.isZero(0) || by(normal));
  }
  /// About how far the box is from the way.
  double beside(const Box& box) const { return towards(box).squaredNorm(); }
  bool meets() const { return !(kept_ >= 0); }
  double kept() const { return kept_; }

 private:
  /// From about the nearest of the way to about the nearest of the box.
  Vector3d towards(const Box& box) const {
    const double square = sweep_.along.squaredNorm();
    const auto on_way = [&](const Vector3d& x) {
      if (!(square > 0)) return sweep_.from;
      return Vector3d(sweep_.from +
                      std::clamp((x - sweep_.from).dot(sweep_.along) / square, 0.0, 1.0) * sweep_.along);
    };
    const auto in_box = [&](const Vector3d& x) { return Vector3d(x.cwiseMax(box.low).cwiseMin(box.high)); };
    const Vector3d x = on_way(in_box(on_way(box.center())));
    return in_box(x) - x;
  }

  Way sweep_;
  double kept_, size_;
};

void descend(const Assembly& body, Kept& kept) {
  const auto nodes = body.hierarchy().nodes();
  if (nodes.empty()) return;
  std::uint32_t stack[128];
  int size = 0;
  stack[size++] = 0;
  Vector3d normal = Vector3d::Zero();
  while (size > 0 && !kept.meets()) {
    const Hierarchy::Node& node = nodes[stack[--size]];
    if (!kept.matters(node.box(), normal)) continue;
    if (!node.is_leaf()) {
      // The nearer one first.
      const bool second = kept.beside(nodes[node.first].box()) > kept.beside(nodes[node.first + 1].box());
      stack[size++] = second ? node.first : node.first + 1;
      stack[size++] = second ? node.first + 1 : node.first;
      continue;
    }
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
      kept.look(piece_of(body, slot), normal);
  }
}

}  // namespace

Near near(const Sweep& sweep, const Ellipsoid& body, const Wanted& wanted) {
  Nearest nearest(way_of(sweep), wanted);
  nearest.look(Piece::ellipsoid(body));
  return nearest.result();
}

Near near(const Sweep& sweep, const Placed& body, Wanted wanted) {
  wanted.normal = nullptr;  // of many pieces each has its own
  Nearest nearest(way_of(sweep, body.pose), wanted);
  if (const Assembly* assembly = body.body.assembly()) {
    descend(*assembly, nearest);
  } else if (const HullBody* hull = body.body.hull()) {
    nearest.look(Piece::points(hull->points().data(), hull->size()));
  } else if (const Convex* convex = body.body.convex()) {
    nearest.look(Piece::convex(*convex));
  } else if (const CombinedEllipsoid* quadric = body.body.quadric()) {
    nearest.look(Piece::ellipsoid(quadric->ellipsoid()));
  } else {
    for (const CombinedEllipsoid& each : *body.body.quadrics())
      if (!nearest.done()) nearest.look(Piece::ellipsoid(each.ellipsoid()));
  }
  return nearest.result();
}

double surely_apart(const Sweep& sweep, const Ellipsoid& body, double enough, Vector3d& normal) {
  Kept kept(way_of(sweep), enough);
  kept.look(Piece::ellipsoid(body), normal);
  return kept.kept();
}

double surely_apart(const Sweep& sweep, const Placed& body, double enough) {
  // In the body's frame all is rounded once more, and a rotation is one to 1e-12.
  const double rounded = body.pose.rotation.isIdentity(0) ? 1e-14 : 4e-12;
  const double size = body.pose.position.norm() + sweep.agent.center().norm() + sweep.along.norm() +
                      sweep.agent.factor().norm();
  Kept kept(way_of(sweep, body.pose), enough + rounded * size);
  Vector3d normal = Vector3d::Zero();
  if (const Assembly* assembly = body.body.assembly()) {
    descend(*assembly, kept);
  } else if (const HullBody* hull = body.body.hull()) {
    kept.look(Piece::points(hull->points().data(), hull->size()), normal);
  } else if (const Convex* convex = body.body.convex()) {
    kept.look(Piece::convex(*convex), normal);
  } else if (const CombinedEllipsoid* quadric = body.body.quadric()) {
    kept.look(Piece::ellipsoid(quadric->ellipsoid()), normal);
  } else {
    for (const CombinedEllipsoid& each : *body.body.quadrics()) {
      normal.setZero();
      kept.look(Piece::ellipsoid(each.ellipsoid()), normal);
    }
  }
  return kept.kept() - rounded * size;
}

}  // namespace vericone::guidance::courses
