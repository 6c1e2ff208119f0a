// SPDX-License-Identifier: BSD-3-Clause
//
// The laws of chapters 3 and 4 against what they promise, y_1' = K_1 (y_1d - y_1) and y_2' = -K_2 y_2: their
// commands are flown on Cartesian paths, y is computed from those alone. What the source prints wrongly is
// flown on the same states.
#include <gtest/gtest.h>
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/internal/guidance/pursuit/source_laws.h>

#include "guidance/law_promises.h"
#include "guidance/pursuit/printed_pursuit.h"
#include "support/allocations.h"

namespace vericone::guidance::pursuit_laws_test {
namespace {

using Eigen::Vector2d;
using testing::Errors, testing::Form, testing::Path, testing::Printed46, testing::RandomBodies,
    testing::kStates, testing::relative_error, testing::richardson_derivative;

double cross(const Vector2d& p, const Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); }

struct Chase {
  Path<2> a, b;
  double radius = 0.1;

  PlanarState state() const { return planar_state({a.p, a.v, b.p, b.v}); }
  double y1(double t) const {
    const Vector2d p = b.position(t) - a.position(t), v = b.velocity(t) - a.velocity(t);
    return std::pow(cross(p, v), 2) - radius * radius * v.squaredNorm();
  }
  double y2(double t) const { return (b.velocity(t) - a.velocity(t)).squaredNorm(); }
  void apply(double lateral, double longitudinal) {
    const Vector2d ahead = a.v.normalized();
    a.a = longitudinal * ahead + lateral * Vector2d(-ahead.y(), ahead.x());
  }
};

Chase random_chase(RandomBodies& random) {
  Chase c;
  const auto vector = [&](double least, double most) {
    return Vector2d(random.uniform(least, most) * random.direction_2d());
  };
  while (true) {
    c.radius = random.uniform(0.1, 5);
    c.a = {vector(0, 100), vector(5, 40), Vector2d::Zero()};
    c.b = {c.a.p + vector(10, 150), vector(0, 30), vector(0, 3)};
    const PlanarState s = c.state();
    const double v = std::hypot(s.v_r, s.v_theta);
    if (std::abs(s.v_r) > 0.02 * v && std::abs(s.v_theta) > 0.02 * v && v > 1) return c;
  }
}

/// (3.1)-(3.8).
TEST(RendezvousLaw, DoesWhatItPromises) {
  RandomBodies random(3081);
  SCOPED_TRACE(random.trace());
  Errors first, second, printed, by_matrix, gradient, printed_gradient, cone;
  for (std::size_t i = 0; i < kStates; ++i) {
    Chase c = random_chase(random);
    RendezvousGains gains;
    gains.radius = c.radius;
    gains.most = 1e12;
    gains.singular = 0;
    gains.cone = random.uniform(0.1, 2);
    gains.speed = random.uniform(0.05, 1);
    gains.closing = random.coin();
    const PlanarState s = c.state();
    const PursuitCommand command = rendezvous_law(s, c.b.a, gains);
    ASSERT_EQ(command.status, PursuitStatus::steering);
    c.apply(command.lateral, command.longitudinal);
    const double k1 = gains.closing && s.v_r > 0 ? -gains.cone : gains.cone;
    const auto y1 = [&](double t) { return c.y1(t); };
    const auto y2 = [&](double t) { return c.y2(t); };
    const double wanted = k1 * (gains.reference - c.y1(0));
    first.add(relative_error(richardson_derivative(y1, 0.05), wanted));
    second.add(relative_error(richardson_derivative(y2, 0.05), -gains.speed * c.y2(0)));
    EXPECT_NEAR(command.y1, c.y1(0), 1e-9 * std::abs(c.y1(0)) + 1e-9);

    // rendezvous_cone: any accelerations.
    const RendezvousRates f = rendezvous_cone(s, c.radius);
    const double lateral = random.uniform(-10, 10), longitudinal = random.uniform(-10, 10);
    Chase other = c;
    other.b.a.setZero();
    other.apply(lateral, longitudinal);
    const double sizes = std::abs(f.by_lateral1 * lateral) + std::abs(f.by_longitudinal1 * longitudinal);
    const double rate = richardson_derivative([&](double t) { return other.y1(t); }, 0.05);
    cone.add(std::abs(rate - f.by_lateral1 * lateral - f.by_longitudinal1 * longitudinal) / sizes);

    // (3.6), and (3.4) along the same motion.
    const double a_b = c.b.a.norm(), delta = std::atan2(c.b.a.y(), c.b.a.x());
    for (const Form form : {Form::corrected, Form::printed}) {
      const Vector2d a = testing::law_3_6(s, c.radius, k1, gains.speed, gains.reference, a_b, delta, form);
      Chase flown = c;
      flown.apply(a.x(), a.y());
      const double error =
          std::max(relative_error(richardson_derivative([&](double t) { return flown.y1(t); }, 0.05), wanted),
                   relative_error(richardson_derivative([&](double t) { return flown.y2(t); }, 0.05),
                                  -gains.speed * c.y2(0)));
      (form == Form::printed ? printed : by_matrix).add(error);
      const auto along = [&](double t) {
        const PlanarState later =
            planar_state({c.a.position(t), c.a.velocity(t), c.b.position(t), c.b.velocity(t)});
        return Eigen::Vector4d(later.r, later.theta, later.v_theta, later.v_r);
      };
      Eigen::Vector4d rates;
      for (int k = 0; k < 4; ++k)
        rates[k] = richardson_derivative([&](double t) { return along(t)[k]; }, 1e-3);
      const Vector2d by = testing::matrix_3_4(s.r, s.v_theta, s.v_r, c.radius, form) * rates;
      (form == Form::printed ? printed_gradient : gradient).add(relative_error(by.x(), wanted));
    }
  }
  std::printf(
      "(3.7), (3.8): y1' %.1e, y2' %.1e; (3.6) corrected %.1e, printed median %.1e; "
      "(3.4) corrected %.1e, printed median %.1e\n",
      first.worst(), second.worst(), by_matrix.worst(), printed.median(), gradient.worst(),
      printed_gradient.median());
  EXPECT_LT(first.worst(), 1e-6);
  EXPECT_LT(second.worst(), 1e-6);
  EXPECT_LT(cone.worst(), 1e-6);
  EXPECT_LT(by_matrix.worst(), 1e-6);
  EXPECT_LT(gradient.worst(), 1e-5);  // through differences of angles
  EXPECT_GT(printed.median(), 1e-2);
  EXPECT_GT(printed_gradient.median(), 1e-2);
}

/// The column of a_B before (3.1) has seven entries of eight: beta' is missing, and the last of them, V_B',
/// stands where beta' should.
TEST(RendezvousKinematics, TheColumnOfTheVehiclesAcceleration) {
  RandomBodies random(3001);
  SCOPED_TRACE(random.trace());
  Errors right, speed, printed;
  for (std::size_t i = 0; i < kStates; ++i) {
    Chase c = random_chase(random);
    if (c.b.v.norm() < 1 || c.b.a.norm() < 0.1) continue;
    const double beta = std::atan2(c.b.v.y(), c.b.v.x()), delta = std::atan2(c.b.a.y(), c.b.a.x());
    const double a_b = c.b.a.norm(), v_b = c.b.v.norm();
    const double turn =
        richardson_derivative([&](double t) { return testing::angle_between(c.b.v, c.b.velocity(t)); }, 1e-3);
    const double faster = richardson_derivative([&](double t) { return c.b.velocity(t).norm(); }, 1e-3);
    right.add(std::abs(turn - std::sin(delta - beta) / v_b * a_b) * v_b / a_b);
    speed.add(std::abs(faster - std::cos(delta - beta) * a_b) / a_b);
    printed.add(std::abs(turn - std::cos(delta - beta) * a_b) * v_b / a_b);
  }
  EXPECT_LT(right.worst(), 1e-6);
  EXPECT_LT(speed.worst(), 1e-6);
  EXPECT_GT(printed.median(), 1);
}

/// errata 4.3.
TEST(RendezvousLaw, KnownValuesOfTheLaneRun) {
  const Cartesian<2> start{{0, 0}, {31.31, 0}, {50, -30}, {22.22, 0}};
  const PlanarState s = planar_state(start);
  const PursuitCommand command = rendezvous_law(s, Vector2d::Zero(), {});
  EXPECT_NEAR(s.r, 58.309519, 1e-6);
  EXPECT_NEAR(s.theta * 180 / M_PI, -30.963757, 1e-6);
  EXPECT_NEAR(s.v_r, -7.794611, 1e-6);
  EXPECT_NEAR(s.v_theta, -4.676766, 1e-6);
  EXPECT_NEAR(command.y1, 74364.5, 0.05);
  EXPECT_NEAR(command.y2, 82.6281, 1e-4);
  EXPECT_NEAR(command.lateral, -0.818093, 1e-6);
  EXPECT_NEAR(command.longitudinal, -0.909000, 1e-6);
}

TEST(RendezvousLaw, CommandsNothingWhereItIsSingular) {
  // 3.4.2 starts with V_r = 0 (errata 4.3).
  const PlanarState s = planar_state({{0, 0}, {31.31, 0}, {0, -20}, {20, 0}});
  const PursuitCommand command = rendezvous_law(s, Vector2d(0, 1), {});
  EXPECT_EQ(command.status, PursuitStatus::singular);
  EXPECT_EQ(command.lateral, 0);
  EXPECT_EQ(command.longitudinal, 0);
  RendezvousGains small;
  small.most = 0.5;
  const PursuitCommand limited =
      rendezvous_law(planar_state({{0, 0}, {31.31, 0}, {50, -30}, {22.22, 0}}), Vector2d::Zero(), small);
  EXPECT_EQ(limited.status, PursuitStatus::saturated);
  EXPECT_EQ(limited.lateral, -0.5);
}

/// A and two foci on paths, the ellipse stretching.
struct FocalChase {
  Path<2> a, f[2];
  double semi = 0, stretch = 0;

