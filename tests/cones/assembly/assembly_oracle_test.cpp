// SPDX-License-Identifier: BSD-3-Clause
//
// Relation and membership against the exact predicates of each piece alone; degenerate cases by construction.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <limits>
#include "support/random_assemblies.h"

namespace vericone::assembly_oracle_test {
namespace {

using Eigen::Vector3d;
using testing::Agent;

AssemblyOracle oracle_of(const Agent& agent, const Assembly& body, const Pose& pose = {}) {
  return std::visit([&](const auto& a) { return AssemblyOracle(a, body, pose); }, agent);
}

/// All pieces, each with its own exact predicate and no hierarchy.
class BruteForce {
 public:
  BruteForce(const Agent& agent, const Assembly& body) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      const HullBody piece = body.piece(i);
      if (body.radius() == 0) {
        std::visit([&](const auto& a) { hulls_.emplace_back(a, piece); }, agent);
        continue;
      }
      const Ellipsoid ball = Ellipsoid::from_axes(piece.points()[0], Vector3d::Constant(body.radius()));
      if (const Ellipsoid* a = std::get_if<Ellipsoid>(&agent)) {
        balls_.emplace_back(*a, ball);
      } else {
        hulls_.emplace_back(std::get<HullBody>(agent), ball);
      }
    }
  }

  Relation relation() const {
    Relation worst = Relation::disjoint;
    each([&](const auto& piece) {
      if (piece.relation() == Relation::overlapping) worst = Relation::overlapping;
      if (piece.relation() == Relation::touching && worst == Relation::disjoint) worst = Relation::touching;
    });
    return worst;
  }
  Membership membership(const Vector3d& w) const {
    Membership answer = Membership::out;
    each([&](const auto& piece) {
      const Membership one = piece.membership(w);
      if (one == Membership::in || answer == Membership::out) answer = one == Membership::out ? answer : one;
    });
    return answer;
  }

 private:
  template <class Call>
  void each(Call call) const {
    for (const HullOracle& piece : hulls_) call(piece);
    for (const ConeOracle& piece : balls_) call(piece);
  }
  std::vector<HullOracle> hulls_;
  std::vector<ConeOracle> balls_;
};

TEST(AssemblyOracle, AnswersAreThoseOfAllPiecesAlone) {
  constexpr int kScenes = 120, kVelocities = 60;
  int counts[3] = {}, relations[3] = {};
  testing::RandomAssemblies random(1);
  for (int scene = 0; scene < kScenes; ++scene) {
    const PieceKind kind = testing::kPieceKinds[scene % 4];
    const Assembly body = random.body(kind, 60, scene % 8 < 4 ? 0 : 0.2);
    const Vector3d place = random.vector(scene % 3 == 0 ? 2 : 6);
    const Agent agent = random.agent(scene / 4 % 2 == 1, place);
    const AssemblyOracle oracle = oracle_of(agent, body);
    const BruteForce brute(agent, body);
    ASSERT_EQ(oracle.relation(), brute.relation()) << "scene " << scene;
    ++relations[int(oracle.relation())];
    if (oracle.relation() != Relation::disjoint) continue;
    for (int i = 0; i < kVelocities; ++i) {
      // Towards the cube, towards a corner of a piece, anywhere.
      Vector3d w = random.vector(4) - place;
      if (i % 3 == 1)
        w = body.piece(static_cast<std::size_t>(random.integer(0, static_cast<int>(body.size()) - 1)))
                .points()[0] -
            place;
      if (i % 3 == 2) w = random.vector(1);
      ASSERT_EQ(oracle.membership(w), brute.membership(w)) << "scene " << scene << ", velocity " << i;
      ++counts[int(oracle.membership(w))];
    }
  }
  EXPECT_GT(counts[int(Membership::in)], 500);
  EXPECT_GT(counts[int(Membership::out)], 500);
  EXPECT_GT(relations[int(Relation::disjoint)], 20);
  EXPECT_GT(relations[int(Relation::overlapping)], 5);
}

