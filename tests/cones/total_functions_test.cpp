// SPDX-License-Identifier: BSD-3-Clause
//
// Every function of the cones has an answer, or an InputError that names a field, for bodies that are not
// disjoint and for arguments that belong to other bodies or to none.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/map/cell.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <vericone/internal/cones/planar/enclose_sector.h>
#include <vericone/internal/cones/slices/slice_sector.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <vericone/internal/cones/times/order.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <numbers>

namespace vericone::total_functions_test {
namespace {

ConeMapOptions coarse() {
  ConeMapOptions options;
  options.resolution = 1;
  return options;
}

using Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;

struct Case {
  const char* name;
  Relation relation;
  Vector3d at, axes;  // of the obstacle; the agent is the unit ball about the origin
};

const Case kCases[] = {
    {"overlapping", Relation::overlapping, {2.5, 0, 0}, {2, 2, 2}},
    {"overlapping, of other axes", Relation::overlapping, {0.5, 1.5, -0.25}, {0.25, 2, 1}},
    {"touching", Relation::touching, {3, 0, 0}, {2, 2, 2}},
    {"touching, another axis", Relation::touching, {0, 0, -1.5}, {3, 0.125, 0.5}},
    {"same centre", Relation::overlapping, {0, 0, 0}, {2, 0.5, 1}},
    {"the same body", Relation::overlapping, {0, 0, 0}, {1, 1, 1}},
    {"contained", Relation::overlapping, {0.25, 0, 0}, {0.5, 0.25, 0.125}},
    {"containing", Relation::overlapping, {0.25, 0, 0}, {5, 6, 7}},
    {"touching from inside", Relation::overlapping, {0.5, 0, 0}, {0.5, 0.5, 0.5}},
};

const Vector3d kVelocities[] = {{1, 0, 0},          {-1, 0, 0},      {0, 1, 0},     {0, 0, 1},
                                {0, 0, -1},         {4, 3, 0},       {-4, 3, 1e-9}, {1e-300, 0, 0},
                                {1e300, 1e300, -1}, {0, -2, 5e-324}, {0, 0, 0},     {3, -4, 12},
                                {-1e-30, 1, 1e8},   {1e-17, 1, 0},   {-1e-17, 1, 0}};

Ellipsoid agent() { return Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}); }
Ellipsoid obstacle(const Case& c) { return Ellipsoid::from_axes(c.at, c.axes); }
Ellipse flat(const Ellipsoid& body, int first, int second) {
  const Vector3d& p = body.center();
  return Ellipse::from_axes({p(first), p(second)},
                            {body.factor()(first, first), body.factor()(second, second)});
}

/// The field an InputError names, "" where there is an answer.
template <typename Ask>
std::string refused(const Ask& ask) {
  try {
    ask();
  } catch (const InputError& e) {
    return e.field().empty() ? "an unnamed field" : e.field();
  }
  return "";
}

/// What the header says of bodies that are not disjoint. The normal of the touching cases is along c.
template <typename Vector>
Membership expected(Relation relation, const Vector& c, const Vector& w) {
  if (w.isZero(0)) return Membership::out;
  if (relation == Relation::overlapping) return Membership::in;
  int k = 0;
  c.cwiseAbs().maxCoeff(&k);
  const double along = c(k) > 0 ? w(k) : -w(k);
  return along > 0 ? Membership::in : along < 0 ? Membership::out : Membership::on;
}

TEST(TotalFunctions, ReadmeWithBodiesThatOverlap) {
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  const Ellipsoid obstacle = Ellipsoid::from_axes({2.5, 0, 0}, {2, 2, 2});
  const ConeOracle oracle(agent, obstacle);
  EXPECT_EQ(oracle.membership({4, 3, 0}), Membership::in);
  const TrueCone cone = true_cone(agent, obstacle, 48);
  EXPECT_EQ(cone.solid_angle, 4 * pi);
  EXPECT_EQ(refused([&] { cone_bounds(cone, agent, obstacle); }), "bodies");
  EXPECT_LT(clearance(agent, obstacle, {4, 3.5, 0}).distance, 0);
}

