// SPDX-License-Identifier: BSD-3-Clause
//
// Where pieces join and none of them alone is entered. The truth is told without looking at what the pieces
// cover: every small change of the velocity, or of the place, is asked of every pair of pieces.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/composite/composite_pair.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <Eigen/LU>
#include <cmath>

#include "support/campaign.h"
#include "support/random.h"

namespace vericone::seam_test {
namespace {

using Eigen::Vector3d;

bool is_flat(const HullBody& piece) {
  Eigen::MatrixXd edges(3, std::ptrdiff_t(piece.size()));
  for (std::size_t i = 0; i < piece.size(); ++i)
    edges.col(std::ptrdiff_t(i)) = piece.points()[i] - piece.points()[0];
  return Eigen::FullPivLU<Eigen::MatrixXd>(edges).rank() < 3;
}

/// Two bodies of pieces with small integers for coordinates.
struct Pieces {
  std::vector<HullBody> a, b;

  Pieces(const Assembly& agent, const Assembly& obstacle) {
    for (std::size_t i = 0; i < agent.size(); ++i) a.push_back(agent.piece(i));
    for (std::size_t i = 0; i < obstacle.size(); ++i) b.push_back(obstacle.piece(i));
  }

  using Group = std::vector<std::pair<std::size_t, std::size_t>>;
  /// Each pair alone; each flat piece with the other body; all flat pieces.
  std::vector<Group> groups() const {
    std::vector<Group> all;
    const auto add = [&](auto&& counts) {
      Group group;
      for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
          if (counts(i, j)) group.emplace_back(i, j);
      all.push_back(group);
    };
    std::vector<bool> flat_a, flat_b;
    for (const HullBody& piece : a) flat_a.push_back(is_flat(piece));
    for (const HullBody& piece : b) flat_b.push_back(is_flat(piece));
    for (std::size_t i = 0; i < a.size(); ++i)
      if (flat_a[i]) add([&](std::size_t k, std::size_t) { return k == i; });
    for (std::size_t j = 0; j < b.size(); ++j)
      if (flat_b[j]) add([&](std::size_t, std::size_t k) { return k == j; });
    add([&](std::size_t i, std::size_t j) { return flat_a[i] && flat_b[j]; });
    return all;
  }

  Membership membership(const Vector3d& w) const {
    Membership best = Membership::out;
    std::vector<HullOracle> oracles;
    std::vector<double> angles;
    const Vector3d u = w.unitOrthogonal(), v = w.normalized().cross(u);
    for (const HullBody& p : a)
      for (const HullBody& q : b) {
        oracles.emplace_back(p, q);
        best = std::max(best, oracles.back().membership(w));
        for (const Vector3d& x : p.points())
          for (const Vector3d& y : q.points())
            if (const Vector3d d = y - x; std::hypot(d.dot(u), d.dot(v)) > 1e-9)
              angles.push_back(std::atan2(d.dot(v), d.dot(u)));
      }
    if (best != Membership::on) return best;
    // Between two neighbouring angles nothing changes.
    std::sort(angles.begin(), angles.end());
    angles.push_back(angles.front() + 2 * M_PI);
    std::vector<Vector3d> changed;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      if (angles[i + 1] - angles[i] < 1e-9) continue;
      const double angle = 0.5 * (angles[i] + angles[i + 1]);
      const Vector3d d = 0x1p20 * (std::cos(angle) * u + std::sin(angle) * v);
      changed.push_back(0x1p45 * w + d.array().round().matrix());
    }
    return entered([&](const Group& group) {
      return std::all_of(changed.begin(), changed.end(), [&](const Vector3d& other) {
        return std::any_of(group.begin(), group.end(), [&](const auto& pair) {
          return oracles[pair.first * b.size() + pair.second].membership(other) != Membership::out;
        });
      });
    })
               ? Membership::in
               : best;
  }

