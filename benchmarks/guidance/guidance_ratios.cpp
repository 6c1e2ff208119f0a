// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what a step of guidance costs, piece by piece, and how often each choice of the plane
// hides a collision; and what decisions of pilots cost. Times are medians over rounds, each item taken in
// turn in each round.
//
// Usage: vericone_guidance_ratios [decisions]
#include <benchmarks/combined_pairs.h>
#include <benchmarks/items.h>
#include <vericone/guidance/guide.h>
#include <vericone/guidance/navigator.h>
#include <vericone/internal/guidance/plane_view.h>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace vericone::benchmarks {
namespace {

using Eigen::Vector3d;
using namespace guidance;

void print(std::vector<Item>& items, int rounds) {
  measure(items, rounds);
  std::printf("| piece | median | least |\n| --- | --- | --- |\n");
  for (const Item& it : items)
    std::printf("| %s | %.2f us | %.2f us |\n", it.name.c_str(), 1e-3 * median(it.times),
                1e-3 * *std::min_element(it.times.begin(), it.times.end()));
}

struct Pair {
  BodyState a, b;
  Vector3d along;                 // axis of the plane of motion
  Vector3d widest, widest_slice;  // of the largest opening, 0.01 s before
};

/// Agent with the relative velocity of the engagement; it turns with its heading, the obstacle turns.
Pair pair_of(const Engagement& e, const CombinedEllipsoid& a, const CombinedEllipsoid& b) {
  Pair p;
  p.a.shape = a;
  p.b.shape = b;
  p.a.position = a.center();
  p.b.position = b.center();
  p.b.velocity = 5 * e.motion.v_b;
  p.a.velocity = p.b.velocity + 10 * e.w;
  p.a.turning = Turning::with_heading;
  p.b.omega = 0.1 * e.motion.omega_b;
  return p;
}

std::vector<Pair> ellipsoid_pairs(int count) {
  std::vector<Pair> all;
  PlaneOptions options;
  for (const Engagement& e : engagements(count)) {
    Pair p = pair_of(e, e.a, e.b);
    options.choice = PlaneChoice::of_motion;
    p.along = *choose_plane(p.a, p.b, SectorMethod::true_cone, options);
    options.choice = PlaneChoice::largest_opening;
    const BodyState a = advanced(p.a, -0.01), b = advanced(p.b, -0.01);
    p.widest = *choose_plane(a, b, SectorMethod::true_cone, options);
    p.widest_slice = *choose_plane(a, b, SectorMethod::slice, options);
    all.push_back(p);
  }
  return all;
}

void ellipsoid_table() {
  constexpr int kPairs = 500, kRounds = 21;
  const std::vector<Pair> pairs = ellipsoid_pairs(kPairs);
  std::vector<Item> items;
  const auto ellipsoid = [&](const BodyState& s) -> const Ellipsoid& {
    return s.shape.quadric()->ellipsoid();
  };
  items.push_back(item("true_sector", kPairs, 4, [&](std::size_t i) {
    return true_sector(ellipsoid(pairs[i].a), ellipsoid(pairs[i].b), pairs[i].along).psi();
  }));
  const auto add_view = [&](const char* name, SectorMethod method, RateMethod rates) {
    items.push_back(item(name, kPairs, 4, [&pairs, method, rates](std::size_t i) {
      return plane_view(pairs[i].a, pairs[i].b, pairs[i].along, method, rates)->cone.psi;
    }));
  };
  add_view("plane_view, true sector, no rates", SectorMethod::true_cone, RateMethod::none);
  add_view("plane_view, true sector, rates", SectorMethod::true_cone, RateMethod::analytic);
  add_view("plane_view, true sector, differenced", SectorMethod::true_cone, RateMethod::differenced);
  add_view("plane_view, slices, no rates", SectorMethod::slice, RateMethod::none);
  add_view("plane_view, slices, rates", SectorMethod::slice, RateMethod::analytic);
  items.push_back(item("plane_view, true sector, rates, and avoidance()", kPairs, 4, [&](std::size_t i) {
    const auto view =
        plane_view(pairs[i].a, pairs[i].b, pairs[i].along, SectorMethod::true_cone, RateMethod::analytic);
    return avoidance(view->state, view->cone, {}).a;
  }));
  for (const PlaneChoice choice :
       {PlaneChoice::of_motion, PlaneChoice::largest_opening, PlaneChoice::least_turn, PlaneChoice::least_y,
        PlaneChoice::wind_aware, PlaneChoice::steepest_clearance}) {
    PlaneOptions options;
    options.choice = choice;
    options.wind = Vector3d(3, 0, 0);
    items.push_back(
        item(std::string("choose_plane, ") + to_string(choice), kPairs, 1, [&pairs, options](std::size_t i) {
          return choose_plane(pairs[i].a, pairs[i].b, SectorMethod::true_cone, options)->x();
        }));
  }
  items.push_back(
      item("choose_plane, largest-opening, followed from 0.01 s before", kPairs, 4, [&](std::size_t i) {
        return choose_plane(pairs[i].a, pairs[i].b, SectorMethod::true_cone, {}, &pairs[i].widest)->x();
      }));
  std::vector<Pair> engaged;
  for (const Pair& p : ellipsoid_pairs(4 * kPairs))
    if (ConeOracle(ellipsoid(p.a), ellipsoid(p.b)).membership(p.a.velocity, p.b.velocity) == Membership::in)
      engaged.push_back(p);
  const auto add_step = [&](const std::string& name, PlaneChoice choice, SectorMethod method) {
    GuideOptions options;
    options.plane.choice = choice;
    options.sector = method;
    options.inversion.most = 15;
    items.push_back(item("guide(): " + name, engaged.size(), 4, [&engaged, options](std::size_t i) {
      const Pair& p = engaged[i];
      GuideMemory memory;
      memory.across = options.sector == SectorMethod::true_cone ? p.widest : p.widest_slice;
      const auto step = guide(p.a, p.b, options, memory, 0);
      return step ? step->a.x() : 0;
    }));
  };
  add_step("true sector, plane of motion", PlaneChoice::of_motion, SectorMethod::true_cone);
  add_step("true sector, largest opening followed", PlaneChoice::largest_opening, SectorMethod::true_cone);
  add_step("slices, largest opening followed", PlaneChoice::largest_opening, SectorMethod::slice);
  std::printf("guide() of the %zu colliding pairs of %d.\n", engaged.size(), 4 * kPairs);
  std::printf("%d pairs of ellipsoids (benchmarks/pairs.h), %d rounds.\n\n", kPairs, kRounds);
  print(items, kRounds);
}

void other_bodies_table() {
  constexpr int kPairs = 20;
  std::vector<Pair> dented, hulls;
  const auto plain = engagements(kPairs);
  const auto combined = combined_engagements(kPairs, Family::ellipsoid, Family::biconcave);
  for (int i = 0; i < kPairs; ++i) {
    dented.push_back(pair_of(plain[i], combined[i].a, combined[i].b));
    Pair p = pair_of(plain[i], plain[i].a, plain[i].b);
    std::vector<Vector3d> points;
    Dice dice(static_cast<std::uint64_t>(i) + 1);
    for (int k = 0; k < 12; ++k) points.push_back(plain[i].b.support_point(dice.direction()));
    p.b.shape = HullBody(points);
    hulls.push_back(p);
  }
  std::vector<Item> items;
  const auto add = [&](const char* name, const std::vector<Pair>& pairs, SectorMethod method,
                       RateMethod rates, int repeats) {
    items.push_back(item(name, kPairs, repeats, [&pairs, method, rates](std::size_t i) {
      const auto view =
          plane_view(pairs[i].a, pairs[i].b, pairs[i].a.velocity.unitOrthogonal(), method, rates);
      return view ? view->cone.psi : 0;
    }));
  };
  add("biconcave, slices, rates", dented, SectorMethod::slice, RateMethod::analytic, 100);
  add("biconcave, true sector", dented, SectorMethod::true_cone, RateMethod::none, 1);
  add("biconcave, true sector, rates", dented, SectorMethod::true_cone, RateMethod::analytic, 1);
  std::vector<EdgeMemory> memories(kPairs);
  items.push_back(
      item("biconcave, true sector, rates, followed from 0.01 s before", kPairs, 1, [&](std::size_t i) {
        const Pair& p = dented[i];
        const Vector3d across = p.a.velocity.unitOrthogonal();
        EdgeMemory memory = memories[i];
        const auto view =
            plane_view(p.a, p.b, across, SectorMethod::true_cone, RateMethod::analytic, 0, &memory);
        return view ? view->cone.psi : 0;
      }));
  for (int i = 0; i < kPairs; ++i)
    (void)plane_view(advanced(dented[i].a, -0.01), advanced(dented[i].b, -0.01),
                     dented[i].a.velocity.unitOrthogonal(), SectorMethod::true_cone, RateMethod::none, 0,
                     &memories[i]);
  add("hull of 12 points, slices, rates (differenced)", hulls, SectorMethod::slice, RateMethod::analytic, 20);
  add("hull of 12 points, true sector", hulls, SectorMethod::true_cone, RateMethod::none, 5);
  add("hull of 12 points, true sector, rates", hulls, SectorMethod::true_cone, RateMethod::analytic, 5);
  std::printf("\nOther obstacles, %d pairs, agent an ellipsoid, 5 rounds.\n\n", kPairs);
  print(items, 5);
}

/// Of colliding pairs: on how many the chosen plane says that nothing is to be done.
void hidden_collisions() {
  constexpr int kPairs = 20000;
  const auto all = engagements(kPairs, 0.2, 7);
  constexpr PlaneChoice kChoices[] = {
      PlaneChoice::largest_opening, PlaneChoice::least_turn,         PlaneChoice::least_y,
      PlaneChoice::wind_aware,      PlaneChoice::steepest_clearance, PlaneChoice::of_motion};
  int colliding = 0, hidden[2][6] = {};
  for (const Engagement& e : all) {
    const Pair p = pair_of(e, e.a, e.b);
    if (ConeOracle(e.a, e.b).membership(p.a.velocity, p.b.velocity) != Membership::in) continue;
    ++colliding;
    for (const SectorMethod method : {SectorMethod::slice, SectorMethod::true_cone})
      for (int k = 0; k < 6; ++k) {
        PlaneOptions options;
        options.choice = kChoices[k];
        options.wind = Vector3d(3, 0, 0);
        const auto across = choose_plane(p.a, p.b, method, options);
        const auto view = plane_view(p.a, p.b, *across, method, RateMethod::none);
        hidden[method == SectorMethod::true_cone][k] += !cone_rates(view->state, view->cone).colliding();
      }
  }
  std::printf("\nOf %d colliding pairs of %d, those whose chosen plane shows no collision:\n\n", colliding,
              kPairs);
  std::printf("| choice | slices | true sector |\n| --- | --- | --- |\n");
  for (int k = 0; k < 6; ++k)
    std::printf("| %s | %d | %d |\n", to_string(kChoices[k]), hidden[0][k], hidden[1][k]);
}

/// A row of decision times, in processor time of this thread.
void decision_row(const char* of, std::vector<double> milliseconds) {
  std::sort(milliseconds.begin(), milliseconds.end());
  const std::size_t n = milliseconds.size();
  std::printf("| %s | %zu | %.3f ms | %.3f ms | %.3f ms |\n", of, n, milliseconds[n / 2],
              milliseconds[n * 99 / 100], milliseconds.back());
}

template <class Decide>
double milliseconds_of(Decide&& decide) {
  timespec from, to;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
  decide();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
  return 1e3 * double(to.tv_sec - from.tv_sec) + 1e-6 * double(to.tv_nsec - from.tv_nsec);
}

BodyState still_or_moving(const WorldBody& shape, const Vector3d& position, const Vector3d& velocity) {
  BodyState state;
  state.shape = shape;
  state.position = position;
  state.velocity = velocity;
  return state;
}

/// Four ellipsoids ahead: first decisions, by what they came to.
void crowd_decisions() {
  Dice dice(3);
  const Ellipsoid shape = Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.3, 0.2});
  std::vector<double> of[6];
  for (int i = 0; i < 400; ++i) {
    const double speed = dice.uniform(2, 10);
    const BodyState agent = still_or_moving(CombinedEllipsoid(shape), {0, 0, 0}, {speed, 0, 0});
    std::vector<BodyState> others;
    while (others.size() < 4) {
      const Vector3d axes(dice.uniform(0.3, 2), dice.uniform(0.3, 2), dice.uniform(0.3, 2));
      const Vector3d at = dice.uniform(3, 12) * (Vector3d::UnitX() + 0.6 * dice.direction());
      if (at.norm() < 3) continue;
      const Vector3d velocity =
          dice.uniform(0, 1) < 0.5 ? Vector3d(Vector3d::Zero()) : Vector3d(3 * dice.direction());
      others.push_back(still_or_moving(CombinedEllipsoid(Ellipsoid::from_axes(at, axes)), at, velocity));
    }
    Navigator navigator({.required = 0.3, .beyond = 0.1, .most = 5});
    NavigatorStep said;
    const double time = milliseconds_of([&] { said = navigator.step(agent, others, std::nullopt, 0, 0.02); });
    of[static_cast<int>(said.status)].push_back(time);
  }
  for (const NavigatorStatus status : {NavigatorStatus::straight, NavigatorStatus::avoiding,
                                       NavigatorStatus::too_near, NavigatorStatus::cannot_avoid})
    if (const auto& times = of[static_cast<int>(status)]; !times.empty())
      decision_row((std::string("4 ellipsoids, first decision: ") + to_string(status)).c_str(), times);
}

