// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies made of very many convex pieces: meshes, point clouds, maps of cells, convex polyhedra.
#pragma once

#include <vericone/geometry/convex.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/geometry/pose.h>
#include <vericone/internal/geometry/hierarchy.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace vericone {

/// What the pieces of an assembly are.
enum class PieceKind : std::uint8_t {
  triangle,  // flat, with its edges; the inside of a closed mesh is not part of the body
  ball,      // about each point, all of one radius, which may be 0
  box,       // solid, axis-aligned in the body's frame
  hull,      // solid convex hulls of points
  convex,    // convex bodies of flat, round and straight parts
};
[[nodiscard]] const char* to_string(PieceKind kind);

/// The union of many convex pieces of one kind in the body's own frame, metres. Immutable; copies share. What
/// is proved about an assembly is proved of the coordinates as stored.
class Assembly {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// A triangle mesh, open or closed; corners are indices into `points`. Degenerate triangles are segments
  /// and points. Points of no triangle are not part of it. Throws InputError naming "points[i][k]" (not
  /// finite), "triangles[i][k]" (no such point), "triangles" (none, or more than 2^31).
  [[nodiscard]] static Assembly mesh(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles);

  /// Balls of one radius >= 0 about points. Throws InputError naming "points", "points[i][k]" or "radius".
  [[nodiscard]] static Assembly cloud(std::vector<Eigen::Vector3d> points, double radius);

  /// Solid boxes, low <= high. Throws InputError naming "boxes" or "boxes[i].low[k]" or "boxes[i].high[k]".
  [[nodiscard]] static Assembly boxes(std::vector<Box> boxes);

  /// Solid convex polyhedra. Throws InputError naming "hulls".
  [[nodiscard]] static Assembly polyhedra(std::vector<HullBody> hulls);

  /// Cylinders, capsules and other convex bodies. Throws InputError naming "pieces".
  [[nodiscard]] static Assembly convexes(std::vector<Convex> pieces);

  [[nodiscard]] PieceKind kind() const;
  /// Number of pieces.
  [[nodiscard]] std::size_t size() const;
  /// Of the balls; 0 for other kinds.
  [[nodiscard]] double radius() const;
  /// Around all pieces.
  [[nodiscard]] const Box& bounds() const;

  [[nodiscard]] const Hierarchy& hierarchy() const;

  /// The points whose convex hull, rounded by radius(), is piece i (0 <= i < size(), in the order given).
  /// Of a convex body that is no hull: points whose hull, rounded by its margin, contains it.
  [[nodiscard]] HullBody piece(std::size_t i) const;
  /// Piece i, whatever its kind.
  [[nodiscard]] Convex convex_piece(std::size_t i) const;

  /// Those of all pieces, by slot: their convex hull, rounded by radius(), is that of the body; of convex
  /// bodies, contains it. Metres.
  [[nodiscard]] std::vector<Eigen::Vector3d> corners() const;

  /// The pieces by *slot* of the hierarchy, so that those of a leaf lie side by side. Only that of kind() is
  /// filled.
  struct Storage {
    std::vector<std::array<Eigen::Vector3d, 3>> triangles;  // m
    std::vector<Eigen::Vector3d> balls;                     // m
    std::vector<Box> boxes;
    std::vector<HullBody> hulls;
    std::vector<Convex> convexes;
  };
  [[nodiscard]] const Storage& by_slot() const;

 private:
  struct Data;
  explicit Assembly(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace vericone