  Relation relation() const {
    Relation worst = Relation::disjoint;
    std::vector<Sides> sides;
    for (const HullBody& p : a)
      for (const HullBody& q : b) {
        const Relation own = HullOracle(p, q).relation();
        worst = std::max(worst, own);
        sides.push_back(own == Relation::touching ? sides_of(p, q) : Sides{});
      }
    if (worst != Relation::touching) return worst;
    return entered([&](const Group& group) {
      std::vector<Sides> touched;
      for (const auto& [i, j] : group)
        if (const Sides& own = sides[i * b.size() + j]; !own.empty()) touched.push_back(own);
      return shifts_meet(touched);
    })
               ? Relation::overlapping
               : worst;
  }

  /// Of the shifts of the agent (negated) that do not part two pieces at once: normals n with n.shift >= 0.
  /// None where every shift off a plane does.
  using Sides = std::vector<Vector3d>;
  static Sides sides_of(const HullBody& p, const HullBody& q) {
    std::vector<Vector3d> all;
    for (const Vector3d& x : p.points())
      for (const Vector3d& y : q.points()) all.push_back(y - x);
    Sides sides;
    for (const Vector3d& x : all)
      for (const Vector3d& y : all) {
        const Vector3d n = x.cross(y);
        const auto above = [&](const Vector3d& k) { return n.dot(k) >= 0; };
        const auto within = [&](const Vector3d& k) { return n.dot(k) == 0; };
        if (n.isZero(0)) continue;
        if (std::all_of(all.begin(), all.end(), within)) return {};
        if (std::all_of(all.begin(), all.end(), above)) sides.push_back(n);
      }
    return sides;
  }

  /// Whether every shift is among those of some pair: where two sides cross, looked at all around.
  static bool shifts_meet(const std::vector<Sides>& touched) {
    std::vector<Vector3d> normals;
    for (const Sides& sides : touched)
      for (const Vector3d& n : sides)
        if (std::none_of(normals.begin(), normals.end(),
                         [&](const Vector3d& other) { return n.cross(other).isZero(0); }))
          normals.push_back(n);
    const auto covered_around = [&](const Vector3d& ray) {
      const Vector3d u = ray.unitOrthogonal(), v = ray.normalized().cross(u);
      std::vector<double> angles{-M_PI, M_PI};
      for (const Vector3d& n : normals)
        if (n.dot(ray) == 0)
          for (const Vector3d& side : {Vector3d(ray.cross(n)), Vector3d(n.cross(ray))})
            angles.push_back(std::atan2(side.dot(v), side.dot(u)));
      std::sort(angles.begin(), angles.end());
      for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        if (angles[i + 1] - angles[i] < 1e-9) continue;
        const double angle = 0.5 * (angles[i] + angles[i + 1]);
        const Vector3d beside = std::cos(angle) * u + std::sin(angle) * v;
        if (std::none_of(touched.begin(), touched.end(), [&](const Sides& sides) {
              return std::all_of(sides.begin(), sides.end(), [&](const Vector3d& n) {
                const double at = n.dot(ray);
                return at > 0 || (at == 0 && n.dot(beside) > 0);
              });
            }))
          return false;
      }
      return true;
    };
    for (const Vector3d& n : normals) {
      std::vector<Vector3d> others = normals;
      for (int k = 0; k < 3; ++k) others.push_back(Vector3d::Unit(k));
      for (const Vector3d& other : others)
        if (const Vector3d ray = n.cross(other);
            !ray.isZero(0) && !(covered_around(ray) && covered_around(-ray)))
          return false;
    }
    return !normals.empty();
  }

  template <class Covered>
  bool entered(Covered&& covered) const {
    for (const Group& group : groups())
      if (group.size() > 1 && covered(group)) return true;
    return false;
  }
};

/// Pieces between the points of a small grid, so that they share corners, edges and parts of faces.
class GridBodies : public testing::Random {
 public:
  using Random::Random;

  Vector3d corner() { return Vector3d(integer(-1, 1), integer(-1, 1), integer(-1, 1)); }

