// SPDX-License-Identifier: BSD-3-Clause
//
// First contact, miss distance and cells of directions of composite pairs: against sampled sweeps, against
// AssemblyOracle piece by piece, and against membership.
#include <gtest/gtest.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/composite/composite_pair.h>
#include <vericone/internal/cones/map/cell.h>

#include "cones/assembly/composite_sweep.h"

namespace vericone::composite_questions_test {
namespace {

using Eigen::Vector3d;
using testing::RandomPairs;
using testing::share;

/// Least distance of a point to the surfaces of the pieces, by projection to planes and edges.
double to_pieces(const std::vector<testing::SweptPiece>& pieces, const Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const testing::SweptPiece& piece : pieces) {
    if (piece.triangles.empty()) least = std::min(least, std::abs((x - piece.center).norm() - piece.radius));
    for (const auto& t : piece.triangles) {
      const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      bool inside = true;
      for (int k = 0; k < 3; ++k) {
        const Vector3d edge = t[(k + 1) % 3] - t[k];
        inside = inside && n.dot(edge.cross(x - t[k])) >= 0;
        const double along = std::clamp(edge.dot(x - t[k]) / edge.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (x - t[k] - along * edge).norm());
      }
      if (inside) least = std::min(least, std::abs(n.dot(x - t[0])));
    }
  }
  return least;
}

TEST(DelimitedQuestions, ContactsAndMissesAreThoseOfSweeps) {
  RandomPairs random(50);
  SCOPED_TRACE(random.trace());
  int contacts = 0, misses = 0, closed = 0;
  for (int scene = 0; scene < share(240); ++scene) {
    const Assembly obstacle = random.few(testing::kPieceKinds[scene % 4], 5);
    const CombinedEllipsoid body = random.delimited(random.vector(5));
    const Pose pose = scene % 3 == 0 ? Pose{random.vector(1), random.rotation()} : Pose{};
    const CompositePair pair(body, obstacle, pose, 1e-2);
    if (pair.relation() != Relation::disjoint) continue;
    double spacing;
    const auto points = testing::surface_points(body, 900, &spacing);
    const auto pieces = testing::swept_pieces(obstacle, pose);
    const double extent = body.ellipsoid().semi_axes()(0);
    const Vector3d w = random.vector(4) - body.center();
    double first = std::numeric_limits<double>::infinity();
    for (const testing::SweptPiece& piece : pieces)
      for (const Vector3d& p : points) first = std::min(first, testing::ray_meets(p, w, piece));
    const auto contact = pair.first_contact(w);
    if (!contact) {
      ASSERT_TRUE(std::isinf(first)) << scene;
      ASSERT_NE(pair.membership(w, Vector3d::Zero()), Membership::in);
      const double sampled = testing::sweep_distance(points, pieces, w);
      const CompositeMiss miss = pair.miss_distance(w, 1e-2);
      ASSERT_LE(miss.least, sampled + 1e-9) << scene;
      ASSERT_GE(miss.most, sampled - spacing) << scene;
      ASSERT_LE(miss.least, miss.most);
      // What it names is of the bodies, and as near as it says.
      ASSERT_LT((miss.agent_point + miss.time * w - miss.point).norm(), miss.most + 1e-7);
      ASSERT_LE(body.gauge(miss.agent_point - body.center()), 1 + 1e-9);
      ASSERT_LT(to_pieces(pieces, miss.point), 1e-7) << scene;
      ++misses;
      closed += miss.most - miss.least < 0.05 * extent;
      continue;
    }
    ASSERT_NE(pair.membership(w, Vector3d::Zero()), Membership::out);
    ASSERT_LE(contact->earliest, first * (1 + 1e-9)) << scene;
    ++contacts;
    closed += (contact->latest - contact->earliest) * w.norm() < 0.1 * extent;
    if (std::isinf(contact->latest)) continue;
    ASSERT_LT(to_pieces(pieces, contact->point), 1e-7) << scene;
    ASSERT_LE(body.gauge(contact->point - contact->latest * w - body.center()), 1 + 1e-6) << scene;
    ASSERT_NEAR(contact->normal.norm(), 1, 1e-9);
    const CompositeMiss miss = pair.miss_distance(w);
    ASSERT_EQ(miss.least, 0);
    ASSERT_LT((miss.agent_point + miss.time * w - miss.point).norm(), 1e-9);
  }
  EXPECT_GT(contacts, share(60));
  EXPECT_GT(misses, share(40));
  EXPECT_GT(closed, 0.9 * (contacts + misses));
}

TEST(DelimitedQuestions, WithoutDelimitersTheyAreThoseOfAnEllipsoid) {
  RandomPairs random(51);
  SCOPED_TRACE(random.trace());
  for (int scene = 0; scene < share(80); ++scene) {
    const Assembly obstacle = random.few(testing::kPieceKinds[scene % 4], 5);
    const Ellipsoid body = random.delimited(random.vector(6)).ellipsoid();
    const CompositePair pair(body, obstacle);
    const AssemblyOracle oracle(body, obstacle);
    if (oracle.relation() != Relation::disjoint) continue;
    const Vector3d w = random.vector(4) - body.center();
    const auto contact = pair.first_contact(w);
    const auto truth = oracle.first_contact(w);
    if (truth) {
      ASSERT_TRUE(contact);
      ASSERT_LE(contact->earliest, truth->latest);
      ASSERT_GE(contact->latest, truth->earliest);
    } else {
      const AssemblyMiss far = oracle.miss_distance(w);
      const CompositeMiss miss = pair.miss_distance(w);
      ASSERT_LE(miss.least, far.most);
      ASSERT_GE(miss.most, far.least);
      if (contact) {
        ASSERT_TRUE(std::isinf(contact->latest));
      }
    }
  }
}

TEST(PiecesQuestions, ContactsAndMissesAreThoseOfEachPieceAlone) {
  RandomPairs random(52);
  SCOPED_TRACE(random.trace());
  int contacts = 0, misses = 0;
  for (int scene = 0; scene < share(320); ++scene) {
    const Assembly b = random.few(testing::kPieceKinds[scene / 4 % 4], 8);
    const Assembly a = random.few(testing::kPieceKinds[scene % 4], 6);
    const Pose place{random.vector(3) + Vector3d(8, 0, 0), Eigen::Matrix3d::Identity()};
    const CompositePair pair(a, place, b);
    if (pair.relation() != Relation::disjoint) continue;
    const Vector3d w =
        scene % 7 == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(random.vector(4) - place.position);
    double earliest = std::numeric_limits<double>::infinity(), least = earliest;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const HullBody piece = a.piece(i).translated(place.position);
      const AssemblyOracle alone =
          a.radius() > 0
              ? AssemblyOracle(Ellipsoid::from_axes(piece.points()[0], Vector3d::Constant(a.radius())), b)
              : AssemblyOracle(piece, b);
      if (const auto contact = alone.first_contact(w)) earliest = std::min(earliest, contact->time);
      least = std::min(least, alone.miss_distance(w).most);
    }
    const auto contact = pair.first_contact(w);
    ASSERT_EQ(contact.has_value(), std::isfinite(earliest)) << scene;
    const CompositeMiss miss = pair.miss_distance(w, 1e-9);
    ASSERT_NEAR(miss.most, least, 1e-7 * (1 + least)) << scene;
    ASSERT_LE(miss.least, least + 1e-12);
    ASSERT_NEAR((miss.agent_point + miss.time * w - miss.point).norm(), miss.most, 1e-7) << scene;
    if (!contact) {
      ++misses;
      continue;
    }
    ++contacts;
    ASSERT_NEAR(contact->time, earliest, 1e-7 * (1 + earliest)) << scene;
    const auto pieces = testing::swept_pieces(b);
    ASSERT_LT(to_pieces({pieces[contact->piece]}, contact->point), 1e-6) << scene;
    const auto own = testing::swept_pieces(a, place);
    ASSERT_LT(to_pieces({own[contact->agent_piece]}, contact->point - contact->time * w), 1e-6) << scene;
    // The mirrored pair: the velocity and the normal turn round.
    const auto mirrored = CompositePair(b, {}, a, place).first_contact(-w);
    ASSERT_TRUE(mirrored);
    ASSERT_NEAR(mirrored->time, contact->time, 1e-7 * (1 + contact->time));
  }
  EXPECT_GT(contacts, share(60));
  EXPECT_GT(misses, share(80));
}

