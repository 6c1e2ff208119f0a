// SPDX-License-Identifier: BSD-3-Clause
//
// Certificates of runs: tubes against the tracks that they are of, planes against sampled points of the
// bodies, damaged ones, and what a whole run gets. tests/cli/run_certificate_test.py has them read by the
// checker.
#include <gtest/gtest.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/certificate.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "certificate/planes.h"
#include "certificate/solid.h"
#include "certificate/tube.h"
#include "simulation/moving_pairs.h"
#include "simulation/random.h"

namespace vericone::simulation::certificate_test {
namespace {

using namespace certified;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPadding = 1e-8;

TubeQuestion question(const Track& track, double tolerance = 1e-4) {
  return {track.appears(), track.end(), tolerance, reach(track.shape()), true, kPadding};
}

ShapeInTime box(const Vector3d& half) { return RigidShape{HullBody::box(-half, half)}; }

Track with_curve(Random& random, double end) {
  Quintic position{}, turned{};
  for (std::size_t k = 0; k < 6; ++k) {
    position[k] = random.vector(5.0 / std::pow(3, k));
    turned[k] = k == 0 ? Vector3d(Vector3d::Zero()) : random.vector(1.5 / std::pow(3, k));
  }
  const Curve curve(position, turned, random.rotation(), 0, end);
  Track track(box({1, 2, 0.5}), curve.start(), Orientation::fixed, 0);
  track.append(curve);
  return track;
}

/// Level and climbing, by arcs.
Track level(Random& random, double end) {
  Track track(box({2, 1, 0.5}), {random.vector(10), {5, random.uniform(-5, 5), 1}, Matrix3d::Identity()},
              Orientation::level, 0);
  for (int i = 1; track.end() < end; ++i) track.advance(random.vector(3), std::min(end, 0.2 * i));
  return track;
}

Track braking(Random& random, double end) {
  const Vector3d v(random.uniform(1, 3), 0, 0);
  Track track(box({2, 1, 0.5}), {random.vector(10), v, Matrix3d::Identity()}, Orientation::fixed, 0);
  track.advance({-2, random.uniform(-1, 1), 0}, end);
  return track;
}

/// The largest distance of a corner of the body's surroundings from where the stated track puts it.
double farthest_off(const Track& track, const StatedTrack& stated, double reach_of_body, Random& random) {
  double most = 0;
  for (int i = 0; i <= 700; ++i) {
    const double t = track.appears() + (track.end() - track.appears()) * i / 700;
    const Motion motion = track.motion(t);
    std::size_t segment = 0;
    while (segment + 2 < stated.times.size() && stated.times[segment + 1] <= t) ++segment;
    const Placement placed = placement(stated, segment, t);
    for (int j = 0; j < 4; ++j) {
      const Vector3d x = reach_of_body * (random.vector(1) + Vector3d(0, 0, 1e-6)).normalized();
      most = std::max(most,
                      (motion.position + motion.rotation * x - placed.position - placed.rotation * x).norm());
    }
  }
  return most;
}

TEST(Tube, HoldsTheTrack) {
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const Motion start{random.vector(20), random.vector(6) + Vector3d(4, 0, 0), random.rotation()};
    const std::vector<Track> tracks{
        turning(random, box({1, 2, 0.5}), start, 8, 3), with_curve(random, 2), level(random, 3),
        braking(random, 3), straight(box({1, 1, 1}), start.position, start.velocity, 4, start.rotation)};
    for (std::size_t k = 0; k < tracks.size(); ++k) {
      SCOPED_TRACE(k);
      const double tolerance = std::pow(10, random.uniform(-6, -3)), r = reach(tracks[k].shape());
      const auto stated = tube(tracks[k], question(tracks[k], tolerance));
      ASSERT_TRUE(stated);
      const double off = farthest_off(tracks[k], *stated, r, random);
      EXPECT_LE(off, stated->radius - 2 * kPadding);
      if (k != 3) {  // a body that comes to rest is followed by chords
        EXPECT_LE(stated->radius, 1.2 * tolerance + 2.1 * kPadding);
      }
    }
  }
}

TEST(Tube, OfUnboundedTurningIsNone) {
  Track track(box({2, 1, 0.5}), {{0, 0, 0}, {0, 0, 3}, Matrix3d::Identity()}, Orientation::level, 0);
  track.advance({1, 0, 0}, 2);  // at once from upwards to ahead
  EXPECT_FALSE(tube(track, question(track)));
  TubeQuestion round = question(track);
  round.turns_matter = false;
  EXPECT_TRUE(tube(track, round));
}

TEST(Tube, IsAsFineAsItsSegmentsSay) {
  Random random(2);
  const Track track = turning(random, box({1, 1, 1}), {{0, 0, 0}, {6, 1, 0}, Matrix3d::Identity()}, 5, 4);
  const auto coarse = tube(track, question(track, 1e-3)), fine = tube(track, question(track, 1e-6));
  EXPECT_LT(coarse->segments.size(), fine->segments.size());
  EXPECT_LT(fine->radius, coarse->radius);
}

/// Of bodies that change, and of planar ones: every boundary point at every time is in what stands for them.
TEST(OwnFrame, HoldsTheBodyAtAllTimes) {
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    const Oscillation k{random.uniform(0.3, 0.6), random.uniform(0, 0.3), random.uniform(0.5, 3),
                        random.uniform(-3, 3)};
    DentedConic conic{random.uniform(1, 5), random.uniform(1, 5), k};
    DentedQuadric quadric{{random.uniform(1, 5), random.uniform(1, 5), random.uniform(1, 5)}, k};
    const ShapeInTime ellipse =
        RigidShape{CombinedEllipse(Ellipse::from_axes({0, 0}, {random.uniform(1, 5), random.uniform(1, 5)},
                                                      random.rotation_about_z().topLeftCorner<2, 2>()))};
    for (const ShapeInTime& shape : {ShapeInTime(conic), ShapeInTime(quadric), ellipse}) {
      const OwnFrame own = in_own_frame(shape, 1, 3);
      ASSERT_EQ(own.solid.rounds.size(), 1U);
      EXPECT_EQ(own.dents, shape.rigid() == nullptr);
      const Matrix3d inverse = own.solid.rounds.front().ellipsoid().factor().inverse();
      double farthest = 0;
      for (int j = 0; j < 400; ++j) {
        const WorldBody body = shape_at(shape, random.uniform(1, 3), Vector3d::Zero(), Matrix3d::Identity());
        const Vector3d u = planar(shape) ? random.flat_vector(1) : random.vector(1);
        const Vector3d end = u / body.gauge(u);
        farthest = std::max(farthest, (inverse * end).norm());
        for (const auto& delimiter : own.solid.rounds.front().delimiters())
          EXPECT_LE(delimiter.value(end), 1e-12);
      }
      EXPECT_LE(farthest, 1 + 1e-12);
      EXPECT_GT(farthest, 0.9);
    }
  }
}