  FocalState at(double t) const {
    FocalState s;
    s.position = a.position(t);
    s.velocity = a.velocity(t);
    for (std::size_t i = 0; i < 2; ++i) {
      s.foci[i] = f[i].position(t);
      s.velocities[i] = f[i].velocity(t);
      s.accelerations[i] = f[i].a;
    }
    s.a = semi + t * stretch;
    s.a_rate = stretch;
    return s;
  }
  double y2(double t) const { return (f[0].velocity(t) - a.velocity(t)).squaredNorm(); }
};

FocalChase random_focal_chase(RandomBodies& random, double deforming) {
  FocalChase c;
  const auto vector = [&](double least, double most) {
    return Vector2d(random.uniform(least, most) * random.direction_2d());
  };
  while (true) {
    const Vector2d centre = vector(20, 200), half = vector(1, 15), moving = vector(0, 25);
    c.a = {Vector2d::Zero(), vector(5, 35), Vector2d::Zero()};
    for (int i = 0; i < 2; ++i) {
      c.f[i] = {centre + (i ? half : Vector2d(-half)), moving + vector(0, deforming),
                vector(0, deforming > 0 ? 1 : 0)};
    }
    c.semi = half.norm() * random.uniform(1.05, 3);
    c.stretch = deforming > 0 ? random.uniform(-1, 1) : 0;
    const FocalState s = c.at(0);
    bool good = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector2d p = s.foci[i] - s.position, v = s.velocities[i] - s.velocity;
      good = good && v.norm() > 2 && std::abs(cross(p, v)) > 0.05 * p.norm() * v.norm();
    }
    if (good) return c;
  }
}

