// SPDX-License-Identifier: BSD-3-Clause
//
// First contact, miss distance, extreme directions and cells: against moved agents, closed forms and
// membership.
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <numbers>
#include "support/random_assemblies.h"

namespace vericone::assembly_questions_test {
namespace {

using Eigen::Vector3d;
using testing::Agent;
using testing::translated;

AssemblyOracle oracle_of(const Agent& agent, const Assembly& body) {
  return std::visit([&](const auto& a) { return AssemblyOracle(a, body); }, agent);
}

/// Calls check(random, body, agent, oracle, place) for disjoint scenes of all kinds.
template <class Check>
void in_scenes(std::uint64_t seed, int count, Check check) {
  testing::RandomAssemblies random(seed);
  for (int scene = 0; scene < count; ++scene) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", scene " + std::to_string(scene));
    const Assembly body = random.body(testing::kPieceKinds[scene % 4], 60, scene % 8 < 4 ? 0 : 0.2);
    const Vector3d place = random.vector(6);
    const Agent agent = random.agent(scene / 4 % 2 == 1, place);
    const AssemblyOracle oracle = oracle_of(agent, body);
    if (oracle.relation() == Relation::disjoint) check(random, body, agent, oracle, place);
  }
}

TEST(AssemblyQuestions, NothingIsTouchedBeforeAndSomethingOverlappedAfterTheContact) {
  int contacts = 0;
  in_scenes(
      11, 80,
      [&](auto& random, const Assembly& body, const Agent& agent, const AssemblyOracle& oracle,
          const Vector3d& place) {
        for (int i = 0; i < 20; ++i) {
          const Vector3d w = random.vector(4) - place;
          const auto contact = oracle.first_contact(w);
          ASSERT_EQ(bool(contact), oracle.membership(w) != Membership::out);
          if (!contact) continue;
          ++contacts;
          ASSERT_LE(contact->earliest, contact->time);
          ASSERT_LE(contact->time, contact->latest);
          EXPECT_LT(contact->latest - contact->earliest, 1e-6);
          // Moved bodies are rounded: by less than this.
          const double slack = 1e-12;
          for (int k = 0; k < 4; ++k)
            EXPECT_EQ(
                oracle_of(translated(agent, contact->earliest * (1 - slack) * k / 3 * w), body).relation(),
                Relation::disjoint);
          EXPECT_EQ(
              oracle_of(translated(agent, (contact->latest + slack) * (1 + slack) * w), body).relation(),
              Relation::overlapping);
          // The point lies on the piece and on the moved agent.
          const Agent there = translated(agent, contact->time * w - contact->point);
          const AssemblyOracle at(oracle_of(there, Assembly::cloud({Vector3d::Zero()}, 0)));
          EXPECT_LT(at.miss_distance(Vector3d::Zero()).most, 1e-7);
          EXPECT_NEAR(contact->normal.norm(), 1, 1e-12);
        }
      });
  EXPECT_GT(contacts, 300);
}

