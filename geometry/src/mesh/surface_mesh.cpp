// SPDX-License-Identifier: BSD-3-Clause
#include "surface_mesh.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using forms::Form;

constexpr double kFinest = 64;      // edges are halved down to this part of the resolution to find a form
constexpr double kOnCurve = 1e-12;  // relative; values of a form are right to a few roundings

double angle_between(const Vector3d& u, const Vector3d& v) {
  return 2 * std::atan2((u - v).norm(), (u + v).norm());
}

double size(const Form<3>& f) { return f.matrix.cwiseAbs().maxCoeff(); }

/// Values of a form on the chord (1 - t) u + t v as a (1-t)^2 + 2 b t (1-t) + c t^2.
struct OnChord {
  OnChord(const Form<3>& f, const Vector3d& u, const Vector3d& v)
      : a(u.dot(f.matrix * u)), b(u.dot(f.matrix * v)), c(v.dot(f.matrix * v)) {}
  /// Roots t in (0, 1).
  std::vector<double> roots() const {
    std::vector<double> all;
    const forms::Roots r = forms::roots(a, b, c);
    for (int k = 0; k < r.count; ++k) {
      const double t = r.direction[k].y() / (r.direction[k].x() + r.direction[k].y());
      if (t > 0 && t < 1) all.push_back(t);
    }
    return all;
  }
  double a, b, c;
};

}  // namespace

SurfaceMesh::SurfaceMesh(std::vector<Form<3>> forms, double resolution)
    : forms_(std::move(forms)), resolution_(resolution) {
  for (std::size_t i = 1; i < forms_.size(); ++i) {
    const auto solver = symmetric_eigen<3>(forms_[i].matrix);
    const Vector3d& l = solver.values;
    const double level = forms_[i].level;
    // The narrowest extent of a dent about its axis, or of an end that a waist leaves.
    const bool dent = level > l(1);
    const double radius =
        std::atan(std::sqrt(dent ? (l(2) - level) / (level - l(0)) : (level - l(0)) / (l(2) - level)));
    const Vector3d axis = solver.vectors.col(dent ? 2 : 0);
    for (const double s : {1.0, -1.0}) small_.push_back({s * axis, radius});
  }
  icosahedron();
  for (double length = 1.2; length > 1.3 * resolution_; length /= 2) quarter_all();
  if (forms_.size() == 1) return;
  // The cuts make new edges and move nodes, between which a third form may come nearest again: seen
  // afterwards at nodes that are not on their triangles' forms. Shorter edges there, and once more.
  constexpr int kAttempts = 6;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    refine();
    const auto nodes = nodes_;
    const auto triangles = triangles_;
    for (int m = 1; m < static_cast<int>(forms_.size()); ++m) cut(m);
    if (!find_missed() || attempt + 1 == kAttempts) return;
    nodes_ = nodes;
    triangles_ = triangles;
  }
}

bool SurfaceMesh::find_missed() {
  bool found = false;
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      const Node& node = nodes_[static_cast<std::size_t>(t.nodes[k])];
      const Form<3>& f = forms_[static_cast<std::size_t>(t.form)];
      const double r2 = radius(node) * radius(node);
      if (std::abs(r2 * f(node.direction) - f.level) <= 1e-10 * (f.level + r2 * size(f))) continue;
      double length = 0;
      for (std::size_t n = 0; n < 3; ++n)
        length =
            std::max(length, angle_between(nodes_[static_cast<std::size_t>(t.nodes[n])].direction,
                                           nodes_[static_cast<std::size_t>(t.nodes[(n + 1) % 3])].direction));
      small_.push_back({node.direction, length});
      found = true;
    }
  return found;
}

double SurfaceMesh::radius(const Node& node) const {
  const Form<3>& f = forms_[static_cast<std::size_t>(node.form)];
  double r = std::sqrt(f.level / f(node.direction));
  // A form that no edge found is cut off by the triangles, but the nodes are on it.
  for (const Form<3>& other : forms_) {
    const double q = other(node.direction);
    if (other.level > 0 && q > 0) r = std::min(r, std::sqrt(other.level / q));
  }
  return r;
}