double y1_of(const FocalState& s, FocalForm form) {
  return form == FocalForm::source ? testing::equation_4_6(s, {false, false}) : testing::polynomial_y1(s);
}

/// (4.10), (4.11) with the term of a'.
TEST(FocalCone, RatesUnderAnyAccelerations) {
  RandomBodies random(4111);
  SCOPED_TRACE(random.trace());
  for (const FocalForm form : {FocalForm::source, FocalForm::polynomial}) {
    Errors first, second, without_stretch;
    for (std::size_t i = 0; i < kStates; ++i) {
      FocalChase c = random_focal_chase(random, 2);
      c.a.a = random.uniform(0, 10) * random.direction_2d();
      const FocalRates f = focal_cone(c.at(0), form);
      const double y = y1_of(c.at(0), form);
      ASSERT_NEAR(f.y1, y, 1e-9 * (std::abs(y) + 4 * c.semi * c.semi * std::pow(f.y2, 2)));
      const double rate = richardson_derivative([&](double t) { return y1_of(c.at(t), form); }, 4e-3);
      const double push = f.by_acceleration1.dot(c.a.a);
      const double size = std::abs(f.drift1) + f.by_acceleration1.norm() * c.a.a.norm();
      first.add(std::abs(f.drift1 + push - rate) / size);
      const double rate2 = richardson_derivative([&](double t) { return c.y2(t); }, 4e-3);
      second.add(std::abs(f.drift2 + f.by_acceleration2.dot(c.a.a) - rate2) / (std::abs(rate2) + f.y2));
      FocalState still = c.at(0);
      still.a_rate = 0;  // what (4.11) leaves out
      without_stretch.add(std::abs(focal_cone(still, form).drift1 + push - rate) / size);
    }
    std::printf("%s form: y1' %.1e, y2' %.1e; without a': median %.1e\n",
                form == FocalForm::source ? "source's" : "polynomial", first.worst(), second.worst(),
                without_stretch.median());
    EXPECT_LT(first.worst(), 1e-6);
    EXPECT_LT(second.worst(), 1e-6);
    EXPECT_GT(without_stretch.median(), 1e-3);
  }
}