TEST(AssemblyQuestions, PolyhedraThatMeetSymmetrically) {
  // Face to face, and a corner on the edge that two triangles share: both times are known.
  const AssemblyOracle faces(HullBody::box({-1, -1, -1}, {1, 1, 1}),
                             Assembly::boxes({{{4, -1, -1}, {6, 1, 1}}}));
  const auto face = faces.first_contact({1, 0, 0});
  ASSERT_TRUE(face);
  EXPECT_LE(face->earliest, 3);
  EXPECT_GE(face->latest, 3);
  EXPECT_LT(face->latest - face->earliest, 1e-9);
  const HullBody tetrahedron({{0, 0, 0}, {-1, 0.2, 0}, {-1, -0.1, 0.2}, {-1, -0.1, -0.2}});
  const AssemblyOracle corner(
      tetrahedron, Assembly::mesh({{5, -1, -1}, {5, 1, -1}, {5, 1, 1}, {5, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}));
  const auto edge = corner.first_contact({1, 0, 0});
  ASSERT_TRUE(edge);
  EXPECT_LE(edge->earliest, 5);
  EXPECT_GE(edge->latest, 5);
  EXPECT_LT(edge->latest - edge->earliest, 1e-9);
}

TEST(AssemblyQuestions, AgentsOfManyPoints) {
  // The same body by its corners alone and with thousands of points inside.
  testing::RandomAssemblies random(17);
  std::vector<Vector3d> corners, many;
  for (int i = 0; i < 12; ++i) corners.push_back(random.vector(0.5) + Vector3d(7, 0, 0));
  many = corners;
  while (many.size() < 3000) {
    Vector3d inside = Vector3d::Zero();
    double sum = 0;
    for (const Vector3d& corner : corners) {
      const double weight = random.uniform(0, 1);
      inside += weight * corner;
      sum += weight;
    }
    many.push_back(inside / sum);
  }
  const Assembly body = random.body(PieceKind::triangle, 100);
  const AssemblyOracle few(HullBody(corners), body), all(HullBody(many), body);
  ASSERT_EQ(few.relation(), all.relation());
  for (int i = 0; i < 200; ++i) {
    const Vector3d w = random.vector(4) - Vector3d(7, 0, 0);
    EXPECT_EQ(few.membership(w), all.membership(w));
    const auto one = few.first_contact(w), other = all.first_contact(w);
    ASSERT_EQ(bool(one), bool(other));
    if (one) {
      EXPECT_NEAR(one->time, other->time, 1e-12);
    }
  }
}

TEST(AssemblyQuestions, MissDistanceIsTheLeastOverTheWay) {
  int misses = 0;
  in_scenes(12, 60,
            [&](auto& random, const Assembly& body, const Agent& agent, const AssemblyOracle& oracle,
                const Vector3d& place) {
              for (int i = 0; i < 10; ++i) {
                const Vector3d w = i == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(random.vector(5) - place);
                const AssemblyMiss miss = oracle.miss_distance(w);
                ASSERT_LE(miss.least, miss.most);
                if (oracle.membership(w) != Membership::out) {
                  EXPECT_EQ(miss.most, 0);
                  continue;
                }
                ++misses;
                EXPECT_LT(miss.most - miss.least, 2e-9 * (miss.most + 1));
                for (int k = 0; k < 8; ++k) {
                  const AssemblyOracle later = oracle_of(translated(agent, k * 0.25 * w), body);
                  EXPECT_GE(later.miss_distance(Vector3d::Zero()).most, miss.least - 1e-9);
                }
                const AssemblyOracle nearest = oracle_of(translated(agent, miss.time * w), body);
                EXPECT_NEAR(nearest.miss_distance(Vector3d::Zero()).most, miss.most, 1e-6);
              }
            });
  EXPECT_GT(misses, 100);
}

TEST(AssemblyQuestions, MissDistancesHoldTheLeastOfAllPiecesToTheirTolerance) {
  int misses = 0;
  in_scenes(17, 24,
            [&](auto& random, const Assembly& body, const Agent& agent, const AssemblyOracle& oracle,
                const Vector3d& place) {
              std::vector<AssemblyOracle> alone;
              for (std::size_t i = 0; i < body.size(); ++i)
                alone.push_back(body.kind() == PieceKind::ball
                                    ? oracle_of(agent, Assembly::cloud(body.piece(i).points(), body.radius()))
                                    : oracle_of(agent, Assembly::polyhedra({body.piece(i)})));
              const double size = 0.8;  // of any agent, or more
              for (int i = 0; i < 6; ++i) {
                const Vector3d w = i == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(random.vector(5) - place);
                double least = INFINITY, most = INFINITY;
                for (const AssemblyOracle& one : alone) {
                  const AssemblyMiss own = one.miss_distance(w, 1e-12);
                  least = std::min(least, own.least);
                  most = std::min(most, own.most);
                }
                misses += most > 0;
                for (const double tolerance : {1e-12, 1e-9, 1e-6, 1e-3, 0.1, 1.0}) {
                  const AssemblyMiss miss = oracle.miss_distance(w, tolerance);
                  ASSERT_LE(miss.least, most) << tolerance;
                  ASSERT_GE(miss.most, least) << tolerance;
                  ASSERT_GE(miss.least, 0);
                  ASSERT_LE(miss.most - miss.least, (tolerance + 1e-12) * (miss.most + size)) << tolerance;
                }
              }
            });
  EXPECT_GT(misses, 40);
}

/// A sphere with bumps, of 2 n^2 triangles.
Assembly bumpy_sphere(std::uint32_t n) {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double t = std::numbers::pi * i / n, p = 2 * std::numbers::pi * j / n;
      const double r = 1 + 0.05 * std::sin(7 * t) * std::cos(9 * p);
      points.push_back(r * Vector3d(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t next = (j + 1) % n, a = i * n, b = (i + 1) * n;
      triangles.push_back({a + j, b + j, b + next});
      triangles.push_back({a + j, b + next, a + next});
    }
  return Assembly::mesh(points, triangles);
}

TEST(AssemblyQuestions, MissDistancesMeasureFewPiecesOfMany) {
  const Assembly body = bumpy_sphere(100);
  testing::RandomAssemblies random(18);
  double measured = 0, boxes = 0;
  for (int i = 0; i < 40; ++i) {
    const Vector3d from = random.vector(1).normalized();
    const AssemblyOracle oracle(Ellipsoid::from_axes(3 * from, {0.3, 0.2, 0.1}), body);
    const Vector3d side = from.unitOrthogonal();
    Effort effort;
    ASSERT_GT(
        oracle
            .miss_distance(i % 4 == 0 ? Vector3d(Vector3d::Zero()) : Vector3d((0.6 + 0.01 * i) * side - from),
                           1e-6, &effort)
            .least,
        0);
    measured += double(effort.pieces);
    boxes += double(effort.nodes);
  }
  EXPECT_LT(measured / 40, 20);  // of 20,000
  EXPECT_LT(boxes / 40, 600);
}

TEST(AssemblyQuestions, OneBallAgreesWithTwoEllipsoids) {
  testing::RandomAssemblies random(13);
  int out = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3d center = random.vector(1), place = random.vector(1) + Vector3d(3, 0, 0);
    const Ellipsoid agent = std::get<Ellipsoid>(random.agent(false, place));
    const Ellipsoid ball = Ellipsoid::from_axes(center, Vector3d::Constant(0.4));
    const AssemblyOracle oracle(agent, Assembly::cloud({center}, 0.4));
    const ConeOracle pair(agent, ball);
    ASSERT_EQ(oracle.relation(), pair.relation());
    if (pair.relation() != Relation::disjoint) continue;
    const Vector3d w = center - place + random.vector(1.5);
    ASSERT_EQ(oracle.membership(w), pair.membership(w));
    const AssemblyMiss miss = oracle.miss_distance(w);
    if (const auto time = time_to_contact(agent, ball, w)) {
      const auto contact = oracle.first_contact(w);
      ASSERT_TRUE(contact);
      EXPECT_NEAR(contact->time, *time, 1e-7 * *time);
      EXPECT_LE(contact->earliest, *time * (1 + 1e-12));
      EXPECT_GE(contact->latest, *time * (1 - 1e-12));
    } else {
      ++out;
      const double expected = clearance_ahead(pair, w, Vector3d::Zero());
      EXPECT_LE(miss.least, expected * (1 + 1e-12) + 1e-12);
      EXPECT_GE(miss.most, expected * (1 - 1e-12) - 1e-12);
    }
  }
  EXPECT_GT(out, 50);
}

TEST(AssemblyQuestions, ExtremesOfOneBallAreTheBoundaryOfItsCone) {
  testing::RandomAssemblies random(14);
  for (int i = 0; i < 40; ++i) {
    const Vector3d center = random.vector(1), place = random.vector(1) + Vector3d(3, 0, 0);
    const Ellipsoid agent = std::get<Ellipsoid>(random.agent(false, place));
    const Ellipsoid ball = Ellipsoid::from_axes(center, Vector3d::Constant(0.4));
    if (relation(agent, ball) != Relation::disjoint) continue;
    const AssemblyOracle oracle(agent, Assembly::cloud({center}, 0.4));
    const TrueCone cone = true_cone(agent, ball, 12);
    for (const BoundarySample& sample : cone.boundary) {
      const Vector3d side = (sample.direction - sample.direction.dot(cone.axis) * cone.axis).normalized();
      const double angle = std::acos(sample.direction.dot(cone.axis));
      for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        const ExtremeDirection extreme = oracle.extreme(cone.axis, side, tolerance);
        ASSERT_TRUE(extreme.any);
        EXPECT_LE(extreme.high - extreme.low, tolerance);
        EXPECT_LE(extreme.low, angle + 1e-12);
        EXPECT_GE(extreme.high, angle - 1e-12);
      }
    }
  }
}

