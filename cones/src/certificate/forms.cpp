// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/forms.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "combined/quadratic_search.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Of numbers N: a symmetric matrix of z = (1, y, t), metres and seconds, and a linear form of it.
template <typename N>
using Form = std::array<std::array<N, 5>, 5>;
template <typename N>
using Linear = std::array<N, 5>;

/// What is above zero at common points, and how the file names it.
struct Bound {
  enum class Kind : std::uint8_t { one, from, until, agent, obstacle } kind;
  Vector3d normal = Vector3d::Zero();  // of a body with corners; whole numbers
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
  Inequalities(const PairOfPieces& pair, const Part& part) : pair_(pair), part_(part) {
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
    const Vector3d &own = piece.round()->center(),
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
      const char* between = "";
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
    std::vector<Vector3d> normals;
    if (piece.corners.size() == 3) {
      const Vector3d e = piece.corners[1] - piece.corners[0], f = piece.corners[2] - piece.corners[0],
                     n = e.cross(f);
      normals = {n, n.cross(e), n.cross(f), n.cross(f - e)};
    }
    for (Vector3d& n : normals) {
      n /= n.cwiseAbs().maxCoeff();
      n = (0x1p20 * n).array().round();
    }
    std::erase_if(normals, [](const Vector3d& n) { return !n.allFinite(); });
    if (normals.empty()) normals = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    const auto kind = agent ? Bound::Kind::agent : Bound::Kind::obstacle;
    for (const Vector3d& n : normals) {
      add({kind, n}, {kind, -n});
      add({Bound::Kind::one}, {kind, n});
      add({Bound::Kind::one}, {kind, -n});
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
    } else {
      const bool agent = bound.kind == Bound::Kind::agent;
      const Piece& piece = agent ? pair_.a : pair_.b;
      const Vector3d& at = agent ? pair_.question.agent.at() : pair_.question.obstacle.at();
      bool first = true;
      for (const Vector3d& x : piece.corners) {
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
  bool moves_ = false;
  std::vector<Inequality> list_;
  std::vector<Product> products_;
};

/// All pivots of the elimination above zero.
bool is_positive(Form<Rational> m, int size) {
  for (int k = 0; k < size; ++k) {
    if (m[k][k].sign() <= 0) return false;
    for (int r = k + 1; r < size; ++r) {
      if (m[r][k].is_zero()) continue;
      const Rational by = m[r][k] / m[k][k];
      for (int c = k + 1; c < size; ++c) m[r][c] -= by * m[k][c];
    }
  }
  return true;
}

/// Multipliers >= 0 of matrices, of sum 1, so that the sum is positive definite; empty where none are found.
/// By Newton's method along the central path of: the least s for which the sum and s times the identity is.
std::vector<double> positive_combination(const std::vector<Matrix5>& forms, int size) {
  const int m = static_cast<int>(forms.size());
  Eigen::VectorXd x = Eigen::VectorXd::Constant(m, 1.0 / m);
  const auto sum = [&](const Eigen::VectorXd& of) {
    Eigen::MatrixXd p = Eigen::MatrixXd::Zero(size, size);
    for (int i = 0; i < m; ++i) p += of(i) * forms[i].topLeftCorner(size, size);
    return p;
  };
  const auto least = [&](const Eigen::MatrixXd& p) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(p, Eigen::EigenvaluesOnly).eigenvalues()(0);
  };
  double s = 0.1 - std::min(0.0, least(sum(x)));
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
  // Unknowns: all but the last multiplier, and s.
  const auto value = [&](const Eigen::VectorXd& at, double shift, double weight) {
    if (at.minCoeff() <= 0) return std::numeric_limits<double>::infinity();
    const Eigen::LLT<Eigen::MatrixXd> root(sum(at) + shift * identity);
    if (root.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    return weight * shift - 2 * root.matrixLLT().diagonal().array().log().sum() - at.array().log().sum();
  };
  for (double weight = 10; weight < 1e9; weight *= 4) {
    for (int step = 0; step < 12; ++step) {
      const Eigen::MatrixXd inverse = (sum(x) + s * identity).inverse();
      std::vector<Eigen::MatrixXd> slopes;
      for (int i = 0; i + 1 < m; ++i)
        slopes.push_back(inverse * (forms[i] - forms[m - 1]).topLeftCorner(size, size));
      slopes.push_back(inverse);
      Eigen::VectorXd gradient(m);
      Eigen::MatrixXd curvature(m, m);
      for (int i = 0; i < m; ++i) {
        gradient(i) = -slopes[i].trace();
        for (int j = 0; j <= i; ++j) curvature(i, j) = curvature(j, i) = (slopes[i] * slopes[j]).trace();
      }
      for (int i = 0; i + 1 < m; ++i) {
        gradient(i) += 1 / x(m - 1) - 1 / x(i);
        curvature(i, i) += 1 / (x(i) * x(i));
        for (int j = 0; j + 1 < m; ++j) curvature(i, j) += 1 / (x(m - 1) * x(m - 1));
      }
      gradient(m - 1) += weight;
      const Eigen::VectorXd move = -curvature.ldlt().solve(gradient);
      if (!move.allFinite()) break;
      Eigen::VectorXd way = Eigen::VectorXd::Zero(m);
      way.head(m - 1) = move.head(m - 1);
      way(m - 1) = -move.head(m - 1).sum();
      const double before = value(x, s, weight), slope = gradient.dot(move);
      double length = 1;
      while (length > 1e-6 &&
             !(value(x + length * way, s + length * move(m - 1), weight) <= before + 0.1 * length * slope))
        length /= 2;
      if (!(length > 1e-6)) break;
      x += length * way;
      s += length * move(m - 1);
      if (-slope < 1e-3) break;
    }
    // Deep enough inside to be cut to few digits.
    const double depth = least(sum(x));
    if (depth > 0 && depth > 0.3 / weight * size) return {x.data(), x.data() + m};
    if (s > 0 && weight * s > 50 * (m + size)) return {};
  }
  if (least(sum(x)) > 0) return {x.data(), x.data() + m};
  return {};
}

double cut(double x, int bits) {
  if (!(x > 0)) return 0;
  const int unit = std::ilogb(x) - bits;
  return std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit);
}

/// By multipliers for all of a part of the time.
bool prove_part(const PairOfPieces& pair, const Part& part, Text& proof) {
  const Inequalities inequalities(pair, part);
  const auto& list = inequalities.list();
  const int size = inequalities.size();
  // Coordinates in which the bodies are about one large.
  const auto middle = [](const Piece& piece, const Vector3d& at) {
    if (piece.round()) return Vector3d(piece.round()->center() + at);
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& x : piece.corners) sum += x / static_cast<double>(piece.corners.size());
    return Vector3d(sum + at);
  };
  const auto extent = [](const Piece& piece) {
    if (piece.round()) return piece.round()->factor().norm();
    double most = 0;
    for (const Vector3d& x : piece.corners) most = std::max(most, (x - piece.corners.front()).norm());
    return most;
  };
  const Vector3d w = pair.question.v_a - pair.question.v_b;
  const double length = std::max(extent(pair.a), extent(pair.b)), speed = w.norm();
  const double beat = !inequalities.moves()    ? 1
                      : std::isinf(part.until) ? length / speed
                                               : std::min(length / speed, part.until - part.from);
  const Vector3d center = middle(pair.b, pair.question.obstacle.at());
  const double near =
      speed > 0 ? (center - middle(pair.a, pair.question.agent.at())).dot(w) / (speed * speed) : 0;
  const double moment =
      std::clamp(near, part.from, std::isinf(part.until) ? std::max(near, part.from) : part.until);
  Matrix5 change = Matrix5::Zero();
  change(0, 0) = 1;
  change.block<3, 1>(1, 0) = center;
  change.block<3, 3>(1, 1) = length * Eigen::Matrix3d::Identity();
  change(4, 0) = moment;
  change(4, 4) = beat;
  std::vector<Matrix5> forms;
  std::vector<double> sizes;
  for (const Inequality& of : list) {
    const Form<double> form = inequalities.form<double>(of);
    Matrix5 m;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) m(r, c) = form[r][c];
    m = change.transpose() * m * change;
    if (size == 4) m.row(4).setZero(), m.col(4).setZero();
    sizes.push_back(std::max(m.norm(), 1e-300));
    forms.push_back(m / sizes.back());
  }
  const std::vector<double> found = positive_combination(forms, size);
  if (found.empty()) return false;
  std::vector<Form<Rational>> exact;
  for (const Inequality& of : list) exact.push_back(inequalities.form<Rational>(of));
  for (const int bits : {4, 10, 20, 50}) {
    std::vector<double> multipliers;
    for (std::size_t i = 0; i < list.size(); ++i)
      multipliers.push_back(found[i] > std::ldexp(0.1, -bits) ? cut(found[i] / sizes[i], bits) : 0);
    Form<Rational> sum;
    for (auto& row : sum) row.fill(Rational(0));
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (multipliers[i] == 0) continue;
      const Rational times(multipliers[i]);
      for (int r = 0; r < size; ++r)
        for (int c = 0; c < size; ++c) sum[r][c] += times * exact[i][r][c];
    }
    if (!is_positive(std::move(sum), size)) continue;
    inequalities.write(proof, multipliers);
    return true;
  }
  return false;
}