/// Straight flight past a rigid ellipse changes y_1 by nothing: the first entry of M_1 in (4.11) is 0.
TEST(FocalCone, IsAConstantOfStraightMotion) {
  RandomBodies random(4112);
  SCOPED_TRACE(random.trace());
  for (const FocalForm form : {FocalForm::source, FocalForm::polynomial})
    for (int i = 0; i < 200; ++i) {
      const FocalRates f = focal_cone(random_focal_chase(random, 0).at(0), form);
      EXPECT_NEAR(f.drift1, 0, 1e-10 * f.by_acceleration1.norm());
    }
}

/// (4.12)-(4.14).
TEST(FocalLaw, DoesWhatItPromises) {
  RandomBodies random(4141);
  SCOPED_TRACE(random.trace());
  for (const FocalForm form : {FocalForm::source, FocalForm::polynomial}) {
    Errors first, second, at_rest;
    while (first.count() < kStates) {
      FocalChase c = random_focal_chase(random, 2);
      FocalGains gains;
      gains.most = 1e12;
      gains.singular = 0;
      gains.layer_when_receding = false;
      gains.cone = random.uniform(0.3, 2);
      gains.speed = random.uniform(0.05, 1);
      const FocalRates f = focal_cone(c.at(0), form);
      const Vector2d &g = f.by_acceleration1, &h = f.by_acceleration2;
      if (std::abs(cross(g, h)) < 0.05 * g.norm() * h.norm()) continue;
      FocalLaw law(gains, form);
      const PursuitCommand command = law.step(c.at(0), 0);
      ASSERT_FALSE(law.in_layer());
      const Vector2d ahead = c.a.v.normalized();
      c.a.a = command.longitudinal * ahead + command.lateral * Vector2d(-ahead.y(), ahead.x());
      const double rate = richardson_derivative([&](double t) { return y1_of(c.at(t), form); }, 2e-3);
      const double wanted = f.y1 >= 0 ? gains.cone * (gains.reference - f.y1) : 0;
      first.add(std::abs(rate - wanted) / (std::abs(wanted) + std::abs(f.drift1) + g.norm() * c.a.a.norm()));
      second.add(relative_error(richardson_derivative([&](double t) { return c.y2(t); }, 4e-3),
                                -gains.speed * f.y2));
    }
    std::printf("%s form: (4.14): y1' %.1e, y2' %.1e\n",
                form == FocalForm::source ? "source's" : "polynomial", first.worst(), second.worst());
    EXPECT_LT(first.worst(), 1e-6);
    EXPECT_LT(second.worst(), 1e-6);
  }
}

/// Between the foci of a rigid ellipse y_1 = -4 b^2 V^4 whatever the direction: det M_3 = 0, and the layer
/// takes over. The polynomial has a gradient there.
TEST(FocalLaw, BetweenTheFociTheSourceHasNoLaw) {
  FocalState s;
  s.velocity = {20, 0};
  s.foci = {Vector2d(100, -10), Vector2d(100, 14)};
  s.velocities = {Vector2d(5, 0), Vector2d(5, 0)};
  s.accelerations = {Vector2d::Zero(), Vector2d::Zero()};
  s.a = 20;
  const FocalRates source = focal_cone(s, FocalForm::source), ours = focal_cone(s, FocalForm::polynomial);
  const auto sine = [](const FocalRates& f) {
    return std::abs(cross(f.by_acceleration1.normalized(), f.by_acceleration2.normalized()));
  };
  EXPECT_LT(sine(source), 1e-9);
  EXPECT_GT(sine(ours), 0.1);
  EXPECT_NEAR(ours.y1 / source.y1, (140 + 400 - 144) / (400.0 - 144), 1e-9);  // d_1 d_2 = -140
  FocalLaw law({}, FocalForm::source);
  EXPECT_EQ(law.step(s, 0).status, PursuitStatus::singular);
  EXPECT_TRUE(law.in_layer());
  FocalState aside = s;  // not singular, but the layer stays for 2 s
  aside.position = {0, 60};
  law.step(aside, 1.9);
  EXPECT_TRUE(law.in_layer());
  law.step(aside, 2);
  EXPECT_FALSE(law.in_layer());
}