/// Two bodies that pass each other, and what is proved of them.
struct Pass {
  Track a, b;
  Solid solid_a, solid_b;
  StatedTrack track_a, track_b;
  Group group{0};
  double end;
  double least = 0;  // proved by the run

  [[nodiscard]] Side side_a() const { return {&solid_a, &track_a, &group}; }
  [[nodiscard]] Side side_b() const { return {&solid_b, &track_b, &group}; }
};

ShapeInTime some_body(Random& random) {
  const Vector3d size(random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2));
  if (random.uniform(0, 1) < 0.5) return box(size);
  return ellipsoid(size);
}

std::optional<Pass> some_pass(Random& random) {
  const double end = 4;
  const Vector3d from = random.vector(12);
  Track a = turning(random, some_body(random), {{0, 0, 0}, Vector3d(3, 0.2, 0.1), random.rotation()}, 3, end);
  Track b =
      turning(random, some_body(random), {from, towards(random, from, end, 6), random.rotation()}, 3, end);
  const PairProof proof = prove(a, b, 0, end);
  if (proof.verdict != ProofVerdict::avoided || proof.least_distance < 0.01) return std::nullopt;
  Solid of_a = in_own_frame(a.shape(), 0, end).solid, of_b = in_own_frame(b.shape(), 0, end).solid;
  auto tube_a = tube(a, question(a)), tube_b = tube(b, question(b));
  return Pass{std::move(a), std::move(b), std::move(of_a),     std::move(of_b), *tube_a, *tube_b,
              {0},          end,          proof.least_distance};
}