/// Flights of 60 m among 100 ellipsoids within 80 m, half of them moving.
void decisions_among_a_hundred(bool longitudinal) {
  Dice dice(5);
  const Ellipsoid shape = Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.3, 0.2});
  const Vector3d goal(60, 0, 0);
  std::vector<double> times;
  for (int flight = 0; flight < 40; ++flight) {
    std::vector<BodyState> others;
    while (others.size() < 100) {
      const Vector3d axes(dice.uniform(0.3, 2), dice.uniform(0.3, 2), dice.uniform(0.3, 2));
      const Vector3d at = 80 * std::cbrt(dice.uniform(0, 1)) * dice.direction();
      if (at.norm() < 4 || (at - goal).norm() < 4) continue;
      const Vector3d velocity = others.size() % 2 ? Vector3d(3 * dice.direction()) : Vector3d(0, 0, 0);
      others.push_back(still_or_moving(CombinedEllipsoid(Ellipsoid::from_axes(at, axes)), at, velocity));
    }
    Navigator navigator({.required = 0.3, .beyond = 0.1, .most = 8, .longitudinal = longitudinal});
    Vector3d p(0, 0, 0), v(5, 0, 0);
    constexpr double kStep = 0.05;
    for (double t = 0; (goal - p).norm() > 2 && t < 20; t += kStep) {
      const BodyState agent = still_or_moving(CombinedEllipsoid(shape.translated(p)), p, v);
      NavigatorStep said;
      times.push_back(milliseconds_of([&] {
        said = navigator.step(agent, others, Destination{goal, 8}, t, kStep);
      }));
      Vector3d next = v + kStep * said.acceleration;
      if (!longitudinal) next *= v.norm() / next.norm();
      p += 0.5 * kStep * (v + next);
      v = next;
      for (BodyState& other : others) {
        other.position += kStep * other.velocity;
        other.shape =
            CombinedEllipsoid(other.shape.quadric()->ellipsoid().translated(kStep * other.velocity));
      }
    }
  }
  decision_row(
      longitudinal ? "among 100 ellipsoids, its speed may change" : "among 100 ellipsoids, at constant speed",
      times);
}

