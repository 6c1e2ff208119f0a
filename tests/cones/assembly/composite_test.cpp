// SPDX-License-Identifier: BSD-3-Clause
//
// Delimited bodies against pieces, by sampled sweeps (composite_sweep.h); pieces against pieces, by all pairs
// of pieces alone; the laws of both.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/composite/composite_pair.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>

#include "cones/assembly/composite_sweep.h"
#include "support/random_assemblies.h"

namespace vericone::composite_test {
namespace {

using Eigen::Vector3d;
using testing::share;

using testing::RandomPairs;

class DelimitedPair : public ::testing::TestWithParam<PieceKind> {};

TEST_P(DelimitedPair, SampledSweepsContradictNoAnswer) {
  RandomPairs random(10 + static_cast<std::uint64_t>(GetParam()));
  SCOPED_TRACE(random.trace());
  int asked = 0, decided = 0, counts[3] = {};
  for (int scene = 0; scene < share(1000); ++scene) {
    const Assembly obstacle = random.few(GetParam(), 6);
    const CombinedEllipsoid body = random.delimited(random.vector(scene % 4 == 0 ? 6 : 3));
    const Pose pose = scene % 3 == 0 ? Pose{random.vector(1), random.rotation()} : Pose{};
    const CompositePair pair(body, obstacle, pose, 1e-2);
    if (pair.relation() != Relation::disjoint) continue;
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
      if (testing::sweep_hits(points, pieces, w)) {
        ASSERT_NE(*answer, Membership::out) << "scene " << scene << ", velocity " << w.transpose();
      } else if (*answer == Membership::in) {
        ASSERT_LT(testing::sweep_distance(points, pieces, w), spacing)
            << "scene " << scene << ", velocity " << w.transpose();
      }
    }
  }
  RecordProperty("decided", std::to_string(decided) + " of " + std::to_string(asked));
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
    each([&](const auto& pair) { best = std::max(best, pair.membership(w)); });
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

/// Two half spaces of a sphere with dents at its x ends, and a wall at x = 5 that ends at y = 1.
CombinedEllipsoid dented_ball(const Vector3d& center) {
  return {Ellipsoid::from_axes(center, {1, 1, 1}), {hyperboloid(2, {0.6, 1, 1})}};
}
Assembly wall() {
  return Assembly::mesh({{5, -1, -1}, {5, 1, -1}, {5, 1, 1}, {5, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
}

TEST(DelimitedPairLaws, NoWrongAnswerWhereItGrazes) {
  // |12 - 25| / 13 = 1: the direction (12, 5, 0) touches the wall's edge with the round part of the body.
  const CompositePair pair(dented_ball({0, 0, 0}), wall(), {}, 4e-3);
  ASSERT_EQ(pair.relation(), Relation::disjoint);
  EXPECT_EQ(pair.membership({12, 5, 0}, {0, 0, 0}), std::nullopt);
  EXPECT_EQ(pair.verdict({12, 5, 0}, {0, 0, 0}), Verdict::undecided);
  int decided = 0;
  for (int k = 1; k < 50; ++k) {
    const double off = std::ldexp(1.0, -k);
    const auto in = pair.membership({12, 5 - off, 0}, {0, 0, 0}),
               out = pair.membership({12, 5 + off, 0}, {0, 0, 0});
    EXPECT_NE(in, Membership::out) << k;
    EXPECT_NE(out, Membership::in) << k;
    decided += in.has_value() + out.has_value();
  }
  EXPECT_GT(decided, 8);
  // What rests, and what is not a number.
  EXPECT_EQ(pair.membership({1, 2, 3}, {1, 2, 3}), Membership::out);
  EXPECT_THROW(pair.membership({NAN, 0, 0}, {0, 0, 0}), InputError);
  EXPECT_THROW(CompositePair(dented_ball({0, 0, 0}), wall(), {}, 0), InputError);
}

TEST(DelimitedPairLaws, RelationsWithDents) {
  const auto relation = [](const Vector3d& low, const Vector3d& high) {
    return CompositePair(dented_ball({0, 0, 0}), Assembly::boxes({{low, high}})).relation();
  };
  // The dents end at x = 0.6; the ellipsoid would be met at x = 0.95.
  EXPECT_EQ(relation({0.65, -0.1, -0.1}, {2, 0.1, 0.1}), Relation::disjoint);
  EXPECT_EQ(relation({0.55, -0.1, -0.1}, {2, 0.1, 0.1}), Relation::overlapping);
  EXPECT_EQ(relation({0.6, 0, 0}, {2, 0, 0}), std::nullopt);  // a needle that touches
  EXPECT_EQ(relation({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}), Relation::overlapping);
  EXPECT_EQ(relation({-9, -9, -9}, {9, 9, 9}), Relation::overlapping);
  EXPECT_EQ(relation({0.9, 0.9, 0.9}, {2, 2, 2}), Relation::disjoint);
  const CompositePair plate(dented_ball({0, 0, 0}),
                            Assembly::mesh({{0.3, -9, -9}, {0.3, 9, -9}, {0.3, 0, 20}}, {{0, 1, 2}}));
  EXPECT_EQ(plate.relation(), Relation::overlapping);
  EXPECT_EQ(plate.verdict({1, 0, 0}, {0, 0, 0}), Verdict::overlapping);
  EXPECT_EQ(plate.membership({1, 0, 0}, {0, 0, 0}), Membership::in);
}

TEST(DelimitedPairLaws, LengthPlaceAndFrameDoNotMatter) {
  RandomPairs random(30);
  SCOPED_TRACE(random.trace());
  int decided = 0;
  for (int scene = 0; scene < share(120); ++scene) {
    const Assembly obstacle = random.few(testing::kPieceKinds[scene % 4], 5);
    const CombinedEllipsoid body = random.delimited(random.vector(5));
    const CompositePair pair(body, obstacle);
    const Vector3d by(64, -32, 128);
    const CompositePair moved(body.translated(by), obstacle, Pose{by, Eigen::Matrix3d::Identity()});
    // The same two in a turned frame; numbers differ by rounding.
    const Eigen::Matrix3d r = random.rotation();
    std::vector<Delimiter<3>> turned;
    for (const Delimiter<3>& d : body.delimiters()) {
      const Eigen::Matrix3d m = r * d.matrix * r.transpose();
      turned.push_back({0.5 * (m + m.transpose()), d.level});
    }
    const CompositePair rotated(
        CombinedEllipsoid(Ellipsoid::from_axes(r * body.center(), body.ellipsoid().semi_axes(),
                                               [&] {
                                                 Eigen::Matrix3d axes =
                                                     r * body.ellipsoid().axis_directions();
                                                 if (axes.determinant() < 0) axes.col(2) *= -1;
                                                 return axes;
                                               }()),
                          turned),
        obstacle, Pose{Vector3d::Zero(), r});
    const auto agree = [](const auto& x, const auto& y) { return !x || !y || *x == *y; };
    ASSERT_TRUE(agree(pair.relation(), moved.relation()) && agree(pair.relation(), rotated.relation()));
    for (int i = 0; i < 4; ++i) {
      const Vector3d w = random.vector(4) - body.center();
      const auto answer = pair.membership(w, Vector3d::Zero());
      decided += answer.has_value();
      ASSERT_EQ(pair.membership(0x1p-40 * w, Vector3d::Zero()), answer);
      ASSERT_EQ(pair.membership(Vector3d::Zero(), -w), answer);
      ASSERT_TRUE(agree(moved.membership(w, Vector3d::Zero()), answer));
      ASSERT_TRUE(agree(rotated.membership(r * w, Vector3d::Zero()), answer)) << scene;
    }
  }
  EXPECT_GT(decided, share(120) * 4 * 0.95);
}

TEST(DelimitedPairLaws, OfAnySizeTheAnswersAreNeverWrong) {
  RandomPairs random(31);
  SCOPED_TRACE(random.trace());
  int decided = 0, asked = 0;
  for (int scene = 0; scene < share(40); ++scene) {
    std::vector<HullBody> hulls;
    const Assembly loose = random.few(PieceKind::hull, 4);
    const CombinedEllipsoid body = random.delimited(random.vector(5));
    const CompositePair pair(body, loose, {}, 1e-2);
    const Vector3d w = random.vector(4) - body.center();
    const auto answer = pair.membership(w, Vector3d::Zero());
    for (const int exponent : {-480, -300, -60, 60, 110, 300, 480}) {
      const double scale = std::ldexp(1.0, exponent);
      hulls.clear();
      for (std::size_t i = 0; i < loose.size(); ++i) hulls.push_back(loose.piece(i).scaled(scale));
      const CompositePair scaled(body.scaled(scale), Assembly::polyhedra(hulls), {}, 1e-2);
      ASSERT_TRUE(!scaled.relation() || !pair.relation() || *scaled.relation() == *pair.relation())
          << exponent;
      const auto other = scaled.membership(w, Vector3d::Zero());
      ASSERT_TRUE(!answer || !other || *answer == *other) << exponent;
      if (std::abs(exponent) > 60) continue;
      ++asked;
      decided += other.has_value();
    }
  }
  EXPECT_GT(decided, 0.9 * asked);
}

TEST(PiecesPair, TouchingAndGrazingAreExact) {
  const Assembly cube = Assembly::boxes({{{0, 0, 0}, {1, 1, 1}}});
  const auto at = [](double x, double y) { return Assembly::boxes({{{x, y, 0}, {x + 1, y + 1, 1}}}); };
  EXPECT_EQ(CompositePair(cube, {}, at(1, 0)).relation(), Relation::touching);
  EXPECT_EQ(CompositePair(cube, {}, at(std::nextafter(1, 0), 0)).relation(), Relation::overlapping);
  EXPECT_EQ(CompositePair(cube, {}, at(std::nextafter(1, 2), 0)).relation(), Relation::disjoint);
  const CompositePair pair(cube, {}, at(3, 1));
  EXPECT_EQ(pair.membership({1, 0, 0}, {0, 0, 0}), Membership::on);
  EXPECT_EQ(pair.membership({1, 0x1p-60, 0}, {0, 0, 0}), Membership::in);
  EXPECT_EQ(pair.membership({1, -0x1p-60, 0}, {0, 0, 0}), Membership::out);
  EXPECT_EQ(pair.membership({1 + 3, 0x1p-60, 0}, {3, 0, 0}), Membership::in);
  EXPECT_EQ(pair.verdict({1, 0, 0}, {0, 0, 0}), Verdict::on);
  EXPECT_EQ(pair.membership({2, 2, 2}, {2, 2, 2}), Membership::out);
  const CompositePair touching(cube, {}, at(1, 0));
  EXPECT_EQ(touching.verdict({-1, 0, 0}, {0, 0, 0}), Verdict::touching);
  // Both moved alike: nothing is rounded, whatever the pose.
  const Pose far{{0.1, 0.2, 0.3}, Eigen::Matrix3d::Identity()};
  EXPECT_EQ(CompositePair(cube, far, at(1, 0), far).relation(), Relation::touching);
  // A sieve: balls pass between balls that touch them, and no larger ones.
  std::vector<Vector3d> net;
  for (int y = -2; y <= 2; ++y)
    for (int z = -2; z <= 2; ++z) net.emplace_back(8, 2 * y + 1, 2 * z + 1);
  const auto through = [&](double radius) {
    return CompositePair(Assembly::cloud({{0, 0, 0}}, radius), {}, Assembly::cloud(net, 0.125))
        .membership({1, 0, 0}, {0, 0, 0});
  };
  EXPECT_EQ(through(1.25), Membership::out);  // sqrt(2) - 0.125
  EXPECT_EQ(through(1.3), Membership::in);
}

TEST(PiecesPair, PosesMoveTheBodies) {
  RandomPairs random(40);
  SCOPED_TRACE(random.trace());
  int counts[3] = {};
  for (int scene = 0; scene < share(160); ++scene) {
    const Assembly a = random.few(testing::kPieceKinds[scene % 4], 6),
                   b = random.few(testing::kPieceKinds[scene / 4 % 4], 8);
    const Pose of_a{random.vector(4) + Vector3d(9, 0, 0), random.rotation()},
        of_b{random.vector(2), random.rotation()};
    const CompositePair pair(a, of_a, b, of_b);
    const auto placed = [](const Assembly& body, const Pose& pose) {
      std::vector<HullBody> hulls;
      std::vector<Vector3d> points;
      for (std::size_t i = 0; i < body.size(); ++i) {
        points = body.piece(i).points();
        for (Vector3d& x : points) x = pose.to_world(x);
        hulls.emplace_back(points);
      }
      if (body.kind() != PieceKind::ball) return Assembly::polyhedra(hulls);
      points.clear();
      for (const HullBody& hull : hulls) points.push_back(hull.points()[0]);
      return Assembly::cloud(points, body.radius());
    };
    const AllPairs all(placed(a, of_a), placed(b, of_b));
    ASSERT_EQ(pair.relation(), all.relation());
    if (all.relation() != Relation::disjoint) continue;
    for (int i = 0; i < 6; ++i) {
      const Vector3d w = random.vector(5) - of_a.position;
      ASSERT_EQ(pair.membership(w, Vector3d::Zero()), all.membership(w)) << scene;
      ++counts[int(all.membership(w))];
    }
  }
  EXPECT_GT(counts[0], share(100));
  EXPECT_GT(counts[2], share(100));
}

}  // namespace
}  // namespace vericone::composite_test
