// SPDX-License-Identifier: BSD-3-Clause
#include "fit/cone/cone_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <numbers>

#include "fit/cone/cone_json.h"
#include "geometry/meshes.h"
#include "json/json_value.h"
#include "support/campaign.h"

namespace vericone::cone_comparison_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fitting::FitResult;
using fitting::Sample;
using std::numbers::pi;
using testing::RandomBodies;

Sample sample_of(const testing::Mesh& mesh) { return {mesh.points, mesh.triangles}; }

Ellipsoid ball(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

ConeRequest one(const Ellipsoid& agent) {
  ConeRequest request;
  request.agents.push_back({agent, "agent"});
  return request;
}

/// The hull is these bodies; taken as certified.
FitResult hull_of(const std::vector<CombinedEllipsoid>& bodies) {
  FitResult fit;
  for (const auto& body : bodies) fit.pieces.emplace_back().body = body;
  fit.certified = true;
  return fit;
}

ConeComparisonOptions settings(double resolution = 0.002, int threads = 1) {
  ConeComparisonOptions options;
  options.resolution = resolution;
  options.threads = threads;
  return options;
}

/// Of two balls whose radii add up to `reach`, `distance` apart.
double circular(double reach, double distance) {
  return 2 * pi * (1 - std::sqrt(1 - reach * reach / (distance * distance)));
}

/// An ellipsoid of semi-axes (2, 1, 1) with a waist of radius 0.4 across x.
CombinedEllipsoid waisted() {
  return CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {2, 1, 1}), {hyperboloid(1, {0.6, 0.4, 0.4})});
}

/// Corners on the surface of a body about the origin, made smaller so that the triangles are inside too.
Sample mesh_within(const CombinedEllipsoid& body) {
  testing::Mesh mesh = testing::sphere(4);
  for (Vector3d& x : mesh.points) x *= 0.95 / body.gauge(x);
  return sample_of(mesh);
}

struct Estimate {
  double value = 0, error = 0;  // error: one standard deviation
};

/// Solid angle of directions within `angle` of `axis` for which `hit` holds, by uniform random ones.
template <typename Hit>
Estimate monte_carlo(RandomBodies& random, const Vector3d& axis, double angle, const Hit& hit) {
  constexpr int kCount = 20'000;
  const AxisFrame frame(axis);
  int hits = 0;
  for (int i = 0; i < kCount; ++i) {
    const double z = random.uniform(std::cos(angle), 1), t = random.uniform(0, 2 * pi);
    const double r = std::sqrt(1 - z * z);
    hits += hit(z * frame.axis + r * std::cos(t) * frame.e1 + r * std::sin(t) * frame.e2) ? 1 : 0;
  }
  const double cap = 2 * pi * (1 - std::cos(angle)), p = double(hits) / kCount;
  return {cap * p, cap * std::sqrt(p * (1 - p) / kCount)};
}

void expect_contains(const ConeRow& row, const Estimate& truth) {
  EXPECT_LT(row.low, truth.value + 4 * truth.error) << row.what;
  EXPECT_GT(row.high, truth.value - 4 * truth.error) << row.what;
}

