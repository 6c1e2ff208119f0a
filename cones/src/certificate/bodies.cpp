// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/bodies.h"

#include <vericone/internal/geometry/rotation.h>
#include <algorithm>
#include <numeric>
#include <variant>

namespace vericone::certificates {

using Eigen::Vector3d;

int Piece::grid() const {
  int e = kNoGrid;
  for (const Vector3d& x : corners) e = std::min(e, grid_of(x));
  if (const Ellipsoid* body = round()) e = std::min({e, grid_of(body->center()), grid_of_matrix(*body)});
  return e;
}

Convex Piece::on(int grid, const Vector3d& at) const {
  const Vector place = on_grid(at, grid);
  Convex body;
  if (const Ellipsoid* own = round()) {
    body.points.push_back(place + on_grid(own->center(), grid));
    body.round.emplace(*own, grid);
    return body;
  }
  body.points.reserve(corners.size());
  for (const Vector3d& x : corners) body.points.push_back(place + on_grid(x, grid));
  return body;
}

Stated::Stated(const Placed& placed) : at_(placed.pose.position) {
  Pose turn;  // about the body's own origin
  turn.rotation = placed.pose.rotation;
  std::visit([&](const auto& shape) { take(shape, turn); }, placed.body.shape());
}

void Stated::take(const CombinedEllipsoid& body, const Pose& pose) {
  quadrics_.push_back(is_upright(pose) ? body : in_world(body, pose));
}

void Stated::take(const HullBody& body, const Pose& pose) {
  kind_ = Kind::hull;
  points_ = is_upright(pose) ? body.points() : in_world(body, pose).points();
}

void Stated::take(const vericone::Convex& body, const Pose& pose) {
  if (!body.is_hull()) {
    kind_ = Kind::convex;
    convexes_.push_back(is_upright(pose) ? body : in_world(body, pose));
    return;
  }
  std::vector<Vector3d> points;
  for (const auto& piece : body.pieces()) points.push_back(piece.center);
  take(HullBody(std::move(points)), pose);
}

void Stated::take(const std::vector<CombinedEllipsoid>& bodies, const Pose& pose) {
  kind_ = Kind::quadrics;
  count_ = bodies.size();
  for (const CombinedEllipsoid& body : bodies) take(body, pose);
}

void Stated::take(const Assembly& body, const Pose& pose) {
  count_ = body.size();
  radius_ = body.radius();
  rounded_ = !is_upright(pose);
  const Assembly::Storage& storage = body.by_slot();
  const auto order = body.hierarchy().order();
  const auto in_order = [&](const auto& by_slot, auto& list) {
    list.assign(by_slot.begin(), by_slot.end());
    for (std::size_t slot = 0; slot < by_slot.size(); ++slot) list[order[slot]] = by_slot[slot];
  };
  switch (body.kind()) {
    case PieceKind::triangle:
      kind_ = Kind::mesh;
      take_triangles(body);
      break;
    case PieceKind::ball:
      kind_ = Kind::cloud;
      in_order(storage.balls, points_);
      break;
    case PieceKind::hull:
      kind_ = Kind::hulls;
      in_order(storage.hulls, hulls_);
      break;
    case PieceKind::convex:
      kind_ = Kind::convexes;
      in_order(storage.convexes, convexes_);
      break;
    case PieceKind::box:
      kind_ = rounded_ ? Kind::hulls : Kind::boxes;
      in_order(storage.boxes, boxes_);
      if (rounded_)
        for (const Box& box : boxes_) hulls_.push_back(HullBody::box(box.low, box.high));
      break;
  }
  if (!rounded_) return;
  for (Vector3d& x : points_) x = pose.to_world(x);
  for (HullBody& hull : hulls_) hull = in_world(hull, pose);
  for (vericone::Convex& convex : convexes_) convex = in_world(convex, pose);
}

/// Each point once.
void Stated::take_triangles(const Assembly& body) {
  const auto& by_slot = body.by_slot().triangles;
  const auto order = body.hierarchy().order();
  std::vector<std::uint32_t> corner(3 * by_slot.size());
  const auto at = [&](std::uint32_t i) -> const Vector3d& { return by_slot[i / 3][i % 3]; };
  std::iota(corner.begin(), corner.end(), 0);
  std::sort(corner.begin(), corner.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Vector3d &x = at(i), &y = at(j);
    return x.x() != y.x() ? x.x() < y.x() : x.y() != y.y() ? x.y() < y.y() : x.z() < y.z();
  });
  triangles_.resize(by_slot.size());
  for (const std::uint32_t i : corner) {
    if (points_.empty() || at(i) != points_.back()) points_.push_back(at(i));
    triangles_[order[i / 3]][i % 3] = static_cast<std::uint32_t>(points_.size() - 1);
  }
}

Piece Stated::piece(std::size_t i) const {
  Piece piece;
  switch (kind_) {
    case Kind::quadric:
    case Kind::quadrics:
      piece.quadric = &quadrics_[i];
      break;
    case Kind::hull:
      piece.corners = points_;
      break;
    case Kind::mesh:
      for (const std::uint32_t k : triangles_[i]) piece.corners.push_back(points_[k]);
      break;
    case Kind::cloud:
      piece.is_ball = true;
      if (radius_ > 0)
        piece.ball = Ellipsoid::from_axes(points_[i], Vector3d::Constant(radius_));
      else
        piece.corners = {points_[i]};
      break;
    case Kind::boxes:
      piece.corners = HullBody::box(boxes_[i].low, boxes_[i].high).points();
      break;
    case Kind::hulls:
      piece.corners = hulls_[i].points();
      break;
    case Kind::convex:
    case Kind::convexes:
      piece.convex = &convexes_[i];
      break;
  }
  return piece;
}