void expect_map_agrees(const CompositePair& pair, RandomPairs& random, double least_decided) {
  ConeMapOptions options;
  options.resolution = 0.2;
  const ConeMap map = cone_map(pair, options);
  int known = 0, asked = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d w = random.vector(1);
    const auto answer = pair.membership(w, Vector3d::Zero());
    const Certified label = map.cells[cell_at(map, w)].label;
    ++asked;
    known += label != Certified::undecided;
    if (!answer) continue;
    ASSERT_FALSE(label == Certified::in && *answer == Membership::out) << w.transpose();
    ASSERT_FALSE(label == Certified::out && *answer == Membership::in) << w.transpose();
  }
  EXPECT_GT(known, least_decided * asked);
}

TEST(CompositeCells, AgreeWithMembership) {
  RandomPairs random(53);
  SCOPED_TRACE(random.trace());
  double colliding = 0;
  for (int scene = 0; scene < share(16); ++scene) {
    const Assembly obstacle = random.few(testing::kPieceKinds[scene % 4], 4);
    const Vector3d place = random.vector(2) + Vector3d(7, 0, 0);
    if (scene % 2 == 0) {
      const CompositePair pair(random.delimited(place), obstacle, Pose{Vector3d::Zero(), random.rotation()},
                               1e-2);
      if (pair.relation() == Relation::disjoint) expect_map_agrees(pair, random, 0.8);
    } else {
      const CompositePair pair(random.few(testing::kPieceKinds[scene / 2 % 4], 4),
                               Pose{place, random.rotation()}, obstacle);
      if (pair.relation() == Relation::disjoint) expect_map_agrees(pair, random, 0.7);
    }
  }
  // A large plate is met in a whole cell.
  const CompositePair plate(Assembly::boxes({{{-1, -1, -1}, {1, 1, 1}}}), {},
                            Assembly::boxes({{{3, -9, -9}, {4, 9, 9}}}));
  ConeMapOptions options;
  options.resolution = 0.1;
  colliding = cone_map(plate, options).colliding;
  EXPECT_GT(colliding, 4);
}

}  // namespace
}  // namespace vericone::composite_questions_test
