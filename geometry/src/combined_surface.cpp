// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/mesh/surface.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "mesh/surface_mesh.h"

namespace vericone {
namespace {

void require_resolution(double resolution, double least) {
  if (!(resolution >= least && resolution <= 1))
    throw InputError("resolution", to_text(resolution), "between " + to_text(least) + " and 1");
}

void require_vertices(const CombinedSurface& surface) {
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = surface.triangles[i].vertices[k];
      if (v < 0 || static_cast<std::size_t>(v) >= surface.vertices.size())
        throw InputError("triangles[" + std::to_string(i) + "].vertices[" + std::to_string(k) + "]",
                         std::to_string(v),
                         "the index of one of the " + std::to_string(surface.vertices.size()) + " vertices");
    }
}

/// Leaves out the vertices that no triangle uses.
CombinedSurface compacted(const CombinedSurface& all) {
  CombinedSurface kept;
  std::vector<int> index(all.vertices.size(), -1);
  for (CombinedSurface::Triangle t : all.triangles) {
    for (int& v : t.vertices) {
      int& i = index[static_cast<std::size_t>(v)];
      if (i < 0) {
        i = static_cast<int>(kept.vertices.size());
        kept.vertices.push_back(all.vertices[static_cast<std::size_t>(v)]);
      }
      v = i;
    }
    kept.triangles.push_back(t);
  }
  return kept;
}

void append_point(std::string& text, const Eigen::Vector3d& p) {
  text.append(to_text(p.x()))
      .append(" ")
      .append(to_text(p.y()))
      .append(" ")
      .append(to_text(p.z()))
      .append("\n");
}

}  // namespace

CombinedSurface surface(const CombinedEllipsoid& body, double resolution) {
  require_resolution(resolution, 0.005);
  const SurfaceMesh mesh(forms::whitened_forms<3>(body), resolution);
  CombinedSurface all;
  const Eigen::Matrix3d f = body.ellipsoid().factor();
  std::vector<int> index;
  int centre = -1;
  for (const auto& node : mesh.nodes()) {
    const double r = mesh.radius(node);
    index.push_back(static_cast<int>(all.vertices.size()));
    if (r == 0 && centre < 0) centre = index.back();
    if (r == 0) index.back() = centre;
    if (index.back() == static_cast<int>(all.vertices.size()))
      all.vertices.push_back(body.center() + f * (r * node.direction));
  }
  const bool mirrored = f.determinant() < 0;
  for (const auto& t : mesh.triangles()) {
    auto [a, b, c] = t.nodes;
    a = index[static_cast<std::size_t>(a)];
    b = index[static_cast<std::size_t>(b)];
    c = index[static_cast<std::size_t>(c)];
    if (a == b || b == c || c == a) continue;  // shrunk to the pinched centre
    all.triangles.push_back({{a, mirrored ? c : b, mirrored ? b : c}, t.form});
  }
  return compacted(all);
}

CombinedSurface part(const CombinedSurface& surface, SurfacePart which) {
  require_vertices(surface);
  CombinedSurface chosen{surface.vertices, {}};
  for (const auto& t : surface.triangles)
    if ((t.quadric == 0) == (which == SurfacePart::ellipsoid)) chosen.triangles.push_back(t);
  return compacted(chosen);
}

std::vector<std::array<int, 2>> rims(const CombinedSurface& surface) {
  require_vertices(surface);
  std::map<std::pair<int, int>, int> first;
  std::vector<std::array<int, 2>> found;
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = t.vertices[k], j = t.vertices[(k + 1) % 3];
      const auto [it, isnew] = first.try_emplace(std::minmax(i, j), t.quadric);
      if (!isnew && it->second != t.quadric) found.push_back({std::min(i, j), std::max(i, j)});
    }
  return found;
}

double enclosed_volume(const CombinedSurface& surface) {
  require_vertices(surface);
  if (surface.vertices.empty()) return 0;
  const Eigen::Vector3d origin = surface.vertices.front();  // near the body: no cancellation
  double sum = 0;
  for (const auto& t : surface.triangles) {
    const auto at = [&](std::size_t k) -> Eigen::Vector3d {
      return surface.vertices[static_cast<std::size_t>(t.vertices[k])] - origin;
    };
    sum += at(0).dot(at(1).cross(at(2)));
  }
  return sum / 6;
}

