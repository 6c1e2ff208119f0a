// SPDX-License-Identifier: BSD-3-Clause
//
// The inequalities that common points of two bodies satisfy within a part of the time: forms of (1, y, t)
// that are at most 0 there, y = x - t v_B.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "certificate/pieces.h"

namespace vericone::certificates {

using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Of numbers N: a symmetric matrix of z = (1, y, t), metres and seconds, and a linear form of it.
template <typename N>
using Form = std::array<std::array<N, 5>, 5>;
template <typename N>
using Linear = std::array<N, 5>;

/// What is above zero at common points, and how the file names it.
struct Bound {
  enum class Kind : std::uint8_t { one, from, until, agent, obstacle, cut } kind;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of a body with corners; whole numbers
  std::size_t index = 0;                             // of a cut
};

/// A half of space along an axis: y_axis <= at, or >= at.
struct Cut {
  int axis;
  double at;
  bool above;
};

/// One inequality: of a body, or the product of two bounds.
struct Inequality {
  int body;   // 0 the agent's, 1 the obstacle's, 2 a product
  int index;  // of the body's forms: 0 the ellipsoid's, then the delimiters'; of the products
};

/// The part of the time that is asked about.
struct Part {
  double from, until;
};

template <typename N>
N number(double x) {
  return N(x);
}

class Inequalities {
 public:
  /// `cuts`: of enclosing halves, from the outermost on.
  Inequalities(const PairOfPieces& pair, const Part& part, const std::vector<Cut>& cuts = {})
      : pair_(pair), part_(part), cuts_(cuts) {
    moves_ = pair.question.v_a != pair.question.v_b && part.from < part.until;
    for (const bool agent : {true, false}) {
      const Piece& piece = agent ? pair.a : pair.b;
      if (!piece.round()) {
        add_corners(piece, agent);
        continue;
      }
      const int count = 1 + (piece.quadric ? static_cast<int>(piece.quadric->delimiters().size()) : 0);
      for (int i = 0; i < count; ++i) list_.push_back({agent ? 0 : 1, i});
    }
    if (!cuts_.empty()) add_cuts();
    if (!moves_) return;
    add({Bound::Kind::one}, {Bound::Kind::from});
    if (std::isinf(part.until)) return;
    add({Bound::Kind::one}, {Bound::Kind::until});
    add({Bound::Kind::from}, {Bound::Kind::until});
  }

  [[nodiscard]] const std::vector<Inequality>& list() const { return list_; }
  [[nodiscard]] int size() const { return moves_ ? 5 : 4; }
  [[nodiscard]] bool moves() const { return moves_; }
  [[nodiscard]] const Part& part() const { return part_; }