constexpr int kDeepest = 5;  // parts of parts

bool prove_parts(const PairOfPieces& pair, const Part& part, int depth, std::vector<double>& cuts,
                 std::vector<std::string>& proofs) {
  Question question = pair.question;
  question.horizon = {part.from, part.until};
  const PairOfPieces now{pair.a, pair.b, question, pair.agent, pair.obstacle};
  Text text;
  if (prove_out(now, text) || prove_part(now, part, text)) {
    proofs.push_back(text.take());
    return true;
  }
  const Vector3d w = question.v_a - question.v_b;
  if (depth == kDeepest || w.isZero(0) || !(part.from < part.until)) return false;
  // A way without end: until they have passed, and after.
  double middle = 0.5 * (part.from + part.until);
  if (std::isinf(part.until)) {
    const Eigen::Vector3d c = question.obstacle.at() - question.agent.at();
    middle = part.from + std::max(c.norm(), 1.0) / w.norm() * (depth == 0 ? 1.0 : 2.0);
  }
  middle = static_cast<double>(static_cast<float>(middle));
  if (!(part.from < middle && middle < part.until)) return false;
  if (!prove_parts(pair, {part.from, middle}, depth + 1, cuts, proofs)) return false;
  cuts.push_back(middle);
  return prove_parts(pair, {middle, part.until}, depth + 1, cuts, proofs);
}

}  // namespace

