// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <limits>
#include <numeric>

#include "point_merger.h"

namespace vericone::files {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool has_repeated_index(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// `items` in the order of their keys, which are below `bound`; equal keys stay in their order. Linear time.
template <typename Key>
std::vector<std::uint32_t> ordered(const std::vector<std::uint32_t>& items, std::size_t bound,
                                   const Key& key) {
  std::vector<std::uint32_t> next(bound + 1, 0), out(items.size());
  for (const std::uint32_t i : items) ++next[key(i) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const std::uint32_t i : items) out[next[key(i)]++] = i;
  return out;
}

/// Corners 3 t + k stand for the edges from corner k of triangle t to the next.
struct Edges {
  const std::vector<Triangle>& triangles;

  std::uint32_t from(std::uint32_t i) const { return triangles[i / 3][i % 3]; }
  std::uint32_t to(std::uint32_t i) const { return triangles[i / 3][(i + 1) % 3]; }
  std::uint32_t low(std::uint32_t i) const { return std::min(from(i), to(i)); }
  std::uint32_t high(std::uint32_t i) const { return std::max(from(i), to(i)); }
};

void count_edges(const TriangleMesh& mesh, MeshReport& report) {
  const Edges edges{mesh.triangles};
  std::vector<std::uint32_t> items;
  items.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!has_repeated_index(mesh.triangles[t]))
      for (std::size_t k = 0; k < 3; ++k) items.push_back(std::uint32_t(3 * t + k));
  items = ordered(items, mesh.points.size(), [&](std::uint32_t i) { return edges.high(i); });
  items = ordered(items, mesh.points.size(), [&](std::uint32_t i) { return edges.low(i); });
  for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
    std::size_t upwards = 0;
    const std::uint32_t low = edges.low(items[first]), high = edges.high(items[first]);
    for (; last < items.size() && edges.low(items[last]) == low && edges.high(items[last]) == high; ++last)
      upwards += edges.from(items[last]) == low;
    const std::size_t all = last - first, downwards = all - upwards;
    ++report.edges;
    report.boundary_edges += all == 1;
    report.nonmanifold_edges += all > 2;
    report.odd_edges += all % 2;
    report.misoriented_edges += std::max(upwards, downwards) - std::min(upwards, downwards) > 1;
  }
}

/// Triangles with the corners of another before them.
std::vector<char> duplicates(const TriangleMesh& mesh) {
  const auto corner = [&](std::uint32_t t, std::size_t rank) {
    Triangle sorted = mesh.triangles[t];
    std::ranges::sort(sorted);
    return sorted[rank];
  };
  std::vector<std::uint32_t> items;
  items.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!has_repeated_index(mesh.triangles[t])) items.push_back(std::uint32_t(t));
  for (const std::size_t rank : {2, 1, 0})
    items = ordered(items, mesh.points.size(), [&](std::uint32_t t) { return corner(t, rank); });
  const auto same = [&](std::uint32_t s, std::uint32_t t) {
    return corner(s, 0) == corner(t, 0) && corner(s, 1) == corner(t, 1) && corner(s, 2) == corner(t, 2);
  };
  std::vector<char> repeated(mesh.triangles.size(), 0);
  for (std::size_t i = 1; i < items.size(); ++i) repeated[items[i]] = same(items[i - 1], items[i]);
  return repeated;
}

void merge_points(PointFile& file) {
  std::vector<Eigen::Vector3d> points;
  PointMerger merger(points);
  std::vector<std::uint32_t> index(file.points.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = merger.index(file.points[i]);
  for (Face& face : file.faces)
    for (std::uint32_t& corner : face) corner = index[corner];
  file.points = std::move(points);
}

}  // namespace

TriangleMesh triangle_mesh(PointFile file, const MeshOptions& options) {
  if (file.faces.empty())
    throw InputError("faces", "a cloud of " + std::to_string(file.points.size()) + " points",
                     "a mesh, with at least one face");
  for (std::size_t i = 0; i < file.points.size(); ++i)
    if (!file.points[i].allFinite())
      throw InputError("points[" + std::to_string(i) + "]", "a number that is not finite", "finite");
  for (std::size_t i = 0; i < file.faces.size(); ++i)
    for (const std::uint32_t corner : file.faces[i])
      if (corner >= file.points.size())
        throw InputError("faces[" + std::to_string(i) + "]", std::to_string(corner),
                         "indices of points, below " + std::to_string(file.points.size()));
  if (options.merge_equal_points) merge_points(file);
  TriangleMesh mesh;
  MeshReport& report = mesh.report;
  for (const Face& face : file.faces) report.polygons += face.size() > 3;
  mesh.triangles = triangles_of(file.points, file.faces);
  file.faces = {};
  mesh.points = std::move(file.points);
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max() / 3)
    throw InputError("faces", std::to_string(mesh.triangles.size()) + " triangles", "at most 1431655765");

  const auto is_degenerate = [&](const Triangle& t) {
    return has_repeated_index(t) || are_collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  };
  if (options.drop_degenerate)
    report.degenerate_triangles = std::erase_if(mesh.triangles, is_degenerate);
  else
    report.degenerate_triangles = std::size_t(std::ranges::count_if(mesh.triangles, is_degenerate));

  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = 1;
  report.unreferenced_points = std::size_t(std::ranges::count(used, 0));
  const std::vector<char> repeated = duplicates(mesh);
  report.duplicate_triangles = std::size_t(std::ranges::count(repeated, 1));
  if (options.drop_duplicates) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < repeated.size(); ++t)
      if (!repeated[t]) mesh.triangles[kept++] = mesh.triangles[t];
    mesh.triangles.resize(kept);
  }
  count_edges(mesh, report);
  return mesh;
}

}  // namespace vericone::files
