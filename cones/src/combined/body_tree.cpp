// SPDX-License-Identifier: BSD-3-Clause
#include "combined/body_tree.h"

#include <Eigen/Geometry>

namespace vericone {
namespace {

using Eigen::Vector3d;

/// Room for the roundings of some dozen operations on numbers that sum to this.
constexpr double kBoundRounding = 1e-14;

/// The most of r.d over a box of half widths h (r in units of h) where g_i.d <= -base_i: r.d <= |r - sum
/// lambda_i g_i| - sum lambda_i base_i for any multipliers >= 0.
class Support {
 public:
  Support(const BodyTree::Node& node, const Vector3d& row)
      : cuts_(node.cuts), r_(row.cwiseProduct(node.box.half)) {
    for (int i = 0; i < cuts_; ++i) {
      g_[i] = node.gradient[i].cwiseProduct(node.box.half);
      base_[i] = node.base[i];
    }
    best_ = r_.cwiseAbs().sum();
    weights_.fill(0);
    for (int i = 0; i < cuts_; ++i) along(i);
    for (int i = 0; i < cuts_; ++i)
      for (int j = i + 1; j < cuts_; ++j) try_two(i, j);
    if (cuts_ >= 3) try_three();
    for (int i = 0; cuts_ > 1 && i < cuts_; ++i) along(i);
  }
  double most() const { return best_; }

 private:
  void offer(const std::array<double, 4>& weights) {
    Vector3d rest = r_;
    double sum = 0;
    for (int i = 0; i < cuts_; ++i) {
      if (!(weights[i] > 0)) continue;
      rest -= weights[i] * g_[i];
      sum -= weights[i] * base_[i];
    }
    const double value = sum + rest.cwiseAbs().sum();
    if (value < best_) {
      best_ = value;
      weights_ = weights;
    }
  }

  /// From the best so far along one multiplier: the least is where a component vanishes.
  void along(int i) {
    Vector3d rest = r_;
    double sum = 0;
    for (int k = 0; k < cuts_; ++k) {
      if (k == i || !(weights_[k] > 0)) continue;
      rest -= weights_[k] * g_[k];
      sum -= weights_[k] * base_[k];
    }
    for (int j = 0; j < 3; ++j) {
      const double t = rest(j) / g_[i](j);
      if (!(t > 0) || !(t < 1e100)) continue;
      const double value = sum - t * base_[i] + (rest - t * g_[i]).cwiseAbs().sum();
      if (value < best_) {
        best_ = value;
        weights_[i] = t;
      }
    }
  }

  void try_two(int i, int j) {
    const double gii = g_[i].squaredNorm(), gjj = g_[j].squaredNorm(), gij = g_[i].dot(g_[j]),
                 ri = r_.dot(g_[i]), rj = r_.dot(g_[j]), det = gii * gjj - gij * gij;
    if (!(det > 1e-12 * gii * gjj)) return;
    std::array<double, 4> weights{};
    weights[i] = (gjj * ri - gij * rj) / det;
    weights[j] = (gii * rj - gij * ri) / det;
    if (weights[i] > 0 && weights[j] > 0) offer(weights);
  }

  void try_three() {
    const Vector3d c12 = g_[1].cross(g_[2]), c20 = g_[2].cross(g_[0]), c01 = g_[0].cross(g_[1]);
    const double det = g_[0].dot(c12);
    if (det == 0) return;
    const double x = r_.dot(c12) / det, y = r_.dot(c20) / det, z = r_.dot(c01) / det;
    if (x > 0 && y > 0 && z > 0 && x + y + z < 1e100) offer({x, y, z, 0});
  }