bool prove_out_by_forms(const PairOfPieces& pair, Text& proof) {
  std::vector<double> cuts;
  std::vector<std::string> proofs;
  if (!prove_parts(pair, {pair.question.horizon.from, pair.question.horizon.until}, 0, cuts, proofs))
    return false;
  if (cuts.empty()) {
    proof.raw(proofs.front());
    return true;
  }
  const char* between = "{\"rule\": \"times\", \"cuts\": [";
  for (const double cut_at : cuts) {
    proof.raw(between).number(cut_at);
    between = ", ";
  }
  between = "], \"proofs\": [";
  for (const std::string& one : proofs) {
    proof.raw(between).raw(one);
    between = ", ";
  }
  proof.raw("]}");
  return true;
}

namespace {

/// Where a search for a common point looks: z = change (1, q, tau), q and tau between 0 and 1.
struct Place {
  Matrix5 change = Matrix5::Zero();
  std::vector<std::uint32_t> corners = {};  // of which q has the weights, of all but the first
};

/// A point that satisfies all with some room, as a search in doubles finds it.
std::optional<Eigen::Vector4d> find_point(const Inequalities& inequalities, const Place& place) {
  std::vector<QuadraticConstraint<4>> constraints;
  for (const Inequality& of : inequalities.list()) {
    if (of.body == 2) continue;
    const Form<double> form = inequalities.form<double>(of);
    Matrix5 m;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) m(r, c) = form[r][c];
    m = place.change.transpose() * m * place.change;
    m /= std::max(m.norm(), 1e-300);
    QuadraticConstraint<4> q;
    q.c = m(0, 0);
    q.g = m.block<4, 1>(1, 0);
    q.h = m.block<4, 4>(1, 1);
    const double least =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(q.h, Eigen::EigenvaluesOnly).eigenvalues()(0);
    q.concavity = std::max(0.0, -least) + 1e-12;
    constraints.push_back(q);
  }
  if (!place.corners.empty()) {
    QuadraticConstraint<4> sum;  // of the weights, at most one
    sum.g.head<3>().setConstant(0.5);
    sum.c = -1;
    constraints.push_back(sum);
  }
  static thread_local QuadraticSearch<4> search;
  const SearchBox<4> box{Eigen::Vector4d::Constant(0.5), Eigen::Vector4d::Constant(0.5)};
  for (const double room : {1e-2, 1e-4, 1e-7, 1e-10}) {
    for (std::size_t i = 0; i < constraints.size() - (place.corners.empty() ? 0 : 1); ++i)
      constraints[i].slack = room;
    const auto result = search.run(constraints, box, {room / 8, 4000});
    if (result.outcome == SearchOutcome::found) return result.point;
  }
  return std::nullopt;
}

