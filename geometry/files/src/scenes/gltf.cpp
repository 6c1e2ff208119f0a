// SPDX-License-Identifier: BSD-3-Clause
//
// glTF 2.0 and GLB: the triangles of a scene, placed by its nodes. An own reader: tinygltf 2.7 brings
// decoders of pictures into the process and leaves the reading of accessors to its users; assimp keeps floats
// where nodes turn them.
#include <Eigen/Geometry>
#include <cmath>

#include "../source.h"
#include "gltf_document.h"
#include "placed_mesh.h"

namespace vericone::files {
namespace {

using Eigen::Vector3d;

/// What an extension that a file requires must not be about: anything but looks.
bool leaves_shapes_alone(std::string_view extension) {
  for (const char* with : {"KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "MSFT_texture_"})
    if (extension.starts_with(with)) return true;
  // Coordinates as whole numbers, which are read.
  return extension == "KHR_mesh_quantization" || extension == "KHR_xmp" || extension == "KHR_xmp_json_ld";
}

Placement placement_of(const GltfValue& node) {
  Placement local;
  if (const auto m = node["matrix"].numbers(16); !m.empty()) {
    const Eigen::Map<const Eigen::Matrix4d> matrix(m.data());  // by columns
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      node["matrix"].refuse("one whose last row is 0 0 0 1", "a last row of other numbers");
    local.linear = matrix.topLeftCorner<3, 3>();
    local.shift = matrix.topRightCorner<3, 1>();
    return local;
  }
  if (const auto q = node["rotation"].numbers(4); !q.empty()) {
    Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(std::abs(turn.norm() - 1) < 1e-3))  // floats, as they are written
      node["rotation"].refuse("a quaternion [x, y, z, w] of length 1", "one of another length");
    // Quarters and halves of a turn stay what they are.
    if (turn.squaredNorm() != 1) turn.normalize();
    local.linear = turn.toRotationMatrix();
  }
  if (const auto s = node["scale"].numbers(3); !s.empty())
    local.linear *= Vector3d(s[0], s[1], s[2]).asDiagonal();
  if (const auto t = node["translation"].numbers(3); !t.empty()) local.shift = {t[0], t[1], t[2]};
  return local;
}

/// Triangles of a list, strip or fan of corners.
std::vector<Face> triangles_of_mode(std::uint64_t mode, const std::vector<std::uint32_t>& corners) {
  std::vector<Face> faces;
  if (mode == 4) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return faces;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = i % 2;
    faces.push_back(mode == 5 ? Face{corners[i], corners[i + 1 + odd], corners[i + 2 - odd]}
                              : Face{corners[i + 1], corners[i + 2], corners[0]});
  }
  return faces;
}

class SceneReader {
 public:
  explicit SceneReader(const Source& source) : document_(source), mesh_(source, document_.size()) {}

  Parsed read() {
    const GltfValue root = document_.root(), required = root["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i)
      if (!leaves_shapes_alone(required[i].text()))
        required[i].refuse(
            "glTF without it: gltf-transform or an exporter without compression writes such a file");
    const GltfValue nodes = root["nodes"], scenes = root["scenes"];
    seen_.resize(nodes.size());
    Placement upright;  // glTF has y up
    upright.linear << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (scenes.size() > 0) {
      const GltfValue roots = scenes[root["scene"].whole_or(0)]["nodes"];
      for (std::size_t i = 0; i < roots.size(); ++i) place(roots[i], upright);
    } else if (nodes.size() > 0) {
      add_all_nodes(nodes, upright);
    } else {
      for (std::size_t i = 0; i < root["meshes"].size(); ++i) add_mesh(root["meshes"][i], upright);
    }
    Parsed parsed = mesh_.take();
    parsed.format = document_.is_binary() ? "glTF 2.0 binary" : "glTF 2.0";
    parsed.trailing_bytes = document_.trailing_bytes();
    return parsed;
  }

 private:
  /// Of a file without scenes: every node that no other has.
  void add_all_nodes(const GltfValue& nodes, const Placement& upright) {
    std::vector<char> is_child(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const GltfValue children = nodes[i]["children"];
      for (std::size_t k = 0; k < children.size(); ++k) {
        nodes[children[k].whole()];  // is there
        is_child[children[k].whole()] = 1;
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!is_child[i]) place(i, upright);
  }

  void place(const GltfValue& number, const Placement& upright) {
    document_.root()["nodes"][number.whole()];  // is there
    place(number.whole(), upright);
  }
  /// A node and all below it; each is below one other.
  void place(std::size_t top, const Placement& upright) {
    struct Placed {
      std::size_t node;
      Placement in;
    };
    std::vector<Placed> waiting{{top, upright}};
    while (!waiting.empty()) {
      const Placed next = waiting.back();
      waiting.pop_back();
      const GltfValue node = document_.root()["nodes"][next.node];
      if (seen_[next.node]) node.refuse("the child of one node, or none's", "a node in two places");
      seen_[next.node] = 1;
      const Placement here = next.in * placement_of(node);
      if (node["skin"].there()) node["skin"].refuse("left out: a mesh that bones move has no one shape");
      require_unmoved(node["weights"]);
      if (node["mesh"].there()) add_mesh(document_.root()["meshes"][node["mesh"].whole()], here);
      const GltfValue children = node["children"];
      for (std::size_t k = 0; k < children.size(); ++k) {
        document_.root()["nodes"][children[k].whole()];  // is there
        waiting.push_back({std::size_t(children[k].whole()), here});
      }
    }
  }

  /// Weights of shapes that the mesh may take.
  static void require_unmoved(const GltfValue& weights) {
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i].number() != 0) weights[i].refuse("0: the mesh as it is");
  }

  void add_mesh(const GltfValue& mesh, const Placement& here) {
    require_unmoved(mesh["weights"]);
    const GltfValue primitives = mesh["primitives"];
    mesh_.count(primitives.size() + 1);
    for (std::size_t i = 0; i < primitives.size(); ++i) add(primitives[i], here);
  }

  void add(const GltfValue& primitive, const Placement& here) {
    const std::uint64_t mode = primitive["mode"].whole_or(4);
    if (mode > 6) primitive["mode"].refuse("0 to 6");
    const GltfValue position = primitive["attributes"]["POSITION"];
    // Lines have no side, and a primitive without places nothing that could be met.
    if ((mode >= 1 && mode <= 3) || !position.there()) return;
    const GltfValue accessors = document_.root()["accessors"];
    mesh_.count(accessors[position.whole()]["count"].whole());
    const std::vector<Vector3d> points = document_.positions(position.whole());
    if (mode == 0) return mesh_.add_cloud(points, here);
    std::vector<std::uint32_t> corners;
    if (const GltfValue indices = primitive["indices"]; indices.there()) {
      mesh_.count(accessors[indices.whole()]["count"].whole());
      corners = document_.indices(indices.whole());
      for (const std::uint32_t corner : corners)
        if (corner >= points.size())
          indices.refuse("of numbers below " + std::to_string(points.size()) + ", as there are points",
                         "an accessor with " + std::to_string(corner));
    } else {
      corners.resize(points.size());
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = std::uint32_t(i);
    }
    if (mode == 4 && corners.size() % 3 != 0)
      primitive.refuse("three for each triangle", std::to_string(corners.size()) + " corners");
    mesh_.add(points, triangles_of_mode(mode, corners), here);
  }

  GltfDocument document_;
  PlacedMesh mesh_;
  std::vector<char> seen_;
};

}  // namespace

bool looks_like_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }

Parsed parse_gltf(const Source& source) { return SceneReader(source).read(); }

}  // namespace vericone::files
