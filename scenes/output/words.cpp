// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/lengths.h>
#include <vericone/internal/scenes/words.h>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace vericone::scenes {
namespace {

template <int N>
std::string list(const Eigen::Matrix<double, N, 1>& v) {
  std::string text;
  for (int i = 0; i < N; ++i) text += (i ? ", " : "") + brief(v(i));
  return text;
}

template <int N>
std::string at(const Eigen::Matrix<double, N, 1>& center) {
  return ", centre (" + list<N>(center) + ") m";
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// Of bodies without a centre: what box holds them.
std::string within_box(const Placed& body) {
  Eigen::Vector3d low, high;
  for (int i = 0; i < 3; ++i) {
    high(i) = body.support(Eigen::Vector3d::Unit(i));
    low(i) = -body.support(-Eigen::Vector3d::Unit(i));
  }
  return ", within (" + list<3>(low) + ") and (" + list<3>(high) + ") m";
}

template <int D>
std::string quadric_words(const BasicCombined<D>& body) {
  const std::string center = at<D>(body.center());
  std::string text = std::string(D == 2 ? "ellipse" : "ellipsoid") + ", half-lengths " +
                     list<D>(body.ellipsoid().semi_axes()) + " m" + center;
  const std::size_t cuts = body.delimiters().size();
  if (cuts > 0) text += ", cut by " + counted(cuts, D == 2 ? "hyperbola" : "hyperboloid");
  return text;
}

struct Words {
  const Placed& placed;

  std::string operator()(const CombinedEllipsoid& body) const {
    return quadric_words<3>(in_world(body, placed.pose));
  }
  std::string operator()(const HullBody& hull) const {
    return "convex hull of " + counted(hull.size(), "point") + within_box(placed);
  }
  std::string operator()(const Convex& body) const {
    const bool named = body.word() != "convex";
    // Of a capsule the margin is its radius.
    const bool swollen = body.margin() > 0 && body.word() != "capsule";
    return (named ? body.word() : "convex body of " + counted(body.pieces().size(), "piece")) +
           (swollen ? " with a margin of " + brief(body.margin()) + " m" : "") + within_box(placed);
  }
  std::string operator()(const Assembly& pieces) const {
    const std::string box = within_box(placed);
    switch (pieces.kind()) {
      case PieceKind::triangle:
        return "surface of " + counted(pieces.size(), "triangle") + box;
      case PieceKind::ball:
        return counted(pieces.size(), "ball") + " of radius " + brief(pieces.radius()) + " m" + box;
      case PieceKind::box:
        return std::to_string(pieces.size()) + (pieces.size() == 1 ? " solid box" : " solid boxes") + box;
      case PieceKind::hull:
        return "union of " + counted(pieces.size(), "convex hull") + box;
      case PieceKind::convex:
        break;
    }
    return "union of " + counted(pieces.size(), "convex piece") + box;
  }
  std::string operator()(const std::vector<CombinedEllipsoid>& pieces) const {
    return "union of " + counted(pieces.size(), "ellipsoid") + within_box(placed);
  }
};

}  // namespace

std::string brief(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string body_words(const Placed& body) { return std::visit(Words{body}, body.body.shape()); }
std::string body_words(const CombinedEllipse& body) { return quadric_words<2>(body); }

std::vector<std::string> reading_words(const Reading& reading) {
  std::vector<std::string> notes;
  const auto note = [&](std::size_t count, const std::string& what, const std::string& text) {
    if (count > 0) notes.push_back(counted(count, what) + text);
  };
  note(reading.dropped_points, "point", " with coordinates that are not finite left out");
  note(reading.dropped_faces, "face", " left out that cannot be drawn");
  note(reading.unreferenced_points, "point", " of no face left out");
  note(reading.trailing_bytes, "byte", " after what the header claims read over: does it count all?");
  if (reading.map && reading.map->unknown_occupied)
    notes.push_back(reading.map->has_free
                        ? "unknown space of the map counts as occupied (unknown: free)"
                        : "the map has no free cells, and unknown space counts as occupied: "
                          "it is one solid block; its cells alone by unknown: free");
  return notes;
}

std::string motion_words(const Eigen::Vector3d& velocity, bool planar) {
  if (velocity.isZero(0)) return "at rest";
  const double degree = std::numbers::pi / 180;
  std::string text = "moves at " + brief(detail::length(velocity)) + " m/s, azimuth " +
                     brief(std::atan2(velocity.y(), velocity.x()) / degree);
  if (!planar)
    text += ", elevation " + brief(std::atan2(velocity.z(), std::hypot(velocity.x(), velocity.y())) / degree);
  return text + " degrees";
}

}  // namespace vericone::scenes
