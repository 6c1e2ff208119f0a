// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/program.h"

#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <algorithm>
#include <stdexcept>

#include "gmpz.h"
#include "predicates/algebra.h"

namespace vericone::verify {
namespace {

using namespace algebra;
using Eigen::Vector3d;
using Program = CGAL::Quadratic_program<CGAL::Gmpz>;

/// The unit of lengths on which the product t w lies as well.
void include_motion(Unit& unit, const Motion& motion) {
  for (double t : {motion.from, motion.to})
    for (double x : motion.w)
      if (t != 0 && x != 0) unit.e = std::min(unit.e, exponent(t) + exponent(x));
}

/// t w in units of 2^e.
Vector<3> shift(double t, const Vector3d& w, int e) {
  Vector<3> r;
  if (t == 0) return r;
  const int s = exponent(t);
  for (int i = 0; i < 3; ++i) r[i] = w(i) == 0 ? Integer(0) : whole(t, s) * whole(w(i), e - s);
  return r;
}

/// Directions have a unit of their own: their length says nothing.
Vector<3> direction(const Vector3d& d) {
  Unit unit;
  unit.vector<3>(d);
  return on_unit<3>(d, unit.e);
}

/// Sign of `reach` minus the least y^T m y, y = (convex combination of points) - (cone of directions).
int compare(const std::vector<Vector<3>>& points, const std::vector<Vector<3>>& directions,
            const Matrix<3>& m, const Integer& reach) {
  Program qp(CGAL::EQUAL, true, CGAL::Gmpz(0), false, CGAL::Gmpz(0));
  std::vector<Vector<3>> generators = points;
  for (Vector<3> d : directions) {
    for (Integer& x : d) x = -x;
    generators.push_back(d);
  }
  for (std::size_t i = 0; i < generators.size(); ++i) {
    const int row = static_cast<int>(i);
    qp.set_a(row, 0, CGAL::Gmpz(i < points.size() ? 1 : 0));
    const Vector<3> image = times<3>(m, generators[i]);
    for (int j = 0; j <= row; ++j) qp.set_d(row, j, gmpz(2 * dot<3>(image, generators[j])));
  }
  qp.set_b(0, CGAL::Gmpz(1));
  const auto solution = CGAL::solve_quadratic_program(qp, CGAL::Gmpz());
  if (!solution.is_optimal()) throw std::logic_error("no nearest point");
  const auto least = solution.objective_value();
  const Integer numerator(least.numerator().mpz()), denominator(least.denominator().mpz());
  return sgn(denominator) * sgn(Integer(reach * denominator - numerator));
}

}  // namespace

int compare_reach(const Ellipsoid& agent, std::span<const Vector3d> points, const Motion& motion) {
  Unit unit;
  unit.body<3>(agent);
  for (const Vector3d& x : points) unit.vector<3>(x);
  include_motion(unit, motion);
  const Vector<3> center = on_unit<3>(agent.center(), unit.e);
  std::vector<Vector<3>> differences, directions;
  for (const Vector3d& x : points) {
    const Vector<3> at = on_unit<3>(x, unit.e);
    for (double t : {motion.from, motion.to}) {
      const Vector<3> moved = shift(t, motion.w, unit.e);
      differences.push_back({Integer(at[0] - center[0] - moved[0]), Integer(at[1] - center[1] - moved[1]),
                             Integer(at[2] - center[2] - moved[2])});
      if (motion.from == motion.to || motion.w.isZero(0)) break;
    }
  }
  for (const Vector3d& d : motion.directions) directions.push_back(direction(d));
  const Matrix<3> s = shape_on_unit<3>(agent, unit.e);
  return compare(differences, directions, adjugate<3>(s), determinant<3>(s));
}

int compare_reach(std::span<const Vector3d> agent, std::span<const Vector3d> points, const Motion& motion,
                  const std::vector<double>& radii) {
  Unit unit;
  for (const Vector3d& x : agent) unit.vector<3>(x);
  for (const Vector3d& x : points) unit.vector<3>(x);
  for (double r : radii) unit.length(r);
  include_motion(unit, motion);
  if (unit.e == kNoExponent) unit.e = 0;
  std::vector<Vector<3>> differences, directions;
  for (const Vector3d& x : points)
    for (const Vector3d& a : agent) {
      const Vector<3> at = on_unit<3>(x, unit.e), center = on_unit<3>(a, unit.e);
      for (double t : {motion.from, motion.to}) {
        const Vector<3> moved = shift(t, motion.w, unit.e);
        differences.push_back({Integer(at[0] - center[0] - moved[0]), Integer(at[1] - center[1] - moved[1]),
                               Integer(at[2] - center[2] - moved[2])});
        if (motion.from == motion.to || motion.w.isZero(0)) break;
      }
    }
  for (const Vector3d& d : motion.directions) directions.push_back(direction(d));
  Integer reach = 0;
  for (double r : radii) reach += whole(r, unit.e);
  Matrix<3> identity{};
  for (int i = 0; i < 3; ++i) identity[i][i] = 1;
  return compare(differences, directions, identity, reach * reach);
}

}  // namespace vericone::verify