  int cuts_;
  Vector3d r_;
  std::array<Vector3d, 4> g_;
  std::array<double, 4> base_, weights_;
  double best_;
};

}  // namespace

void BodyTree::start(const std::vector<QuadraticConstraint<3>>& surfaces, const Vector3d& unit) {
  surfaces_ = surfaces;
  unit_ = unit;
  steepest_.clear();
  for (const QuadraticConstraint<3>& q : surfaces_) steepest_.push_back(q.h.norm() * (1 + 1e-12));
  nodes_.clear();
  roots_.clear();
  parts_.clear();
  Node root;
  root.box = {Vector3d::Zero(), Vector3d::Constant(1.001)};
  if (!examine(root)) return;
  nodes_.push_back(root);
  parts_.push_back(-1);
  roots_.push_back(0);
}

void BodyTree::ask(const TreeRows& rows) {
  rows_ = rows;
  ++question_;
}

/// Shrinks the box to what may hold boundary and finds its bounds; false where it holds none.
bool BodyTree::examine(Node& node) const {
  SearchBox<3>& box = node.box;
  for (int pass = 0; pass < 3; ++pass) {
    const double square = box.half.squaredNorm();
    Vector3d lo = -box.half, hi = box.half;
    bool inside = true;
    node.cuts = 0;
    std::array<double, 4> cutting{};
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const QuadraticConstraint<3>& q = surfaces_[i];
      Vector3d gradient;
      const double value = q.evaluate(box.middle, gradient), base = value - q.concavity * square - q.slack,
                   reach = gradient.cwiseAbs().dot(box.half),
                   rounding = kBoundRounding * (std::abs(base) + reach);
      if (base - reach > rounding) return false;
      if (value + reach + steepest_[i] * square + q.slack > -rounding) inside = false;
      const double excess = base + reach;
      if (excess <= 0) continue;
      for (int j = 0; j < 3; ++j) {
        const double g = gradient(j), rest = reach - std::abs(g) * box.half(j), room = rest - base + rounding;
        if (std::abs(g) * box.half(j) <= 1e-3 * reach) continue;
        const double limit = room / g * (1 + (room > 0 ? kBoundRounding : -kBoundRounding));
        (g > 0 ? hi(j) : lo(j)) = g > 0 ? std::min(hi(j), limit) : std::max(lo(j), limit);
      }
      // The four that cut most, in parts of their own reach.
      int at = node.cuts;
      if (node.cuts == 4) {
        at = static_cast<int>(std::min_element(cutting.begin(), cutting.end()) - cutting.begin());
        if (cutting[at] >= excess / reach) continue;
      } else {
        ++node.cuts;
      }
      cutting[at] = excess / reach;
      node.base[at] = base - rounding;
      node.gradient[at] = gradient;
    }
    if (inside) return false;
    bool shrunk = false;
    for (int j = 0; j < 3; ++j) {
      if (lo(j) > hi(j)) return false;
      shrunk = shrunk || hi(j) - lo(j) < 1.9 * box.half(j);
    }
    if (!shrunk || pass == 2) break;
    for (int j = 0; j < 3; ++j) {
      const double middle = box.middle(j) + 0.5 * (lo(j) + hi(j));
      box.half(j) = 0.5 * (hi(j) - lo(j)) + 4e-16 * (std::abs(middle) + box.half(j));
      box.middle(j) = middle;
    }
  }
  node.width = box.half.cwiseProduct(unit_).norm();
  return true;
}

int BodyTree::divide(int node, int& first) {
  if (parts_[node] < 0) {
    const SearchBox<3> box = nodes_[node].box;
    int split = 0;
    box.half.cwiseProduct(unit_).maxCoeff(&split);
    parts_[node] = 0;
    nodes_[node].children = static_cast<int>(nodes_.size());
    for (const double side : {-1.0, 1.0}) {
      Node part;
      part.box = box;
      const double quarter = 0.5 * box.half(split);
      part.box.half(split) = quarter * (1 + 1e-15) + 4e-16 * (std::abs(box.middle(split)) + quarter);
      part.box.middle(split) += side * quarter;
      if (!examine(part)) continue;
      ++parts_[node];
      nodes_.push_back(part);
      parts_.push_back(-1);
    }
  }
  first = nodes_[node].children;
  return parts_[node];
}

void BodyTree::answer(Node& node, int row) const {
  const Vector3d& r = rows_.row[row];
  const double extent = r.cwiseAbs().dot(node.box.half + node.box.middle.cwiseAbs());
  node.most[row] = r.dot(node.box.middle) + Support(node, r).most() + 100 * kBoundRounding * extent;
  node.known |= 1U << row;
}

}  // namespace vericone
