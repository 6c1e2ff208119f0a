// SPDX-License-Identifier: BSD-3-Clause
//
// Delimited bodies against pieces, by sampled sweeps (composite_sweep.h); pieces against pieces, by all pairs
// of pieces alone; the laws of both.
#include <gtest/gtest.h>
#include <vericone/cones/composite/composite_pair.h>
#include <vericone/cones/hulls/hull_oracle.h>
#include <vericone/geometry/error.h>

#include "cones/composite_sweep.h"
#include "support/random_assemblies.h"

namespace vericone::composite_test {
namespace {

using Eigen::Vector3d;
using testing::share;

class RandomPairs : public testing::RandomAssemblies {
 public:
  using RandomAssemblies::RandomAssemblies;

  /// Dents, waists or both, so deep that other bodies fit into them.
  CombinedEllipsoid delimited(const Vector3d& center) {
    const Vector3d axes(uniform(1, 3), uniform(1, 3), uniform(1, 3));
    const Ellipsoid ellipsoid = Ellipsoid::from_axes(center, axes, rotation());
    for (;;) {
      std::vector<Delimiter<3>> delimiters;
      const int count = integer(1, 2);
      for (int i = 0; i < count; ++i)
        delimiters.push_back(hyperboloid(
            integer(1, 2), Vector3d(uniform(0.3, 1), uniform(0.3, 1.5), uniform(0.3, 1.5)), rotation()));
      try {
        return CombinedEllipsoid(ellipsoid, delimiters);
      } catch (const InputError&) {  // one of them misses the ellipsoid
      }
    }
  }

