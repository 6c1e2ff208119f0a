// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace vericone {

using Eigen::Vector3d;

const char* to_string(BodyKind kind) {
  switch (kind) {
    case BodyKind::ellipsoid:
      return "ellipsoid";
    case BodyKind::combined:
      return "combined";
    case BodyKind::hull:
      return "hull";
    case BodyKind::mesh:
      return "mesh";
    case BodyKind::cloud:
      return "cloud";
    case BodyKind::boxes:
      return "boxes";
    case BodyKind::pieces:
      return "pieces";
    case BodyKind::convex:
      return "convex";
  }
  return "";
}

namespace {

double support_of(const CombinedEllipsoid& body, const Vector3d& n) { return body.ellipsoid().support(n); }
double support_of(const HullBody& hull, const Vector3d& n) { return hull.support(n); }
double support_of(const Convex& body, const Vector3d& n) { return body.support(n); }
double support_of(const std::vector<CombinedEllipsoid>& pieces, const Vector3d& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const CombinedEllipsoid& piece : pieces) most = std::max(most, support_of(piece, n));
  return most;
}

double of_slot(const Assembly& body, std::size_t slot, const Vector3d& n) {
  const Assembly::Storage& pieces = body.by_slot();
  switch (body.kind()) {
    case PieceKind::triangle: {
      const auto& corners = pieces.triangles[slot];
      return std::max({n.dot(corners[0]), n.dot(corners[1]), n.dot(corners[2])});
    }
    case PieceKind::ball:
      return n.dot(pieces.balls[slot]) + body.radius() * n.norm();
    case PieceKind::box:
      return n.dot(pieces.boxes[slot].center()) + n.cwiseAbs().dot(pieces.boxes[slot].half_widths());
    case PieceKind::hull:
      return pieces.hulls[slot].support(n);
    case PieceKind::convex:
      break;
  }
  return pieces.convexes[slot].support(n);
}

/// A descent that leaves out what cannot reach farther.
double support_of(const Assembly& body, const Vector3d& n) {
  const auto nodes = body.hierarchy().nodes();
  const auto reach = [&](const Hierarchy::Node& node) {
    const Box box = node.box();
    return n.dot(box.center()) + n.cwiseAbs().dot(box.half_widths());
  };
  double most = -std::numeric_limits<double>::infinity();
  std::uint32_t stack[128];  // an assembly's tree is at most 64 deep (hierarchy.cpp)
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Hierarchy::Node& node = nodes[stack[--size]];
    if (reach(node) <= most) continue;
    if (node.is_leaf()) {
      for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
        most = std::max(most, of_slot(body, slot, n));
      continue;
    }
    const bool first_is_farther = reach(nodes[node.first]) > reach(nodes[node.first + 1]);
    stack[size++] = node.first + (first_is_farther ? 1 : 0);
    stack[size++] = node.first + (first_is_farther ? 0 : 1);
  }
  return most;
}

/// E and a ball of radius r about each of its points: (1 + 1/b) S + (1 + b) r^2 1 contains the sum for every
/// b > 0.
Ellipsoid widened(const Ellipsoid& body, double r) {
  if (!(r > 0)) return body;
  const double b = body.semi_axes().mean() / r;
  const Eigen::Matrix3d shape =
      (1 + 1e-12) * ((1 + 1 / b) * body.shape() + (1 + b) * r * r * Eigen::Matrix3d::Identity());
  return Ellipsoid::from_shape(body.center(), 0.5 * (shape + shape.transpose()));
}

/// The least ellipsoid of points; flat ones and few get corners a little beside them.
Ellipsoid containing_points(std::vector<Vector3d> points) {
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  MinVolumeOptions options;
  options.tolerance = 1e-4;
  try {
    return min_volume_ellipsoid<3>(points, options).body;
  } catch (const InputError&) {  // flat, or a single point
  }
  const double size = (high - low).maxCoeff();
  constexpr double kLeast = 1e-50;  // m, of a point at the origin: its sixth power is a number
  const double beside =
      std::max({1e-6 * size, 1e-9 * low.cwiseAbs().maxCoeff(), 1e-9 * high.cwiseAbs().maxCoeff(), kLeast});
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k)
      for (const double side : {-beside, beside}) points.push_back(points[i] + side * Vector3d::Unit(k));
  return min_volume_ellipsoid<3>(points, options).body;
}