Vector3d normal_of(const StatedPlane& plane) {
  Vector3d n;
  for (int i = 0; i < 3; ++i) n(i) = static_cast<double>(plane.normal[static_cast<std::size_t>(i)]);
  return n;
}

/// The largest n.x of a body on the run's own track, by its points or its factor.
double support(const Track& track, double t, const Vector3d& n) {
  const Motion motion = track.motion(t);
  const WorldBody body = *track.shape().rigid();
  const Vector3d m = motion.rotation.transpose() * n;
  if (body.quadric()) return n.dot(motion.position) + body.quadric()->ellipsoid().radius(m);
  double most = -1e300;
  for (const Vector3d& x : body.hull()->points()) most = std::max(most, m.dot(x));
  return n.dot(motion.position) + most;
}

TEST(RunCertificate, PlanesAreBetweenTheBodies) {
  Random random(3);
  int found = 0;
  while (found < 60) {
    const auto pass = some_pass(random);
    if (!pass || (found % 3 == 0 && pass->least > 0.4)) continue;  // a third of them near
    ++found;
    double stuck = 0;
    const double by = 0.3 * pass->least;
    const auto pieces = planes_between(pass->side_a(), pass->side_b(), by, 0, pass->end, stuck);
    ASSERT_TRUE(pieces) << pass->least << " at " << stuck;
    ASSERT_TRUE(proves(pass->side_a(), pass->side_b(), by, 0, pass->end, *pieces));
    for (std::size_t k = 0; k < pieces->planes.size(); ++k) {
      const auto& plane = pieces->planes[k];
      const Vector3d n = normal_of(plane).normalized();
      for (int i = 0; i <= 20; ++i) {
        const double t = pieces->times[k] + (pieces->times[k + 1] - pieces->times[k]) * i / 20;
        EXPECT_GT(-support(pass->b, t, -n) - support(pass->a, t, n), by);
      }
    }
  }
}