void SurfaceMesh::icosahedron() {
  constexpr double kGolden = std::numbers::phi;
  for (const double s : {1.0, -1.0})
    for (const double t : {kGolden, -kGolden})
      for (const Vector3d& p : {Vector3d(s, t, 0), Vector3d(0, s, t), Vector3d(t, 0, s)})
        nodes_.push_back({p.normalized()});
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k) {
        const auto at = [&](int n) { return nodes_[static_cast<std::size_t>(n)].direction; };
        const auto adjacent = [&](int n, int m) { return at(n).dot(at(m)) > 0.4; };
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(i, k)) continue;
        const bool outward = at(i).dot(at(j).cross(at(k))) > 0;
        triangles_.push_back({{i, outward ? j : k, outward ? k : j}});
      }
}

void SurfaceMesh::quarter_all() {
  std::map<Edge, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [it, isnew] = middles.try_emplace(edge(i, j), static_cast<int>(nodes_.size()));
    if (isnew)
      nodes_.push_back(
          {(nodes_[static_cast<std::size_t>(i)].direction + nodes_[static_cast<std::size_t>(j)].direction)
               .normalized()});
    return it->second;
  };
  std::vector<Triangle> finer;
  for (const Triangle& t : triangles_) {
    checkpoint();
    const auto [a, b, c] = t.nodes;
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::array<int, 3>& n : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      finer.push_back({n});
  }
  triangles_ = std::move(finer);
}

/// Short around small dents and ends, growing with the distance from them.
double SurfaceMesh::wanted_length(const Vector3d& u) const {
  double length = 1.3 * resolution_;
  for (const Small& s : small_)
    length =
        std::min(length, std::max({0.25 * s.radius, 0.35 * (angle_between(u, s.axis) - s.radius), 1e-6}));
  return length;
}

bool SurfaceMesh::too_long(int i, int j) const {
  const Node &a = nodes_[static_cast<std::size_t>(i)], &b = nodes_[static_cast<std::size_t>(j)];
  const double length = angle_between(a.direction, b.direction);
  if (length > wanted_length((a.direction + b.direction).normalized())) return true;
  // The surface is steep where a dent is deep.
  if (length > resolution_ / 16 &&
      (a.direction * radius(a) - b.direction * radius(b)).norm() > 1.6 * resolution_)
    return true;
  // A form that comes nearest between the ends only.
  if (length < resolution_ / kFinest) return false;
  if (a.form != b.form) {
    const double s = crossing(a.form, b.form, i, j);
    const int there = forms::active_form<3>(forms_, ((1 - s) * a.direction + s * b.direction).normalized());
    return there != a.form && there != b.form;
  }
  for (int m = 0; m < static_cast<int>(forms_.size()); ++m) {
    if (m == a.form) continue;
    const OnChord h(
        forms::difference<3>(forms_[static_cast<std::size_t>(m)], forms_[static_cast<std::size_t>(a.form)]),
        a.direction, b.direction);
    if (h.a < 0 && h.c < 0 && h.b > 0 && h.roots().size() == 2) return true;
  }
  return false;
}

void SurfaceMesh::refine() {
  do
    for (Node& n : nodes_) n.form = forms::active_form<3>(forms_, n.direction);
  while (bisect_marked());
  for (Node& n : nodes_) n.form = 0;  // until the cuts
}

/// Bisects the edges that are too long and, so that no angle becomes small, first the longest edge of every
/// triangle with such an edge (Rivara 1984). False when there was nothing to do.
bool SurfaceMesh::bisect_marked() {
  const auto length = [&](int i, int j) {
    return (nodes_[static_cast<std::size_t>(i)].direction - nodes_[static_cast<std::size_t>(j)].direction)
        .squaredNorm();
  };
  // The longest edge first; equal ones in the order of their nodes, the same for both neighbours.
  const auto longest_first = [&](Triangle& t) {
    auto& n = t.nodes;
    for (int turn = 0; turn < 2; ++turn) {
      const auto key = [&](int k) {
        const Edge e = edge(n[static_cast<std::size_t>(k)], n[static_cast<std::size_t>((k + 1) % 3)]);
        return std::make_pair(length(e.first, e.second), e);
      };
      if (key(0) < key(1) || key(0) < key(2)) std::rotate(n.begin(), n.begin() + 1, n.end());
    }
  };
  std::map<Edge, int> marked;
  std::map<Edge, std::vector<int>> around;
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
    checkpoint();
    Triangle& t = triangles_[static_cast<std::size_t>(i)];
    longest_first(t);
    for (std::size_t k = 0; k < 3; ++k) around[edge(t.nodes[k], t.nodes[(k + 1) % 3])].push_back(i);
  }
  std::vector<Edge> queue;
  for (const auto& [e, neighbours] : around)
    if (too_long(e.first, e.second)) {
      marked[e] = -1;
      queue.push_back(e);
    }
  if (queue.empty()) return false;
  while (!queue.empty()) {
    const Edge e = queue.back();
    queue.pop_back();
    for (const int i : around[e]) {
      const auto& n = triangles_[static_cast<std::size_t>(i)].nodes;
      const Edge longest = edge(n[0], n[1]);
      if (marked.try_emplace(longest, -1).second) queue.push_back(longest);
    }
  }
  for (auto& [e, node] : marked) {
    node = static_cast<int>(nodes_.size());
    nodes_.push_back({(nodes_[static_cast<std::size_t>(e.first)].direction +
                       nodes_[static_cast<std::size_t>(e.second)].direction)
                          .normalized()});
  }
  std::vector<Triangle> finer;
  const auto half = [&](int a, int b, int c) {  // bisects bc if that is marked
    const auto it = marked.find(edge(b, c));
    if (it == marked.end()) {
      finer.push_back({{a, b, c}});
    } else {
      finer.push_back({{a, b, it->second}});
      finer.push_back({{a, it->second, c}});
    }
  };
  for (const Triangle& t : triangles_) {
    checkpoint();
    const auto [a, b, c] = t.nodes;
    const auto it = marked.find(edge(a, b));
    if (it == marked.end()) {
      finer.push_back(t);
      continue;
    }
    half(it->second, b, c);
    half(it->second, c, a);
  }
  triangles_ = std::move(finer);
  return true;
}