Ellipsoid containing(const CombinedEllipsoid& body) {
  return body.is_ellipsoid() ? body.ellipsoid() : body.bounding_ellipsoid();
}

Ellipsoid containing(const HullBody& hull) { return containing_points(hull.points()); }

/// Around the ellipses and ellipsoids are the corners of what their axes span.
Ellipsoid containing(const Convex& body) {
  const Convex::Piece& first = body.pieces().front();
  if (body.pieces().size() == 1 && first.rank == 3) {
    const Eigen::Matrix3d square = (1 + 1e-12) * first.factor * first.factor.transpose();
    const Eigen::Matrix3d shape = 0.5 * (square + square.transpose());
    const Ellipsoid own = Ellipsoid::from_shape(first.center, first.shape ? *first.shape : shape);
    return widened(own, body.margin());
  }
  return widened(containing_points(body.corners()), body.margin());
}

Ellipsoid containing(const Assembly& body) {
  return widened(containing_points(body.corners()), body.radius());
}

/// The box around each piece's ellipsoid decides: at worst its corners are sqrt(3) too far out.
Ellipsoid containing(const std::vector<CombinedEllipsoid>& pieces) {
  if (pieces.size() == 1) return containing(pieces.front());
  std::vector<Vector3d> points;
  for (const CombinedEllipsoid& piece : pieces) {
    const Ellipsoid around = containing(piece);
    const Vector3d axes = around.semi_axes();
    const Eigen::Matrix3d directions = around.axis_directions();
    for (int i = 0; i < 8; ++i) {
      const Vector3d corner((i & 1 ? 1 : -1) * axes.x(), (i & 2 ? 1 : -1) * axes.y(),
                            (i & 4 ? 1 : -1) * axes.z());
      points.push_back(around.center() + directions * (corner * (1 + 1e-12)));
    }
  }
  return containing_points(std::move(points));
}

}  // namespace

struct Body::Data {
  explicit Data(Shape what) : shape(std::move(what)) {}

  Shape shape;
  mutable std::once_flag asked;
  mutable Ellipsoid containing;
};

Body::Body() : Body(Ellipsoid()) {}
Body::Body(const Ellipsoid& ellipsoid) : Body(CombinedEllipsoid(ellipsoid)) {}
Body::Body(const CombinedEllipsoid& body) : data_(std::make_shared<Data>(body)) {}
Body::Body(HullBody hull) : data_(std::make_shared<Data>(std::move(hull))) {}
Body::Body(Assembly assembly) : data_(std::make_shared<Data>(std::move(assembly))) {}
Body::Body(Convex convex) : data_(std::make_shared<Data>(std::move(convex))) {}

Body Body::pieces(std::vector<CombinedEllipsoid> pieces) {
  if (pieces.empty()) throw InputError("pieces", "none", "one piece or more");
  Body result;
  result.data_ = std::make_shared<Data>(std::move(pieces));
  return result;
}

const Body::Shape& Body::shape() const { return data_->shape; }

const CombinedEllipsoid* Body::quadric() const { return std::get_if<CombinedEllipsoid>(&data_->shape); }
const HullBody* Body::hull() const { return std::get_if<HullBody>(&data_->shape); }
const Assembly* Body::assembly() const { return std::get_if<Assembly>(&data_->shape); }
const std::vector<CombinedEllipsoid>* Body::quadrics() const {
  return std::get_if<std::vector<CombinedEllipsoid>>(&data_->shape);
}
const Convex* Body::convex() const { return std::get_if<Convex>(&data_->shape); }

