// SPDX-License-Identifier: BSD-3-Clause
//
// A body as a tree of boxes with its convex parts at the leaves.
#pragma once

#include <vericone/geometry/body.h>
#include <cstdint>

#include "bands/parts.h"

namespace vericone::guidance::barriers {

class PartsTree {
 public:
  using Node = std::uint32_t;  // the tree's own nodes, then the parts

  explicit PartsTree(const Placed& body)
      : body_(body),
        quadrics_(body.body.quadrics()),
        assembly_(body.body.assembly()),
        inner_(assembly_   ? static_cast<Node>(assembly_->hierarchy().nodes().size())
               : quadrics_ ? 1
                           : 0) {}

  static constexpr Node root() { return 0; }
  bool is_part(Node node) const { return node >= inner_; }

  template <typename Use>
  void for_each_child(Node node, const Use& use) const {
    if (quadrics_) {
      for (Node i = 0; i < quadrics_->size(); ++i) use(inner_ + i);
      return;
    }
    const Hierarchy::Node& own = assembly_->hierarchy().nodes()[node];
    const Node first = own.is_leaf() ? inner_ + own.first : own.first, count = own.is_leaf() ? own.count : 2;
    for (Node i = 0; i < count; ++i) use(first + i);
  }

  /// Around a node, in the body's frame.
  Box box(Node node) const {
    if (!is_part(node)) return assembly_ ? assembly_->hierarchy().nodes()[node].box() : body_.body.bounds();
    return part(node).body.bounds();
  }

  /// A convex body; what has delimiters as its ellipsoid.
  Placed part(Node node) const {
    if (const auto* one = body_.body.quadric()) return {one->ellipsoid(), body_.pose};
    if (quadrics_) return {(*quadrics_)[node - inner_].ellipsoid(), body_.pose};
    if (!assembly_) return body_;
    return banding::piece_of(body_, assembly_->hierarchy().order()[node - inner_]);
  }

  const Pose& pose() const { return body_.pose; }

 private:
  const Placed& body_;
  const std::vector<CombinedEllipsoid>* quadrics_;
  const Assembly* assembly_;
  Node inner_;
};

}  // namespace vericone::guidance::barriers