  template <typename N>
  [[nodiscard]] Form<N> form(const Inequality& of) const {
    if (of.body == 2) return product<N>(products_[of.index]);
    const Piece& piece = of.body == 0 ? pair_.a : pair_.b;
    std::array<std::array<N, 3>, 3> k;
    N level = number<N>(1);
    if (of.index > 0) {
      const Delimiter<3>& delimiter = piece.quadric->delimiters()[of.index - 1];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) k[i][j] = number<N>(delimiter.matrix(i, j));
      level = number<N>(delimiter.level);
    } else if (piece.ball) {
      const N radius = number<N>(piece.ball->factor()(0, 0));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) k[i][j] = number<N>(i == j);
      level = radius * radius;
    } else {
      k = inverse_shape<N>(*piece.round());
    }
    // Rows of y - p - t v, v of the agent as seen from the obstacle.
    const bool agent = of.body == 0;
    const Eigen::Vector3d &own = piece.round()->center(),
                          &at = agent ? pair_.question.agent.at() : pair_.question.obstacle.at();
    std::array<Linear<N>, 3> rows;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rows[i][j + 1] = number<N>(i == j);
      rows[i][0] = -(number<N>(own(i)) + number<N>(at(i)));
      rows[i][4] =
          agent ? N(number<N>(pair_.question.v_b(i)) - number<N>(pair_.question.v_a(i))) : number<N>(0);
      fix_time(rows[i]);
    }
    Form<N> form;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) {
        N sum = number<N>(0);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) sum += rows[i][r] * k[i][j] * rows[j][c];
        form[r][c] = sum;
      }
    form[0][0] -= level;
    return form;
  }

  void write(Text& text, const std::vector<double>& multipliers) const {
    text.raw("{\"rule\": \"forms\"");
    for (const int body : {0, 1}) {
      text.raw(body == 0 ? ", \"agent\": [" : ", \"obstacle\": [");
      const Piece& piece = body == 0 ? pair_.a : pair_.b;
      const char* between = "";
      if (piece.is_ball && !piece.round()) text.raw("0");  // it is bounded as a corner
      for (std::size_t i = 0; i < list_.size(); ++i) {
        if (list_[i].body != body) continue;
        text.raw(between).number(multipliers[i]);
        between = ", ";
      }
      text.raw("]");
    }
    const char* between = ", \"products\": [[";
    bool any = false;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (list_[i].body != 2 || multipliers[i] == 0) continue;
      const auto& [first, second] = products_[list_[i].index];
      write(text.raw(between), first);
      write(text.raw(", "), second);
      text.raw(", ").number(multipliers[i]).raw("]");
      between = ", [";
      any = true;
    }
    text.raw(any ? "]}" : "}");
  }

 private:
  using Product = std::array<Bound, 2>;

  static void write(Text& text, const Bound& bound) {
    switch (bound.kind) {
      case Bound::Kind::one:
        text.raw("\"one\"");
        break;
      case Bound::Kind::from:
        text.raw("\"from\"");
        break;
      case Bound::Kind::until:
        text.raw("\"until\"");
        break;
      case Bound::Kind::cut:
        text.raw("[\"cut\", ").index(bound.index).raw("]");
        break;
      default:
        text.raw(bound.kind == Bound::Kind::agent ? "[\"agent\", " : "[\"obstacle\", ");
        text.number(bound.normal).raw("]");
    }
  }

  void add(const Bound& first, const Bound& second) {
    list_.push_back({2, static_cast<int>(products_.size())});
    products_.push_back({first, second});
  }

  /// Slabs about the corners: of a triangle along its plane and its sides, of others along the axes.
  void add_corners(const Piece& piece, bool agent) {
    std::vector<Eigen::Vector3d> normals;
    if (piece.corners.size() == 3) {
      const Eigen::Vector3d e = piece.corners[1] - piece.corners[0], f = piece.corners[2] - piece.corners[0],
                            n = e.cross(f);
      normals = {n, n.cross(e), n.cross(f), n.cross(f - e)};
    }
    if (piece.corners.size() == 2) {  // along it and across
      const Eigen::Vector3d e = piece.corners[1] - piece.corners[0], n = e.unitOrthogonal();
      normals = {e, n, n.cross(e)};
    }
    for (Eigen::Vector3d& n : normals) {
      n /= n.cwiseAbs().maxCoeff();
      n = (0x1p20 * n).array().round();
    }
    std::erase_if(normals, [](const Eigen::Vector3d& n) { return !n.allFinite(); });
    if (normals.empty())
      normals = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
    const auto kind = agent ? Bound::Kind::agent : Bound::Kind::obstacle;
    for (const Eigen::Vector3d& n : normals) {
      add({kind, n}, {kind, -n});
      add({Bound::Kind::one}, {kind, n});
      add({Bound::Kind::one}, {kind, -n});
    }
  }

  /// Of the cuts those that bound y most, each with all others and with what bounds corners along its axis.
  void add_cuts() {
    std::vector<Bound> nearest;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      bool bounds = true;  // later cuts are within those before
      for (std::size_t l = k + 1; l < cuts_.size(); ++l)
        bounds = bounds && !(cuts_[l].axis == cuts_[k].axis && cuts_[l].above == cuts_[k].above);
      if (bounds) nearest.push_back({Bound::Kind::cut, Eigen::Vector3d::Zero(), k});
    }
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const Cut& cut = cuts_[nearest[i].index];
      add({Bound::Kind::one}, nearest[i]);
      for (std::size_t j = 0; j < i; ++j) add(nearest[j], nearest[i]);
      for (const bool agent : {true, false}) {
        if ((agent ? pair_.a : pair_.b).round()) continue;
        const Bound::Kind kind = agent ? Bound::Kind::agent : Bound::Kind::obstacle;
        const Eigen::Vector3d along = (cut.above ? 1.0 : -1.0) * Eigen::Vector3d::Unit(cut.axis);
        add(nearest[i], {kind, along});
      }
      if (!moves_) continue;
      add({Bound::Kind::from}, nearest[i]);
      if (!std::isinf(part_.until)) add({Bound::Kind::until}, nearest[i]);
    }
    for (const bool agent : {true, false}) add_faces(agent ? pair_.a : pair_.b, agent);
  }

  /// What bounds few corners on their faces.
  void add_faces(const Piece& piece, bool agent) {
    const std::size_t count = piece.corners.size();
    if (piece.round() || count < 4 || count > 10) return;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        for (std::size_t k = j + 1; k < count; ++k) {
          const Eigen::Vector3d& x = piece.corners[i];
          Eigen::Vector3d n = (piece.corners[j] - x).cross(piece.corners[k] - x);
          double low = 0, high = 0;
          for (const Eigen::Vector3d& y : piece.corners) {
            low = std::min(low, n.dot(y - x));
            high = std::max(high, n.dot(y - x));
          }
          const double most = std::max(high, -low);
          if (!(std::min(high, -low) <= 1e-9 * most) || !(most > 0)) continue;
          if (high > -low) n = -n;
          n = (0x1p20 / n.cwiseAbs().maxCoeff() * n).array().round();
          add({Bound::Kind::one}, {agent ? Bound::Kind::agent : Bound::Kind::obstacle, n});
        }
  }

  template <typename N>
  void fix_time(Linear<N>& row) const {
    if (moves_) return;
    row[0] += row[4] * number<N>(part_.from);
    row[4] = number<N>(0);
  }

  template <typename N>
  Linear<N> linear(const Bound& bound) const {
    Linear<N> row;
    row.fill(number<N>(0));
    if (bound.kind == Bound::Kind::one) {
      row[0] = number<N>(1);
    } else if (bound.kind == Bound::Kind::from) {
      row[0] = -number<N>(part_.from);
      row[4] = number<N>(1);
    } else if (bound.kind == Bound::Kind::until) {
      row[0] = number<N>(part_.until);
      row[4] = number<N>(-1);
    } else if (bound.kind == Bound::Kind::cut) {
      const Cut& cut = cuts_[bound.index];
      row[0] = cut.above ? N(-number<N>(cut.at)) : number<N>(cut.at);
      row[cut.axis + 1] = number<N>(cut.above ? 1 : -1);
    } else {
      const bool agent = bound.kind == Bound::Kind::agent;
      const Piece& piece = agent ? pair_.a : pair_.b;
      const Eigen::Vector3d& at = agent ? pair_.question.agent.at() : pair_.question.obstacle.at();
      bool first = true;
      for (const Eigen::Vector3d& x : piece.corners) {
        N value = number<N>(0);
        for (int i = 0; i < 3; ++i)
          value += number<N>(bound.normal(i)) * (number<N>(x(i)) + number<N>(at(i)));
        if (first || value > row[0]) row[0] = value;
        first = false;
      }
      for (int i = 0; i < 3; ++i) {
        row[i + 1] = -number<N>(bound.normal(i));
        if (agent)
          row[4] += number<N>(bound.normal(i)) *
                    (number<N>(pair_.question.v_a(i)) - number<N>(pair_.question.v_b(i)));
      }
      fix_time(row);
    }
    return row;
  }

  template <typename N>
  Form<N> product(const Product& of) const {
    const Linear<N> x = linear<N>(of[0]), y = linear<N>(of[1]);
    Form<N> form;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) form[r][c] = -(x[r] * y[c] + x[c] * y[r]) / number<N>(2);
    return form;
  }

  template <typename N>
  static std::array<std::array<N, 3>, 3> inverse_shape(const Ellipsoid& body) {
    const bool by_factor = body.defined_by_factor();
    std::array<std::array<N, 3>, 3> m, adj, k;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = number<N>(by_factor ? body.factor()(i, j) : body.shape()(i, j));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
        adj[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
      }
    const N det = m[0][0] * adj[0][0] + m[0][1] * adj[1][0] + m[0][2] * adj[2][0];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if (!by_factor) {
          k[i][j] = adj[i][j] / det;
          continue;
        }
        k[i][j] = number<N>(0);
        for (int e = 0; e < 3; ++e) k[i][j] += adj[e][i] * adj[e][j];
        k[i][j] /= det * det;
      }
    return k;
  }

  const PairOfPieces& pair_;
  Part part_;
  std::vector<Cut> cuts_;
  bool moves_ = false;
  std::vector<Inequality> list_;
  std::vector<Product> products_;
};

}  // namespace vericone::certificates