BodyKind Body::kind() const {
  struct Name {
    BodyKind operator()(const CombinedEllipsoid& body) const {
      return body.is_ellipsoid() ? BodyKind::ellipsoid : BodyKind::combined;
    }
    BodyKind operator()(const HullBody&) const { return BodyKind::hull; }
    BodyKind operator()(const Assembly& body) const {
      switch (body.kind()) {
        case PieceKind::triangle:
          return BodyKind::mesh;
        case PieceKind::ball:
          return BodyKind::cloud;
        case PieceKind::box:
          return BodyKind::boxes;
        case PieceKind::hull:
        case PieceKind::convex:
          break;
      }
      return BodyKind::pieces;
    }
    BodyKind operator()(const Convex&) const { return BodyKind::convex; }
    BodyKind operator()(const std::vector<CombinedEllipsoid>&) const { return BodyKind::pieces; }
  };
  return std::visit(Name{}, data_->shape);
}

double Body::support(const Vector3d& n) const {
  return std::visit([&](const auto& shape) { return support_of(shape, n); }, data_->shape);
}

Box Body::bounds() const {
  if (const Assembly* pieces = assembly()) return pieces->bounds();
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.high(k) = support(Vector3d::Unit(k));
    box.low(k) = -support(-Vector3d::Unit(k));
  }
  return box;
}

Vector3d Body::middle() const {
  struct Middle {
    const Body& body;
    Vector3d operator()(const CombinedEllipsoid& one) const { return one.center(); }
    Vector3d operator()(const HullBody& hull) const {
      Vector3d sum = Vector3d::Zero();
      for (const Vector3d& x : hull.points()) sum += x / static_cast<double>(hull.size());
      return sum;
    }
    Vector3d operator()(const Convex& convex) const { return convex.middle(); }
    Vector3d operator()(const Assembly& assembly) const { return assembly.bounds().center(); }
    Vector3d operator()(const std::vector<CombinedEllipsoid>&) const { return body.bounds().center(); }
  };
  return std::visit(Middle{*this}, data_->shape);
}

const Ellipsoid& Body::containing_ellipsoid() const {
  std::call_once(data_->asked, [&] {
    data_->containing = std::visit([](const auto& shape) { return containing(shape); }, data_->shape);
  });
  return data_->containing;
}

namespace {

struct Swell {
  double margin;

  Body operator()(const CombinedEllipsoid& body) const {
    if (!body.is_ellipsoid())
      throw InputError("margin", to_text(margin), "left out of a body that hyperboloids delimit");
    return Convex::rounded(body.ellipsoid(), margin);
  }
  Body operator()(const HullBody& hull) const { return Convex::rounded(hull, margin); }
  Body operator()(const Convex& body) const { return body.swollen(margin); }
  Body operator()(const std::vector<CombinedEllipsoid>& parts) const {
    std::vector<Convex> all;
    for (const CombinedEllipsoid& part : parts) all.push_back(*(*this)(part).convex());
    return Assembly::convexes(std::move(all));
  }
  Body operator()(const Assembly& body) const {
    if (body.kind() == PieceKind::ball) {
      std::vector<Vector3d> points;
      for (std::size_t i = 0; i < body.size(); ++i) points.push_back(body.piece(i).points().front());
      return Assembly::cloud(std::move(points), body.radius() + margin);
    }
    std::vector<Convex> all;
    for (std::size_t i = 0; i < body.size(); ++i) all.push_back(body.convex_piece(i).swollen(margin));
    return Assembly::convexes(std::move(all));
  }
};

}  // namespace

Body swollen(const Body& body, double margin) {
  if (!(std::isfinite(margin) && margin >= 0))
    throw InputError("margin", to_text(margin), "a finite number >= 0 (m)");
  return margin == 0 ? body : std::visit(Swell{margin}, body.shape());
}

Ellipsoid Placed::containing_ellipsoid() const { return in_world(body.containing_ellipsoid(), pose); }

}  // namespace vericone