TEST(AssemblyQuestions, NoDirectionBeyondTheExtremeCollides) {
  constexpr double kPi = std::numbers::pi;
  in_scenes(
      15, 60,
      [&](auto&, const Assembly& body, const Agent&, const AssemblyOracle& oracle, const Vector3d& place) {
        const AxisFrame frame(body.bounds().center() - place);
        const std::vector<ExtremeDirection> extremes = oracle.extremes(frame.axis, 12, 1e-5);
        for (int k = 0; k < 12; ++k) {
          const ExtremeDirection& extreme = extremes[std::size_t(k)];
          const double azimuth = 2 * kPi * k / 12;
          const Vector3d side = std::cos(azimuth) * frame.e1 + std::sin(azimuth) * frame.e2;
          if (extreme.any) {
            EXPECT_NE(oracle.membership(extreme.direction), Membership::out);
            EXPECT_LE(extreme.high - extreme.low, 1e-5);
          }
          for (int i = 1; i <= 60; ++i) {
            const double t = extreme.high + (kPi - extreme.high) * i * i / 3600;
            if (t > extreme.high) {
              EXPECT_EQ(oracle.membership(std::cos(t) * frame.axis + std::sin(t) * side), Membership::out);
            }
          }
          // Alone it is the same, found without a guess.
          const ExtremeDirection alone = oracle.extreme(frame.axis, side, 1e-5);
          EXPECT_EQ(alone.any, extreme.any);
          EXPECT_NEAR(alone.low, extreme.low, 1e-5);
        }
      });
}