TEST(ConeComparison, OfABallIsKnown) {
  const Sample scan = sample_of(testing::sphere(3));
  const ConeComparison c =
      compare_cones(scan, hull_of({ball({0, 0, 0}, 1.1)}), one(ball({0, -3, 1}, 0.5)), settings());
  const auto& rows = c.agents.at(0).rows;
  ASSERT_EQ(rows.size(), 4);
  const double distance = std::sqrt(10.0);
  double inscribed = 1;  // radius of the largest ball in the mesh
  for (const auto& t : scan.triangles) {
    const Vector3d &p = scan.points[t[0]], &q = scan.points[t[1]], &r = scan.points[t[2]];
    inscribed = std::min(inscribed, std::abs((q - p).cross(r - p).normalized().dot(p)));
  }
  EXPECT_EQ(rows[0].what, "scan");
  EXPECT_LT(rows[0].low, circular(1.5, distance));
  EXPECT_GT(rows[0].high, circular(0.5 + inscribed, distance));
  EXPECT_LT(rows[0].high - rows[0].low, 0.01 * rows[0].low);

  EXPECT_EQ(rows[1].what, "ellipsoid");
  EXPECT_NEAR(rows[1].low, circular(1.5, distance), 1e-3 * rows[1].low);
  EXPECT_EQ(rows[2].what, "hull");
  EXPECT_LE(rows[2].low, circular(1.6, distance));
  EXPECT_GE(rows[2].high, circular(1.6, distance));
  EXPECT_LT(rows[2].high - rows[2].low, 1e-3 * rows[2].low);
  EXPECT_EQ(rows[3].what, "convex hull");
  EXPECT_LT(rows[3].high, circular(1.5, distance) * (1 + 1e-4));
  EXPECT_GT(rows[3].low, circular(0.5 + inscribed, distance) * (1 - 1e-4));
  EXPECT_DOUBLE_EQ(rows[2].excess_low, rows[2].low / rows[0].high - 1);
  EXPECT_DOUBLE_EQ(rows[2].excess_high, rows[2].high / rows[0].low - 1);
}

TEST(ConeComparison, RowsAreNestedAndContainWhatRandomDirectionsSay) {
  RandomBodies random(601);
  SCOPED_TRACE(random.trace());
  const CombinedEllipsoid hull = waisted();
  const Sample scan = mesh_within(hull);
  for (int k = 0; k < 4; ++k) {
    const Ellipsoid agent = random.ellipsoid(4 * random.direction(), 0.3, 0.8);
    SCOPED_TRACE(k);
    const ConeComparison c = compare_cones(scan, hull_of({hull}), one(agent), settings());
    const auto& rows = c.agents.at(0).rows;
    ASSERT_EQ(rows.size(), 4);
    for (const ConeRow& row : rows) {
      EXPECT_LE(row.low, row.high) << row.what;
      EXPECT_LT(row.high - row.low, 0.02 * row.low) << row.what;
      EXPECT_LT(rows[0].low, row.high) << row.what;
    }
    EXPECT_LT(rows[3].low, rows[1].high);  // the convex hull is in every convex body about the scan

    const Vector3d axis = -agent.center();
    const AssemblyOracle of_scan(agent, Assembly::mesh(scan.points, scan.triangles));
    const auto hits = [](const AssemblyOracle& oracle) {
      return [&](const Vector3d& d) { return oracle.membership(d) != Membership::out; };
    };
    expect_contains(rows[0], monte_carlo(random, axis, 1.2, hits(of_scan)));
    const CombinedOracle of_hull(agent, hull);
    expect_contains(rows[2], monte_carlo(random, axis, 1.2, [&](const Vector3d& d) {
                      return of_hull.membership(d) == Certified::in;
                    }));
    const AssemblyOracle of_points(agent, Assembly::polyhedra({HullBody(scan.points)}));
    expect_contains(rows[3], monte_carlo(random, axis, 1.2, hits(of_points)));
  }
}

TEST(ConeComparison, AnAgentInTheWaistOverlapsConvexHullsOnly) {
  const CombinedEllipsoid hull = waisted();
  const ConeComparison c =
      compare_cones(mesh_within(hull), hull_of({hull}), one(ball({0, 0.7, 0}, 0.1)), settings(0.02));
  const auto& rows = c.agents.at(0).rows;
  EXPECT_EQ(rows[1].overlapping, 1);
  EXPECT_DOUBLE_EQ(rows[1].low, 4 * pi);
  EXPECT_EQ(rows[2].overlapping, 0);
  EXPECT_LT(rows[2].high, 3 * pi);
  EXPECT_EQ(rows[3].overlapping, 1);
  EXPECT_GT(rows[1].excess_low, rows[2].excess_high);
}

