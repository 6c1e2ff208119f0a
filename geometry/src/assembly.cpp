// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/assembly.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/requires.h>
#include <cmath>
#include <string>

namespace vericone {
namespace {

void require_finite(const std::string& field, const Eigen::Vector3d& x) {
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(x(k)))
      throw InputError(field + "[" + std::to_string(k) + "]", to_text(x(k)), "a finite number (m)");
}

/// Pieces between two checkpoints.
constexpr std::size_t kPiecesWorthAsking = 4096;

std::string at(const char* field, std::size_t i) {
  return std::string(field) + "[" + std::to_string(i) + "]";
}

// Slots are 32 bits wide; a tree has fewer than twice as many nodes as slots.
void require_count(const char* field, std::size_t count, const char* one) {
  if (count == 0) throw InputError(field, std::string("no ") + one, std::string("one ") + one + " or more");
  if (count >= (std::size_t(1) << 31))
    throw InputError(field, std::to_string(count), "fewer than 2^31 of them");
}

template <class Points>
Box bounds_of(const Points& points) {
  Box box{points[0], points[0]};
  for (const Eigen::Vector3d& x : points) box.include({x, x});
  return box;
}

/// Outwards by one rounding, so that the ball about x is inside.
Box around(const Eigen::Vector3d& x, double radius) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.low(k) = x(k) - radius;
    box.high(k) = x(k) + radius;
    if (radius > 0) {
      box.low(k) = std::nextafter(box.low(k), -INFINITY);
      box.high(k) = std::nextafter(box.high(k), INFINITY);
    }
  }
  return box;
}

}  // namespace

const char* to_string(PieceKind kind) {
  switch (kind) {
    case PieceKind::triangle:
      return "triangle";
    case PieceKind::ball:
      return "ball";
    case PieceKind::box:
      return "box";
    case PieceKind::hull:
      return "hull";
    case PieceKind::convex:
      return "convex";
  }
  return "";
}

struct Assembly::Data {
  PieceKind kind = PieceKind::triangle;
  double radius = 0;
  Box bounds;
  Hierarchy hierarchy;
  Storage storage;
  std::vector<std::uint32_t> slot;  // of each piece

  /// Sorts `pieces` into slots.
  template <class Piece>
  void place(const std::vector<Box>& boxes, std::vector<Piece> pieces, std::vector<Piece> Storage::*where) {
    bounds = boxes.front();
    for (const Box& box : boxes) bounds.include(box);
    hierarchy = Hierarchy(boxes);
    slot.resize(pieces.size());
    std::vector<Piece>& placed = storage.*where;
    placed.reserve(pieces.size());
    for (const std::uint32_t i : hierarchy.order()) {
      if (placed.size() % kPiecesWorthAsking == 0) checkpoint();
      slot[i] = static_cast<std::uint32_t>(placed.size());
      placed.push_back(std::move(pieces[i]));
    }
  }
};

Assembly Assembly::mesh(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles) {
  require_count("triangles", triangles.size(), "triangle");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite()) require_finite(at("points", i), points[i]);
  std::vector<std::array<Eigen::Vector3d, 3>> pieces(triangles.size());
  std::vector<Box> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i % kPiecesWorthAsking == 0) checkpoint();
    for (std::size_t k = 0; k < 3; ++k) {
      if (triangles[i][k] >= points.size())
        throw InputError(at("triangles", i) + "[" + std::to_string(k) + "]", std::to_string(triangles[i][k]),
                         "the index of one of the " + std::to_string(points.size()) + " points");
      pieces[i][k] = points[triangles[i][k]];
    }
    boxes[i] = bounds_of(pieces[i]);
  }
  auto data = std::make_shared<Data>();
  data->kind = PieceKind::triangle;
  data->place(boxes, std::move(pieces), &Storage::triangles);
  return Assembly(std::move(data));
}

Assembly Assembly::cloud(std::vector<Eigen::Vector3d> points, double radius) {
  require_count("points", points.size(), "point");
  if (!std::isfinite(radius) || radius < 0)
    throw InputError("radius", to_text(radius), "a finite number >= 0 (m)");
  std::vector<Box> boxes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kPiecesWorthAsking == 0) checkpoint();
    if (!points[i].allFinite()) require_finite(at("points", i), points[i]);
    boxes[i] = around(points[i], radius);
  }
  auto data = std::make_shared<Data>();
  data->kind = PieceKind::ball;
  data->radius = radius;
  data->place(boxes, std::move(points), &Storage::balls);
  return Assembly(std::move(data));
}