TEST(AssemblyQuestions, CellsAreAllInOrAllOut) {
  int in = 0, out = 0;
  in_scenes(
      16, 60,
      [&](auto& random, const Assembly&, const Agent&, const AssemblyOracle& oracle, const Vector3d& place) {
        for (int i = 0; i < 60; ++i) {
          const AxisFrame frame(random.vector(5) - place);
          const double s = std::pow(10, random.uniform(-2.5, 0));
          const auto corner = [&](double x, double y) {
            return (frame.axis + s * (x * frame.e1 + y * frame.e2)).normalized();
          };
          const DirectionCell cell{corner(1, 0), corner(-0.5, 0.87), corner(-0.5, -0.87)};
          Frontier own, again;
          const Certified label = oracle.classify(cell, oracle.start(), own);
          in += label == Certified::in;
          out += label == Certified::out;
          if (label == Certified::undecided) {
            // What is learned about a cell serves its parts.
            const DirectionCell part{cell[0], (cell[0] + cell[1]).normalized(),
                                     (cell[0] + cell[2]).normalized()};
            EXPECT_EQ(oracle.classify(part, own, again) == Certified::out,
                      oracle.classify(part, oracle.start(), again) == Certified::out);
            continue;
          }
          for (int k = 0; k < 20; ++k) {
            const Vector3d d = random.uniform(0, 1) * cell[0] + random.uniform(0, 1) * cell[1] +
                               random.uniform(0, 1) * cell[2];
            ASSERT_EQ(oracle.membership(d) == Membership::out, label == Certified::out);
          }
        }
      });
  EXPECT_GT(in, 100);
  EXPECT_GT(out, 100);
}

}  // namespace
}  // namespace vericone::assembly_questions_test
