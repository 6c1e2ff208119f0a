// SPDX-License-Identifier: BSD-3-Clause
//
// The boundary of a body of quadratic inequalities in boxes that are halved as they are asked for. Questions
// about two bodies then cost what is new in them: boxes, and the linear bounds of the surfaces in each, are
// kept.
#pragma once

#include <array>
#include <vector>

#include "combined/quadratic_search.h"

namespace vericone {

/// Linear functions of the point, as many as one question asks for.
struct TreeRows {
  static constexpr int kMost = 10;
  int count = 0;
  std::array<Eigen::Vector3d, kMost> row;

  void add(const Eigen::Vector3d& r) { row[count++] = r; }
};

class BodyTree {
 public:
  struct Node {
    SearchBox<3> box;
    double width = 0;   // half of the diagonal, in the unit given
    int children = -1;  // the first of the two; -1: not divided yet
    int cuts = 0;
    // base + gradient.d <= 0 for all points of the body at box.middle + d.
    std::array<double, 4> base;
    std::array<Eigen::Vector3d, 4> gradient;
    // Of the question `asked`: what its functions are at most in the part of the body that is in the box, as
    // far as they are known.
    int asked = -1;
    unsigned known = 0;
    std::array<double, TreeRows::kMost> most;
  };

  /// `surfaces`: for the box |z_j| <= 1.001; `unit`: lengths of the coordinates' axes, for widths.
  void start(const std::vector<QuadraticConstraint<3>>& surfaces, const Eigen::Vector3d& unit);

  /// The next question's functions; what nodes knew of the last one is forgotten.
  void ask(const TreeRows& rows);

  /// The boxes together hold the boundary; none where that is empty.
  const std::vector<int>& roots() const { return roots_; }
  /// Halves a box; parts without boundary are left out. Their number is 0, 1 or 2, the first is `first`.
  int divide(int node, int& first);

  const Node& node(int i) const { return nodes_[i]; }
  /// Function `row` of the question asked last, at most, in the box.
  double most(int i, int row) {
    Node& node = nodes_[i];
    if (node.asked != question_) {
      node.asked = question_;
      node.known = 0;
    }
    if (!(node.known >> row & 1)) answer(node, row);
    return node.most[row];
  }

 private:
  bool examine(Node& node) const;
  void answer(Node& node, int row) const;

  std::vector<QuadraticConstraint<3>> surfaces_;
  std::vector<double> steepest_;  // norms of the surfaces' matrices
  Eigen::Vector3d unit_ = Eigen::Vector3d::Ones();
  std::vector<Node> nodes_;
  std::vector<int> roots_, parts_;  // parts_: of each node, how many children it has
  TreeRows rows_;
  int question_ = 0;
};

}  // namespace vericone
