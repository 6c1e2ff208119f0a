// SPDX-License-Identifier: BSD-3-Clause
//
// Cylinders, capsules, boxes, cones and ellipsoids that all but touch, in the whole scene turned by random
// attitudes: how often FCL and Pair say the wrong thing, and what both take.
//
// Usage: vericone_fcl_solids [ATTITUDES]
//
// Bodies of 1 to 8 m whose gap is known: they touch where small numbers say so, and the obstacle is moved
// along the common normal by 2^-k. Turning rounds by 1e-15 m, far less than the least gap, 2^-40 m = 1e-12 m.
#include <vericone/cones/pair.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <benchmarks/items.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace {

using namespace vericone;
using namespace vericone::benchmarks;
using Eigen::Matrix3d, Eigen::Vector3d;

using Shape = std::shared_ptr<fcl::CollisionGeometryd>;

/// A body as both know it.
struct Solid {
  Body own;
  Shape fcl;
};

Solid cylinder(double radius, double height) {
  return {Convex::cylinder(radius, height), std::make_shared<fcl::Cylinderd>(radius, height)};
}
Solid capsule(double radius, double length) {
  return {Convex::capsule(radius, length), std::make_shared<fcl::Capsuled>(radius, length)};
}
Solid cone(double radius, double height) {
  return {Convex::cone(radius, height), std::make_shared<fcl::Coned>(radius, height)};
}
Solid box(const Vector3d& half) {
  const Vector3d edges = 2 * half;
  return {Convex::box(half), std::make_shared<fcl::Boxd>(edges)};
}
Solid ellipsoid(const Vector3d& axes) {
  return {Ellipsoid::from_axes(Vector3d::Zero(), axes, Matrix3d::Identity()),
          std::make_shared<fcl::Ellipsoidd>(axes)};
}

/// Two that touch: the obstacle's centre and attitude as seen from the agent, and their common normal.
struct Touch {
  const char* name;
  Solid agent, obstacle;
  Vector3d center, normal;
  Matrix3d turn = Matrix3d::Identity();
};

std::vector<Touch> touches() {
  Matrix3d along_x;  // z to x
  along_x << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const Vector3d slant(0.6, 0.8, 0), x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  return {{"cylinders, side by side", cylinder(1, 2), cylinder(2, 3), {1.8, 2.4, 0.3}, slant},
          {"cylinders, side by side along x", cylinder(1, 2), cylinder(2, 3), {3, 0, 0.3}, x},
          {"cylinders, crossed axes", cylinder(1, 8), cylinder(2, 8), {0.2, 3, 0.1}, y, along_x},
          {"cylinders, cap on cap", cylinder(1, 2), cylinder(2, 3), {0.3, 0.2, 2.5}, z},
          {"cylinder and ellipsoid", cylinder(2, 4), ellipsoid({1, 2, 3}), {3, 0, 0.2}, x},
          {"capsules", capsule(1, 4), capsule(2, 4), {0.3, 3, 0.2}, y, along_x},
          {"apex of a cone and ball", cone(1, 3), ellipsoid({1, 1, 1}), {0, 0, 2.5}, z},
          {"box and cylinder", box({1, 2, 3}), cylinder(2, 3), {3, 0.1, 0.2}, x}};
}

fcl::Transform3d transform(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation;
  t.translation() = pose.position;
  return t;
}

struct Standing {
  Pose agent, obstacle;
};

Standing standing(const Touch& touch, const Matrix3d& attitude, double gap) {
  return {{Vector3d::Zero(), attitude},
          {attitude * (touch.center + gap * touch.normal), attitude * touch.turn}};
}

bool fcl_collides(const Touch& touch, const Standing& at, fcl::GJKSolverType solver) {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = solver;
  fcl::CollisionResultd result;
  fcl::collide(touch.agent.fcl.get(), transform(at.agent), touch.obstacle.fcl.get(), transform(at.obstacle),
               request, result);
  return result.isCollision();
}

