// SPDX-License-Identifier: BSD-3-Clause
#include "fit/hull_files.h"

#include <vericone/geometry/error.h>
#include <cmath>
#include <numbers>

namespace vericone::fit {
namespace {

constexpr double kResolution = 0.08;  // edges in parts of the semi-axes
constexpr int kSides = 96;            // of cylinders and discs

CombinedSurface cylinder(const fitting::Piece& piece) {
  CombinedSurface surface;
  const bool flat = !(piece.low < piece.high);
  const auto triangle = [&](int a, int b, int c, int quadric) {
    surface.triangles.push_back({{a, b, c}, quadric});
  };
  const Ellipse& e = *piece.footprint;
  surface.vertices.emplace_back(e.center().x(), e.center().y(), piece.low);
  surface.vertices.emplace_back(e.center().x(), e.center().y(), piece.high);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const Eigen::Vector2d x = e.center() + e.factor() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    surface.vertices.emplace_back(x.x(), x.y(), piece.low);
    surface.vertices.emplace_back(x.x(), x.y(), piece.high);
  }
  // A factor may reflect; from outside the corners go counter-clockwise all the same.
  const bool reflected = e.factor().determinant() < 0;
  for (int i = 0; i < kSides; ++i) {
    int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % kSides);
    if (reflected) std::swap(a, b);
    triangle(1, a + 1, b + 1, 1);
    if (flat) continue;
    triangle(0, b, a, 1);
    triangle(a, b, b + 1, 0);
    triangle(a, b + 1, a + 1, 0);
  }
  return surface;
}

std::string line(const char* first, const Eigen::Vector3d& x) {
  return first + to_text(x.x()) + " " + to_text(x.y()) + " " + to_text(x.z()) + "\n";
}

}  // namespace

std::vector<CombinedSurface> hull_surfaces(const std::vector<fitting::Piece>& pieces) {
  std::vector<CombinedSurface> surfaces;
  for (const fitting::Piece& piece : pieces)
    surfaces.push_back(piece.footprint ? cylinder(piece) : surface(piece.body, kResolution));
  return surfaces;
}

std::string hull_obj(const std::vector<CombinedSurface>& surfaces) {
  std::string text;
  int before = 1;
  for (std::size_t piece = 0; piece < surfaces.size(); ++piece) {
    const CombinedSurface& s = surfaces[piece];
    for (const Eigen::Vector3d& x : s.vertices) text += line("v ", x);
    int quadrics = 0;
    for (const auto& t : s.triangles) quadrics = std::max(quadrics, t.quadric + 1);
    for (int q = 0; q < quadrics; ++q) {
      text += "g piece_" + std::to_string(piece) + "_quadric_" + std::to_string(q) + "\n";
      for (const auto& t : s.triangles)
        if (t.quadric == q)
          text += "f " + std::to_string(t.vertices[0] + before) + " " +
                  std::to_string(t.vertices[1] + before) + " " + std::to_string(t.vertices[2] + before) +
                  "\n";
    }
    before += static_cast<int>(s.vertices.size());
  }
  return text;
}

std::string hull_ply(const std::vector<CombinedSurface>& surfaces) {
  std::size_t vertices = 0, faces = 0;
  for (const CombinedSurface& s : surfaces) {
    vertices += s.vertices.size();
    faces += s.triangles.size();
  }
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(faces) +
                     "\nproperty list uchar int vertex_indices\nproperty int piece\nproperty int quadric\n"
                     "end_header\n";
  for (const CombinedSurface& s : surfaces)
    for (const Eigen::Vector3d& x : s.vertices) text += line("", x);
  int before = 0;
  for (std::size_t piece = 0; piece < surfaces.size(); ++piece) {
    for (const auto& t : surfaces[piece].triangles) {
      text += "3";
      for (const int i : t.vertices) text += " " + std::to_string(i + before);
      text += " " + std::to_string(piece) + " " + std::to_string(t.quadric) + "\n";
    }
    before += static_cast<int>(surfaces[piece].vertices.size());
  }
  return text;
}

}  // namespace vericone::fit