TEST(ConeComparison, RefusesAgentsThatAreNotOutside) {
  const Sample scan = sample_of(testing::sphere(2));
  const FitResult hull = hull_of({ball({0, 0, 0}, 1)});
  for (const Ellipsoid& agent : {ball({0.9, 0, 0}, 0.2), ball({0, 0, 0}, 0.2), ball({0, 0, 0}, 3)}) try {
      compare_cones(scan, hull, one(agent), settings(0.05));
      FAIL();
    } catch (const InputError& e) {
      EXPECT_EQ(e.field(), "--cone");
    }
  EXPECT_THROW(compare_cones(scan, hull, one(ball({3, 0, 0}, 1)), settings(0)), InputError);
}

TEST(ConeComparison, UnionsOfPiecesAreAddedWhereTheyAreApart) {
  testing::Mesh mesh = testing::sphere(2).mapped(0.5 * Matrix3d::Identity(), {5, -2, 0});
  mesh.append(testing::sphere(2).mapped(0.5 * Matrix3d::Identity(), {5, 2, 0}));
  const FitResult two = hull_of({ball({5, -2, 0}, 0.5), ball({5, 2, 0}, 0.5)});
  const auto apart = compare_cones(sample_of(mesh), two, one(ball({0, 0, 0}, 0.1)), settings());
  const double each = circular(0.6, std::sqrt(29.0));
  EXPECT_LT(apart.mean[2].low, 2 * each);
  EXPECT_GT(apart.mean[2].high, 2 * each);
  EXPECT_LT(apart.mean[2].high - apart.mean[2].low, 0.05 * each);
  EXPECT_EQ(apart.agents[0].rows[2].outline.size(), 2);
  EXPECT_GT(apart.mean[1].excess_low, 1);  // one ellipsoid around both

  // Seen from the side one hides the other.
  const auto behind = compare_cones(sample_of(mesh), two, one(ball({5, -8, 0}, 0.1)), settings());
  EXPECT_LT(behind.mean[2].low, circular(0.6, 6));
  EXPECT_GT(behind.mean[2].high, circular(0.6, 6));
}

TEST(ConeComparison, SaysWhatAProofIsMissingOrACloudMeans) {
  const Sample cloud{testing::sphere(3).points, {}};
  FitResult hull = hull_of({ball({0, 0, 0}, 1.1)});
  const auto proved = compare_cones(cloud, hull, one(ball({4, 0, 0}, 0.5)), settings(0.02));
  EXPECT_THAT(proved.notes, ::testing::ElementsAre(::testing::HasSubstr("cloud")));
  hull.certified = false;
  hull.certificate.margin = 0.05;
  const auto not_proved = compare_cones(cloud, hull, one(ball({4, 0, 0}, 0.5)), settings(0.02));
  EXPECT_THAT(not_proved.notes, ::testing::Contains(::testing::HasSubstr("not proved")));
  EXPECT_GT(not_proved.mean[0].low, proved.mean[0].high);  // balls of 5 cm are seen in more directions
}

TEST(ConeComparison, IsTheSameForAllThatIsTurnedMovedAndScaled) {
  RandomBodies random(602);
  SCOPED_TRACE(random.trace());
  const CombinedEllipsoid hull = waisted();
  const Sample scan = mesh_within(hull);
  const Vector3d at(1, 3, 2);
  const auto plain = compare_cones(scan, hull_of({hull}), one(ball(at, 0.5)), settings());
  for (const double scale : {1e-3, 1e3}) {
    const Matrix3d turn = random.rotation();
    const Vector3d shift = scale * random.in_box(10);
    Sample moved = scan;
    for (Vector3d& x : moved.points) x = shift + scale * (turn * x);
    const CombinedEllipsoid body(Ellipsoid::from_axes(shift, scale * Vector3d(2, 1, 1), turn),
                                 {hyperboloid(1, scale * Vector3d(0.6, 0.4, 0.4), turn)});
    const auto c = compare_cones(moved, hull_of({body}), one(ball(shift + scale * (turn * at), 0.5 * scale)),
                                 settings(0.002, 2));
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(c.mean[i].low, plain.mean[i].high);
      EXPECT_GT(c.mean[i].high, plain.mean[i].low);
    }
  }
}