TEST(TotalFunctions, MembershipInSpace) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Ellipsoid a = agent(), b = obstacle(c);
    const ConeOracle oracle(a, b), mirrored(b, a);
    ASSERT_EQ(oracle.relation(), c.relation);
    const exact::RationalBody<3> ra(a), rb(b);
    for (const Vector3d& w : kVelocities) {
      SCOPED_TRACE(w.transpose());
      const Membership is = expected<Vector3d>(c.relation, c.at, w);
      EXPECT_EQ(oracle.membership(w), is);
      EXPECT_EQ(mirrored.membership(-w), is) << "law (2)";
      EXPECT_EQ(oracle.membership(Vector3d(0.5 * w), Vector3d(-0.5 * w)),
                expected<Vector3d>(c.relation, c.at, 0.5 * w));
      EXPECT_EQ(oracle.exact_membership(w, Vector3d::Zero()), is);
      EXPECT_EQ(exact::membership(ra, rb, exact::to_rational<3>(w)), is);
      EXPECT_EQ(oracle.triage_membership(w).value_or(is), is);
      EXPECT_EQ(oracle.interval_membership(w, Vector3d::Zero()).value_or(is), is);
      if (c.relation == Relation::overlapping) {
        EXPECT_EQ(oracle.naive_membership(w), is);
        EXPECT_TRUE(oracle.triage_membership(w)) << "no integers for what is known";
      }
      const Passage passage = oracle.passage(w);
      EXPECT_EQ(passage == Passage::ahead, is == Membership::in);
      EXPECT_EQ(passage == Passage::ahead_grazing, is == Membership::on);
      EXPECT_EQ(passage == Passage::never, w.isZero(0));
      EXPECT_EQ(oracle.verdict(w, Vector3d::Zero()),
                c.relation == Relation::touching ? Verdict::touching : Verdict::overlapping);
    }
    for (const double bad : {std::nan(""), HUGE_VAL}) {
      EXPECT_EQ(refused([&] { oracle.membership({0, bad, 0}); }), "agent_velocity[1]");
      EXPECT_EQ(refused([&] { oracle.exact_membership({0, 0, 1}, {0, 0, bad}); }), "obstacle_velocity[2]");
    }
  }
}

TEST(TotalFunctions, MembershipInThePlane) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const int k = c.at.z() < -1 ? 2 : 1;  // the plane of x and y, or of x and z
    const Ellipse a = flat(agent(), 0, k), b = flat(obstacle(c), 0, k);
    const Vector2d at = b.center();
    const SectorOracle oracle(a, b);
    ASSERT_EQ(oracle.relation(), c.relation);
    const exact::RationalBody<2> ra(a), rb(b);
    for (const Vector3d& velocity : kVelocities) {
      const Vector2d w(velocity.x(), velocity(k));
      SCOPED_TRACE(w.transpose());
      const Membership is = expected<Vector2d>(c.relation, at, w);
      EXPECT_EQ(oracle.membership(w), is);
      EXPECT_EQ(SectorOracle(b, a).membership(-w), is);
      EXPECT_EQ(oracle.exact_membership(w, Vector2d::Zero()), is);
      EXPECT_EQ(exact::membership(ra, rb, exact::to_rational<2>(w)), is);
      EXPECT_EQ(oracle.triage_membership(w).value_or(is), is);
      EXPECT_EQ(oracle.interval_membership(w, Vector2d::Zero()).value_or(is), is);
      if (c.relation == Relation::overlapping) {
        EXPECT_EQ(oracle.naive_membership(w), is);
      }
      EXPECT_EQ(oracle.verdict(w, Vector2d::Zero()),
                c.relation == Relation::touching ? Verdict::touching : Verdict::overlapping);
    }
    EXPECT_EQ(refused([&] { oracle.membership({std::nan(""), 0}); }), "agent_velocity[0]");
  }
}