  Assembly body(PieceKind kind, std::uint32_t count, const Vector3d& at) {
    std::vector<Vector3d> points;
    for (std::uint32_t i = 0; i < 3 * count; ++i) points.push_back(at + corner());
    // Half of them about one point.
    for (std::uint32_t i = 0; i < count; i += 2) points[3 * i] = at;
    if (kind == PieceKind::ball) return Assembly::cloud(points, 0);
    std::vector<Assembly::Triangle> triangles;
    std::vector<Box> boxes;
    std::vector<HullBody> hulls;
    for (std::uint32_t i = 0; i < count; ++i) {
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      const Vector3d low = at + Vector3d(integer(-1, 0), integer(-1, 0), integer(-1, 0));
      boxes.push_back({low, low + Vector3d(integer(0, 4) > 0, 1, 1)});
      hulls.emplace_back(std::vector<Vector3d>{points[3 * i], points[3 * i + 1], points[3 * i + 2],
                                               at + corner(), at + corner()});
    }
    if (kind == PieceKind::triangle) return Assembly::mesh(points, triangles);
    if (kind == PieceKind::box) return Assembly::boxes(boxes);
    return Assembly::polyhedra(hulls);
  }
};

constexpr PieceKind kKinds[] = {PieceKind::triangle, PieceKind::ball, PieceKind::box, PieceKind::hull};

TEST(Seams, VelocitiesAreDecidedAsAllSmallChangesOfThem) {
  GridBodies random(31);
  SCOPED_TRACE(random.trace());
  int joined = 0, on = 0;
  for (int scene = 0; scene < testing::share(8000); ++scene) {
    const Vector3d at(random.integer(3, 4), random.integer(-1, 1), random.integer(-1, 1));
    const Assembly b = random.body(kKinds[scene % 4], std::uint32_t(random.integer(1, 8)), at);
    // Convex agents of every dimension, and many pieces.
    const int corners = random.integer(1, 5);
    std::vector<Vector3d> points;
    for (int i = 0; i < corners; ++i) points.push_back(0.5 * random.corner());
    const Assembly a =
        scene % 3 > 0 ? Assembly::polyhedra({HullBody(points)})
                      : random.body(kKinds[scene / 4 % 4], std::uint32_t(random.integer(1, 4)), {0, 0, 0});
    const Pieces pieces(a, b);
    const CompositePair pair(a, {}, b), exchanged(b, {}, a);
    if (pair.relation() != Relation::disjoint) continue;
    const Vector3d w =
        2 * (at - a.piece(0).points()[0]) + (scene % 2 > 0 ? random.corner() : Vector3d(0, 0, 0));
    const Membership truth = pieces.membership(w), got = *pair.membership(w, {0, 0, 0});
    ASSERT_EQ(got, truth) << "scene " << scene;
    ASSERT_EQ(exchanged.membership({0, 0, 0}, w), truth) << "scene " << scene;
    if (a.size() == 1) {
      const AssemblyOracle oracle(a.piece(0), b);
      ASSERT_EQ(oracle.membership(w), truth) << "scene " << scene;
    }
    on += truth == Membership::on;
    if (truth != Membership::in) continue;
    bool alone = false;
    for (const HullBody& p : pieces.a)
      for (const HullBody& q : pieces.b) alone = alone || HullOracle(p, q).membership(w) == Membership::in;
    joined += !alone;
    // When, without rounding: what is touched first is touched then.
    const auto contact = pair.first_contact(w);
    ASSERT_TRUE(contact);
    ASSERT_LE(contact->latest - contact->earliest, 1e-6) << "scene " << scene;
  }
  EXPECT_GT(joined, testing::share(100));
  EXPECT_GT(on, testing::share(300));
}