bool all_inside(const Inequalities& inequalities, const std::array<Rational, 5>& z) {
  for (const Inequality& of : inequalities.list()) {
    if (of.body == 2) continue;
    const Form<Rational> m = inequalities.form<Rational>(of);
    Rational sum = 0;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) sum += z[r] * m[r][c] * z[c];
    if (sum.sign() >= 0) return false;
  }
  return true;
}

Rational cut_to(double x, int unit) {
  return Rational(std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit));
}

/// Rounds what was found, and writes it where it is still right.
bool write_point(const PairOfPieces& pair, const Inequalities& inequalities, const Place& place,
                 const Eigen::Vector4d& q, Text& proof) {
  const Eigen::Matrix<double, 5, 1> at = place.change * (Eigen::Matrix<double, 5, 1>() << 1, q).finished();
  const auto& [from, until] = inequalities.part();
  const bool of_agent = !pair.a.round();
  const Question& question = pair.question;
  const double length = place.change.block<3, 3>(1, 1).norm();
  for (const int bits : {6, 12, 20, 32, 46}) {
    std::array<Rational, 5> z;
    z[0] = 1;
    double t = inequalities.moves() ? at(4) : from;
    if (inequalities.moves()) {
      const int unit = log2_of(place.change(4, 4)) - bits;
      t = std::clamp(std::ldexp(std::nearbyint(std::ldexp(t, -unit)), unit), from, until);
    }
    z[4] = Rational(t);
    std::vector<Rational> weights;
    std::array<Rational, 3> x;  // in the world
    for (int i = 0; i < 3; ++i) x[i] = 0;
    if (place.corners.empty()) {
      for (int i = 0; i < 3; ++i) {
        z[i + 1] = cut_to(at(i + 1), log2_of(length) - bits);
        x[i] = z[i + 1] + z[4] * Rational(question.v_b(i));
      }
    } else {
      const Piece& piece = of_agent ? pair.a : pair.b;
      weights.push_back(1);
      for (std::size_t k = 1; k < place.corners.size(); ++k) {
        weights.push_back(cut_to(std::max(q(static_cast<Eigen::Index>(k) - 1), 0.0), -bits));
        weights[0] -= weights.back();
      }
      if (weights[0].sign() < 0) continue;
      for (int i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < weights.size(); ++k)
          x[i] += weights[k] * Rational(piece.corners[place.corners[k]](i));
        x[i] += Rational((of_agent ? question.agent : question.obstacle).at()(i)) +
                z[4] * Rational((of_agent ? question.v_a : question.v_b)(i));
        z[i + 1] = x[i] - z[4] * Rational(question.v_b(i));
      }
    }
    if (!all_inside(inequalities, z)) continue;
    proof.raw("{\"rule\": \"point\", \"time\": ").number(t).raw(", \"point\": [").number(x[0]).raw(", ");
    proof.number(x[1]).raw(", ").number(x[2]).raw("], \"inside\": ");
    proof.raw(of_agent ? "\"obstacle\"" : "\"agent\"");
    const char* between = of_agent ? ", \"agent_weights\": [[" : ", \"obstacle_weights\": [[";
    bool any = false;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k].is_zero()) continue;
      proof.raw(between).index(place.corners[k]).raw(", ").number(weights[k]).raw("]");
      between = ", [";
      any = true;
    }
    if (any) proof.raw("]");
    if (pair.agent) proof.raw(", \"agent_piece\": ").index(*pair.agent);
    if (pair.obstacle) proof.raw(", \"obstacle_piece\": ").index(*pair.obstacle);
    proof.raw("}");
    return true;
  }
  return false;
}

}  // namespace

