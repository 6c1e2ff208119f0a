// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/octomap/read_octree.h>

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <istream>
#include <limits>
#include <streambuf>

#include "octree_header.h"

namespace vericone::octomap {
namespace {

/// A stream of bytes that stay where they are.
class View : public std::streambuf {
 public:
  View(const char* begin, const char* end) {
    // The interface wants them writable; nobody writes.
    setg(const_cast<char*>(begin), const_cast<char*>(begin), const_cast<char*>(end));
  }
};

/// The leaves and the missing children, depth first.
template <typename Tree>
class Cells {
 public:
  Cells(const Tree& tree, bool is_decided, std::vector<OctreeCell>& cells)
      : tree_(tree), is_decided_(is_decided), cells_(cells) {}

  void add(const typename Tree::NodeType* node, OctreeCell cell) {
    if (node && tree_.nodeHasChildren(node)) {
      const unsigned half = 1U << (kDepth - 1 - cell.depth);
      for (unsigned i = 0; i < 8; ++i) {
        OctreeCell child{.key = cell.key, .depth = std::uint8_t(cell.depth + 1)};
        for (unsigned axis = 0; axis < 3; ++axis)
          if (i >> axis & 1U) child.key[axis] = std::uint16_t(child.key[axis] + half);
        add(tree_.nodeChildExists(node, i) ? tree_.getNodeChild(node, i) : nullptr, child);
      }
      return;
    }
    if (node) {
      constexpr float kCertain = std::numeric_limits<float>::infinity();
      cell.is_known = true;
      cell.log_odds = !is_decided_ ? node->getLogOdds() : tree_.isNodeOccupied(node) ? kCertain : -kCertain;
    }
    if (cells_.size() % 4096 == 0) checkpoint();
    cells_.push_back(cell);
  }

 private:
  const Tree& tree_;
  bool is_decided_;
  std::vector<OctreeCell>& cells_;
};

template <typename Tree>
std::vector<OctreeCell> read_cells(const files::Source& source, const OctreeHeader& header) {
  View view(source.bytes.data() + header.size, source.bytes.data() + source.bytes.size());
  std::istream stream(&view);
  Tree tree(header.resolution);
  // Not read() of the file, which reports to standard error.
  if (header.is_binary)
    tree.readBinaryData(stream);
  else
    tree.readData(stream);
  std::vector<OctreeCell> cells;
  // Every node but the root is a child, and so is every missing one.
  cells.reserve(header.nodes + header.nodes / 4);
  Cells<Tree>(tree, header.is_binary, cells).add(tree.getRoot(), {});
  return cells;
}

}  // namespace

Octree read_octree(const std::filesystem::path& path) { return read_octree(files::load(path)); }

Octree read_octree(const files::Source& source) {
  const OctreeHeader header = check_octree(source);
  Octree octree;
  octree.format = header.is_binary ? "OcTree binary" : header.id;
  octree.resolution = header.resolution;
  octree.nodes = header.nodes;
  // Stamps are not in the file, and the binary form has no colours.
  octree.cells = header.id == "ColorOcTree" && !header.is_binary
                     ? read_cells<::octomap::ColorOcTree>(source, header)
                     : read_cells<::octomap::OcTree>(source, header);
  bool is_first = true;
  for (const OctreeCell& cell : octree.cells)
    if (cell.is_known) {
      const Box box = octree.box(cell);
      is_first ? octree.bounds = box : (octree.bounds.include(box), octree.bounds);
      is_first = false;
    }
  return octree;
}

}  // namespace vericone::octomap
