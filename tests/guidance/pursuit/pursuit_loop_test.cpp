// SPDX-License-Identifier: BSD-3-Clause
//
// The laws in closed loop with exact states: the source's runs 3.4.1, 3.4.2, 4.3.0.1 and 4.3.0.2, 40 starts
// within 1 mm.
#include <gtest/gtest.h>
#include <vericone/guidance/estimation/filters.h>
#include <vericone/guidance/pursuit/pursuit_law.h>
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace vericone::guidance::pursuit_loop_test {
namespace {

using Eigen::Vector2d;
using testing::RandomBodies;

struct Vehicle {
  Vector2d position, velocity, acceleration;
};
using Road = std::function<Vehicle(double)>;

struct Pulse {
  double at, seconds, acceleration;
};

/// Constant speed, and pulses across it. Pulses begin on steps of the loop.
Road lane(const Vector2d& start, const std::vector<Pulse>& pulses) {
  return [=](double t) {
    Vehicle v{start + Vector2d(22.22 * t, 0), Vector2d(22.22, 0), Vector2d::Zero()};
    for (const Pulse& p : pulses) {
      const double u = t - p.at + 1e-9, s = p.acceleration, half = p.seconds;
      if (u < 0) continue;
      if (u < half) {
        v.position.y() += s * u * u / 2;
        v.velocity.y() += s * u;
        v.acceleration.y() += s;
      } else if (u < 2 * half) {
        const double w = u - half;
        v.position.y() += s * (half * half / 2 + half * w - w * w / 2);
        v.velocity.y() += s * (half - w);
        v.acceleration.y() -= s;
      } else {
        v.position.y() += s * half * half;
      }
    }
    return v;
  };
}

Road lane_of_3_4_1() {
  return lane({50, -30},
              {{5, 2, -1}, {15, 2, 1}, {25, 2, -1}, {35, 2, -1}, {55, 2, 1}, {75, 2, -1}, {105, 2, 1}});
}

/// Fernandez-Guasti's squircle, derivatives by differences (errors of 1e-9).
Vector2d on_squircle(double t) {
  constexpr double s = 0.9, r = 1000, period = 360;
  const double p = 2 * M_PI * t / period - M_PI / 2, k = 2 * std::sqrt(2.0) * s, c = s * s * std::cos(2 * p);
  const auto one = [&](double f, double sign) {
    return r / (2 * s) * (std::sqrt(2 + k * f + sign * c) - std::sqrt(2 - k * f + sign * c));
  };
  return {one(std::cos(p), 1), one(std::sin(p), -1)};
}
Road squircle(const Vector2d& start) {
  return [=](double t) {
    constexpr double h = 0.02;
    const Vector2d z = on_squircle(t), m = on_squircle(t - h), q = on_squircle(t + h),
                   m2 = on_squircle(t - 2 * h), q2 = on_squircle(t + 2 * h);
    return Vehicle{start + z - on_squircle(0), (8 * (q - m) - (q2 - m2)) / (12 * h),
                   (q - 2 * z + m) / (h * h)};
  };
}

TEST(Roads, AsTheErrataHaveThem) {
  const Road road = squircle({0, -20});
  double slowest = HUGE_VAL, fastest = 0;
  for (double t = 0; t < 360; t += 0.1) {
    const double speed = road(t).velocity.norm();
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  EXPECT_NEAR(slowest, 14.7885, 1e-3);
  EXPECT_NEAR(fastest, 22.6266, 1e-3);
  EXPECT_NEAR(lane_of_3_4_1()(20).position.y(), -30, 1e-6);
}

/// motion: how a step goes from one command to the next.
enum class Motion { exact, source };

struct Flight {
  std::vector<Vector2d> path;
  double mean_r = 0;  // of the last two thirds
};

using Steer = std::function<Vector2d(const Vector2d&, const Vector2d&, const Vehicle&)>;

/// exact: constant accelerations over a step, the vehicle on its road. source: the new velocity moves both,
/// the vehicle adds up the velocities of its road.
Flight fly(const Road& road, double duration, const Vector2d& start, const Steer& steer, Motion motion) {
  constexpr double dt = 0.1;
  Vector2d p = start, v(31.31, 0), b = road(0).position;
  Flight flight;
  int counted = 0;
  for (int i = 0; i < std::lround(duration / dt); ++i) {
    Vehicle vehicle = road(i * dt);
    if (motion == Motion::source) vehicle.position = b;
    flight.path.push_back(p);
    if (i * dt >= duration / 3) {
      flight.mean_r += (vehicle.position - p).norm();
      ++counted;
    }
    const Vector2d a = steer(p, v, vehicle);
    if (motion == Motion::exact) p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
    if (motion == Motion::source) p += dt * v;
    b += dt * road((i + 1) * dt).velocity;
  }
  flight.mean_r /= counted;
  return flight;
}

Steer source_law(const RendezvousGains& gains) {
  return [=](const Vector2d& p, const Vector2d& v, const Vehicle& b) -> Vector2d {
    const PlanarState s = planar_state({p, v, b.position, b.velocity});
    const PursuitCommand c = rendezvous_law(s, b.acceleration, gains);
    const Vector2d ahead(std::cos(s.alpha), std::sin(s.alpha));
    return c.longitudinal * ahead + c.lateral * Vector2d(-ahead.y(), ahead.x());
  };
}

Steer our_law(double most) {
  return [=](const Vector2d& p, const Vector2d& v, const Vehicle& b) -> Vector2d {
    EnclosingEllipse disc;
    disc.centre = b.position;
    disc.centre_rate = b.velocity;
    disc.a = disc.b = 4;
    disc.circle = true;
    PursuitGains gains;
    gains.most = most;
    const Vector2d a = pursuit_law(p, v, disc, b.acceleration, gains).acceleration;
    EXPECT_LE(a.norm(), most * (1 + 1e-12));
    return a;
  };
}

struct Starts {
  double least, first, median, third, most, apart;
};

Starts forty_starts(const Road& road, double duration, const Steer& steer, Motion motion) {
  RandomBodies random(3401);
  std::vector<double> means;
  Starts s{};
  std::vector<Vector2d> first;
  for (int i = 0; i < 40; ++i) {
    const Vector2d start = (i ? random.uniform(0, 1e-3) : 0.0) * random.direction_2d();
    const Flight flight = fly(road, duration, start, steer, motion);
    means.push_back(flight.mean_r);
    if (i == 0) first = flight.path;
    for (std::size_t k = 0; k < first.size(); ++k)
      s.apart = std::max(s.apart, (flight.path[k] - first[k]).norm());
  }
  std::sort(means.begin(), means.end());
  s.least = means[0];
  s.first = means[10];
  s.median = 0.5 * (means[19] + means[20]);
  s.third = means[30];
  s.most = means[39];
  return s;
}

void print(const char* name, const Starts& s) {
  std::printf("%s: mean r %.4g / %.4g %.4g %.4g / %.4g m, paths apart by at most %.2g m\n", name, s.least,
              s.first, s.median, s.third, s.most, s.apart);
}

TEST(PursuitLoop, LaneChanges) {
  const Road road = lane_of_3_4_1();
  const Starts source = forty_starts(road, 149, source_law({}), Motion::source);
  const Starts exact = forty_starts(road, 149, source_law({}), Motion::exact);
  const Starts ours = forty_starts(road, 149, our_law(10), Motion::exact);
  const Starts gentle = forty_starts(road, 149, our_law(3), Motion::exact);
  print("3.4.1, source", source);
  print("3.4.1, source, exact motion", exact);
  print("3.4.1, ours", ours);
  print("3.4.1, ours, 3 m/s^2", gentle);
  EXPECT_GT(source.median, 1.5);
  EXPECT_LT(source.median, 3);
  EXPECT_GT(source.apart, 0.1);
  for (const Starts& s : {ours, gentle}) {
    EXPECT_LT(s.most, std::min(source.least, exact.least));
    EXPECT_LT(s.most - s.least, 0.01);
    EXPECT_LT(s.apart, 0.01);
  }
}

TEST(PursuitLoop, Squircle) {
  const Road road = squircle({0, -20});
  RendezvousGains gains;
  gains.cone = 1.4;
  gains.speed = 0.09;
  const Starts source = forty_starts(road, 671, source_law(gains), Motion::source);
  const Starts exact = forty_starts(road, 671, source_law(gains), Motion::exact);
  const Starts ours = forty_starts(road, 671, our_law(10), Motion::exact);
  const Starts gentle = forty_starts(road, 671, our_law(3), Motion::exact);
  print("3.4.2, source", source);
  print("3.4.2, source, exact motion", exact);
  print("3.4.2, ours", ours);
  print("3.4.2, ours, 3 m/s^2", gentle);
  EXPECT_GT(source.median, 4.5);
  EXPECT_LT(source.median, 7);
  for (const Starts& s : {ours, gentle}) {
    EXPECT_LT(s.most, std::min(source.least, exact.least));
    EXPECT_LT(s.most - s.least, 0.01);
    EXPECT_LT(s.apart, 0.01);
  }
}

/// What Singer's filter makes of positions with errors of 0.3 m, hidden for 1.5 s of every 10 s, and nothing
/// of the truth.
class Watched {
 public:
  Watched(Steer law, std::uint64_t seed) : law_(std::move(law)), random_(seed) {}
  Vector2d operator()(const Vector2d& p, const Vector2d& v, const Vehicle& truth) {
    const double time = 0.1 * step_++;
    const Vector2d error = 0.3 * std::sqrt(-2 * std::log(1 - random_.uniform())) * random_.direction_2d();
    std::optional<Vector2d> seen = truth.position + error;
    if (std::fmod(time, 10) > 8.5) seen.reset();
    filter_.step(seen, 0.09 * Eigen::Matrix2d::Identity(), time);
    return law_(p, v, {filter_.position(), filter_.velocity(), filter_.acceleration()});
  }

 private:
  Steer law_;
  RandomBodies random_;
  SingerFilter filter_;
  int step_ = 0;
};

TEST(PursuitLoop, WithTheFilterAndHiddenTargets) {
  const struct {
    const char* name;
    Road road;
    double duration;
    RendezvousGains gains;
  } runs[] = {{"3.4.1", lane_of_3_4_1(), 149, {}},
              {"3.4.2", squircle({0, -20}), 671, {.cone = 1.4, .speed = 0.09}}};
  for (const auto& run : runs) {
    const auto of = [&](const Steer& law) {
      std::pair<double, double> worst{0, 0};  // mean r; paths apart
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Flight one = fly(run.road, run.duration, Vector2d::Zero(), Watched(law, seed), Motion::exact);
        const Flight other =
            fly(run.road, run.duration, Vector2d(1e-3, 0), Watched(law, seed), Motion::exact);
        worst.first = std::max({worst.first, one.mean_r, other.mean_r});
        for (std::size_t k = 0; k < one.path.size(); ++k)
          worst.second = std::max(worst.second, (one.path[k] - other.path[k]).norm());
      }
      return worst;
    };
    const auto ours = of(our_law(10)), gentle = of(our_law(3)), source = of(source_law(run.gains));
    std::printf(
        "%s, watched: mean r and paths apart at most: ours %.2f m, %.1e m; 3 m/s^2 %.2f m, %.1e m; "
        "source %.1f m, %.0f m\n",
        run.name, ours.first, ours.second, gentle.first, gentle.second, source.first, source.second);
    for (const auto& [mean, apart] : {ours, gentle}) {
      EXPECT_LT(mean, 1);
      EXPECT_LT(mean, source.first);
      EXPECT_LT(apart, 0.01);
    }
  }
}

/// errata 3.3: without sign(-V_r) the UAS matches the velocity first and parks beside the vehicle.
TEST(PursuitLoop, WithoutTheSignItParks) {
  RendezvousGains gains;
  gains.closing = false;
  const Flight parked = fly(lane_of_3_4_1(), 149, Vector2d::Zero(), source_law(gains), Motion::source);
  std::printf("3.4.1 without the sign: mean r %.1f m\n", parked.mean_r);
  EXPECT_GT(parked.mean_r, 20);
}

struct GroupFlight {
  double layer = 0, mean = 0, last = 0;
};

GroupFlight follow_group(const std::vector<Road>& roads, double duration, const FocalGains& gains,
                         FocalForm form, bool ours) {
  constexpr double dt = 0.01;
  EllipseFollower follower(8);
  FocalLaw law(gains, form);
  Vector2d p(0, 0), v(31.31, 0);
  GroupFlight flight;
  const int steps = static_cast<int>(std::lround(duration / dt));
  int counted = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * dt;
    std::vector<Vector2d> centres, velocities;
    Vector2d acceleration = Vector2d::Zero();
    for (const Road& road : roads) {
      const Vehicle at = road(t);
      centres.push_back(at.position);
      velocities.push_back(at.velocity);
      acceleration += at.acceleration / double(roads.size());
    }
    const EnclosingEllipse& e = follower.step(centres, velocities);
    flight.last = (e.centre - p).norm();
    if (t >= duration / 3) {
      flight.mean += flight.last;
      ++counted;
    }
    Vector2d a;
    if (ours) {
      a = pursuit_law(p, v, e, acceleration, {}).acceleration;
    } else {
      FocalState s{p, v, e.foci, e.foci_rates, {Vector2d::Zero(), Vector2d::Zero()}, e.a, e.a_rate};
      const PursuitCommand c = law.step(s, t);
      const double alpha = std::atan2(v.y(), v.x());
      const Vector2d ahead(std::cos(alpha), std::sin(alpha));
      a = c.longitudinal * ahead + c.lateral * Vector2d(-ahead.y(), ahead.x());
      flight.layer += law.in_layer() ? 1.0 / steps : 0;
    }
    EXPECT_TRUE(a.allFinite());
    p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
  }
  flight.mean /= counted;
  return flight;
}

TEST(PursuitLoop, GroupsOfThree) {
  const auto pulses = [](double s) {
    return std::vector<Pulse>{{35, 5, -s}, {55, 5, -s}, {75, 5, s}, {105, 5, s}, {125, 5, -s}};
  };
  const std::vector<Road> lanes{lane({100, -150}, pulses(0.09)), lane({100, -120}, {}),
                                lane({90, -135}, pulses(-0.135))};
  const std::vector<Road> squircles{squircle({100, -160}), squircle({100, -130}), squircle({90, -145})};
  FocalGains second;
  second.cone = 1.4;
  second.speed = 0.1;
  second.singular = 1000;
  second.sight = 0.3;
  second.distance = 0.03;
  const auto report = [](const char* name, const GroupFlight& f) {
    std::printf("%s: layer %.0f %%, distance to the centre %.2f m at the end, %.2f m on average\n", name,
                100 * f.layer, f.last, f.mean);
  };
  const GroupFlight lane_source = follow_group(lanes, 150, {}, FocalForm::source, false);
  const GroupFlight lane_polynomial = follow_group(lanes, 150, {}, FocalForm::polynomial, false);
  const GroupFlight lane_ours = follow_group(lanes, 150, {}, FocalForm::source, true);
  const GroupFlight source = follow_group(squircles, 390, second, FocalForm::source, false);
  FocalGains narrow = second;
  narrow.singular = 10;
  const GroupFlight source_narrow = follow_group(squircles, 390, narrow, FocalForm::source, false);
  const GroupFlight polynomial = follow_group(squircles, 390, second, FocalForm::polynomial, false);
  const GroupFlight ours = follow_group(squircles, 390, second, FocalForm::source, true);
  report("4.3.0.1, source", lane_source);
  report("4.3.0.1, polynomial", lane_polynomial);
  report("4.3.0.1, ours", lane_ours);
  report("4.3.0.2, source", source);
  report("4.3.0.2, source, layer where |det| < 10", source_narrow);
  report("4.3.0.2, polynomial", polynomial);
  report("4.3.0.2, ours", ours);
  EXPECT_GT(lane_source.layer, 0.2);
  EXPECT_GT(source.layer, 0.2);
  EXPECT_LT(lane_ours.mean, 1);
  EXPECT_LT(ours.mean, 1);
}

/// Nowhere singular: at the centre, at the same velocity, on a circle, between the foci, from far away.
TEST(PursuitLaw, AlwaysHasACommand) {
  RandomBodies random(4301);
  SCOPED_TRACE(random.trace());
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    EnclosingEllipse e;
    e.centre = random.uniform(0, 100) * random.direction_2d();
    e.centre_rate = random.uniform(0, 25) * random.direction_2d();
    e.a = random.uniform(1, 30);
    e.b = random.coin() ? e.a : random.uniform(0.01, 1) * e.a;
    e.circle = e.a == e.b;
    e.angle = random.uniform(-3, 3);
    // Distances and speeds from nothing to much.
    const auto size = [&] { return random.integer(0, 3) ? random.log_uniform(1e-300, 1e4) : 0; };
    const Vector2d x = size() * random.direction_2d(), w = size() * random.direction_2d();
    const Vector2d t = random.uniform(0, 3) * random.direction_2d();
    const PursuitStep step = pursuit_law(e.centre + x, e.centre_rate + w, e, t, {});
    ASSERT_TRUE(step.acceleration.allFinite() && std::isfinite(step.demanded) && std::isfinite(step.m) &&
                std::isfinite(step.y1) && std::isfinite(step.y2));
    ASSERT_LE(step.acceleration.norm(), 10 * (1 + 1e-12));
    // A little aside, a little different: no jump.
    const Vector2d dx = 1e-7 * random.direction_2d(), dw = 1e-7 * random.direction_2d();
    const PursuitStep next = pursuit_law(e.centre + x + dx, e.centre_rate + w + dw, e, t, {});
    worst = std::max(worst, (next.acceleration - step.acceleration).norm());
  }
  std::printf("changes of 1e-7 m and m/s change the command by at most %.1e m/s^2\n", worst);
  EXPECT_LT(worst, 1e-6);
}

/// Once steady, the course meets the ellipse before A is in it: m < 0, and y_2 falls to nothing.
TEST(PursuitLaw, MeetsAndMatches) {
  RandomBodies random(4302);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    EnclosingEllipse e;
    e.a = 10;
    e.b = 4;
    e.centre_rate = random.uniform(0, 25) * random.direction_2d();
    Vector2d p = random.uniform(60, 300) * random.direction_2d(),
             v = random.uniform(0, 35) * random.direction_2d();
    bool aimed_outside = false;
    PursuitStep step;
    for (int k = 0; k < 12'000; ++k) {
      step = pursuit_law(p, v, e, Vector2d::Zero(), {});
      const Vector2d x = p - e.centre;
      if (step.m < 0 && miss_distance(x, Vector2d::Zero(), e) > 0) aimed_outside = true;
      p += 0.01 * v + 0.5e-4 * step.acceleration;
      v += 0.01 * step.acceleration;
      e.centre += 0.01 * e.centre_rate;
    }
    EXPECT_TRUE(aimed_outside) << i;
    EXPECT_LT(step.m, 0);
    EXPECT_LT(step.y2, 1e-6);
    EXPECT_LT((p - e.centre).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace vericone::guidance::pursuit_loop_test
