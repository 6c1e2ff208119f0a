// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small assemblies, hard on purpose, with velocities to ask about.
#pragma once

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/internal/verify/assembly/truth.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace vericone::verify {

enum class AgentKind : std::uint8_t { ball, ellipsoid, hull };

/// How a case is made; the index runs through them.
enum class AssemblyVariation : std::uint8_t {
  regular,     // random doubles
  tangent,     // integers: pieces that the agent touches exactly in passing, at a corner, an edge or a face
  near,        // the same with some numbers moved by a few roundings
  shared,      // meshes with common corners and edges and velocities exactly towards them; boxes side by side
  touching,    // integers: pieces that the agent touches now
  degenerate,  // triangles that are segments or points, flat boxes, points twice
  thin,        // agents of axis ratio 1e4
  enclosing,   // pieces all round the agent
};
inline constexpr int kAssemblyVariations = 8;
[[nodiscard]] const char* to_string(AgentKind kind);
[[nodiscard]] const char* to_string(AssemblyVariation variation);

struct AssemblyCase {
  AssemblyVariation variation = AssemblyVariation::regular;
  std::variant<Ellipsoid, HullBody> agent;
  PieceKind kind = PieceKind::triangle;
  std::vector<Eigen::Vector3d> points;  // of triangles and balls
  std::vector<Assembly::Triangle> triangles;
  double radius = 0;
  std::vector<Box> boxes;
  std::vector<HullBody> hulls;
  std::vector<Eigen::Vector3d> velocities;

  [[nodiscard]] Assembly assembly() const;
  [[nodiscard]] TruePieces pieces() const;
  [[nodiscard]] double agent_size() const;  // half its longest extent
};

/// Every third case is moved about a million sizes away, or made a millionth of the size, or neither; without
/// rounding where coordinates are integers.
[[nodiscard]] AssemblyCase assembly_case(AgentKind agent, PieceKind pieces, std::uint64_t seed,
                                         std::uint64_t index);

}  // namespace vericone::verify
