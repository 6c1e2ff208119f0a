// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/fits/fit_files.h>
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <filesystem>

#include "input/assembly_body.h"
#include "input/stopwatch.h"

namespace vericone::fits {
namespace {

std::string count(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

bool less(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

void read_map(Scan& scan) {
  if (!input::have_octrees())
    throw InputError(scan.file, "an octree map",
                     "a mesh or a cloud: this vericone was built without octree maps");
  const scenes::SceneBody body = [&] {
    try {
      return input::read_any_body(scan.file, 0, "free");
    } catch (const InputError& e) {
      // Scenes name the file of a map in the value.
      const std::string name = std::filesystem::path(scan.file).filename().string() + ": ";
      throw InputError(scan.file, e.value().starts_with(name) ? e.value().substr(name.size()) : e.value(),
                       e.requirement());
    }
  }();
  const auto& boxes = body.pieces()->by_slot().boxes;
  scan.kind = ScanKind::octree;
  scan.format = "octree";
  scan.cells = boxes.size();
  auto& points = scan.sample.points;
  points.reserve(8 * boxes.size());
  for (const Box& box : boxes)
    for (int corner = 0; corner < 8; ++corner)
      points.emplace_back((corner & 1 ? box.high : box.low).x(), (corner & 2 ? box.high : box.low).y(),
                          (corner & 4 ? box.high : box.low).z());
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  scan.notes.push_back(
      "of the map its occupied cells are fitted, by their corners; unknown space is taken for free");
}

void read_mesh(Scan& scan, files::PointFile file) {
  const std::size_t read = file.points.size();
  // Triangles without area stay: they are segments of the surface, and to be inside like the rest of it.
  // Those that are there twice enclose what one of them does, or nothing where they are turned round.
  files::TriangleMesh mesh =
      files::triangle_mesh(std::move(file), {.merge_equal_points = true, .drop_duplicates = true});
  const files::MeshReport& report = mesh.report;
  if (report.degenerate_triangles == mesh.triangles.size())
    throw InputError(scan.file, count(mesh.triangles.size(), "triangle", "triangles") + ", none with area",
                     "a mesh with a surface, or a cloud of points");
  scan.kind = ScanKind::mesh;
  if (report.degenerate_triangles)
    scan.notes.push_back(count(report.degenerate_triangles, "triangle has", "triangles have") + " no area");
  if (report.unreferenced_points)
    scan.notes.push_back(count(report.unreferenced_points, "point is", "points are") +
                         " of no face and not part of the mesh");
  if (mesh.points.size() < read)
    scan.notes.push_back(count(read - mesh.points.size(), "point was", "points were") +
                         " there twice and made one");
  if (report.duplicate_triangles)
    scan.notes.push_back(count(report.duplicate_triangles, "triangle was", "triangles were") +
                         " there twice, perhaps turned round, and made one");
  scan.sample.points = std::move(mesh.points);
  scan.sample.triangles = std::move(mesh.triangles);
  if (!report.is_closed())
    scan.notes.push_back("the mesh is open (" + count(report.boundary_edges, "edge", "edges") +
                         " of one triangle), so it has no volume");
  else if (!report.is_oriented())
    scan.notes.push_back("the mesh has no volume: neighbours disagree at " +
                         count(report.misoriented_edges, "edge", "edges") + " which side is outside");
  else if (!fitting::enclosed_volume(scan.sample))
    scan.notes.push_back("the mesh is closed and has no inside, so it has no volume");
}

}  // namespace

Scan read_scan(const std::string& file) {
  const auto start = Clock::now();
  Scan scan;
  scan.file = file;
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".bt" || extension == ".ot") {
    read_map(scan);
  } else {
    files::PointFile read = files::read_points(file);
    scan.format = read.format;
    if (read.trailing_bytes)
      scan.notes.push_back(count(read.trailing_bytes, "byte", "bytes") +
                           " after what the header claims read over: does it count all?");
    if (read.dropped_points)
      scan.notes.push_back(count(read.dropped_points, "point", "points") +
                           " with coordinates that are not finite left out");
    if (read.dropped_faces)
      scan.notes.push_back(count(read.dropped_faces, "face", "faces") + " left out that cannot be drawn");
    if (read.faces.empty()) {
      scan.sample.points = std::move(read.points);
    } else {
      read_mesh(scan, std::move(read));
    }
  }
  scan.seconds = seconds_since(start);
  return scan;
}

std::string describe(const Scan& scan) {
  const std::string points = std::to_string(scan.sample.points.size());
  if (scan.kind == ScanKind::octree)
    return points + " corners of " + count(scan.cells, "occupied cell", "occupied cells");
  if (scan.kind == ScanKind::cloud) return "cloud of " + count(scan.sample.points.size(), "point", "points");
  return "mesh of " + count(scan.sample.triangles.size(), "triangle", "triangles") + " and " + points +
         " points";
}

}  // namespace vericone::fits
