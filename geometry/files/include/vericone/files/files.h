// SPDX-License-Identifier: BSD-3-Clause
//
// Points and faces from mesh and point-cloud files; polygons as triangles, convex pieces and bodies.
#pragma once

#include <vericone/geometry/body.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vericone::files {

/// Corners of a polygon as indices into PointFile::points, three or more.
using Face = std::vector<std::uint32_t>;

struct PointFile {
  /// "OFF", "OBJ", "PLY ascii", "PLY binary_little_endian", "PLY binary_big_endian", "STL ascii",
  /// "STL binary", "PCD ascii", "PCD binary", "PCD binary_compressed", "LAS 1.2" or "LAZ 1.2" (its
  /// version), "PTX", "XYZ", "KITTI", "nuScenes", "scan graph", "scan graph text", "glTF 2.0", "glTF 2.0
  /// binary" or "COLLADA 1.4.1" (its version).
  std::string format;

  /// In the unit, frame and order of the file. The double nearest to what is written, however many digits; a
  /// binary float is kept exactly; LAS coordinates are rounded once from integer * scale + offset. Of a scan
  /// graph and of PTX in the world frame, turned and moved in double; of an STL file each point once, in the
  /// order of first use. Of a scene (glTF, COLLADA) as its nodes place them, z up, in metres where the file
  /// says its unit, points that are equal there once. All finite.
  std::vector<Eigen::Vector3d> points;

  /// Empty for a cloud. Triangles, quads and larger polygons as they stand in the file.
  std::vector<Face> faces;

  /// Points of the file with a coordinate that is NaN or infinite, left out of `points`; the indices in
  /// `faces` are those after leaving them out. Of PTX also those from where nothing came back.
  std::size_t dropped_points = 0;

  /// Faces of the file that use a dropped point or have fewer than three corners, left out of `faces`.
  std::size_t dropped_faces = 0;

  /// Of an organised cloud (PCD with more than one row, PTX of one scan) the grid of the file, which `points`
  /// still fills where no point was dropped; 0 otherwise.
  std::size_t width = 0, height = 0;

  /// Bytes after the data that the header of a binary PLY, STL or PCD file claims, read over: more than a few
  /// mean that its counts are too low.
  std::size_t trailing_bytes = 0;

  /// Members of `points` that no member of `faces` uses; for a cloud, all.
  std::size_t unreferenced_points = 0;
};

/// Reads meshes (OFF, OBJ, PLY, STL), scenes of them (glTF, GLB, COLLADA) and clouds (PLY, PCD, LAS, LAZ,
/// PTX, XYZ and kin, KITTI, OctoMap's scan graphs); docs/reference/files.md has what is kept of each and what
/// is refused. Other content (normals, colours, intensities, further PLY elements) is read over; PLY triangle
/// strips become triangles. The format is told by the first bytes where the format has a signature, by the
/// extension otherwise.
///
/// Throws InputError whose field is the path and whose message is one line: for a file that is missing,
/// empty, truncated, longer than its header says (but for `trailing_bytes`), of no known format or malformed
/// anywhere, that has no finite point or whose faces point outside the file. Memory is taken only for what is
/// in the file, not for what its header claims. Time and memory are linear in the size of the file.
[[nodiscard]] PointFile read_points(const std::filesystem::path& path);

/// The faces cut into triangles, n - 2 for n corners. A polygon is looked at along the coordinate axis from
/// which it looks largest: it becomes the fan about its first corner where all of that turns the same way
/// (convex polygons), else its ears are cut one by one, both decided exactly. So a flat polygon is itself; of
/// one that is not flat this choice is made; where it crosses itself as seen along that axis, another along
/// which it looks half as large is tried. Corners on straight edges are kept (triangles without area), as
/// neighbours use them. Throws InputError naming "faces[i]" for one that crosses itself, "faces[i][k]" for a
/// corner that is no finite point. Cost: of a dented polygon, for each triangle that of the corners near it
/// (20,000 corners of a spiral: 0.1 s).
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles_of(
    const std::vector<Eigen::Vector3d>& points, const std::vector<Face>& faces);

/// What is inside of an outline and of no hole, the edges included; metres. Corners either way round.
struct Polygon {
  std::vector<Eigen::Vector2d> outline;
  std::vector<std::vector<Eigen::Vector2d>> holes = {};
};