/// Of each kind of damage one that makes the proof, or the claim, wrong whatever the bodies are.
TEST(RunCertificate, DamagedIsRefused) {
  Random random(4);
  int found = 0;
  while (found < 40) {
    const auto pass = some_pass(random);
    if (!pass) continue;
    ++found;
    double stuck = 0;
    const auto pieces = planes_between(pass->side_a(), pass->side_b(), 0, 0, pass->end, stuck);
    ASSERT_TRUE(pieces);
    const auto refused = [&](const Pass& bodies, const StatedPieces& damaged, double by = 0) {
      return !proves(bodies.side_a(), bodies.side_b(), by, 0, pass->end, damaged);
    };
    ASSERT_FALSE(refused(*pass, *pieces));
    const auto k =
        static_cast<std::size_t>(random.uniform(0, static_cast<double>(pieces->planes.size()) - 1e-9));
    StatedPieces wrong = *pieces;
    for (auto& x : wrong.planes[k].normal) x = -x;
    EXPECT_TRUE(refused(*pass, wrong)) << "a plane turned round";
    wrong = *pieces;
    wrong.planes[k].length -= 2;
    EXPECT_TRUE(refused(*pass, wrong)) << "a length that is too short";
    for (const bool of_a : {true, false}) {
      wrong = *pieces;
      auto& plane = wrong.planes[k];
      Vector3d n = normal_of(plane);
      if (!of_a) n = -n;
      const Track& track = of_a ? pass->a : pass->b;
      const double t = wrong.times[k], reached = support(track, t, n) - n.dot(track.motion(t).position);
      (of_a ? plane.most_a : plane.most_b)[0] = reached - 1e-3 * n.norm();
      EXPECT_TRUE(refused(*pass, wrong)) << "a support below the body's";
    }
    wrong = *pieces;
    wrong.times.pop_back();
    EXPECT_TRUE(refused(*pass, wrong)) << "a time missing";
    wrong.planes.pop_back();
    EXPECT_TRUE(refused(*pass, wrong)) << "the last piece missing";
    wrong = *pieces;
    wrong.times[k + 1] = wrong.times[k];
    EXPECT_TRUE(refused(*pass, wrong)) << "a piece of no time";
    // The least distance is proved to a few per cent; points of both are nearer than a third more.
    EXPECT_TRUE(refused(*pass, *pieces, 1.34 * pass->least + 1)) << "a distance that is not kept";
    Pass other = *pass;
    other.track_a.radius += 1.34 * pass->least + 1;
    EXPECT_TRUE(refused(other, *pieces)) << "a tube that reaches the other body";
    other = *pass;
    std::swap(other.solid_a, other.solid_b);
    std::swap(other.track_a, other.track_b);
    EXPECT_TRUE(refused(other, *pieces)) << "bodies exchanged";
    other = *pass;  // into the other one
    const std::size_t segment = other.track_a.segment_of(pieces->times[k], pieces->times[k + 1]);
    const Vector3d apart =
        pass->b.motion(pieces->times[k]).position - pass->a.motion(pieces->times[k]).position;
    for (auto& c : other.track_a.segments[segment].position)
      for (int i = 0; i < 3; ++i)
        c[static_cast<std::size_t>(i)] += std::llround(std::ldexp(apart(i), other.track_a.grid));
    EXPECT_TRUE(refused(other, *pieces)) << "a track moved";
    other = *pass;
    other.group.clear();
    EXPECT_TRUE(refused(other, *pieces)) << "no pieces of the bodies";
  }
}

TEST(RunCertificate, DividesWhatIsNotConvex) {
  // A frame of four bars, and a ball that flies through it.
  std::vector<HullBody> bars;
  for (const double side : {-2.0, 2.0}) {
    bars.push_back(HullBody::box({-0.1, side - 0.2, -2.2}, {0.1, side + 0.2, 2.2}));
    bars.push_back(HullBody::box({-0.1, -2.2, side - 0.2}, {0.1, 2.2, side + 0.2}));
  }
  const ShapeInTime frame = RigidShape{WorldBody(Placed(vericone::Body(Assembly::polyhedra(bars))))};
  const Track a = straight(ball(1), {-6, 0.3, 0}, {3, 0, 0}, 4);
  const Track b = straight(frame, {0, 0, 0}, {0, 0, 0}, 4);
  const Solid of_a = in_own_frame(a.shape(), 0, 4).solid, of_b = in_own_frame(b.shape(), 0, 4).solid;
  const auto tube_a = tube(a, question(a)), tube_b = tube(b, question(b));
  std::string reason;
  const auto proof = proof_of_pair({of_a, of_b, *tube_a, *tube_b, 0, 0, 4}, reason);
  ASSERT_TRUE(proof) << reason;
  EXPECT_NE(proof->find("groups"), std::string::npos);
  EXPECT_FALSE(proof_of_pair({of_a, of_b, *tube_a, *tube_b, 0.6, 0, 4}, reason));  // 0.5 m from a bar
}

Body a_body(const std::string& name, const ShapeInTime& shape, const Vector3d& position,
            const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.start = {position, velocity, Matrix3d::Identity()};
  return body;
}