std::string to_obj(const CombinedSurface& surface) {
  std::string text = "# surface of a combined quadric, metres\n";
  for (const auto& p : surface.vertices) append_point(text.append("v "), p);
  require_vertices(surface);
  std::set<int> quadrics;
  for (const auto& t : surface.triangles) quadrics.insert(t.quadric);
  for (const int i : quadrics) {
    text.append("g quadric_").append(std::to_string(i)).append("\n");
    for (const auto& t : surface.triangles) {
      if (t.quadric != i) continue;
      text.append("f");
      for (const int v : t.vertices) text.append(" ").append(std::to_string(v + 1));
      text.append("\n");
    }
  }
  return text;
}

std::string to_ply(const CombinedSurface& surface) {
  std::string text = "ply\nformat ascii 1.0\ncomment surface of a combined quadric, metres\nelement vertex " +
                     std::to_string(surface.vertices.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(surface.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nproperty int quadric\nend_header\n";
  require_vertices(surface);
  for (const auto& p : surface.vertices) append_point(text, p);
  for (const auto& t : surface.triangles) {
    text.append("3");
    for (const int v : t.vertices) text.append(" ").append(std::to_string(v));
    text.append(" ").append(std::to_string(t.quadric)).append("\n");
  }
  return text;
}

std::vector<BoundaryArc> outline(const CombinedEllipse& body, double resolution) {
  require_resolution(resolution, 1e-4);
  using Eigen::Vector2d;
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto all = forms::whitened_forms<2>(body);
  const Eigen::Matrix2d f = body.ellipsoid().factor();
  const auto unit = [](double t) { return Vector2d(std::cos(t), std::sin(t)); };
  std::vector<double> angles;  // of corners, whitened
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const Eigen::Matrix2d h = forms::difference<2>(all[i], all[j]).matrix;
      const forms::Roots r = forms::roots(h(0, 0), h(0, 1), h(1, 1));
      for (int k = 0; k < r.count; ++k)
        for (const double s : {1.0, -1.0})
          angles.push_back(std::atan2(s * r.direction[k].y(), s * r.direction[k].x()));
    }
  std::sort(angles.begin(), angles.end());
  if (angles.empty()) angles.push_back(0);
  std::vector<BoundaryArc> arcs;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double from = angles[i], to = i + 1 < angles.size() ? angles[i + 1] : angles[0] + kTurn;
    if (!(to > from)) continue;
    const int conic = forms::active_form<2>(all, unit(0.5 * (from + to)));
    const auto& form = all[static_cast<std::size_t>(conic)];
    const auto at = [&](double t) -> Vector2d {
      const Vector2d u = unit(t);
      return body.center() + f * (std::sqrt(form.level / form(u)) * u);
    };
    std::vector<Vector2d> points;
    if (form.level > 0) {
      const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / resolution)));
      // Ends of an arc get more points: a deep dent is steep there.
      for (int k = 0; k <= steps; ++k) {
        const double s = 0.5 - 0.5 * std::cos(std::numbers::pi * k / steps);
        points.push_back(at(from + s * (to - from)));
      }
    } else {
      // Both straight lines of a pinched conic, to the centre and out again.
      points = {body.center()};
    }
    if (!arcs.empty() && arcs.back().conic == conic) {
      arcs.back().points.insert(arcs.back().points.end(), points.begin() + 1, points.end());
    } else {
      arcs.push_back({conic, std::move(points)});
    }
  }
  if (arcs.size() > 1 && arcs.front().conic == arcs.back().conic) {
    arcs.back().points.insert(arcs.back().points.end(), arcs.front().points.begin() + 1,
                              arcs.front().points.end());
    arcs.front() = std::move(arcs.back());
    arcs.pop_back();
  }
  // The lines of a pinched arc end in its neighbours' ends.
  for (std::size_t i = 0; i < arcs.size(); ++i)
    if (arcs[i].points.size() == 1) {
      const auto& before = arcs[(i + arcs.size() - 1) % arcs.size()].points;
      const auto& after = arcs[(i + 1) % arcs.size()].points;
      arcs[i].points = {before.back(), arcs[i].points.front(), after.front()};
    }
  return arcs;
}

}  // namespace vericone