/// (4.15), (4.16).
TEST(FocalLaw, BoundaryLayer) {
  FocalGains gains;
  gains.sight = 0.3;
  gains.distance = 0.03;
  gains.singular = 1e300;
  FocalState s;
  s.velocity = {20, 0};
  s.foci = {Vector2d(30, 40), Vector2d(40, 40)};
  s.velocities = {Vector2d(18, 1), Vector2d(18, 1)};
  s.accelerations = {Vector2d::Zero(), Vector2d::Zero()};
  s.a = 10;
  const PursuitCommand front = FocalLaw(gains, FocalForm::source).step(s, 0);
  EXPECT_NEAR(front.lateral, 10 * std::atan2(1, 18) + 0.3 * std::atan2(40, 30), 1e-12);
  EXPECT_NEAR(front.longitudinal, 0.2 * (std::hypot(18, 1) - 20) + 0.03 * 45, 1e-12);
  s.foci[0] = {-30, 40};
  const PursuitCommand behind = FocalLaw(gains, FocalForm::source).step(s, 0);
  EXPECT_NEAR(behind.longitudinal, 0.2 * (std::hypot(18, 1) - 20) - 0.03 * 45, 1e-12);
  // The printed sign asks it to brake for a target in front, and to speed up for one behind.
  for (const auto& [difference, needed] : {std::pair(-0.2, 1.0), std::pair(3.0, -1.0)}) {
    EXPECT_EQ(testing::sign_4_16(difference, 0, Form::corrected), needed);
    EXPECT_EQ(testing::sign_4_16(difference, 0, Form::printed), -needed);
  }
}

TEST(VerticalLaw, SizeFollowsItsEquation) {
  // x_S = W phi / z along a path with the commanded acceleration: x_S'' = K_p e - K_d x_S'.
  RandomBodies random(4231);
  SCOPED_TRACE(random.trace());
  Errors exact, printed;
  for (std::size_t i = 0; i < kStates; ++i) {
    const double focal = focal_length(1000, random.uniform(0.5, 1.5)), world = random.uniform(20, 120);
    const double z = random.uniform(100, 500), climb = random.uniform(-10, 10);
    VerticalGains gains;
    const double size = world * focal / z, rate = -size * climb / z;
    for (const bool with_square : {true, false}) {
      gains.exact = with_square;
      const double a = size_acceleration(size, rate, z, gains);
      const auto size_rate = [&](double t) {
        const double later = z + climb * t + 0.5 * a * t * t;
        return -world * focal * (climb + a * t) / (later * later);
      };
      const double wanted = gains.size_p * (gains.size - size) - gains.size_d * rate;
      const double error = std::abs(richardson_derivative(size_rate, 0.02) - wanted) /
                           (std::abs(gains.size_p * (gains.size - size)) + std::abs(gains.size_d * rate));
      (with_square ? exact : printed).add(error);
    }
  }
  std::printf("(4.23): x_S'' %.1e, printed: median %.1e, worst %.1e\n", exact.worst(), printed.median(),
              printed.worst());
  EXPECT_LT(exact.worst(), 1e-6);
  EXPECT_GT(printed.worst(), 1e-2);
}

/// (4.17) and errata 4.3.
TEST(VerticalLaw, FocalLengthAndSizeOfTheLaneRun) {
  const double focal = focal_length(1000, 50 * M_PI / 180);
  EXPECT_NEAR(focal, 1072.2535, 1e-4);
  EXPECT_NEAR(focal * 2 * std::hypot(12.065517, 22.064630) / 425, 126.9, 0.05);
}

/// (4.24).
TEST(VerticalLaw, ThePrintedSignOfTheDampingRunsAway) {
  const auto after_a_minute = [](double d) {
    double z = 50, climb = 0;
    for (int i = 0; i < 6000; ++i) {
      climb += 0.01 * altitude_acceleration(0, z, climb, 0.84, d);
      z += 0.01 * climb;
    }
    return std::abs(z);
  };
  EXPECT_LT(after_a_minute(0.42), 0.01);
  EXPECT_GT(after_a_minute(-0.42), 1000);
}