namespace {

void write_matrix(Text& text, const Eigen::Matrix3d& m) {
  text.raw("[");
  for (int i = 0; i < 3; ++i) text.raw(i ? ", " : "").number(Vector3d(m.row(i).transpose()));
  text.raw("]");
}

void write_list(Text& text, const std::vector<Vector3d>& points) {
  text.raw("[");
  for (std::size_t i = 0; i < points.size(); ++i) text.raw(i ? ", " : "").number(points[i]);
  text.raw("]");
}

}  // namespace

/// Where its own center stands, a sum that is not rounded.
void Stated::write_center(Text& text, const Vector3d& own) const {
  const int grid = std::min(grid_of(own), grid_of(at_));
  if (grid == kNoGrid) return;
  text.raw(", \"center\": ").number(on_grid(own, grid) + on_grid(at_, grid), grid);
}

void Stated::write_quadric(Text& text, const CombinedEllipsoid& body) const {
  const Ellipsoid& own = body.ellipsoid();
  text.raw(body.is_ellipsoid() ? "{\"kind\": \"ellipsoid\"" : "{\"kind\": \"delimited\"");
  write_center(text, own.center());
  write_matrix(text.raw(own.defined_by_factor() ? ", \"factor\": " : ", \"shape\": "),
               own.defined_by_factor() ? own.factor() : own.shape());
  if (body.is_ellipsoid()) return;
  text.raw(", \"delimiters\": [");
  const char* between = "";
  for (const Delimiter<3>& delimiter : body.delimiters()) {
    write_matrix(text.raw(between).raw("{\"matrix\": "), delimiter.matrix);
    text.raw(", \"level\": ").number(delimiter.level).raw("}");
    between = ", ";
  }
  text.raw("]");
}

void Stated::write_convex(Text& text, const vericone::Convex& body) const {
  text.raw("{\"kind\": \"convex\"");
  write_center(text, Vector3d::Zero());
  const char* between = ", \"parts\": [{";
  for (const auto& part : body.pieces()) {
    text.raw(between).raw("\"center\": ").number(part.center);
    if (part.rank > 0)
      write_matrix(text.raw(part.shape ? ", \"shape\": " : ", \"factor\": "),
                   part.shape ? *part.shape : part.factor);
    between = "}, {";
  }
  text.raw("}]");
  if (body.margin() > 0) text.raw(", \"margin\": ").number(body.margin());
}

void Stated::write(Text& text, const Vector3d* velocity) const {
  const auto pieces = [&](std::size_t count, const auto& write_piece) {
    text.raw("{\"kind\": \"union\", \"pieces\": [");
    for (std::size_t i = 0; i < count; ++i) {
      text.raw(i ? ", " : "");
      write_piece(i);
      text.raw("}");
    }
    text.raw("]");
  };
  switch (kind_) {
    case Kind::quadric:
      write_quadric(text, quadrics_.front());
      break;
    case Kind::quadrics:
      pieces(quadrics_.size(), [&](std::size_t i) { write_quadric(text, quadrics_[i]); });
      break;
    case Kind::convex:
      write_convex(text, convexes_.front());
      break;
    case Kind::convexes:
      pieces(convexes_.size(), [&](std::size_t i) { write_convex(text, convexes_[i]); });
      break;
    case Kind::hulls:
      pieces(hulls_.size(), [&](std::size_t i) {
        text.raw("{\"kind\": \"hull\"");
        write_center(text, Vector3d::Zero());
        write_list(text.raw(", \"points\": "), hulls_[i].points());
      });
      break;
    case Kind::hull:
    case Kind::mesh:
    case Kind::cloud:
      text.raw(kind_ == Kind::hull   ? "{\"kind\": \"hull\""
               : kind_ == Kind::mesh ? "{\"kind\": \"mesh\""
                                     : "{\"kind\": \"cloud\"");
      write_center(text, Vector3d::Zero());
      write_list(text.raw(", \"points\": "), points_);
      if (kind_ == Kind::cloud) text.raw(", \"radius\": ").number(radius_);
      if (kind_ != Kind::mesh) break;
      text.raw(", \"triangles\": [");
      for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto& t = triangles_[i];
        text.raw(i ? ", [" : "[").index(t[0]).raw(", ").index(t[1]).raw(", ").index(t[2]).raw("]");
      }
      text.raw("]");
      break;
    case Kind::boxes:
      text.raw("{\"kind\": \"boxes\"");
      write_center(text, Vector3d::Zero());
      text.raw(", \"boxes\": [");
      for (std::size_t i = 0; i < boxes_.size(); ++i) {
        text.raw(i ? ", [" : "[").number(boxes_[i].low).raw(", ").number(boxes_[i].high).raw("]");
      }
      text.raw("]");
      break;
  }
  if (velocity) text.raw(", \"velocity\": ").number(*velocity);
  text.raw("}");
}

}  // namespace vericone::certificates
