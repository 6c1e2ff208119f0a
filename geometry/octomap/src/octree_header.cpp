// SPDX-License-Identifier: BSD-3-Clause
#include "octree_header.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <bit>
#include <cmath>

#include "binary.h"
#include "text.h"

namespace vericone::octomap {
namespace {

using files::Lines, files::Source, files::Words, files::in_quotes;

constexpr std::string_view kBinaryTitle = "# Octomap OcTree binary file", kTitle = "# Octomap OcTree file";

OctreeHeader read_header(const Source& source) {
  OctreeHeader header;
  header.is_binary = source.bytes.starts_with(kBinaryTitle);
  if (!header.is_binary && !source.bytes.starts_with(kTitle))
    source.refuse(in_quotes(std::string_view(source.bytes).substr(0, source.bytes.find('\n'))),
                  "a file that begins with \"" + std::string(kTitle) + "\" or \"" +
                      std::string(kBinaryTitle) +
                      "\" (of an older one, convert_octree of OctoMap makes such a file)");
  bool has_nodes = false;
  Lines lines(source);
  while (lines.next()) {
    Words words(lines.text());
    const std::string_view keyword = words.next(), value = words.next();
    if (keyword == "id") {
      header.id = value == "1" ? "OcTree" : value;  // 1 by the first versions
    } else if (keyword == "size") {
      const std::int64_t n = lines.integer(value);
      if (n < 1) source.refuse(lines.where() + ": a tree of " + std::to_string(n) + " nodes", "at least one");
      header.nodes = std::size_t(n);
      has_nodes = true;
    } else if (keyword == "res") {
      header.resolution = lines.number(value);
      if (!(header.resolution >= 1e-100 && header.resolution <= 1e100))
        source.refuse(lines.where() + ": resolution " + to_text(header.resolution),
                      "a positive finite number (metres)");
    } else if (keyword == "data") {
      if (header.id.empty() || !has_nodes || header.resolution == 0)
        source.refuse("a header without id, size or res", "all three before the data");
      header.size = source.bytes.size() - lines.rest().size();
      return header;
    }
  }
  source.refuse("a header without end", "a header with id, size and res that ends with data");
}

class Walk {
 public:
  Walk(const Source& source, const OctreeHeader& header)
      : source_(source), rest_(std::string_view(source.bytes).substr(header.size)) {}

  /// Nodes of the tree.
  std::size_t binary() {
    nodes_ = 1;
    binary_node(0);
    return finish();
  }
  std::size_t full(std::size_t bytes_of_colour) {
    bytes_of_colour_ = bytes_of_colour;
    full_node(0);
    return finish();
  }

 private:
  /// Two bits for each child: 00 not there, 01 and 10 leaves, 11 an inner node.
  void binary_node(int depth) {
    const auto bits = files::little_endian<std::uint16_t>(take(2));
    if (bits == 0) refuse("an inner node without children");
    for (int i = 0; i < 8; ++i) nodes_ += ((bits >> (2 * i)) & 3) != 0;
    for (int i = 0; i < 8; ++i)
      if (((bits >> (2 * i)) & 3) == 3) {
        if (depth + 1 >= kDepth) refuse("a tree deeper than 16 levels");
        binary_node(depth + 1);
      }
  }

  /// The logarithm of the odds, the colour if any, a bit for each child.
  void full_node(int depth) {
    if (!std::isfinite(files::little_endian<float>(take(4)))) refuse("a node whose value is not finite");
    take(bytes_of_colour_);
    const auto children = std::uint8_t(*take(1));
    ++nodes_;
    if (children != 0 && depth == kDepth) refuse("a tree deeper than 16 levels");
    for (int i = std::popcount(children); i > 0; --i) full_node(depth + 1);
  }

  const char* take(std::size_t size) {
    if (rest_.size() < size) source_.refuse("end of file inside the tree", "all the nodes of the tree");
    const char* at = rest_.data();
    rest_.remove_prefix(size);
    return at;
  }

  std::size_t finish() const {
    if (!rest_.empty())
      source_.refuse(std::to_string(rest_.size()) + " bytes after the tree", "the end of the file");
    return nodes_;
  }

  [[noreturn]] void refuse(const char* what) const {
    source_.refuse(std::string(what) + " before byte " + std::to_string(source_.bytes.size() - rest_.size()),
                   "a tree as OctoMap writes it");
  }

  const Source& source_;
  std::string_view rest_;
  std::size_t nodes_ = 0, bytes_of_colour_ = 0;
};

}  // namespace

OctreeHeader check_octree(const Source& source) {
  OctreeHeader header = read_header(source);
  const bool is_colour = header.id == "ColorOcTree";
  if (!is_colour && header.id != "OcTree" && header.id != "OcTreeStamped")
    source.refuse("a tree of the kind " + in_quotes(header.id),
                  "a tree of occupancy: OcTree, ColorOcTree or OcTreeStamped");
  Walk walk(source, header);
  const std::size_t nodes = header.is_binary ? walk.binary() : walk.full(is_colour ? 3 : 0);
  if (nodes != header.nodes)
    source.refuse("a tree of " + std::to_string(nodes) + " nodes",
                  "the " + std::to_string(header.nodes) + " nodes that its header claims");
  return header;
}

}  // namespace vericone::octomap