double fcl_distance(const Touch& touch, const Standing& at) {
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(touch.agent.fcl.get(), transform(at.agent), touch.obstacle.fcl.get(),
                       transform(at.obstacle), request, result);
}

Pair pair_of(const Touch& touch, const Standing& at) {
  return {Placed(touch.agent.own, at.agent), Placed(touch.obstacle.own, at.obstacle)};
}

/// Wrong answers among apart and overlapping ones; of Pair, an undecided one is wrong.
struct Wrong {
  int libccd = 0, indep = 0, own = 0;
};

Wrong wrong_of(const Touch& touch, int exponent, int attitudes) {
  testing::RandomBodies random(41);
  Wrong wrong;
  for (int i = 0; i < attitudes; ++i) {
    const Matrix3d attitude = random.rotation();
    for (const double side : {1., -1.}) {
      const Standing at = standing(touch, attitude, side * std::ldexp(1.0, -exponent));
      const bool meet = side < 0;
      wrong.libccd += fcl_collides(touch, at, fcl::GST_LIBCCD) != meet;
      wrong.indep += fcl_collides(touch, at, fcl::GST_INDEP) != meet;
      wrong.own += pair_of(touch, at).relation() != (meet ? Relation::overlapping : Relation::disjoint);
    }
  }
  return wrong;
}

template <typename Ask>
double time_of(const std::vector<Standing>& all, const Ask& ask) {
  double least = 1e300;
  for (int round = 0; round < 5; ++round)
    least = std::min(least, item("", all.size(), 20, [&](std::size_t i) { return ask(i); }).round());
  return least;
}

/// Bodies 3 m apart; both answer of the same places, and the pairs are prepared.
void print_times(const Touch& touch) {
  testing::RandomBodies random(42);
  std::vector<Standing> all;
  std::vector<Pair> pairs;
  std::vector<Vector3d> ways;
  for (int i = 0; i < 50; ++i) {
    all.push_back(standing(touch, random.rotation(), 3));
    pairs.push_back(pair_of(touch, all.back()));
    ways.push_back(all.back().obstacle.position + random.in_box(0.3));
  }
  const Vector3d still = Vector3d::Zero();
  const double collide =
      time_of(all, [&](std::size_t i) { return fcl_collides(touch, all[i], fcl::GST_LIBCCD); });
  const double distance = time_of(all, [&](std::size_t i) { return fcl_distance(touch, all[i]); });
  const double verdict = time_of(all, [&](std::size_t i) { return pairs[i].verdict(ways[i], still); });
  const double contact = time_of(all, [&](std::size_t i) {
    const auto found = pairs[i].contact(ways[i], still);
    return found ? found->time : 0.0;
  });
  std::printf("| %s | %.2f us | %.2f us | %.0f ns | %.2f us | %.1f |\n", touch.name, collide / 1000,
              distance / 1000, verdict, contact / 1000, distance / verdict);
}

}  // namespace

int main(int argc, char** argv) {
  const int attitudes = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 100;
  std::printf("Wrong of %d: FCL (libccd), FCL (its own GJK), Pair\n\n| gap |", 2 * attitudes);
  for (const Touch& touch : touches()) std::printf(" %s |", touch.name);
  std::printf("\n| --- |");
  for (std::size_t i = 0; i < touches().size(); ++i) std::printf(" --- |");
  for (const int exponent : {20, 24, 40}) {
    std::printf("\n| 2^-%d m |", exponent);
    for (const Touch& touch : touches()) {
      const Wrong wrong = wrong_of(touch, exponent, attitudes);
      std::printf(" %d, %d, %d |", wrong.libccd, wrong.indep, wrong.own);
      std::fflush(stdout);
    }
  }
  std::printf(
      "\n\n| two bodies | FCL collide now | FCL distance now | verdict | first contact | FCL distance / "
      "verdict "
      "|\n| --- | --- | --- | --- | --- | --- |\n");
  for (const Touch& touch : touches()) print_times(touch);
}