/// The contact polynomial's double root is irrational here, and the normal with it.
TEST(TotalFunctions, TouchingWhereNoDoubleIsTheNormal) {
  // x^2 / 4 + y^2 + z^2 <= 1 and a ball of radius r touch at (2 cos t, sin t) with cos t = 3/5, whose normal
  // (0.3, 0.8) has the length sqrt(0.73): the ball of squared radius 0.73 has its centre at (1.5, 1.6).
  exact::RationalBody<3> a, b;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a.shape[i][j] = b.shape[i][j] = 0;
  a.center = {0, 0, 0};
  b.center = {exact::Rational(3, 2), exact::Rational(8, 5), 0};
  a.shape[0][0] = 4;
  a.shape[1][1] = a.shape[2][2] = 1;
  for (int i = 0; i < 3; ++i) b.shape[i][i] = exact::Rational(73, 100);
  ASSERT_EQ(exact::relation<3>(a, b), Relation::touching);
  const exact::Rational tiny(0x1p-200);
  EXPECT_EQ(exact::membership(a, b, {8, -3, 7}), Membership::on);
  EXPECT_EQ(exact::membership(a, b, {-8, 3, 7}), Membership::on);
  EXPECT_EQ(exact::membership(a, b, {exact::Rational(8) + tiny, -3, 7}), Membership::in);
  EXPECT_EQ(exact::membership(a, b, {exact::Rational(8) - tiny, -3, 7}), Membership::out);
}

TEST(TotalFunctions, ConesInSpace) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Ellipsoid a = agent(), b = obstacle(c);
    const double all = (c.relation == Relation::touching ? 2 : 4) * pi;
    EXPECT_EQ(relation_of(position<3>(a, b)), c.relation);
    const TrueCone cone = true_cone(a, b, 12);
    EXPECT_EQ(cone.relation, c.relation);
    EXPECT_EQ(cone.solid_angle, all);
    EXPECT_TRUE(cone.axis.allFinite());
    EXPECT_EQ(refused([&] { cone_bounds(cone, a, b); }), "bodies");
    EXPECT_EQ(refused([&] {
                cone_bounds(true_cone(a, Ellipsoid::from_axes({9, 0, 0}, {1, 1, 1}), 12), a, b);
              }),
              "bodies");
    const SliceCone slices = slice_cone(a, b, 5);
    EXPECT_TRUE(slices.slices.empty());
    EXPECT_TRUE(slices.axis.allFinite());
    EXPECT_EQ(slices.polyhedral().solid_angle, all);
    EXPECT_EQ(refused([&] { slice_sector(a, b, {0, 1, 1}); }), "bodies");
    EXPECT_EQ(refused([&] { true_sector(a, b, {0, 1, 1}); }), "bodies");
    const SectorPlanes planes(a, b);
    EXPECT_FALSE(planes.disjoint());
    EXPECT_EQ(refused([&] { planes.on({0, 1, 1}); }), "bodies");
    EXPECT_EQ(refused([&] { enclose_plane_sector(a, b, {0, 1, 1}); }), "bodies");
    const CombinedSliceCone combined_slices = combined_slice_cone(a, b, 5);
    EXPECT_TRUE(combined_slices.slices.empty());
    const CombinedCone combined = combined_cone(a, b);
    EXPECT_TRUE(combined.inner.directions.empty());
    const CombinedOracle oracle(a, b);
    for (const Vector3d& w : kVelocities) {
      SCOPED_TRACE(w.transpose());
      EXPECT_EQ(oracle.membership(w), w.isZero(0)                           ? Certified::out
                                      : c.relation == Relation::overlapping ? Certified::in
                                                                            : Certified::undecided);
      EXPECT_FALSE(oracle.all_out(w, {0, 1, 1}));
      refused([&] { oracle.time_to_contact(w); });
    }
    refused([&] { plane_intervals(oracle, {1, 0, 0}, {0, 1, 0}, 0.1); });
    const ConeMap map = cone_map(EllipsoidClassifier(a, b), coarse());
    EXPECT_NEAR(map.colliding, 4 * pi, 1e-12);
  }
}