/// How far form m is inside the form of the node, as a number between -1 and 1; 0 on the curve.
double SurfaceMesh::excess(int m, const Node& node) const {
  const Form<3>&f = forms_[static_cast<std::size_t>(m)], &g = forms_[static_cast<std::size_t>(node.form)];
  const double scale = size(f) * g.level + size(g) * f.level;
  const double h = f(node.direction) * g.level - g(node.direction) * f.level;
  return std::abs(h) <= kOnCurve * scale ? 0 : h / scale;
}

/// Where on the edge the forms m and l cross; the sign changes between its ends.
double SurfaceMesh::crossing(int m, int l, int i, int j) const {
  const OnChord h(
      forms::difference<3>(forms_[static_cast<std::size_t>(m)], forms_[static_cast<std::size_t>(l)]),
      nodes_[static_cast<std::size_t>(i)].direction, nodes_[static_cast<std::size_t>(j)].direction);
  const std::vector<double> roots = h.roots();
  return roots.empty() ? 0.5 : roots.front();
}

/// Moves nodes next to the curve onto it: cutting beside them would leave slivers.
void SurfaceMesh::snap(int m, std::vector<double>& signs) {
  constexpr double kNear = 0.25;
  std::map<int, std::pair<double, Vector3d>> moves;
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = t.nodes[k], j = t.nodes[(k + 1) % 3];
      if (!(signs[static_cast<std::size_t>(i)] * signs[static_cast<std::size_t>(j)] < 0)) continue;
      const double s = crossing(m, t.form, i, j);
      const int mover = s < kNear ? i : s > 1 - kNear ? j : -1;
      if (mover < 0 || nodes_[static_cast<std::size_t>(mover)].on_rim) continue;
      const double distance = std::min(s, 1 - s);
      const auto it = moves.find(mover);
      if (it == moves.end() || distance < it->second.first)
        moves[mover] = {distance, ((1 - s) * nodes_[static_cast<std::size_t>(i)].direction +
                                   s * nodes_[static_cast<std::size_t>(j)].direction)
                                      .normalized()};
    }
  for (const auto& [i, move] : moves) {
    nodes_[static_cast<std::size_t>(i)].direction = move.second;
    signs[static_cast<std::size_t>(i)] = 0;
  }
}

