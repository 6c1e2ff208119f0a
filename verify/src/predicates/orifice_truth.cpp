// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/verify/predicates/orifice_truth.h>

#include "predicates/algebra.h"

namespace vericone::verify {

using namespace algebra;

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
      d2 = g * (d * d), h = q_d - q_e - d2, f = h * h - Integer(4) * (q_e * d2);

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

}  // namespace vericone::verify