/// Algorithm 2: altitude, then size, then the lock; and again when the size leaves its band.
TEST(VerticalLaw, DrivesLocksAndDrivesAgain) {
  VerticalLaw law({});
  const double focal = focal_length(1000, 50 * M_PI / 180);
  double world = 50, z = 425, climb = 0;
  std::vector<VerticalMode> modes;
  const auto fly = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(100 * seconds); ++i) {
      const double size = world * focal / z;
      const double a = law.step(size, -size * climb / z, z, climb);
      ASSERT_LE(std::abs(a), 10);
      if (modes.empty() || modes.back() != law.mode()) modes.push_back(law.mode());
      climb += 0.01 * a;
      z += 0.01 * climb;
    }
  };
  fly(400);
  EXPECT_EQ(modes, (std::vector{VerticalMode::altitude, VerticalMode::size, VerticalMode::lock}));
  EXPECT_LT(std::abs(world * focal / z - 240), 20);
  EXPECT_LT(std::abs(climb), 1e-3);
  modes.clear();
  world = 60;
  fly(400);
  EXPECT_EQ(modes, (std::vector{VerticalMode::size, VerticalMode::lock}));
  EXPECT_LT(std::abs(world * focal / z - 240), 20);
  // Not in the picture: the altitude is held.
  const double before = z;
  for (int i = 0; i < 100; ++i) z += 0.01 * (climb += 0.01 * law.step(0, 0, z, climb));
  EXPECT_EQ(law.mode(), VerticalMode::lock);
  EXPECT_NEAR(z, before, 0.01);
}

/// As printed: while the size is near the wanted one (it is not) drive it, then lock the altitude; within the
/// band drive. So a wrong size is never driven.
TEST(VerticalLaw, Algorithm2AsPrintedLocksTheWrongSize) {
  const VerticalGains gains;
  const double focal = focal_length(1000, 50 * M_PI / 180), world = 50;
  double z[] = {280, 280}, climb[] = {0, 0}, cruise = 0;
  bool locked = false;
  VerticalLaw law(gains);
  for (int i = 0; i < 40'000; ++i) {
    const auto size = [&](int k) { return world * focal / z[k]; };
    const auto rate = [&](int k) { return -size(k) * climb[k] / z[k]; };
    double a[] = {law.step(size(0), rate(0), z[0], climb[0]), 0};
    const double error = std::abs(size(1) - gains.size);
    if (!(error < gains.size_band) && !(error < gains.size_near)) {
      if (!locked) cruise = z[1];
      locked = true;
      a[1] = altitude_acceleration(cruise, z[1], climb[1], gains.lock_p, gains.lock_d);
    } else {
      locked = false;
      a[1] = size_acceleration(size(1), rate(1), z[1], gains);
    }
    for (int k = 0; k < 2; ++k) {
      climb[k] += 0.01 * a[k];
      z[k] += 0.01 * climb[k];
    }
  }
  EXPECT_LT(std::abs(world * focal / z[0] - gains.size), gains.size_band);
  EXPECT_GT(std::abs(world * focal / z[1] - gains.size), 2 * gains.size_band);
}

TEST(PursuitLaws, AllocateNothing) {
  RandomBodies random(3999);
  const FocalState focal = random_focal_chase(random, 2).at(0);
  const PlanarState chase = random_chase(random).state();
  FocalLaw law({}, FocalForm::source);
  VerticalLaw vertical({});
  const std::size_t before = testing::allocations();
  double sum = rendezvous_law(chase, Vector2d::Zero(), {}).lateral + rendezvous_cone(chase, 1).y1;
  for (const FocalForm form : {FocalForm::source, FocalForm::polynomial}) sum += focal_cone(focal, form).y1;
  sum += law.step(focal, 0).lateral + vertical.step(100, 1, 300, 0) + least_focal_sum(focal);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(PursuitNames, OfEveryStatus) {
  EXPECT_STREQ(to_string(PursuitStatus::steering), "steering");
  EXPECT_STREQ(to_string(PursuitStatus::saturated), "saturated");
  EXPECT_STREQ(to_string(PursuitStatus::singular), "singular");
  EXPECT_STREQ(to_string(VerticalMode::size), "size");
  EXPECT_STREQ(to_string(VerticalMode::lock), "lock");
  EXPECT_STREQ(to_string(VerticalMode::altitude), "altitude");
}

}  // namespace
}  // namespace vericone::guidance::pursuit_laws_test