/// A node where the edge crosses the curve of m. An edge between two other forms stands for the curve between
/// its ends where these two meet: the node is the corner on that curve, found by halving it.
int SurfaceMesh::rim_node(int m, int i, int j, int label, int other_label) {
  const Vector3d from = nodes_[static_cast<std::size_t>(i)].direction,
                 to = nodes_[static_cast<std::size_t>(j)].direction;
  const auto chord = [&](double s) -> Vector3d { return (1 - s) * from + s * to; };
  Vector3d u = chord(crossing(m, label, i, j)).normalized();
  if (other_label != label) {
    const auto f = [&](int x) { return forms_[static_cast<std::size_t>(x)]; };
    const Form<3> change = forms::difference<3>(f(m), f(label)),
                  rim = forms::difference<3>(f(other_label), f(label));
    const Vector3d aside = from.cross(to).normalized();
    const auto on_rim = [&](double s) -> Vector3d {
      const Vector3d p = chord(s);
      const forms::Roots r = forms::roots(rim(p), p.dot(rim.matrix * aside), rim(aside));
      double x = r.count ? std::numeric_limits<double>::infinity() : 0;
      for (int k = 0; k < r.count; ++k) {
        const double root = r.direction[k].y() / r.direction[k].x();
        if (std::abs(root) < std::abs(x)) x = root;
      }
      return std::isfinite(x) ? (p + x * aside).normalized() : p.normalized();
    };
    double low = 0, high = 1;
    const bool rising = change(from) < 0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      ((change(on_rim(middle)) < 0) == rising ? low : high) = middle;
    }
    u = on_rim(0.5 * (low + high));
  }
  Node node{u, label, true};
  // A form of level 0 says nothing about the radius.
  if (forms_[static_cast<std::size_t>(label)].level == 0) node.form = m;
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size()) - 1;
}

void SurfaceMesh::cut(int m) {
  std::vector<double> signs(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) signs[i] = excess(m, nodes_[i]);
  snap(m, signs);

  std::map<Edge, std::array<int, 2>> labels;  // of the triangles on both sides
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e = edge(t.nodes[k], t.nodes[(k + 1) % 3]);
      const auto [it, isnew] = labels.try_emplace(e, std::array{t.form, t.form});
      if (!isnew) it->second[1] = t.form;
    }
  std::map<Edge, int> splits;
  for (const auto& [e, l] : labels)
    if (signs[static_cast<std::size_t>(e.first)] * signs[static_cast<std::size_t>(e.second)] < 0)
      splits[e] = rim_node(m, e.first, e.second, l[0], l[1]);

  std::vector<Triangle> parts;
  const auto distance = [&](int i, int j) {
    const Node &a = nodes_[static_cast<std::size_t>(i)], &b = nodes_[static_cast<std::size_t>(j)];
    return (a.direction * radius(a) - b.direction * radius(b)).norm();
  };
  for (const Triangle& t : triangles_) {
    checkpoint();
    const auto sign = [&](int i) { return signs[static_cast<std::size_t>(i)]; };
    auto n = t.nodes;
    int split_edges = 0;
    for (std::size_t k = 0; k < 3; ++k) split_edges += sign(n[k]) * sign(n[(k + 1) % 3]) < 0;
    if (split_edges == 0) {
      bool inner = std::any_of(n.begin(), n.end(), [&](int i) { return sign(i) > 0; });
      if (sign(n[0]) == 0 && sign(n[1]) == 0 && sign(n[2]) == 0) {
        const auto at = [&](std::size_t k) { return nodes_[static_cast<std::size_t>(n[k])].direction; };
        inner = excess(m, {(at(0) + at(1) + at(2)).normalized(), t.form}) > 0;
      }
      parts.push_back({n, inner ? m : t.form});
    } else if (split_edges == 1) {
      // The first node is on the curve.
      while (sign(n[0]) != 0) std::rotate(n.begin(), n.begin() + 1, n.end());
      const int s = splits.at(edge(n[1], n[2]));
      parts.push_back({{n[0], n[1], s}, sign(n[1]) > 0 ? m : t.form});
      parts.push_back({{n[0], s, n[2]}, sign(n[2]) > 0 ? m : t.form});
    } else {
      // The first node is alone on its side.
      while (sign(n[1]) * sign(n[2]) < 0) std::rotate(n.begin(), n.begin() + 1, n.end());
      const int p = splits.at(edge(n[0], n[1])), q = splits.at(edge(n[0], n[2]));
      const int lone = sign(n[0]) > 0 ? m : t.form, others = sign(n[0]) > 0 ? t.form : m;
      parts.push_back({{n[0], p, q}, lone});
      if (distance(p, n[2]) < distance(n[1], q)) {
        parts.push_back({{p, n[1], n[2]}, others});
        parts.push_back({{p, n[2], q}, others});
      } else {
        parts.push_back({{p, n[1], q}, others});
        parts.push_back({{n[1], n[2], q}, others});
      }
    }
  }
  triangles_ = std::move(parts);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i] > 0) nodes_[i].form = m;
    if (signs[i] == 0) {
      nodes_[i].on_rim = true;
      if (forms_[static_cast<std::size_t>(nodes_[i].form)].level == 0) nodes_[i].form = m;
    }
  }
}

}  // namespace vericone