TEST(RunCertificate, OfARunAllPairsThatItCan) {
  Scenario scenario;
  scenario.name = "a \"name\"";
  scenario.duration = 6;
  scenario.bodies = {a_body("A", ball(1), {0, 0, 0}, {2, 0, 0}), a_body("B", ball(1), {8, 3, 0}, {-1, 0, 0}),
                     a_body("C", ball(1), {9, 0, 0}, {0, 0, 0})};
  scenario.bodies[2].appears = 1;
  const auto run = simulate(scenario);
  const RunCertificates found = certificates(scenario, run);
  ASSERT_EQ(found.made.size(), 3U);  // A and B from the start, B and C from 1 s on; A meets C
  EXPECT_EQ(found.made[0].from, 0);
  EXPECT_EQ(found.made[1].from, 1);
  EXPECT_EQ(found.made[0].pairs.front(), (std::pair<std::size_t, std::size_t>{0, 1}));
  EXPECT_NE(found.made[0].text.find(R"("id": "a \"name\": A, B")"), std::string::npos);
  EXPECT_EQ(found.made[1].says, RunClaim::apart);
  EXPECT_EQ(found.made[2].says, RunClaim::meet);
  EXPECT_EQ(found.made[2].pairs.front(), (std::pair<std::size_t, std::size_t>{0, 2}));
  EXPECT_NE(found.made[2].text.find(R"("says": "meet")"), std::string::npos);
  EXPECT_TRUE(found.none.empty());
}

/// Parts a ball from the dents of a body in whose ellipsoid it is, by planes that its delimiter narrows.
TEST(RunCertificate, OfDentsByMultipliers) {
  // |y| <= 1 + x^2 and so on: the ellipsoid reaches 4 m along y, what is left of it 1.8 m.
  const CombinedEllipsoid waisted(Ellipsoid::from_axes({0, 0, 0}, {4, 4, 4}, Matrix3d::Identity()),
                                  {hyperboloid(1, {1.5, 1, 1})});
  const Track a = straight(ball(0.5), {-9, 3.9, 0}, {3, 0, 0}, 6);
  const Track b = straight(RigidShape{waisted}, {0, 0, 0}, {0, 0, 0}, 6);
  const OwnFrame of_a = in_own_frame(a.shape(), 0, 6), of_b = in_own_frame(b.shape(), 0, 6);
  const TubeQuestion asked{0, 6, 1e-4, 4, true, 1e-8};
  const auto tube_a = tube(a, asked), tube_b = tube(b, asked);
  const Group group{0};
  double stuck = 0;
  const auto pieces =
      planes_between({&of_a.solid, &*tube_a, &group}, {&of_b.solid, &*tube_b, &group}, 0, 0, 6, stuck);
  ASSERT_TRUE(pieces) << stuck;
  const auto narrowed = std::find_if(pieces->planes.begin(), pieces->planes.end(),
                                     [](const StatedPlane& plane) { return !plane.multipliers[1].empty(); });
  ASSERT_NE(narrowed, pieces->planes.end());
  const auto k = static_cast<std::size_t>(narrowed - pieces->planes.begin());
  const auto holds = [&](const StatedPlane& plane) {
    return separates({&of_a.solid, &*tube_a, &group}, {&of_b.solid, &*tube_b, &group}, 0, pieces->times[k],
                     pieces->times[k + 1], plane);
  };
  EXPECT_TRUE(holds(*narrowed));
  for (const std::vector<double>& wrong :
       {std::vector<double>{}, {1}, {1, -1}, {0, 0}, {1, 0}, {1, 1, 1}, {0, 1}}) {
    StatedPlane other = *narrowed;
    other.multipliers[1] = wrong;
    EXPECT_FALSE(holds(other));
  }
  StatedPlane other = *narrowed;
  other.multipliers[0] = {1};  // of a ball: as its ellipsoid
  EXPECT_TRUE(holds(other));
  other.multipliers[0] = {2, 1};
  EXPECT_FALSE(holds(other));
}

TEST(RunCertificate, EndsWhereItIsTold) {
  Scenario scenario;
  scenario.duration = 1;
  scenario.bodies = {a_body("A", ball(1), {0, 0, 0}, {0, 0, 0}), a_body("B", ball(1), {8, 3, 0}, {-1, 0, 0})};
  const auto run = simulate(scenario);
  EXPECT_TRUE(certificates(scenario, run, [](double) { return false; }).made.empty());
  Scenario other = scenario;
  other.bodies.pop_back();
  EXPECT_THROW((void)certificates(other, run), InputError);
}

}  // namespace
}  // namespace vericone::simulation::certificate_test