TEST(Seams, RelationsAreDecidedAsAllSmallShifts) {
  GridBodies random(32);
  SCOPED_TRACE(random.trace());
  int joined = 0, touching = 0;
  for (int scene = 0; scene < testing::share(8000); ++scene) {
    const Assembly b = random.body(kKinds[scene % 4], std::uint32_t(random.integer(1, 10)), {0, 0, 0});
    const Vector3d at = scene % 5 > 0 ? Vector3d(0, 0, 0) : Vector3d(random.integer(-1, 1), 0, 0);
    // A point, a segment through it, a triangle about it, what is at one side of it.
    const Vector3d p = 0.5 * random.corner(), q = 0.5 * random.corner();
    const std::vector<std::vector<Vector3d>> shapes{
        {at}, {at - p, at + p}, {at + p, at + q, at - p - q}, {at, at + p, at + q}};
    const std::vector<Vector3d>& points = shapes[std::size_t(random.integer(0, 3))];
    const Assembly a = scene % 3 > 0
                           ? Assembly::polyhedra({HullBody(points)})
                           : random.body(kKinds[scene / 4 % 4], std::uint32_t(random.integer(1, 3)), at);
    const Pieces pieces(a, b);
    const Relation truth = pieces.relation();
    ASSERT_EQ(CompositePair(a, {}, b).relation(), truth) << "scene " << scene;
    ASSERT_EQ(CompositePair(b, {}, a).relation(), truth) << "scene " << scene;
    if (a.size() == 1) {
      ASSERT_EQ(AssemblyOracle(a.piece(0), b).relation(), truth) << "scene " << scene;
    }
    touching += truth == Relation::touching;
    if (truth != Relation::overlapping) continue;
    bool alone = false;
    for (const HullBody& p : pieces.a)
      for (const HullBody& q : pieces.b)
        alone = alone || HullOracle(p, q).relation() == Relation::overlapping;
    joined += !alone;
  }
  EXPECT_GT(joined, testing::share(200));
  EXPECT_GT(touching, testing::share(1000));
}

Assembly plate() {
  return Assembly::mesh({{5, -1, -1}, {5, 1, -1}, {5, 1, 1}, {5, -1, 1}}, {{0, 1, 2}, {0, 2, 3}});
}
Assembly two_boxes() { return Assembly::boxes({{{0, 0, 0}, {1, 1, 1}}, {{0, 1, 0}, {1, 2, 1}}}); }

TEST(Seams, ThroughAPlateAndBetweenBoxes) {
  const Pair through(Body(HullBody({{0, 0, 0}})), Body(plate()));
  EXPECT_EQ(through.verdict({1, 0, 0}, {0, 0, 0}), Verdict::in);
  const auto contact = through.contact({1, 0, 0}, {0, 0, 0});
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->time, 5, 1e-14);
  EXPECT_LE(contact->earliest, 5);
  EXPECT_GE(contact->latest, 5);
  EXPECT_LT(contact->latest - contact->earliest, 1e-13);
  // Its edge and its corner are grazed.
  EXPECT_EQ(through.verdict({5, 1, 0}, {0, 0, 0}), Verdict::on);
  EXPECT_EQ(through.verdict({5, 1, 1}, {0, 0, 0}), Verdict::on);

  const Pair between(Body(HullBody({{-5, 1, 0.5}})), Body(two_boxes()));
  EXPECT_EQ(between.verdict({1, 0, 0}, {0, 0, 0}), Verdict::in);
  EXPECT_NEAR(between.contact({1, 0, 0}, {0, 0, 0})->time, 5, 1e-14);
  EXPECT_EQ(Pair(Body(HullBody({{0.5, 1, 0.5}})), Body(two_boxes())).relation(), Relation::overlapping);
  EXPECT_EQ(Pair(Body(HullBody({{0, 1, 0.5}})), Body(two_boxes())).relation(), Relation::touching);
  EXPECT_EQ(Pair(Body(HullBody({{-1, 1, 0.5}, {2, 1, 0.5}})), Body(two_boxes())).relation(),
            Relation::overlapping);
  // Along the edge that a corner of an L leaves free.
  const Assembly corner =
      Assembly::boxes({{{0, 0, 0}, {1, 1, 1}}, {{0, 1, 0}, {1, 2, 1}}, {{0, 0, 1}, {1, 1, 2}}});
  EXPECT_EQ(Pair(Body(HullBody({{-5, 1, 1}})), Body(corner)).verdict({1, 0, 0}, {0, 0, 0}), Verdict::on);
}

