// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what answers under errors cost, as multiples of the exact verdict on the same
// engagement without errors: vericone_robust_ratios.
#include <benchmarks/items.h>
#include <benchmarks/pairs.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/probability.h>
#include <vericone/cones/uncertain/robust.h>
#include <vericone/guidance/laws.h>
#include <vericone/guidance/robust_law.h>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace vericone::benchmarks {
namespace {

using Eigen::Vector3d;
using namespace guidance;

struct Case {
  Ellipsoid a, b;
  Vector3d w;  // 10 m/s
  RelativeErrors balls, ellipsoids;
  BodyState state_a, state_b;
};

/// Half aimed at the graze (benchmarks/pairs.h); errors from a hundredth of the bodies and of w to a third.
std::vector<Case> cases(int count) {
  std::vector<Case> all;
  Dice dice(5);
  for (const Engagement& e : engagements(count)) {
    Case c{e.a, e.b, 10 * e.w, {}, {}, {}, {}};
    const double size = e.placed_a.semi_axes.mean() * std::pow(10, dice.uniform(-2, -0.5));
    const double fast = 10 * std::pow(10, dice.uniform(-2, -0.5));
    const Vector3d shape(dice.uniform(0.1, 1), dice.uniform(0.1, 1), dice.uniform(0.1, 1));
    c.balls.position = ErrorSet::ball(size);
    c.balls.velocity = ErrorSet::ball(fast);
    c.ellipsoids.position = ErrorSet::ellipsoid(size * shape, dice.rotation());
    c.ellipsoids.velocity = ErrorSet::ellipsoid(fast * shape, dice.rotation());
    c.state_a.shape = CombinedEllipsoid(e.a);
    c.state_a.position = e.a.center();
    c.state_a.velocity = c.w;
    c.state_b.shape = CombinedEllipsoid(e.b);
    c.state_b.position = e.b.center();
    all.push_back(c);
  }
  return all;
}

int verdict_of(const Case& c, const RelativeErrors& errors) {
  return int(robust_verdict(c.a, c.b, c.w, Vector3d::Zero(), errors).verdict);
}

constexpr int kCases = 1000, kRounds = 21;

Probability of_balls(const Case& c) {
  const auto ball = [](const Ellipsoid& e) {
    return Ellipsoid::from_axes(e.center(), Vector3d::Constant(e.semi_axes()(0)));
  };
  return probability_of_passing_through(ball(c.a), ball(c.b), c.w, 0.1 * c.a.shape());
}

Probability of_ellipsoids(const Case& c) {
  return probability_of_passing_through(c.a, c.b, c.w, 0.1 * c.a.shape());
}

/// The first one is what all are compared with.
void print_calls(const std::vector<Case>& all) {
  std::vector<Case> of[4];
  for (const Case& c : all) of[verdict_of(c, c.balls)].push_back(c);
  std::vector<Item> items;
  const auto add = [&](const char* name, const std::vector<Case>& from, auto call) {
    items.push_back(item(name, from.size(), 4, [&from, call](std::size_t i) { return call(from[i]); }));
  };
  add("exact verdict without errors, pair prepared anew", all,
      [](const Case& c) { return int(ConeOracle(c.a, c.b).verdict(c.w, Vector3d::Zero())); });
  add("robust_verdict, balls", all, [](const Case& c) { return verdict_of(c, c.balls); });
  add("robust_verdict, ellipsoids", all, [](const Case& c) { return verdict_of(c, c.ellipsoids); });
  add("robust_verdict, balls, within 2 s", all, [](const Case& c) {
    RelativeErrors errors = c.balls;
    errors.horizon = 2;
    return verdict_of(c, errors);
  });
  add("robust_verdict, balls: all out", of[int(RobustVerdict::out)],
      [](const Case& c) { return verdict_of(c, c.balls); });
  add("robust_verdict, balls: depends", of[int(RobustVerdict::depends)],
      [](const Case& c) { return verdict_of(c, c.balls); });
  add("robust_verdict, balls: all in", of[int(RobustVerdict::in)],
      [](const Case& c) { return verdict_of(c, c.balls); });
  add("clearance", all, [](const Case& c) { return clearance(c.a, c.b, c.w).distance; });
  add("robust_clearance, balls", all, [](const Case& c) {
    return robust_clearance(c.a, c.b, c.w, c.balls.position, c.balls.velocity)->distance;
  });
  add("robust_clearance, ellipsoids", all, [](const Case& c) {
    return robust_clearance(c.a, c.b, c.w, c.ellipsoids.position, c.ellipsoids.velocity)->distance;
  });
  ClearanceOptions plain, balls;
  plain.hold = balls.hold = true;
  balls.position_error = ErrorSet::ball(0.5);
  balls.velocity_error = ErrorSet::ball(0.5);
  add("clearance_law", all,
      [&plain](const Case& c) { return clearance_law(c.state_a, c.state_b, plain).demanded; });
  add("clearance_law for all errors of two balls", all,
      [&balls](const Case& c) { return clearance_law(c.state_a, c.state_b, balls).demanded; });
  // The robust law of docs/explanation/robust-law.md, which a semidefinite solver takes milliseconds for.
  guidance::RobustModel model;
  model.gain = 2;
  model.a_low = 0.4;
  model.a_high = 1.6;
  model.b_low = 0.02;
  model.b_high = 0.05;
  guidance::RobustOptions two, eight;
  two.mu = eight.mu = 10;
  two.input_weight = eight.input_weight = 1e-4;
  two.polytope = guidance::Polytope::printed;
  const auto corrected = [&model](const Case& c, const guidance::RobustOptions& options) {
    return guidance::robust_correction(-0.01 * c.w.norm(), -10, 10, model, options).delta;
  };
  add("robust_correction, two corners", all, [&](const Case& c) { return corrected(c, two); });
  add("robust_correction, eight corners", all, [&](const Case& c) { return corrected(c, eight); });
  add("probability_of_passing_through, balls, to 1e-10", all,
      [](const Case& c) { return of_balls(c).estimate; });
  add("probability_of_passing_through, ellipsoids, to 1e-10", all,
      [](const Case& c) { return of_ellipsoids(c).estimate; });
  add("collision_probability_bound", all, [](const Case& c) {
    GaussianErrors errors;
    errors.position = 0.1 * c.a.shape();
    errors.velocity = 0.1 * Eigen::Matrix3d::Identity();
    return collision_probability_bound(c.a, c.b, c.w, errors).most;
  });
  measure(items, kRounds);
  std::printf(
      "%d pairs of ellipsoids (benchmarks/pairs.h): %zu out, %zu depend, %zu in, %zu undecided; %d "
      "rounds.\n\n",
      kCases, of[int(RobustVerdict::out)].size(), of[int(RobustVerdict::depends)].size(),
      of[int(RobustVerdict::in)].size(), of[int(RobustVerdict::undecided)].size(), kRounds);
  std::printf("| call | mean time | this / exact verdict |\n| --- | --- | --- |\n");
  const double unit = median(items.front().times);
  for (const Item& it : items)
    std::printf("| %s | %.2f us | %.3g |\n", it.name.c_str(), 1e-3 * median(it.times),
                median(it.times) / unit);
}

/// Each call alone: what a median over engagements is.
int print_requirements(const std::vector<Case>& all) {
  std::vector<double> verdicts, balls_alone, ellipsoids_alone;
  const auto alone = [](std::vector<double>& times, const auto& call) {
    double least = std::numeric_limits<double>::infinity();
    for (int r = 0; r < 5; ++r) {
      const double start = cpu_nanoseconds();
      for (int k = 0; k < 20; ++k) {
        const auto answer = call();
        asm volatile("" : : "r"(&answer) : "memory");
      }
      least = std::min(least, (cpu_nanoseconds() - start) / 20);
    }
    times.push_back(least);
  };
  int wide = 0;
  for (const Case& c : all) {
    for (const RelativeErrors* errors : {&c.balls, &c.ellipsoids})
      alone(verdicts, [&] { return verdict_of(c, *errors); });
    alone(balls_alone, [&] { return of_balls(c); });
    alone(ellipsoids_alone, [&] { return of_ellipsoids(c); });
    for (const Probability& p : {of_balls(c), of_ellipsoids(c)})
      wide += p.most > 1e-280 && p.most - p.least > 1e-10 * p.most;
  }
  const double middle = 1e-3 * median(verdicts), of_two_balls = 1e-3 * median(balls_alone),
               of_two_ellipsoids = 1e-3 * median(ellipsoids_alone);
  std::printf("\n%d of %d probabilities wider than 1e-10.\n", wide, 2 * kCases);
  std::printf("\n| requirement | measured | |\n| --- | --- | --- |\n");
  std::printf("| median of the robust verdict over engagements below 5 us | %.2f us | %s |\n", middle,
              middle < 5 ? "met" : "missed");
  std::printf("| median of the probability of two balls to 1e-10 below 50 us | %.2f us | %s |\n",
              of_two_balls, of_two_balls < 50 ? "met" : "missed");
  std::printf("| median of the probability of two ellipsoids to 1e-10 below 1000 us | %.2f us | %s |\n",
              of_two_ellipsoids, of_two_ellipsoids < 1000 ? "met" : "missed");
  return middle < 5 && of_two_balls < 50 && of_two_ellipsoids < 1000 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace vericone::benchmarks

int main() {
  const auto all = vericone::benchmarks::cases(vericone::benchmarks::kCases);
  vericone::benchmarks::print_calls(all);
  return vericone::benchmarks::print_requirements(all);
}
