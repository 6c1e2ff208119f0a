// SPDX-License-Identifier: BSD-3-Clause
//
// A triangulation of the sphere of directions, cut along the curves where the forms of a combined quadric
// change places (whitened_forms.h).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "../whitened_forms.h"

namespace vericone {

class SurfaceMesh {
 public:
  struct Node {
    Eigen::Vector3d direction;  // unit
    int form = 0;               // that gives the radius
    bool on_rim = false;
  };
  struct Triangle {
    std::array<int, 3> nodes{};  // counter-clockwise from outside
    int form = 0;
  };

  SurfaceMesh(std::vector<forms::Form<3>> forms, double resolution);

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Radius in the node's direction; 0 where a form of level 0 bounds the body.
  double radius(const Node& node) const;

 private:
  using Edge = std::pair<int, int>;
  static Edge edge(int i, int j) { return i < j ? Edge{i, j} : Edge{j, i}; }

  void icosahedron();
  void quarter_all();
  void refine();
  bool too_long(int i, int j) const;
  double wanted_length(const Eigen::Vector3d& u) const;
  bool bisect_marked();

  void cut(int m);
  /// Nodes that are not on the form of a triangle of theirs become `small_` spots.
  bool find_missed();
  double excess(int m, const Node& node) const;
  double crossing(int m, int l, int i, int j) const;
  void snap(int m, std::vector<double>& signs);
  int rim_node(int m, int i, int j, int label, int other_label);

  std::vector<forms::Form<3>> forms_;
  double resolution_;
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  struct Small {
    Eigen::Vector3d axis;
    double radius;
  };
  std::vector<Small> small_;  // where short edges are needed: small dents, ends of thin waists
};

}  // namespace vericone