Assembly Assembly::boxes(std::vector<Box> boxes) {
  require_count("boxes", boxes.size(), "box");
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % kPiecesWorthAsking == 0) checkpoint();
    require_finite(at("boxes", i) + ".low", boxes[i].low);
    require_finite(at("boxes", i) + ".high", boxes[i].high);
    for (int k = 0; k < 3; ++k)
      if (boxes[i].low(k) > boxes[i].high(k))
        throw InputError(at("boxes", i) + ".low[" + std::to_string(k) + "]", to_text(boxes[i].low(k)),
                         "at most high, " + to_text(boxes[i].high(k)));
  }
  auto data = std::make_shared<Data>();
  data->kind = PieceKind::box;
  std::vector<Box> pieces = boxes;
  data->place(boxes, std::move(pieces), &Storage::boxes);
  return Assembly(std::move(data));
}

Assembly Assembly::polyhedra(std::vector<HullBody> hulls) {
  require_count("hulls", hulls.size(), "polyhedron");
  std::vector<Box> boxes(hulls.size());
  for (std::size_t i = 0; i < hulls.size(); ++i) boxes[i] = bounds_of(hulls[i].points());
  auto data = std::make_shared<Data>();
  data->kind = PieceKind::hull;
  data->place(boxes, std::move(hulls), &Storage::hulls);
  return Assembly(std::move(data));
}

Assembly Assembly::convexes(std::vector<Convex> pieces) {
  require_count("pieces", pieces.size(), "body");
  std::vector<Box> boxes(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) boxes[i] = pieces[i].bounds();
  auto data = std::make_shared<Data>();
  data->kind = PieceKind::convex;
  data->place(boxes, std::move(pieces), &Storage::convexes);
  return Assembly(std::move(data));
}

PieceKind Assembly::kind() const { return data_->kind; }
std::size_t Assembly::size() const { return data_->slot.size(); }
double Assembly::radius() const { return data_->radius; }
const Box& Assembly::bounds() const { return data_->bounds; }
const Hierarchy& Assembly::hierarchy() const { return data_->hierarchy; }
const Assembly::Storage& Assembly::by_slot() const { return data_->storage; }

std::vector<Eigen::Vector3d> Assembly::corners() const {
  std::vector<Eigen::Vector3d> all;
  const auto add = [&](const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
  const Storage& storage = data_->storage;
  switch (data_->kind) {
    case PieceKind::triangle:
      for (const auto& triangle : storage.triangles) add(triangle);
      break;
    case PieceKind::ball:
      add(storage.balls);
      break;
    case PieceKind::box:
      for (const Box& box : storage.boxes) add(HullBody::box(box.low, box.high).points());
      break;
    case PieceKind::hull:
      for (const HullBody& hull : storage.hulls) add(hull.points());
      break;
    case PieceKind::convex:
      for (const Convex& body : storage.convexes)
        for (const Eigen::Vector3d& x : body.corners()) {
          const Eigen::Vector3d beside = Eigen::Vector3d::Constant(body.margin());
          add(HullBody::box(x - beside, x + beside).points());
        }
      break;
  }
  return all;
}

HullBody Assembly::piece(std::size_t i) const {
  VERICONE_REQUIRES(i < size(), "i", "no such piece", "below size()");
  const std::size_t slot = data_->slot.at(i);
  const Storage& storage = data_->storage;
  switch (data_->kind) {
    case PieceKind::triangle:
      return HullBody({storage.triangles[slot].begin(), storage.triangles[slot].end()});
    case PieceKind::ball:
      return HullBody({storage.balls[slot]});
    case PieceKind::box:
      return HullBody::box(storage.boxes[slot].low, storage.boxes[slot].high);
    case PieceKind::hull:
      return storage.hulls[slot];
    case PieceKind::convex:
      break;
  }
  return HullBody(storage.convexes[slot].corners());
}

Convex Assembly::convex_piece(std::size_t i) const {
  if (kind() != PieceKind::convex) return Convex::rounded(piece(i), radius());
  VERICONE_REQUIRES(i < size(), "i", "no such piece", "below size()");
  return data_->storage.convexes[data_->slot[i]];
}

}  // namespace vericone