TEST(TotalFunctions, LengthsAndTimes) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Ellipsoid a = agent(), b = obstacle(c);
    const ConeOracle oracle(a, b);
    EXPECT_EQ(separation(a, b).distance, 0);
    EXPECT_TRUE(separation(a, b).normal.allFinite());
    EXPECT_EQ(enclose_separation(a, b).hi(), 0);
    for (const Vector3d& w : kVelocities) {
      SCOPED_TRACE(w.transpose());
      EXPECT_EQ(time_to_contact(a, b, w), 0.0);
      EXPECT_EQ(enclose_time_to_contact(oracle, w, Vector3d::Zero())->hi(), 0);
      EXPECT_EQ(exact_time_to_contact(oracle, w, Vector3d::Zero())->hi(), 0);
      EXPECT_FALSE(interval_time_to_contact(a, b, {w.x(), w.y(), w.z()}));
      EXPECT_LE(clearance_ahead(oracle, w, Vector3d::Zero()), 0);
      const std::string field = w.isZero(0) ? "relative_velocity" : "";
      EXPECT_EQ(refused([&] { EXPECT_FALSE(std::isnan(clearance(a, b, w).distance)); }), field);
      EXPECT_EQ(refused([&] { EXPECT_FALSE(std::isnan(enclose_clearance(a, b, w).mid())); }), field);
      contact_time(a, b, w);
      const Encounter now{a, b, w}, later{a, Ellipsoid::from_axes({9, 0, 0}, {1, 1, 1}), {1, 0, 0}};
      EXPECT_EQ(earlier(now, later), Sign::negative);
      EXPECT_EQ(exact_earlier(now, later), Sign::negative);
      EXPECT_EQ(earlier(now, now), Sign::zero);
    }
  }
}

TEST(TotalFunctions, Sectors) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const int k = c.at.z() < -1 ? 2 : 1;
    const Ellipse a = flat(agent(), 0, k), b = flat(obstacle(c), 0, k);
    const double psi = c.relation == Relation::touching ? pi : 2 * pi;
    const Sector sector = sector_by_support(a, b);
    EXPECT_EQ(sector.psi, psi);
    EXPECT_TRUE(std::isfinite(sector.theta_b));
    if (const auto other = sector_by_degenerate_conics(a, b)) {
      EXPECT_EQ(other->psi, psi);
    }
    EXPECT_EQ(refused([&] { sector_rates(sector, a, b, {}); }), "sector.relation");
    EXPECT_EQ(refused([&] { sector_rates(Sector(), a, b, {}); }), "sector.relation");
    const CombinedSector combined = combined_sector(a, b);
    EXPECT_EQ(combined.sector.relation, c.relation);
    EXPECT_EQ(refused([&] { combined_sector_rates(combined, a, b, {}); }), "sector.relation");
    EXPECT_FALSE(enclose_sector(a, b));
    sector_by_source(a, b, TangentChoice::printed);
    EXPECT_EQ(relation_of(position<2>(a, b)), c.relation);
    const TangentRef tangent{a, b, true}, other{Ellipse(), Ellipse::from_axes({5, 1}, {1, 2}), true};
    const std::string field = c.relation == Relation::overlapping ? "p" : "";
    EXPECT_EQ(refused([&] { turn(tangent, other); }), field);
    EXPECT_EQ(refused([&] { exact_turn(tangent, other); }), field);
    EXPECT_EQ(refused([&] { opposed(tangent, other); }), field);
    const std::vector<Vector2d> corners = {b.center(), b.center() + Vector2d(0.1, 0)};
    visible_sector(a, corners);
    sector_of_points(a, corners);
  }
}