/// A unit square in the plane x = 5, as two triangles.
Assembly wall() {
  return Assembly::mesh({{5, -1, -1}, {5, 1, -1}, {5, 1, 1}, {5, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
}

TEST(AssemblyOracle, ExactlyGrazing) {
  // A unit ball at the origin and a wall at x = 5 that ends at y = 1: a line that touches the edge
  // y = 1, x = 5 at the distance 1: direction (4, 3, 0) from the point (5, 1): distance |4*1 - 3*5| / 5 =
  // 11/5, no; direction (d, e) with |d - 5 e| = sqrt(d^2 + e^2): (12, 5): |12 - 25| / 13 = 1.
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  const AssemblyOracle oracle(ball, wall());
  ASSERT_EQ(oracle.relation(), Relation::disjoint);
  EXPECT_EQ(oracle.membership({12, 5, 0}), Membership::on);
  EXPECT_EQ(oracle.membership({12, std::nextafter(5.0, 0.0), 0}), Membership::in);
  EXPECT_EQ(oracle.membership({12, std::nextafter(5.0, 9.0), 0}), Membership::out);
  EXPECT_EQ(oracle.membership({-12, -5, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({0, 0, 0}), Membership::out);
  // The difference of velocities is not rounded.
  const double tiny = 0x1p-60;
  EXPECT_EQ(oracle.membership({12 + 3, 5, 0}, {3, 0, 0}), Membership::on);
  EXPECT_EQ(oracle.membership({12, 5, 0}, {0, tiny, 0}), Membership::in);
  EXPECT_EQ(oracle.membership({12, 5, 0}, {0, -tiny, 0}), Membership::out);
  // Grazing is a contact, and its end is not known.
  const auto contact = oracle.first_contact({12, 5, 0});
  ASSERT_TRUE(contact);
  EXPECT_TRUE(std::isinf(contact->latest));
  EXPECT_NEAR(contact->time, 65.0 / 169, 1e-6);  // where (5, 1) projects to the line
  EXPECT_LE(contact->earliest, 65.0 / 169);
  EXPECT_EQ(oracle.verdict({12, 5, 0}, {0, 0, 0}), Verdict::on);
}

TEST(AssemblyOracle, BetweenTwoTrianglesNothingPasses) {
  // Through the common edge, by the corner, and along the plane.
  const Ellipsoid thin = Ellipsoid::from_axes({0, 0, 0}, {1e-3, 1e-3, 1e-3});
  const AssemblyOracle oracle(thin, wall());
  for (int i = 0; i <= 100; ++i) {
    const double s = -1 + 0.02 * i;
    EXPECT_EQ(oracle.membership({5, s, s}), Membership::in) << s;
  }
}

TEST(AssemblyOracle, TouchingAndOverlapping) {
  const auto relation = [](double x) {
    return AssemblyOracle(Ellipsoid::from_axes({x, 0, 0}, {1, 1, 1}), wall()).relation();
  };
  EXPECT_EQ(relation(4), Relation::touching);
  EXPECT_EQ(relation(std::nextafter(4.0, 0.0)), Relation::disjoint);
  EXPECT_EQ(relation(std::nextafter(4.0, 9.0)), Relation::overlapping);
  const AssemblyOracle touching(Ellipsoid::from_axes({4, 0, 0}, {1, 1, 1}), wall());
  EXPECT_EQ(touching.membership({0, 1, 0}), Membership::in);
  EXPECT_EQ(touching.membership({0, 0, 0}), Membership::out);
  EXPECT_EQ(touching.verdict({0, 1, 0}, {0, 0, 0}), Verdict::touching);
  const auto now = touching.first_contact({0, 1, 0});
  ASSERT_TRUE(now);
  EXPECT_EQ(now->time, 0);
  EXPECT_NEAR((now->point - Vector3d(5, 0, 0)).norm(), 0, 1e-7);
  EXPECT_EQ(touching.miss_distance({0, 1, 0}).most, 0);
}

TEST(AssemblyOracle, ARoomIsNotItsInside) {
  // The surface of a box as a mesh: the agent inside is apart from it, and every velocity meets it.
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 3 : -3, i & 2 ? 3 : -3, i & 4 ? 3 : -3);
  const std::vector<Assembly::Triangle> faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                 {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                 {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const AssemblyOracle room(Ellipsoid::from_axes({0.5, 0, 0}, {1, 1, 1}), Assembly::mesh(corners, faces));
  EXPECT_EQ(room.relation(), Relation::disjoint);
  testing::RandomAssemblies random(2);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(room.membership(random.vector(1)), Membership::in);
  // The solid box contains the agent.
  const AssemblyOracle solid(Ellipsoid::from_axes({0.5, 0, 0}, {1, 1, 1}),
                             Assembly::boxes({{{-3, -3, -3}, {3, 3, 3}}}));
  EXPECT_EQ(solid.relation(), Relation::overlapping);
}

TEST(AssemblyOracle, DegenerateTrianglesAreSegmentsAndPoints) {
  const Assembly body = Assembly::mesh({{5, 0, 0}, {5, 2, 0}, {5, 4, 0}, {5, 0, 3}}, {{0, 1, 2}, {3, 3, 3}});
  const AssemblyOracle oracle(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), body);
  EXPECT_EQ(oracle.membership({5, 3, 0}), Membership::in);
  EXPECT_EQ(oracle.membership({5, 0, 3}), Membership::in);
  EXPECT_EQ(oracle.membership({5, -3, 0}), Membership::out);
  EXPECT_EQ(oracle.membership({5, 4, 3}), Membership::out);
}

TEST(AssemblyOracle, APoseMovesTheBody) {
  testing::RandomAssemblies random(3);
  for (int scene = 0; scene < 20; ++scene) {
    const Assembly body = random.body(testing::kPieceKinds[scene % 4], 40);
    const Pose pose{random.vector(3), random.rotation()};
    const Agent agent = random.agent(scene % 8 < 4, random.vector(5) + Vector3d(8, 0, 0));
    const AssemblyOracle posed = oracle_of(agent, body, pose);
    if (posed.relation() != Relation::disjoint) continue;
    // The same pieces placed in the world by hand.
    std::vector<HullBody> placed;
    if (body.kind() != PieceKind::ball) {
      for (std::size_t i = 0; i < body.size(); ++i) {
        std::vector<Vector3d> points = body.piece(i).points();
        for (Vector3d& x : points) x = pose.to_world(x);
        placed.emplace_back(points);
      }
    }
    std::vector<Vector3d> centers;
    if (body.kind() == PieceKind::ball)
      for (std::size_t i = 0; i < body.size(); ++i)
        centers.push_back(pose.to_world(body.piece(i).points()[0]));
    const AssemblyOracle moved =
        oracle_of(agent, body.kind() == PieceKind::ball ? Assembly::cloud(centers, body.radius())
                                                        : Assembly::polyhedra(placed));
    for (int i = 0; i < 40; ++i) {
      const Vector3d w = random.vector(5) - Vector3d(8, 0, 0);
      EXPECT_EQ(posed.membership(w), moved.membership(w));
      const auto one = posed.first_contact(w), other = moved.first_contact(w);
      ASSERT_EQ(bool(one), bool(other));
      if (!one) continue;
      EXPECT_NEAR(one->time, other->time, 1e-9 * other->time);
      EXPECT_LT((one->point - other->point).norm(), 1e-6);
      EXPECT_LT((one->normal - other->normal).norm(), 1e-6);
    }
  }
}

TEST(AssemblyOracle, AnswersDoNotDependOnTheUnitOfLength) {
  // Powers of two change nothing but the exponents; squares of the outer ones leave the range of doubles.
  testing::RandomAssemblies random(4);
  for (int scene = 0; scene < 8; ++scene) {
    const Vector3d place = random.vector(5);
    std::vector<Vector3d> points;
    std::vector<Assembly::Triangle> triangles;
    for (std::uint32_t i = 0; i < 12; ++i) {
      const Vector3d c = random.vector(3);
      for (int k = 0; k < 3; ++k) points.push_back(c + random.vector(0.5));
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Agent agent = random.agent(scene % 2 == 1, place);
    const AssemblyOracle oracle = oracle_of(agent, Assembly::mesh(points, triangles));
    std::vector<Vector3d> velocities;
    for (int i = 0; i < 20; ++i) velocities.push_back(random.vector(3) - place);
    for (const int exponent : {-700, -400, -30, 30, 400, 700}) {
      // Ellipsoids beyond 2^±500 have no shape matrix in doubles.
      if (scene % 2 == 0 && std::abs(exponent) > 500) continue;
      const double scale = std::ldexp(1.0, exponent);
      std::vector<Vector3d> scaled = points;
      for (Vector3d& x : scaled) x *= scale;
      const Agent same = std::visit([&](const auto& a) -> Agent { return a.scaled(scale); }, agent);
      const AssemblyOracle other = oracle_of(same, Assembly::mesh(scaled, triangles));
      ASSERT_EQ(other.relation(), oracle.relation()) << exponent;
      for (const Vector3d& w : velocities) {
        EXPECT_EQ(other.membership(w), oracle.membership(w)) << exponent;
        EXPECT_EQ(other.membership(scale * w), oracle.membership(w)) << exponent;
      }
    }
  }
}

TEST(AssemblyOracle, RefusesWhatHasNoAnswer) {
  const AssemblyOracle oracle(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), wall());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(oracle.membership({nan, 0, 0}), InputError);
  EXPECT_THROW(oracle.first_contact({0, nan, 0}), InputError);
  EXPECT_THROW(oracle.miss_distance({0, 0, INFINITY}), InputError);
  EXPECT_THROW(oracle.miss_distance({1, 0, 0}, 0), InputError);
  EXPECT_THROW(oracle.extreme({1, 0, 0}, {0, 1, 0}, 0), InputError);
  EXPECT_THROW(oracle.extremes({1, 0, 0}, 0), InputError);
  EXPECT_THROW(AssemblyOracle(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1e-13}), wall()), InputError);
  EXPECT_THROW(AssemblyOracle(Ellipsoid(), wall(), Pose{{0, 0, 0}, 2 * Eigen::Matrix3d::Identity()}),
               InputError);
}

}  // namespace
}  // namespace vericone::assembly_oracle_test
