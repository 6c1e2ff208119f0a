// SPDX-License-Identifier: BSD-3-Clause
//
// Each answer of the C interface is that of the C++ behind it, to the bit; errors are lines and numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/cones/certificate.h>
#include <vericone/cones/cone.h>
#include <vericone/cones/pair.h>
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/bands.h>
#include <vericone/guidance/barrier.h>
#include <vericone/guidance/navigator.h>
#include <vericone/testing/random_bodies.h>
#include <vericone_c.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <thread>

#include "c_bodies.h"

extern "C" {
std::size_t sizes_in_c(std::size_t* list);
std::size_t counted(void);
}

namespace vericone::c_test {
namespace {

using c_test::expect_same;  // beside those below

constexpr int kVelocities = 2;

void expect_same_certificate(const Pair& cpp, const vericone_pair* c, const Vector3d& v, const Vector3d& u) {
  const Certificate expected = cpp.certificate(v, u, {0, 2});
  const std::string& told = expected.text.empty() ? expected.reason : expected.text;
  const auto ask = [&](char* text, std::size_t capacity) {
    return vericone_pair_certificate(c, v.data(), u.data(), 0, 2, text, capacity);
  };
  EXPECT_EQ(ask(nullptr, 0), std::int64_t(expected.text.size()));
  std::string text(told.size() + 10, 'x');
  EXPECT_EQ(ask(text.data(), told.size() + 1), std::int64_t(expected.text.size()));
  EXPECT_EQ(std::string(text.c_str()), told);
  EXPECT_EQ(text.substr(told.size() + 1), "xxxxxxxxx");
  ask(text.data(), 6);
  EXPECT_EQ(std::string(text.c_str()), told.substr(0, 5));
}

void expect_same_answers(RandomBodies& random, const Pair& cpp, const vericone_pair* c) {
  EXPECT_EQ(vericone_pair_exact(c), cpp.guarantee().exact);
  const auto relation = cpp.relation();
  EXPECT_EQ(vericone_pair_relation(c), relation ? int(*relation) : int(VERICONE_RELATION_UNKNOWN));
  std::vector<double> all;
  for (int i = 0; i < kVelocities; ++i) {
    const Vector3d v = random.in_box(1) + (i % 2) * (cpp.obstacle().middle() - cpp.agent().middle()),
                   u = random.in_box(0.1);
    all.insert(all.end(), v.begin(), v.end());
    EXPECT_EQ(vericone_pair_verdict(c, v.data(), u.data()), int(cpp.verdict(v, u)));
    const auto rung = cpp.rung(v, u);
    EXPECT_EQ(vericone_pair_rung(c, v.data(), u.data()), rung ? int(*rung) : int(VERICONE_CERTIFIED));
    for (const Horizon& horizon : {Horizon{0, 0.5}, Horizon{0, 2}, Horizon{1, 3}, Horizon{}})
      EXPECT_EQ(vericone_pair_verdict_within(c, v.data(), u.data(), horizon.from, horizon.until),
                int(cpp.verdict(v, u, horizon)));
    if (i == 0) expect_same_certificate(cpp, c, v, u);
    const auto contact = cpp.contact(v, u);
    vericone_contact touched{};
    ASSERT_EQ(vericone_pair_contact(c, v.data(), u.data(), &touched), contact.has_value());
    if (contact) {
      expect_same(contact->earliest, touched.earliest);
      expect_same(contact->latest, touched.latest);
      if (!std::isnan(contact->time)) expect_same(contact->time, touched.time);
      expect_same(contact->point, touched.point);
      expect_same(contact->normal, touched.normal);
    }
    const Miss miss = cpp.miss(v, u);
    vericone_miss missed{};
    ASSERT_EQ(vericone_pair_miss(c, v.data(), u.data(), &missed), VERICONE_OK);
    expect_same(miss.least, missed.least);
    expect_same(miss.most, missed.most);
    expect_same(miss.time, missed.time);
    expect_same(miss.normal, missed.normal);
    const guidance::Barrier expected = guidance::barrier(cpp, v, u, 2);
    vericone_barrier barrier{};
    ASSERT_EQ(vericone_pair_barrier(c, v.data(), u.data(), 2, &barrier), VERICONE_OK);
    expect_same(expected.h, barrier.h);
    expect_same(expected.least, barrier.least);
    expect_same(expected.by_position, barrier.by_position);
    expect_same(expected.by_velocity, barrier.by_velocity);
    expect_same(expected.by_rotation, barrier.by_rotation);
    expect_same(expected.time, barrier.time);
  }
  std::uint8_t verdicts[kVelocities];
  const Vector3d still = Vector3d::Zero();
  int colliding = 0;
  for (int i = 0; i < kVelocities; ++i)
    colliding += may_collide(cpp.verdict(Vector3d(&all[3 * std::size_t(i)]), still));
  EXPECT_EQ(vericone_pair_verdicts(c, all.data(), kVelocities, still.data(), verdicts), colliding);
  for (int i = 0; i < kVelocities; ++i)
    EXPECT_EQ(verdicts[i], int(cpp.verdict(Vector3d(&all[3 * std::size_t(i)]), still)));
  const Vector3d across(0.1, 1, 0.3);
  const auto sector = cpp.sector(across);
  vericone_sector found{};
  ASSERT_EQ(vericone_pair_sector(c, across.data(), &found), sector.has_value());
  if (!sector) return;
  expect_same(sector->left.angle, found.left);
  expect_same(sector->right.angle, found.right);
  expect_same(sector->left.error, found.left_error);
  expect_same(sector->line_of_sight, found.line_of_sight);
}

TEST(CInterface, AnswersAreThoseOfPairsOfAllKinds) {
  RandomBodies random(3701);
  SCOPED_TRACE(random.trace());
  for (const auto first : kKinds)
    for (const auto second : kKinds) {
      const Both a = first(random), b = second(random);
      ASSERT_TRUE(a.c && b.c) << vericone_error();
      EXPECT_EQ(vericone_body_kind(a.c.get()), int(a.cpp.kind()));
      const Pose here{random.in_box(1), random.rotation()},
          there{Vector3d(6, 1, 0) + random.in_box(2), random.rotation()};
      const Rows turn = here.rotation, turn_there = there.rotation;
      const PairHandle c(vericone_pair_new(a.c.get(), here.position.data(), turn.data(), b.c.get(),
                                           there.position.data(), turn_there.data(), 0));
      ASSERT_TRUE(c) << vericone_error();
      expect_same_answers(random, Pair(Placed(a.cpp, here), Placed(b.cpp, there)), c.get());
    }
}

TEST(CInterface, BodiesSayWhatTheyAre) {
  RandomBodies random(3702);
  for (const auto kind : kKinds) {
    const Both body = kind(random);
    Vector3d low, high, center;
    Rows shape;
    ASSERT_EQ(vericone_body_bounds(body.c.get(), low.data(), high.data()), VERICONE_OK);
    EXPECT_EQ(low, body.cpp.bounds().low);
    EXPECT_EQ(high, body.cpp.bounds().high);
    const Vector3d n = random.direction();
    EXPECT_EQ(vericone_body_support(body.c.get(), n.data()), body.cpp.support(n));
    ASSERT_EQ(vericone_body_containing_ellipsoid(body.c.get(), center.data(), shape.data()), VERICONE_OK);
    EXPECT_EQ(center, body.cpp.containing_ellipsoid().center());
    EXPECT_EQ(Matrix3d(shape), body.cpp.containing_ellipsoid().shape());
  }
}

TEST(CInterface, ConesAreThoseOfPairs) {
  RandomBodies random(3703);
  const Both a = ellipsoid(random), b = hull(random);
  const Vector3d here = Vector3d::Zero(), there(5, 0.5, 0);
  const PairHandle pair(
      vericone_pair_new(a.c.get(), here.data(), nullptr, b.c.get(), there.data(), nullptr, 0));
  const ConeHandle c(vericone_cone_new(pair.get(), 0.001, 0, 1));
  ASSERT_TRUE(c) << vericone_error();
  const Cone cpp = Pair(Placed(a.cpp), Placed(b.cpp, {there})).cone({.tolerance = 0.001});
  double least = 0, most = 0;
  ASSERT_EQ(vericone_cone_solid_angle(c.get(), &least, &most), VERICONE_OK);
  EXPECT_EQ(least, cpp.solid_angle.lo());
  EXPECT_EQ(most, cpp.solid_angle.hi());
  for (int i = 0; i < 200; ++i) {
    const Vector3d w = Vector3d(3, 0, 0) + random.in_box(2);
    EXPECT_EQ(vericone_cone_contains(c.get(), w.data()), int(cpp.contains(w)));
  }
  ASSERT_EQ(vericone_cone_loops(c.get(), 1), std::int64_t(cpp.outer.size()));
  const std::size_t size = cpp.outer[0].size();
  std::vector<double> directions(3 * size);
  EXPECT_EQ(vericone_cone_loop(c.get(), 1, 0, directions.data(), size), std::int64_t(size));
  EXPECT_EQ(directions, flat(cpp.outer[0]));
  EXPECT_EQ(vericone_cone_loop(c.get(), 1, 0, nullptr, 0), std::int64_t(size));
  EXPECT_EQ(vericone_cone_loop(c.get(), 1, 9, nullptr, 0), VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("index: got 9, must be below the number of loops"));
  EXPECT_EQ(vericone_cone_loops(c.get(), 2), VERICONE_BAD_INPUT);
}

/// Bodies about the origin with velocities, in both worlds.
struct Encounters {
  std::vector<Both> bodies;
  std::vector<vericone_moving> c;
  std::vector<guidance::Intruder> cpp;