TEST(Seams, ARoofIsEnteredThroughItsRidgeAndGrazedAlongItsProfile) {
  const Assembly roof =
      Assembly::mesh({{5, -1, 0}, {5, 1, 0}, {6, -1, -1}, {6, 1, -1}, {6, -1, 1}, {6, 1, 1}},
                     {{0, 1, 2}, {1, 3, 2}, {0, 1, 4}, {1, 5, 4}});
  const Pair pair(Body(HullBody({{0, 0, 0}})), Body(roof));
  EXPECT_EQ(pair.verdict({1, 0, 0}, {0, 0, 0}), Verdict::in);
  const Pair above(Body(HullBody({{5, 0, 4}})), Body(roof));
  EXPECT_EQ(above.verdict({0, 0, -1}, {0, 0, 0}), Verdict::on);
}

TEST(Seams, AnAgentWithAnInteriorGrazesAsMuchAsItsPieces) {
  // Through a gap that is exactly as wide as it is nothing is entered.
  const Assembly gap = Assembly::boxes({{{4, -3, -3}, {5, -1, 3}}, {{4, 1, -3}, {5, 3, 3}}});
  EXPECT_EQ(Pair(Body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1})), Body(gap)).verdict({1, 0, 0}, {0, 0, 0}),
            Verdict::on);
  EXPECT_EQ(Pair(Body(HullBody::box({-1, -1, -1}, {1, 1, 1})), Body(gap)).verdict({1, 0, 0}, {0, 0, 0}),
            Verdict::on);
  EXPECT_EQ(
      Pair(Body(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1})), Body(plate())).verdict({1, 0, 0}, {0, 0, 0}),
      Verdict::in);
}

TEST(Seams, FacesThatMeetHeadOnHaveATime) {
  const auto cube = [](const Vector3d& low) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 8; ++i) points.push_back(low + Vector3d(i & 1, i >> 1 & 1, i >> 2 & 1));
    std::vector<Assembly::Triangle> triangles;
    for (int k = 0; k < 3; ++k)
      for (const int side : {0, 1}) {
        const int u = 1 << (k + 1) % 3, v = 1 << (k + 2) % 3, o = side << k;
        triangles.push_back({std::uint32_t(o), std::uint32_t(o + u), std::uint32_t(o + u + v)});
        triangles.push_back({std::uint32_t(o), std::uint32_t(o + u + v), std::uint32_t(o + v)});
      }
    return Assembly::mesh(points, triangles);
  };
  const Pair pair(Body(cube({0, 0, 0})), Body(cube({3, 0.25, 0.25})));
  EXPECT_EQ(pair.verdict({5, 0, 0}, {0, 0, 0}), Verdict::in);
  const auto contact = pair.contact({5, 0, 0}, {0, 0, 0});
  ASSERT_TRUE(contact);
  EXPECT_LE(contact->earliest, 0.4);
  EXPECT_GE(contact->latest, 0.4 * (1 - 1e-15));
  EXPECT_LT(contact->latest - contact->earliest, 1e-13);
}

