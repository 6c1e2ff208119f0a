// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/predicates/orifice_truth.h>

#include <algorithm>
#include <array>

#include "predicates/algebra.h"

namespace vericone::verify {

using namespace algebra;

namespace {

/// An ellipse inside another, by squared half widths along (1, t): of the outer and the inner one, and of the
/// vector between their centres.
Transit nested(const Form& q_d, const Form& q_e, const Form& d2) {
  const Form h = q_d - q_e - d2, f = h * h - Integer(4) * (q_e * d2);

  bool touches = f.is_zero();
  const auto look = [&](int sign_f, int sign_h) {
    if (sign_f == 0) touches = true;
    return sign_f >= 0 && sign_h >= 0;
  };
  if (!look(sgn(f.c[4]), sgn(h.c[2]))) return Transit::blocked;
  if (f.is_zero()) {
    // H is a square or vanishes with F: of one sign.
    for (const int t : {-1, 0, 1})
      if (sign_at(h, Rational(t)) < 0) return Transit::blocked;
    return Transit::grazes;
  }
  const Roots roots(f);
  for (const Rational& t : roots.between())
    if (!look(sign_at(f, t), sign_at(h, t))) return Transit::blocked;
  for (std::size_t i = 0; i < roots.size(); ++i)
    if (!look(0, roots.sign_at(h, i))) return Transit::blocked;
  return touches ? Transit::grazes : Transit::passes;
}

}  // namespace

Transit orifice_truth(const Ellipsoid& agent, const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
                      double radius, const Eigen::Vector3d& velocity) {
  Unit length, of_normal, of_velocity;
  length.body<3>(agent);
  length.vector<3>(center);
  length.length(radius);
  of_normal.vector<3>(normal);
  of_velocity.vector<3>(velocity);
  const Matrix<3> s = shape_on_unit<3>(agent, length.e);
  const Vector<3> p = on_unit<3>(agent.center(), length.e), o = on_unit<3>(center, length.e),
                  m = on_unit<3>(normal, of_normal.e), w = on_unit<3>(velocity, of_velocity.e);
  const Integer r = whole(radius, length.e);
  Vector<3> c;  // from the opening to the agent
  for (int i = 0; i < 3; ++i) c[i] = p[i] - o[i];

  const Integer height = dot<3>(m, c), along = dot<3>(m, w);
  if (height * height < form<3>(s, m, m)) return Transit::blocked;  // cut by the plane
  if (sgn(height) * sgn(along) >= 0) return Transit::blocked;

  // x = o + y1 e1 + y2 e2 + s w with e1, e2 in the plane.
  const int k = m[0] != 0 ? 0 : m[1] != 0 ? 1 : 2;
  std::array<Vector<3>, 2> e{};
  for (int i = 0; i < 2; ++i) {
    e[i][(k + 1 + i) % 3] = m[k];
    e[i][k] = -m[(k + 1 + i) % 3];
  }
  Matrix<3> basis;
  for (int i = 0; i < 3; ++i) basis[i] = {e[0][i], e[1][i], w[i]};
  const Matrix<3> adj = adjugate<3>(basis);  // its first two rows times (x - o) are y det
  const Integer det = determinant<3>(basis);
  const Integer g11 = dot<3>(e[0], e[0]), g12 = dot<3>(e[0], e[1]), g22 = dot<3>(e[1], e[1]),
                g = g11 * g22 - g12 * g12;

  // As forms in n = (1, t) over y, all times g det^2.
  const Integer disc = det * det * r * r;
  const Form d({dot<3>(adj[0], c), dot<3>(adj[1], c)}),
      q_d = disc * Form({g22, -2 * g12, g11}),
      q_e =
          g * Form({form<3>(s, adj[0], adj[0]), 2 * form<3>(s, adj[0], adj[1]), form<3>(s, adj[1], adj[1])}),
      d2 = g * (d * d);

  return nested(q_d, q_e, d2);
}

Transit orifice_truth(const Ellipsoid& agent, const PlacedOpening& placed, const Eigen::Vector3d& velocity) {
  const auto exactly = [](const Eigen::Vector3d& x) {
    return std::array<Rational, 3>{Rational(x.x()), Rational(x.y()), Rational(x.z())};
  };
  const auto dot3 = [](const std::array<Rational, 3>& x, const std::array<Rational, 3>& y) {
    return Rational(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
  };
  const auto cross3 = [](const std::array<Rational, 3>& x, const std::array<Rational, 3>& y) {
    return std::array<Rational, 3>{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2],
                                   x[0] * y[1] - x[1] * y[0]};
  };
  std::array<std::array<Rational, 3>, 3> s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      s[i][j] = agent.defined_by_factor() ? 0 : agent.shape()(i, j);
      for (int k = 0; k < 3 && agent.defined_by_factor(); ++k)
        s[i][j] += Rational(agent.factor()(i, k)) * Rational(agent.factor()(j, k));
    }
  const auto form3 = [&](const std::array<Rational, 3>& x, const std::array<Rational, 3>& y) {
    return dot3(x, {dot3(s[0], y), dot3(s[1], y), dot3(s[2], y)});
  };
  const auto u = exactly(placed.axes.col(0)), v = exactly(placed.axes.col(1)), w = exactly(velocity),
             m = cross3(u, v), p = exactly(agent.center()), o = exactly(placed.center);
  const std::array<Rational, 3> c{p[0] - o[0], p[1] - o[1], p[2] - o[2]};
  const Rational height = dot3(m, c), along = dot3(m, w);
  if (height * height < form3(m, m)) return Transit::blocked;
  if (sgn(height) * sgn(along) >= 0) return Transit::blocked;