/// Convex polygons, counter-clockwise, whose union it is, exactly: their corners are its own, and they share
/// no more than edges. One where it is convex; else triangles (ears, of holes joined to the outline first),
/// put together along diagonals while they stay convex: at most four times the fewest pieces (S. Hertel,
/// K. Mehlhorn, "Fast triangulation of simple polygons", 1983). All turns are decided exactly. Throws
/// InputError naming "outline", "outline[i]", "holes[j]" or "holes[j][i]": fewer than three corners, a corner
/// that is not finite, edges that meet elsewhere than neighbours at their corner, a hole that is not within
/// the outline or is within another. Cost: quadratic in the corners (1,000: some milliseconds), with holes at
/// worst cubic.
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> convex_pieces(const Polygon& polygon);

/// The polygon as a body in space, of prisms between z = -height and height (metres): a hull where it is
/// convex, else the union of hulls. At every z its section is the polygon, so that of two bodies raised that
/// way (this, raised() of body.h, their margins) which move in the plane, relation, verdict and contact time
/// are those of the planar bodies, and so are distances. Depths are too where the height is no less than the
/// bodies' sizes. Throws InputError as convex_pieces(), and naming "height".
[[nodiscard]] Body raised(const Polygon& polygon, double height);

// Meshes and clouds to files, so that reading gives the same numbers.

/// Writes points (metres, or any unit) and triangles of indices into them, none for a cloud, in the format of
/// the extension: .ply (binary, little endian, doubles), .obj, .off, .stl (binary; triangles alone), .pcd
/// (binary, doubles) and .xyz (text), the last two for clouds. read_points() then gives the same doubles in
/// the same order; of .stl, whose numbers are floats, each point once in the order of first use.
///
/// The file is there as a whole at the end, or as it was before. Throws InputError naming "path" for another
/// extension, "points[i][k]" for a number that is not finite or, in .stl, no float, "triangles[i][k]" for an
/// index without a point and "triangles" where the format has no triangles or cannot do without;
/// std::system_error naming the path where it cannot be written. Linear in the points and triangles, 0.2 s a
/// million as text.
void write_points(const std::filesystem::path& path, std::span<const Eigen::Vector3d> points,
                  std::span<const std::array<std::uint32_t, 3>> triangles);

/// The same of a cloud.
void write_points(const std::filesystem::path& path, std::span<const Eigen::Vector3d> points);

// A mesh of triangles from what was read, and what is to be known of it.

struct MeshOptions {
  /// Equal points become one (-0 is 0), so that triangles meet that were written with points of their own.
  bool merge_equal_points = false;

  /// Triangles without area are left out. They add nothing to the union of the triangles but points and
  /// segments of its own, so keeping them is harmless.
  bool drop_degenerate = false;

  /// Of triangles with the same three corners, in any order, the first one stays.
  bool drop_duplicates = false;
};

/// Edges are pairs of different corners, named by index; a triangle with an index twice has none.
struct MeshReport {
  /// Faces of more than three corners, which were cut into fans about their first corner: right where they
  /// are convex.
  std::size_t polygons = 0;

  /// Without area: three points on a line, equal points, or an index twice. Decided exactly for the
  /// coordinates as they are. Counted before they are left out, if they are.
  std::size_t degenerate_triangles = 0;

  /// With the same three corners as another before it, in any order. Counted before they are left out, if
  /// they are.
  std::size_t duplicate_triangles = 0;

  /// Points that no triangle uses.
  std::size_t unreferenced_points = 0;

  std::size_t edges = 0;
  std::size_t boundary_edges = 0;     // of one triangle
  std::size_t nonmanifold_edges = 0;  // of three or more
  std::size_t odd_edges = 0;          // of an odd number, boundary edges among them
  std::size_t misoriented_edges = 0;  // run through one way at least twice more often than the other way

  /// Every edge is of an even number of triangles: almost every ray from a point crosses the mesh an even
  /// number of times, or almost every one an odd number, so there is an inside.
  [[nodiscard]] bool is_closed() const { return edges > 0 && odd_edges == 0; }

  /// Neighbours run through their common edge in opposite ways: all see the same side.
  [[nodiscard]] bool is_oriented() const { return misoriented_edges == 0; }
};

struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;  // in the unit of the file
  /// Indices into `points`.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  MeshReport report;
};

/// The mesh of a file. All points are kept, also those that no triangle uses. Throws InputError where the
/// file has no face, or naming "faces[i]" or "points[i]" (finite). Time and memory are linear in the numbers
/// of points and corners; 10 million triangles take seconds (docs/reference/files.md).
[[nodiscard]] TriangleMesh triangle_mesh(PointFile file, const MeshOptions& options = {});

/// Whether three points are on a line; exact.
[[nodiscard]] bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c);

}  // namespace vericone::files