bool prove_in_of_forms(const PairOfPieces& pair, Text& proof) {
  const Question& question = pair.question;
  const Vector3d w = question.v_a - question.v_b;
  const Vector3d &at_a = question.agent.at(), &at_b = question.obstacle.at();
  Part part{question.horizon.from, question.horizon.until};
  if (w.isZero(0)) part.until = part.from;
  if (std::isinf(part.until)) {  // until they have passed
    const auto reach = [](const Piece& piece) {
      double most = 0;
      if (const Ellipsoid* body = piece.round()) most = body->center().norm() + body->factor().norm();
      for (const Vector3d& x : piece.corners) most = std::max(most, x.norm());
      return most;
    };
    const double far = (at_b - at_a).norm() + reach(pair.a) + reach(pair.b);
    part.until = part.from + far / w.norm() + part.from;
  }
  const Inequalities inequalities(pair, part);
  Place place;
  place.change(0, 0) = 1;
  place.change(4, 0) = part.from;
  place.change(4, 4) = inequalities.moves() ? part.until - part.from : 0;
  const auto look = [&] {
    const auto found = find_point(inequalities, place);
    return found && write_point(pair, inequalities, place, *found, proof);
  };
  if (pair.a.round() && pair.b.round()) {
    const Ellipsoid& body = *pair.b.round();
    const Vector3d half = body.factor().rowwise().norm();
    place.change.block<3, 1>(1, 0) = body.center() + at_b - half;
    place.change.block<3, 3>(1, 1) = (2 * half).asDiagonal();
    return look();
  }
  // A point of a hull is one of a tetrahedron of corners, the first among them.
  const bool of_agent = !pair.a.round();
  const std::vector<Vector3d>& corners = of_agent ? pair.a.corners : pair.b.corners;
  std::vector<std::uint32_t> distinct;
  for (std::uint32_t i = 0; i < corners.size(); ++i)
    if (std::none_of(distinct.begin(), distinct.end(), [&](auto k) { return corners[k] == corners[i]; }))
      distinct.push_back(i);
  const auto look_among = [&](const std::vector<std::uint32_t>& some) {
    place.corners = some;
    const Vector3d& first = corners[some.front()];
    place.change.block<3, 1>(1, 0) = first + (of_agent ? at_a : at_b);
    if (of_agent) place.change.block<3, 1>(1, 0) += part.from * w;
    if (of_agent) place.change.block<3, 1>(1, 4) = place.change(4, 4) * w;
    place.change.block<3, 3>(1, 1).setZero();
    for (std::size_t k = 1; k < some.size(); ++k)
      place.change.block<3, 1>(1, static_cast<Eigen::Index>(k)) = corners[some[k]] - first;
    return look();
  };
  const std::size_t count = distinct.size();
  if (count <= 4) return look_among(distinct);
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k)
        if (look_among({distinct[0], distinct[i], distinct[j], distinct[k]})) return true;
  return false;
}

}  // namespace vericone::certificates