  // x = o + y1 u + y2 v + t w.
  std::array<std::array<Rational, 3>, 2> row{cross3(v, w), cross3(w, u)};
  for (auto& r : row)
    for (Rational& x : r) x /= along;
  const std::array<Rational, 2> center{dot3(row[0], c), dot3(row[1], c)};
  const Rational e11 = form3(row[0], row[0]), e12 = form3(row[0], row[1]), e22 = form3(row[1], row[1]);

  if (!placed.opening.polygonal()) {
    const Rational a = placed.opening.semi_axes().x(), b = placed.opening.semi_axes().y();
    const std::array<Rational, 9> all{a * a,
                                      0,
                                      b * b,
                                      e11,
                                      2 * e12,
                                      e22,
                                      center[0] * center[0],
                                      2 * center[0] * center[1],
                                      center[1] * center[1]};
    Integer common = 1;
    for (const Rational& x : all) common = lcm(common, x.get_den());
    std::array<Form, 3> forms;
    for (int i = 0; i < 9; ++i) forms[i / 3].c.push_back(Integer(Rational(all[i] * common).get_num()));
    return nested(forms[0], forms[1], forms[2]);
  }

  // Of each edge from x to y: (x - center + t (y - x))^T adj(E) (...) - det E.
  const Rational det = e11 * e22 - e12 * e12;
  const auto q = [&](const std::array<Rational, 2>& x, const std::array<Rational, 2>& y) {
    return Rational(e22 * x[0] * y[0] - e12 * (x[0] * y[1] + x[1] * y[0]) + e11 * x[1] * y[1]);
  };
  const auto& vertices = placed.opening.vertices();
  const auto relative = [&](const Eigen::Vector2d& x) {
    return std::array<Rational, 2>{Rational(x.x()) - center[0], Rational(x.y()) - center[1]};
  };
  bool inside = false, touches = false;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto x = relative(vertices[i]), y = relative(vertices[(i + 1) % vertices.size()]);
    const std::array<Rational, 2> e{y[0] - x[0], y[1] - x[1]};
    const Rational q0 = q(x, x) - det, q1 = 2 * q(x, e), q2 = q(e, e);
    Rational least = std::min(q0, Rational(q0 + q1 + q2));
    const Rational at = -q1 / (2 * q2);
    if (at > 0 && at < 1) least = q0 + q1 * at / 2;
    if (least < 0) return Transit::blocked;
    touches = touches || least == 0;
    // Upwards from the centre.
    if ((x[0] > 0) != (y[0] > 0)) inside = inside != (x[1] - x[0] * e[1] / e[0] > 0);
  }
  return !inside ? Transit::blocked : touches ? Transit::grazes : Transit::passes;
}

}  // namespace vericone::verify