/// Flights along a corridor 2.5 m wide and high and 35 m long, of 140,000 boxes, past posts that leave 0.9 m.
void corridor_decisions() {
  std::vector<Box> boxes;
  const auto cell = [&](double x, double y, double z) {
    boxes.push_back({{x, y, z}, {x + 0.05, y + 0.05, z + 0.05}});
  };
  for (int i = 0; i < 700; ++i)
    for (int k = 0; k < 50; ++k) {
      const double x = 0.05 * i - 1, a = 0.05 * k - 1.25;
      for (const double side : {-1.3, 1.25}) {
        cell(x, side, a);
        cell(x, a, side);
      }
      if (i % 160 == 100)
        for (double y = 0; y < 0.3; y += 0.05) cell(x, i % 320 == 100 ? y : -y, a);
    }
  const BodyState map =
      still_or_moving(vericone::Placed(vericone::Body(Assembly::boxes(boxes))), {0, 0, 0}, {0, 0, 0});
  const Ellipsoid shape = Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.3, 0.1});
  for (const double speed : {1.0, 3.0, 5.0}) {
    std::vector<double> times;
    for (const double required : {0.1, 0.3}) {
      Navigator navigator({.required = required, .beyond = 0.1, .most = 8});
      Vector3d p(0, 0, 0), v(speed, 0, 0);
      const double step = 0.05;
      for (double t = 0; p.x() < 28 && t < 40 / speed; t += step) {
        const BodyState agent = still_or_moving(CombinedEllipsoid(shape.translated(p)), p, v);
        NavigatorStep said;
        times.push_back(milliseconds_of([&] {
          said = navigator.step(agent, {&map, 1}, Destination{{30, 0, 0}, 8}, t, step);
        }));
        const Vector3d next = (v + step * said.acceleration).normalized() * speed;
        p += 0.5 * step * (v + next);
        v = next;
      }
    }
    char of[80];
    std::snprintf(of, sizeof of, "in a map of %zu boxes at %g m/s", boxes.size(), speed);
    decision_row(of, times);
  }
}

void decisions_table() {
  std::printf(
      "\nDecisions of a Navigator, processor time.\n\n"
      "| decision | number | median | 99 %% | worst |\n| --- | --- | --- | --- | --- |\n");
  for (const bool longitudinal : {false, true}) decisions_among_a_hundred(longitudinal);
  crowd_decisions();
  corridor_decisions();
}

}  // namespace
}  // namespace vericone::benchmarks

int main(int argc, char** argv) {
  // With an argument the decisions alone, which take seconds.
  if (argc > 1 && std::string(argv[1]) == "decisions") {
    vericone::benchmarks::decisions_table();
    return 0;
  }
  vericone::benchmarks::ellipsoid_table();
  vericone::benchmarks::other_bodies_table();
  vericone::benchmarks::hidden_collisions();
  vericone::benchmarks::decisions_table();
}