TEST(ConeComparison, MeansAreThoseOfTheAgents) {
  const CombinedEllipsoid hull = waisted();
  const Sample scan = mesh_within(hull);
  ConeRequest request = *parse_cone_request("around:3");
  const auto all = compare_cones(scan, hull_of({hull}), request, settings(0.02));
  ASSERT_EQ(all.agents.size(), 3);
  double low = 0, high = 0;
  for (const ConeAgent& agent : agents_of(request, scan)) {
    ConeRequest single;
    single.agents.push_back(agent);
    const auto c = compare_cones(scan, hull_of({hull}), single, settings(0.02));
    low += c.mean[2].excess_low / 3;
    high += c.mean[2].excess_high / 3;
  }
  EXPECT_NEAR(all.mean[2].excess_low, low, 1e-12);
  EXPECT_NEAR(all.mean[2].excess_high, high, 1e-12);
  const auto json = cones_json(all);
  EXPECT_EQ(json["agents"].size(), 3);
  EXPECT_EQ(json["mean"].size(), 4);
  const auto picture = cones_picture(all, "title");
  EXPECT_EQ(picture["shown"]["rows"].size(), 4);
  for (const auto& row : picture["shown"]["rows"]) EXPECT_GE(row["loops"].size(), 1);
}

TEST(ConeComparison, StopsWhenAsked) {
  const Sample scan = sample_of(testing::sphere(2));
  ConeComparisonOptions options;
  double last = 0;
  options.progress = [&](const std::string&, double share) {
    EXPECT_GE(share, 0);
    last = share;
    return share < 0.6;
  };
  EXPECT_THROW(compare_cones(scan, hull_of({ball({0, 0, 0}, 1)}), one(ball({3, 0, 0}, 1)), options),
               Interrupted);
  EXPECT_GE(last, 0.6);
}

TEST(ConeRequest, ReadsItsForms) {
  const auto one_ball = parse_cone_request("1,-2,3e0,0.5");
  ASSERT_TRUE(one_ball);
  EXPECT_EQ(one_ball->agents.at(0).body.center(), Vector3d(1, -2, 3));
  EXPECT_NEAR(one_ball->agents.at(0).body.volume(), pi / 6, 1e-12);
  EXPECT_EQ(parse_cone_request("around:24:4")->distance, 4);
  EXPECT_FALSE(parse_cone_request("agent.yaml"));
  EXPECT_FALSE(parse_cone_request("1,2,3,x"));
  for (const char* bad : {"", "1,2,3,0", "1,2,3,-1", "around:0", "around:2.5", "around:", "around:3:1",
                          "around:3:2:1", "around:x", "around:10001"})
    EXPECT_THROW(parse_cone_request(bad), InputError) << bad;
}

TEST(ConeRequest, AgentsAroundAreSpreadEvenly) {
  Sample scan = sample_of(testing::cube());
  scan.points.emplace_back(100, 0, 0);  // no triangle's
  const auto agents = agents_of(*parse_cone_request("around:24"), scan);
  ASSERT_EQ(agents.size(), 24);
  Vector3d sum = Vector3d::Zero();
  double nearest = 4;
  for (const ConeAgent& a : agents) {
    EXPECT_NEAR(a.body.center().norm(), 2 * std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(a.body.semi_axes().x(), 0.25 * std::sqrt(3.0), 1e-12);
    sum += a.body.center().normalized();
    for (const ConeAgent& b : agents)
      if (&a != &b)
        nearest = std::min(nearest, (a.body.center().normalized() - b.body.center().normalized()).norm());
  }
  EXPECT_LT(sum.norm(), 0.5);
  EXPECT_GT(nearest, 0.45);  // 24 points on a sphere are at most 0.76 apart
}

}  // namespace
}  // namespace vericone::cone_comparison_test