  void add(Both body, const Vector3d& at, const Vector3d& velocity) {
    vericone_moving moving{};
    moving.body = body.c.get();
    std::copy_n(at.data(), 3, moving.position);
    std::copy_n(velocity.data(), 3, moving.velocity);
    c.push_back(moving);
    cpp.push_back({Placed(body.cpp, {at}), velocity});
    bodies.push_back(std::move(body));
  }
};

void expect_same(const std::vector<guidance::Range>& expected, const vericone_range* found,
                 std::size_t count) {
  ASSERT_EQ(count, expected.size());
  for (std::size_t i = 0; i < count; ++i) {
    expect_same(expected[i].from, found[i].from);
    expect_same(expected[i].to, found[i].to);
  }
}

TEST(CInterface, BandsAndSafeVelocitiesAreThoseOfTheLibrary) {
  RandomBodies random(3705);
  for (int i = 0; i < 20; ++i) {
    Encounters own, all;
    own.add(ellipsoid(random), random.in_box(1), Vector3d(2, 0, 0) + random.in_box(1));
    for (const auto kind : {ellipsoid, hull, boxes})
      all.add(kind(random), Vector3d(9, 0, 0) + random.in_box(4), random.in_box(1));
    vericone_band_options options{};
    ASSERT_EQ(vericone_band_defaults(&options), VERICONE_OK);
    guidance::BandOptions cpp;
    cpp.horizon.until = options.until = 20;
    cpp.margin = options.margin = i % 2 ? 0.1 : 0;
    options.last = i % 4 == 0;
    cpp.last = options.last != 0;
    cpp.altitude = {-3, 3};
    options.altitude[0] = -3;
    options.altitude[1] = 3;
    const guidance::Bands expected = guidance::bands(own.cpp[0].body, own.cpp[0].velocity, all.cpp, cpp);
    vericone_range free[4][32], conflict[32];
    vericone_band heading{free[0], 32, conflict, 32, 0, 0, 0}, speed{free[1], 32, nullptr, 0, 0, 0, 0},
        climb{free[2], 32, nullptr, 0, 0, 0, 0}, altitude{free[3], 32, nullptr, 0, 0, 0, 0};
    vericone_course course{};
    ASSERT_EQ(vericone_bands(own.c.data(), all.c.data(), all.c.size(), &options, &heading, &speed, &climb,
                             &altitude, &course),
              int(expected.time_to_violation.has_value()))
        << vericone_error();
    expect_same(expected.heading.free, free[0], heading.free_count);
    expect_same(expected.heading.conflict, conflict, heading.conflict_count);
    expect_same(expected.speed.free, free[1], speed.free_count);
    EXPECT_EQ(speed.conflict_count, expected.speed.conflict.size());
    expect_same(expected.climb.free, free[2], climb.free_count);
    expect_same(expected.altitude.free, free[3], altitude.free_count);
    if (options.last) {
      expect_same(expected.heading.last, heading.last);
    }
    expect_same(expected.time_to_violation.value_or(std::numeric_limits<double>::infinity()),
                course.time_to_violation);
    EXPECT_EQ(std::isnan(course.recovery_time), !expected.recovery.has_value());

    vericone_avoid_options limits{};
    ASSERT_EQ(vericone_avoid_defaults(&limits), VERICONE_OK);
    guidance::AvoidOptions same;
    EXPECT_EQ(limits.gap, same.gap);
    EXPECT_EQ(limits.most, same.most);
    EXPECT_EQ(limits.climb[0], same.climb.from);
    EXPECT_EQ(limits.speed[1], same.speed.to);
    same.until = limits.until = 20;
    same.speed.to = limits.speed[1] = 5;
    const guidance::Avoidance nearest =
        guidance::avoid(own.cpp[0].body, own.cpp[0].velocity, own.cpp[0].velocity, all.cpp, same);
    vericone_avoidance found{};
    ASSERT_EQ(vericone_avoid(own.c.data(), own.c[0].velocity, all.c.data(), all.c.size(), &limits, &found),
              int(nearest.status))
        << vericone_error();
    expect_same(nearest.velocity, found.velocity);
    expect_same(nearest.distance, found.distance);
    expect_same(nearest.lower, found.lower);
    expect_same(nearest.safe_until, found.safe_until);
    expect_same(nearest.latest, found.latest);
    EXPECT_EQ(found.first, nearest.first ? std::int64_t(nearest.first->obstacle) : -1);
  }
}

TEST(CInterface, BandsAndSafeVelocitiesRefuseWhatIsNone) {
  RandomBodies random(3706);
  Encounters all;
  all.add(ellipsoid(random), {0, 0, 0}, {1, 0, 0});
  all.add(ellipsoid(random), {9, 0, 0}, {0, 0, 0});
  vericone_band_options options{};
  vericone_avoid_options limits{};
  vericone_band_defaults(&options);
  vericone_avoid_defaults(&limits);
  const auto bands = [&] {
    return vericone_bands(all.c.data(), all.c.data() + 1, 1, &options, nullptr, nullptr, nullptr, nullptr,
                          nullptr);
  };
  EXPECT_EQ(bands(), 1);  // they meet
  options.margin = -1;
  EXPECT_EQ(bands(), VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("margin: got -1, must be"));
  options.margin = 0;
  all.c[1].omega[2] = 1;
  EXPECT_EQ(bands(), VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("others[0].omega[2]: got 1, must be 0"));
  all.c[1].omega[2] = 0;
  all.c[1].body = nullptr;
  EXPECT_EQ(bands(), VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("others[0].body: got NULL"));
  EXPECT_EQ(vericone_avoid(all.c.data(), nullptr, nullptr, 0, &limits, nullptr), VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("wanted: got NULL"));
  EXPECT_EQ(vericone_avoid(all.c.data(), all.c[0].velocity, nullptr, 0, nullptr, nullptr),
            VERICONE_BAD_INPUT);
  EXPECT_EQ(vericone_avoid(all.c.data(), all.c[0].velocity, nullptr, 0, &limits, nullptr), VERICONE_FREE);
  vericone_band none{nullptr, 1, nullptr, 0, 0, 0, 0};
  EXPECT_EQ(vericone_bands(all.c.data(), nullptr, 0, &options, &none, nullptr, nullptr, nullptr, nullptr),
            VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("free: got NULL"));
}

guidance::BodyState state(const vericone::Body& body, const vericone_moving& moving) {
  guidance::BodyState state;
  state.position = Vector3d(moving.position);
  state.shape = Placed(body, {state.position, Matrix3d(Rows(moving.rotation))});
  state.velocity = Vector3d(moving.velocity);
  return state;
}

TEST(CInterface, ANavigatorsStepsAreThoseOfTheLibraryAndAllocateNothing) {
  RandomBodies random(3704);
  std::vector<Both> bodies;
  std::vector<vericone_moving> others;
  for (const auto kind : {ellipsoid, hull, cloud, boxes}) {
    bodies.push_back(kind(random));
    vericone_moving moving{};
    moving.body = bodies.back().c.get();
    const Vector3d at(8 + 4.0 * double(others.size()), random.uniform(-1, 1), random.uniform(-1, 1));
    std::copy_n(at.data(), 3, moving.position);
    const Rows turn = random.rotation();
    std::copy_n(turn.data(), 9, moving.rotation);
    moving.velocity[1] = 0.1;
    others.push_back(moving);
  }
  const Both own = ellipsoid(random);
  vericone_moving agent{};
  agent.body = own.c.get();
  agent.rotation[0] = agent.rotation[4] = agent.rotation[8] = 1;
  agent.velocity[0] = 5;
  guidance::NavigatorOptions options;
  options.required = 0.2;
  options.most = 6;
  guidance::Navigator cpp(options);
  const NavigatorHandle c(vericone_navigator_new(0.2, 6, 0));
  const double goal[3] = {40, 0, 0}, step = 0.02;
  std::size_t flown = 0, after = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<guidance::BodyState> list;
    for (std::size_t k = 0; k < others.size(); ++k) list.push_back(state(bodies[k].cpp, others[k]));
    const auto expected =
        cpp.step(state(own.cpp, agent), list, guidance::Destination{Vector3d(goal), 6}, i * step, step);
    vericone_command command{};
#ifdef COUNTED
    const std::size_t before = counted();
#endif
    ASSERT_EQ(vericone_navigator_step(c.get(), &agent, others.data(), others.size(), goal, 6, i * step, step,
                                      &command),
              int(expected.status))
        << vericone_error();
#ifdef COUNTED
    if (i >= 100) after += counted() - before;  // it has searched by then
#endif
    expect_same(expected.acceleration, command.acceleration);
    expect_same(expected.least, command.least);
    EXPECT_EQ(command.nearest, std::int64_t(expected.nearest));
    for (int k = 0; k < 3; ++k) {
      agent.position[k] += step * (agent.velocity[k] + 0.5 * step * command.acceleration[k]);
      agent.velocity[k] += step * command.acceleration[k];
    }
    for (vericone_moving& other : others) other.position[1] += step * other.velocity[1];
    flown += command.status == VERICONE_AVOIDING;
  }
  EXPECT_GT(flown, 0u);
  EXPECT_EQ(after, 0u);
}

TEST(CInterface, VerdictsAllocateNothing) {
#ifndef COUNTED
  GTEST_SKIP() << "a sanitizer has a malloc of its own";
#else
  RandomBodies random(3705);
  for (const auto second : kKinds) {
    const Both a = ellipsoid(random), b = second(random);
    const Vector3d here = Vector3d::Zero(), there(5, 0.5, 0), v(1, 0.1, 0);
    const PairHandle pair(
        vericone_pair_new(a.c.get(), here.data(), nullptr, b.c.get(), there.data(), nullptr, 0));
    vericone_pair_verdict(pair.get(), v.data(), here.data());
    const std::size_t before = counted();
    for (int i = 0; i < 50; ++i) {
      const Vector3d w = v + 0.01 * random.direction();
      ASSERT_GE(vericone_pair_verdict(pair.get(), w.data(), here.data()), 0);
    }
    EXPECT_EQ(counted() - before, 0u) << vericone_body_kind(b.c.get());
  }
#endif
}

TEST(CInterface, BadInputIsALineAndANumber) {
  const double zero[3] = {0, 0, 0}, axes[3] = {1, -2, 1}, nan[3] = {1, std::nan(""), 0}, ones[3] = {1, 1, 1};
  EXPECT_EQ(vericone_body_ellipsoid(zero, axes, nullptr), nullptr);
  EXPECT_STREQ(vericone_error(), "semi_axes[1]: got -2, must be a positive finite number (metres)");
  EXPECT_EQ(vericone_body_ellipsoid(nullptr, ones, nullptr), nullptr);
  EXPECT_STREQ(vericone_error(), "center: got NULL, must be given");
  const std::uint32_t corner[3] = {0, 1, 7};
  EXPECT_EQ(vericone_body_mesh(ones, 1, corner, 1), nullptr);
  EXPECT_THAT(vericone_error(), StartsWith("triangles[0][1]: got 1"));
  EXPECT_EQ(vericone_body_hull(nullptr, 0), nullptr);
  EXPECT_EQ(vericone_body_hull(nullptr, 3), nullptr);
  EXPECT_EQ(vericone_body_union(nullptr, 0), nullptr);
  const vericone_hyperboloid far{{3, 0.5, 0.5}, {}, 2};
  EXPECT_EQ(vericone_body_combined(zero, ones, nullptr, &far, 1), nullptr);
  EXPECT_THAT(vericone_error(), StartsWith("hyperboloids[0]"));

  const BodyHandle ball(vericone_body_ellipsoid(zero, ones, nullptr)), point(vericone_body_hull(zero, 1));
  const vericone_body* mixed[] = {ball.get(), point.get()};
  EXPECT_EQ(vericone_body_union(mixed, 2), nullptr);
  EXPECT_THAT(vericone_error(), StartsWith("bodies[1]: got hull, must be of the kind of those before it"));
  const double there[3] = {5, 0, 0}, askew[9] = {1, 0, 0, 0, 2, 0, 0, 0, 1};
  EXPECT_EQ(vericone_pair_new(ball.get(), zero, nullptr, ball.get(), there, askew, 0), nullptr);
  EXPECT_THAT(vericone_error(), HasSubstr("pose"));
  EXPECT_EQ(vericone_pair_new(ball.get(), zero, nullptr, nullptr, there, nullptr, 0), nullptr);
  EXPECT_STREQ(vericone_error(), "obstacle: got NULL, must be given");

  const PairHandle pair(vericone_pair_new(ball.get(), zero, nullptr, ball.get(), there, nullptr, 0));
  EXPECT_EQ(vericone_pair_verdict(pair.get(), nan, zero), VERICONE_BAD_INPUT);
  EXPECT_THAT(vericone_error(), StartsWith("agent_velocity[1]: got nan"));
  EXPECT_EQ(vericone_pair_verdict(nullptr, zero, zero), VERICONE_BAD_INPUT);
  EXPECT_EQ(vericone_pair_verdict_within(pair.get(), zero, zero, 2, 1), VERICONE_BAD_INPUT);
  EXPECT_NE(std::string(vericone_error()).find("horizon"), std::string::npos);
  char text[8] = "";
  EXPECT_EQ(vericone_pair_certificate(pair.get(), nan, zero, 0, 1, text, 8), VERICONE_BAD_INPUT);
  EXPECT_EQ(vericone_pair_certificate(pair.get(), zero, zero, 2, 1, text, 8), VERICONE_BAD_INPUT);
  EXPECT_EQ(vericone_pair_certificate(pair.get(), zero, zero, 0, 1, nullptr, 8), VERICONE_BAD_INPUT);
  EXPECT_STREQ(vericone_error(), "text: got NULL, must be given");
  EXPECT_EQ(vericone_pair_verdicts(pair.get(), nan, 1, zero, nullptr), VERICONE_BAD_INPUT);
  EXPECT_EQ(vericone_pair_miss(pair.get(), zero, zero, nullptr), VERICONE_BAD_INPUT);
  vericone_barrier barrier{};
  EXPECT_EQ(vericone_pair_barrier(pair.get(), zero, zero, -1, &barrier), VERICONE_BAD_INPUT);
  EXPECT_STREQ(vericone_error(), "until: got -1, must be 0 or more (seconds)");
  EXPECT_EQ(vericone_pair_barrier(pair.get(), zero, zero, 1, nullptr), VERICONE_BAD_INPUT);
  EXPECT_TRUE(std::isnan(vericone_body_support(nullptr, zero)));
  EXPECT_EQ(vericone_cone_new(pair.get(), 2, 0, 1), nullptr);
  EXPECT_THAT(vericone_error(), StartsWith("tolerance: got 2"));
  EXPECT_EQ(vericone_navigator_new(-1, 1, 0), nullptr);
  EXPECT_THAT(vericone_error(), StartsWith("required: got -1"));
  const NavigatorHandle navigator(vericone_navigator_new(0.1, 1, 0));
  vericone_moving agent{};
  EXPECT_EQ(vericone_navigator_step(navigator.get(), &agent, nullptr, 0, nullptr, 0, 0, 0.1, nullptr),
            VERICONE_BAD_INPUT);
  EXPECT_STREQ(vericone_error(), "body: got NULL, must be given");
  // What was wrong leaves nothing behind.
  agent.body = ball.get();
  agent.velocity[0] = 1;
  EXPECT_EQ(vericone_navigator_step(navigator.get(), &agent, nullptr, 0, nullptr, 0, 0, 0.1, nullptr),
            VERICONE_STRAIGHT);
  vericone_body_free(nullptr);
  vericone_pair_free(nullptr);
  vericone_cone_free(nullptr);
  vericone_navigator_free(nullptr);
}

TEST(CInterface, ErrorsAreThoseOfTheirThread) {
  const double zero[3] = {0, 0, 0}, axes[3] = {1, -2, 1};
  EXPECT_EQ(vericone_body_ellipsoid(zero, axes, nullptr), nullptr);
  std::thread([] { EXPECT_STREQ(vericone_error(), ""); }).join();
  EXPECT_STRNE(vericone_error(), "");
}

TEST(CInterface, NumbersAndSizesAreThoseOfBothLanguages) {
  static_assert(VERICONE_OUT == int(Verdict::out) && VERICONE_ON == int(Verdict::on) &&
                VERICONE_IN == int(Verdict::in) && VERICONE_TOUCHING == int(Verdict::touching) &&
                VERICONE_OVERLAPPING == int(Verdict::overlapping) &&
                VERICONE_UNDECIDED == int(Verdict::undecided));
  static_assert(VERICONE_DISJOINT == int(Relation::disjoint) && VERICONE_TOUCHES == int(Relation::touching) &&
                VERICONE_OVERLAPS == int(Relation::overlapping));
  static_assert(VERICONE_ELLIPSOID == int(BodyKind::ellipsoid) &&
                VERICONE_COMBINED == int(BodyKind::combined) && VERICONE_HULL == int(BodyKind::hull) &&
                VERICONE_MESH == int(BodyKind::mesh) && VERICONE_CLOUD == int(BodyKind::cloud) &&
                VERICONE_BOXES == int(BodyKind::boxes) && VERICONE_PIECES == int(BodyKind::pieces));
  using guidance::NavigatorStatus;
  static_assert(VERICONE_STRAIGHT == int(NavigatorStatus::straight) &&
                VERICONE_HOMING == int(NavigatorStatus::homing) &&
                VERICONE_AVOIDING == int(NavigatorStatus::avoiding) &&
                VERICONE_TOO_NEAR == int(NavigatorStatus::too_near) &&
                VERICONE_CANNOT_AVOID == int(NavigatorStatus::cannot_avoid) &&
                VERICONE_NO_COURSE == int(NavigatorStatus::no_course));
  using guidance::AvoidStatus;
  static_assert(VERICONE_FREE == int(AvoidStatus::free) &&
                VERICONE_NOTHING_SAFE == int(AvoidStatus::nothing_safe) &&
                VERICONE_NOT_FOUND == int(AvoidStatus::not_found));
  std::size_t sizes[12];
  ASSERT_EQ(sizes_in_c(sizes), 12u);
  EXPECT_THAT(sizes, ::testing::ElementsAre(sizeof(vericone_hyperboloid), sizeof(vericone_contact),
                                            sizeof(vericone_miss), sizeof(vericone_barrier),
                                            sizeof(vericone_sector), sizeof(vericone_moving),
                                            sizeof(vericone_command), sizeof(vericone_band_options),
                                            sizeof(vericone_band), sizeof(vericone_course),
                                            sizeof(vericone_avoid_options), sizeof(vericone_avoidance)));
  EXPECT_EQ(vericone_sound_arithmetic(), VERICONE_OK);
}

}  // namespace
}  // namespace vericone::c_test