  /// A few pieces of the kind about the origin.
  Assembly few(PieceKind kind, int count) {
    if (kind != PieceKind::hull) return body(kind, static_cast<std::size_t>(count), 0.3);
    std::vector<HullBody> hulls;
    for (int i = 0; i < count; ++i) {
      std::vector<Vector3d> points;
      const Vector3d c = vector(4);
      for (int k = 0; k < 6; ++k) points.push_back(c + vector(0.5));
      hulls.emplace_back(points);
    }
    return Assembly::polyhedra(hulls);
  }
};

bool sweep_hits(const std::vector<Vector3d>& points, const std::vector<testing::SweptPiece>& pieces,
                const Vector3d& w) {
  for (const testing::SweptPiece& piece : pieces)
    for (const Vector3d& p : points)
      if (std::isfinite(testing::ray_meets(p, w, piece))) return true;
  return false;
}

double sweep_distance(const std::vector<Vector3d>& points, const std::vector<testing::SweptPiece>& pieces,
                      const Vector3d& w) {
  double least = std::numeric_limits<double>::infinity();
  for (const testing::SweptPiece& piece : pieces)
    for (const Vector3d& p : points) least = std::min(least, testing::ray_distance(p, w, piece));
  return least;
}

class DelimitedPair : public ::testing::TestWithParam<PieceKind> {};

TEST_P(DelimitedPair, SampledSweepsContradictNoAnswer) {
  RandomPairs random(10 + static_cast<std::uint64_t>(GetParam()));
  SCOPED_TRACE(random.trace());
  int asked = 0, decided = 0, counts[3] = {}, relations[4] = {};
  for (int scene = 0; scene < share(1000); ++scene) {
    const Assembly obstacle = random.few(GetParam(), 6);
    const CombinedEllipsoid body = random.delimited(random.vector(scene % 4 == 0 ? 6 : 3));
    const Pose pose = scene % 3 == 0 ? Pose{random.vector(1), random.rotation()} : Pose{};
    const CompositePair pair(body, obstacle, pose, 1e-2);
    const auto relation = pair.relation();
    ++relations[relation ? int(*relation) : 3];
    if (relation != Relation::disjoint) continue;
    double spacing;
    const auto points = testing::surface_points(body, 400, &spacing);
    const auto pieces = testing::swept_pieces(obstacle, pose);
    for (int i = 0; i < 2; ++i) {
      const Vector3d w = i == 0 ? Vector3d(random.vector(1)) : Vector3d(random.vector(3) - body.center());
      const auto answer = pair.membership(w, Vector3d::Zero());
      ++asked;
      if (!answer) continue;
      ++decided;
      ++counts[int(*answer)];
      if (sweep_hits(points, pieces, w)) {
        ASSERT_NE(*answer, Membership::out) << "scene " << scene << ", velocity " << w.transpose();
      } else if (*answer == Membership::in) {
        ASSERT_LT(sweep_distance(points, pieces, w), spacing)
            << "scene " << scene << ", velocity " << w.transpose();
      }
    }
  }
  RecordProperty("decided", std::to_string(decided) + " of " + std::to_string(asked));
  std::printf("decided %d of %d: in %d out %d; relations %d %d %d undecided %d\n", decided, asked, counts[0],
              counts[2], relations[0], relations[1], relations[2], relations[3]);
  EXPECT_GT(decided, 0.95 * asked);
  EXPECT_GT(counts[int(Membership::in)], share(200));
  EXPECT_GT(counts[int(Membership::out)], share(200));
}
INSTANTIATE_TEST_SUITE_P(Kinds, DelimitedPair, ::testing::ValuesIn(testing::kPieceKinds),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

/// All pairs of pieces, each with its own exact predicate.
struct AllPairs {
  AllPairs(const Assembly& a, const Assembly& b) {
    const auto body = [](const Assembly& all, std::size_t i) -> std::variant<Ellipsoid, HullBody> {
      const HullBody piece = all.piece(i);
      if (all.radius() == 0) return piece;
      return Ellipsoid::from_axes(piece.points()[0], Vector3d::Constant(all.radius()));
    };
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) add(body(a, i), body(b, j));
  }
  void add(const testing::Agent& a, const testing::Agent& b) {
    if (a.index() == 0 && b.index() == 0) {
      balls.emplace_back(std::get<0>(a), std::get<0>(b));
    } else if (a.index() == 0) {
      hulls.emplace_back(std::get<0>(a), std::get<1>(b));
    } else if (b.index() == 0) {
      hulls.emplace_back(std::get<1>(a), std::get<0>(b));
    } else {
      hulls.emplace_back(std::get<1>(a), std::get<1>(b));
    }
  }
  template <class Call>
  void each(Call call) const {
    for (const HullOracle& pair : hulls) call(pair);
    for (const ConeOracle& pair : balls) call(pair);
  }
  Relation relation() const {
    Relation worst = Relation::disjoint;
    each([&](const auto& pair) { worst = std::max(worst, pair.relation()); });
    return worst;
  }
  Membership membership(const Vector3d& w) const {
    Membership best = Membership::out;
    each([&](const auto& pair) { best = std::min(best, pair.membership(w)); });
    return best;
  }
  std::vector<HullOracle> hulls;
  std::vector<ConeOracle> balls;
};

Assembly translated(const Assembly& body, const Vector3d& by) {
  std::vector<HullBody> hulls;
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < body.size(); ++i) {
    hulls.push_back(body.piece(i).translated(by));
    points.push_back(hulls.back().points()[0]);
  }
  return body.kind() == PieceKind::ball ? Assembly::cloud(points, body.radius()) : Assembly::polyhedra(hulls);
}

TEST(PiecesPair, AnswersAreThoseOfAllPairsAlone) {
  RandomPairs random(20);
  SCOPED_TRACE(random.trace());
  int counts[3] = {}, relations[3] = {};
  for (int scene = 0; scene < share(480); ++scene) {
    const PieceKind of_a = testing::kPieceKinds[scene % 4], of_b = testing::kPieceKinds[scene / 4 % 4];
    const Assembly loose = random.few(of_a, 7), b = random.few(of_b, 12);
    // Every third scene: two pieces at about the same place.
    const Vector3d place =
        scene % 3 > 0 ? random.vector(9)
                      : Vector3d(b.piece(0).points()[0] - loose.piece(0).points()[0] + random.vector(0.3));
    const Assembly a = translated(loose, place);
    const CompositePair pair(a, Pose{}, b), mirrored(b, Pose{}, a);
    const AllPairs all(a, b);
    ASSERT_TRUE(pair.exact());
    ASSERT_EQ(pair.relation(), all.relation()) << "scene " << scene;
    ASSERT_EQ(mirrored.relation(), all.relation()) << "scene " << scene;
    ++relations[int(all.relation())];
    if (all.relation() != Relation::disjoint) {
      EXPECT_EQ(pair.membership(Vector3d::UnitX(), Vector3d::Zero()), Membership::in);
      continue;
    }
    for (int i = 0; i < 12; ++i) {
      Vector3d w = random.vector(6) - place;
      if (i % 3 == 1) w = b.piece(0).points()[0] - a.piece(0).points()[0];
      if (i % 3 == 2) w = random.vector(1);
      const auto answer = pair.membership(w, Vector3d::Zero());
      ASSERT_EQ(answer, all.membership(w)) << "scene " << scene << ", velocity " << i;
      ASSERT_EQ(mirrored.membership(Vector3d::Zero(), w), answer);
      ASSERT_EQ(pair.membership(0x1p-30 * w, Vector3d::Zero()), answer);
      ++counts[int(*answer)];
    }
  }
  EXPECT_GT(counts[int(Membership::in)], share(400));
  EXPECT_GT(counts[int(Membership::out)], share(400));
  EXPECT_GT(relations[int(Relation::disjoint)], share(100));
  EXPECT_GT(relations[int(Relation::overlapping)], share(50));
}

}  // namespace
}  // namespace vericone::composite_test
