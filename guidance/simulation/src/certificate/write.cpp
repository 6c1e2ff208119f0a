// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <string_view>

#include "certificate/octree.h"
#include "certificate/stated.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Vector3d;

template <typename List, typename Write>
std::string list_of(const List& list, const Write& write) {
  std::string text = "[";
  const char* between = "";
  for (const auto& x : list) {
    text.append(between).append(write(x));
    between = ", ";
  }
  return text + "]";
}

template <typename Number>
std::string digits_of(Number x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

std::string vector_text(const Vector3d& v) {
  return "[" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) + "]";
}
std::string matrix_text(const Eigen::Matrix3d& m) {
  return list_of(std::array{0, 1, 2}, [&](int i) { return vector_text(m.row(i).transpose()); });
}
template <std::size_t N>
std::string whole_numbers(const std::array<std::int64_t, N>& list) {
  return list_of(list, [](std::int64_t x) { return digits_of(x); });
}

std::string quadric_text(const CombinedEllipsoid& body) {
  const Ellipsoid& own = body.ellipsoid();
  std::string text = body.is_ellipsoid() ? R"({"kind": "ellipsoid")" : R"({"kind": "delimited")";
  if (!own.center().isZero(0)) text += ", \"center\": " + vector_text(own.center());
  text += own.defined_by_factor() ? ", \"factor\": " + matrix_text(own.factor())
                                  : ", \"shape\": " + matrix_text(own.shape());
  if (!body.is_ellipsoid())
    text += ", \"delimiters\": " + list_of(body.delimiters(), [](const Delimiter<3>& one) {
              return R"({"matrix": )" + matrix_text(one.matrix) + ", \"level\": " + text_of(one.level) + "}";
            });
  return text + "}";
}

std::string points_text(std::string_view kind, const std::vector<Vector3d>& points) {
  return std::string(R"({"kind": ")").append(kind) + R"(", "points": )" + list_of(points, vector_text);
}

std::string hull_text(const Solid& solid, const std::vector<std::uint32_t>& piece) {
  std::vector<Vector3d> points;
  for (const std::uint32_t i : piece) points.push_back(solid.points[i]);
  return points_text("hull", points) + "}";
}

std::string convex_text(const vericone::Convex& body) {
  std::string text = R"({"kind": "convex")";
  if (body.margin() > 0) text += ", \"margin\": " + text_of(body.margin());
  return text + ", \"parts\": " +
         list_of(body.pieces(),
                 [](const vericone::Convex::Piece& part) {
                   std::string own = R"({"center": )" + vector_text(part.center);
                   if (part.shape) return own + ", \"shape\": " + matrix_text(*part.shape) + "}";
                   return own + (part.rank > 0 ? ", \"factor\": " + matrix_text(part.factor) : "") + "}";
                 }) +
         "}";
}

}  // namespace

std::string text_of(double x) { return digits_of(x == 0 ? 0.0 : x); }

std::string text_of(const std::vector<Box>& boxes) {
  return list_of(
      boxes, [](const Box& box) { return "[" + vector_text(box.low) + ", " + vector_text(box.high) + "]"; });
}

std::string text_of(const Solid& solid) {
  switch (solid.kind) {
    case Solid::Kind::rounds:
      if (solid.rounds.size() == 1) return quadric_text(solid.rounds.front());
      return R"({"kind": "union", "pieces": )" + list_of(solid.rounds, quadric_text) + "}";
    case Solid::Kind::convexes:
      if (solid.convexes.size() == 1) return convex_text(solid.convexes.front());
      return R"({"kind": "union", "pieces": )" + list_of(solid.convexes, convex_text) + "}";
    case Solid::Kind::hull:
      return points_text("hull", solid.points) + "}";
    case Solid::Kind::mesh:
      return points_text("mesh", solid.points) + ", \"triangles\": " +
             list_of(solid.pieces,
                     [](const auto& piece) { return list_of(piece, [](auto i) { return digits_of(i); }); }) +
             "}";
    case Solid::Kind::cloud:
      return points_text("cloud", solid.points) + ", \"radius\": " + text_of(solid.radius) + "}";
    case Solid::Kind::boxes:
      return R"({"kind": "boxes", "boxes": )" + text_of(solid.boxes) + "}";
    case Solid::Kind::octree:
      return R"({"kind": "octree", "low": )" + vector_text(solid.octree->low) +
             ", \"cell\": " + text_of(solid.octree->cell) + ", \"depth\": " + digits_of(solid.octree->depth) +
             ", \"tree\": \"" + solid.octree->tree + "\"}";
    case Solid::Kind::hulls:
      return R"({"kind": "union", "pieces": )" +
             list_of(solid.pieces, [&](const auto& piece) { return hull_text(solid, piece); }) + "}";
    case Solid::Kind::wall:
      return R"({"kind": "wall", "outline": )" +
             list_of(solid.ring->outline,
                     [](const Eigen::Vector2d& v) {
                       return "[" + text_of(v.x()) + ", " + text_of(v.y()) + "]";
                     }) +
             ", \"extent\": " + text_of(solid.ring->extent) + "}";
  }
  return {};
}

std::string text_of(const StatedTrack& track) {
  const auto numbers = [](double x) { return text_of(x); };
  std::string text = R"({"times": )" + list_of(track.times, numbers) +
                     ", \"grid\": " + digits_of(track.grid) +
                     ", \"positions\": " + list_of(track.segments, [](const Segment& segment) {
                       return list_of(segment.position, [](const auto& c) { return whole_numbers(c); });
                     });
  if (track.turned)
    text += ", \"turns\": " + list_of(track.segments, [](const Segment& segment) {
              return list_of(segment.turn, [](const auto& c) { return whole_numbers(c); });
            });
  return text + ", \"radius\": " + text_of(track.radius) + "}";
}

std::string text_of(const StatedPieces& pieces) {
  const auto numbers = [](double x) { return text_of(x); };
  return R"({"rule": "pieces", "times": )" + list_of(pieces.times, numbers) + ", \"planes\": " +
         list_of(pieces.planes,
                 [&](const StatedPlane& plane) {
                   const auto& [of_a, of_b] = plane.multipliers;
                   const bool none = of_a.empty() && of_b.empty();
                   return "[" + whole_numbers(plane.normal) + ", " + digits_of(plane.length) + ", " +
                          list_of(plane.most_a, numbers) + ", " + list_of(plane.most_b, numbers) +
                          (none ? "" : ", " + list_of(of_a, numbers) + ", " + list_of(of_b, numbers)) + "]";
                 }) +
         "}";
}

}  // namespace vericone::simulation::certified