/// The least t >= 0 with t w in the hull of all b - a: in it there is a point of the line that one of them,
/// two or three make. By sums that are exact for small integers.
std::optional<double> first_of_all(const std::vector<Vector3d>& k, const Vector3d& w) {
  std::optional<double> first;
  int axis = 0;
  w.cwiseAbs().maxCoeff(&axis);
  std::vector<Eigen::Vector2d> shadow;
  for (const Vector3d& x : k) {
    const Vector3d y = w(axis) * x - x(axis) * w;
    shadow.emplace_back(y((axis + 1) % 3), y((axis + 2) % 3));
  }
  const auto cross = [&](std::size_t i, std::size_t j) {
    return shadow[i].x() * shadow[j].y() - shadow[i].y() * shadow[j].x();
  };
  const auto consider = [&](double weight, double along) {
    const double t = along / weight / w(axis);
    if (t >= 0 && (!first || t < *first)) first = t;
  };
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (shadow[i].isZero(0)) consider(1, k[i](axis));
    for (std::size_t j = 0; j < i; ++j) {
      if (cross(i, j) == 0 && shadow[i].dot(shadow[j]) < 0) {
        const double a = shadow[j].norm(), b = shadow[i].norm();
        consider(a + b, a * k[i](axis) + b * k[j](axis));
      }
      for (std::size_t l = 0; l < j; ++l) {
        const double a = cross(j, l), b = cross(l, i), c = cross(i, j);
        if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0))
          consider(a + b + c, a * k[i](axis) + b * k[j](axis) + c * k[l](axis));
      }
    }
  }
  return first;
}

TEST(Seams, FirstTimesOfHullsAreThoseOfTheirPoints) {
  testing::Random random(4111);
  SCOPED_TRACE(random.trace());
  int met = 0, missed = 0;
  const int cases = static_cast<int>(testing::from_environment("VERICONE_CASES", 400));
  for (int i = 0; i < cases; ++i) {
    const bool integers = i % 4 != 0;
    const auto points = [&](const Vector3d& at) {
      std::vector<Vector3d> all;
      for (int n = random.integer(1, 6); n > 0; --n)
        all.push_back(integers ? Vector3d(at + Vector3d(random.integer(-2, 2), random.integer(-2, 2),
                                                        random.integer(-2, 2)))
                               : Vector3d(at + 2 * random.vector<3>().normalized()));
      return all;
    };
    const std::vector<Vector3d> a = points(Vector3d::Zero()), b = points({6, 0, 1});
    const Vector3d w = integers ? Vector3d(random.integer(1, 4), random.integer(-1, 1), random.integer(-1, 1))
                                : Vector3d(Vector3d(6, 0, 1) + random.vector<3>().normalized());
    std::vector<Vector3d> k;
    for (const Vector3d& x : b)
      for (const Vector3d& y : a) k.push_back(x - y);
    const auto truth = first_of_all(k, w);
    const auto found = Pair(Body(HullBody(a)), Body(HullBody(b))).contact(w, Vector3d::Zero());
    ASSERT_EQ(found.has_value(), truth.has_value()) << i;
    truth ? ++met : ++missed;
    if (!truth) continue;
    const double off = integers ? 1e-15 : 1e-11;
    EXPECT_LE(found->earliest, *truth * (1 + off)) << i;
    EXPECT_GE(found->latest, *truth * (1 - off)) << i;
    EXPECT_LE(found->latest - found->earliest, 1.001e-12 * *truth) << i;
  }
  EXPECT_GT(met, cases / 4);
  EXPECT_GT(missed, cases / 10);
}

// Where lengths are of one size and speeds of another the time is a double though their quotient is none.
TEST(Seams, FirstTimesAreRoundedOnce) {
  const double size = 0x1p480, speed = 0x1p1023;
  for (int p = 3; p < 20; p += 2) {
    const Body triangle(HullBody({{0, p * size, 0}, {size, -1e6 * size, 0}, {5 * size, -3 * size, 0}}));
    const auto found =
        Pair(Body(HullBody({Vector3d::Zero()})), triangle).contact(Vector3d(speed, 0, 0), Vector3d::Zero());
    ASSERT_TRUE(found);
    const exact::Rational truth =
        exact::Rational(p, p + 1'000'000) * exact::Rational(size) / exact::Rational(speed);
    EXPECT_LE(exact::Rational(found->earliest), truth) << p;
    EXPECT_GE(exact::Rational(found->latest), truth) << p;
  }
}

}  // namespace
}  // namespace vericone::seam_test