TEST(TotalFunctions, Hulls) {
  for (const Vector3d& at :
       {Vector3d(0, 0, 0), Vector3d(1.5, 0, 0), Vector3d(2, 0, 0), Vector3d(0, 0, 0.25)}) {
    SCOPED_TRACE(at.transpose());
    const HullBody box = HullBody::box(at - Vector3d(1, 1, 1), at + Vector3d(1, 1, 1));
    const HullOracle hull(agent(), box);
    const AssemblyOracle pieces(agent(), Assembly::polyhedra({box}));
    ASSERT_NE(hull.relation(), Relation::disjoint);
    ASSERT_EQ(pieces.relation(), hull.relation());
    for (const Vector3d& w : kVelocities) {
      SCOPED_TRACE(w.transpose());
      const Membership is = w.isZero(0) ? Membership::out : Membership::in;
      EXPECT_EQ(hull.membership(w), is);
      EXPECT_EQ(hull.exact_membership(w, Vector3d::Zero()), is);
      EXPECT_EQ(hull.passage(w) == Passage::ahead, is == Membership::in);
      EXPECT_EQ(pieces.membership(w), is);
      EXPECT_EQ(pieces.first_contact(w)->time, 0);
      EXPECT_EQ(pieces.miss_distance(w).most, 0);
    }
    const ExtremeDirection extreme = pieces.extreme({1, 0, 0}, {0, 1, 0});
    EXPECT_TRUE(extreme.low >= 0 && extreme.low <= extreme.high && extreme.high <= pi + 1e-12);
    EXPECT_EQ(pieces.extremes({0, 0, 1}, 3).size(), 3);
  }
}

TEST(TotalFunctions, ArgumentsOfOtherBodies) {
  const Ellipsoid a = agent(), b = Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2});
  const TrueCone cone = true_cone(a, b, 24);
  EXPECT_EQ(refused([&] { cone_bounds(cone, a, b); }), "");
  EXPECT_EQ(refused([&] { cone_bounds(TrueCone(), a, b); }), "cone.relation");
  EXPECT_EQ(refused([&] { cone_bounds(true_cone(a, a, 24), a, b); }), "cone.relation");
  EXPECT_EQ(refused([&] { cone_bounds(cone, a, a); }), "bodies");
  EXPECT_EQ(refused([&] { cone_bounds(cone, b, a); }), "cone.axis");
  EXPECT_EQ(refused([&] { cone_bounds(true_cone(a, b.translated({0, 1, 0}), 24), a, b); }), "cone.axis");
  TrueCone empty = cone;
  empty.boundary.clear();
  EXPECT_EQ(refused([&] { cone_bounds(empty, a, b); }), "cone.boundary");
  // The same centres, other shapes: wide, and true.
  for (const double radius : {0.5, 3.9}) {
    const ConeBounds wide =
        cone_bounds(true_cone(a, Ellipsoid::from_axes({5, 0, 0}, {radius, 1, 1}), 24), a, b);
    EXPECT_LE(wide.inner.solid_angle, cone.solid_angle);
    EXPECT_GE(wide.outer.solid_angle, cone.solid_angle);
  }
  EXPECT_EQ(refused([&] { true_sector_rates(PlaneSector(), a, b, {}); }), "sector");
  const PlaneSector sector = true_sector(a, b, {0, 1, 0});
  EXPECT_EQ(refused([&] { true_sector_rates(sector, a, a, {}); }), "bodies");
  EXPECT_EQ(refused([&] { combined_sector_rates(CombinedSector(), Ellipse(), Ellipse(), {}); }),
            "sector.relation");
  EXPECT_EQ(SliceCone().polyhedral().solid_angle, 4 * pi);
  EXPECT_TRUE(CombinedSliceCone().polyhedral().directions.empty());
  EXPECT_TRUE(VisibleCone().polyhedral().directions.empty());
  EXPECT_EQ(cone_map(CombinedClassifier(CombinedCone()), coarse()).colliding, 0);
  EXPECT_EQ(refused([] { cell_at(ConeMap(), {1, 0, 0}); }), "map.cells");
  EXPECT_EQ(refused([] { region_around(ConeMap(), {1, 0, 0}); }), "map.cells");
  EXPECT_TRUE(regions(ConeMap()).empty());
  EXPECT_EQ(refused([&] { cell_at(cone_map(EllipsoidClassifier(a, b), coarse()), {0, 0, 0}); }), "direction");
  EXPECT_EQ(polygon_solid_angle({0, 0, 1}, {}), 0);
  EXPECT_EQ(polygon_section_area({0, 0, 1}, {}), 0);
  EXPECT_EQ(relation<3>(Ellipsoid(), Ellipsoid()), Relation::overlapping);
}

}  // namespace
}  // namespace vericone::total_functions_test
