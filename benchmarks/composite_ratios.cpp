// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what questions about a dented body and a mesh, and about two meshes, cost:
// vericone_composite_ratios.
#include <benchmarks/pairs.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/composite/composite_pair.h>
#include <algorithm>
#include <cstdio>
#include <ctime>

namespace vericone::benchmarks {
namespace {

using Eigen::Vector3d;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Times {
  std::vector<double> seconds;

  template <class Call>
  auto of(Call&& call) {
    const double start = cpu_seconds();
    auto answer = call();
    asm volatile("" : : "r,m"(&answer) : "memory");
    seconds.push_back(cpu_seconds() - start);
    return answer;
  }
  void row(const char* what, std::size_t decided) {
    std::sort(seconds.begin(), seconds.end());
    const auto at = [&](double share) {
      return 1e6 * seconds[std::min(seconds.size() - 1, std::size_t(share * double(seconds.size())))];
    };
    std::printf("| %s | %.3g us | %.3g us | %.3g us | %zu of %zu |\n", what, at(0.5), at(0.9), at(1), decided,
                seconds.size());
  }
};

/// A sphere with bumps of height `bumps`, 4 n^2 triangles.
Assembly bumpy(int n, const Vector3d& center, double bumps) {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(i * 2 * n + j % (2 * n)); };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = std::numbers::pi * i / n, b = std::numbers::pi * j / n;
      const double r = 1 + bumps * std::sin(5 * a) * std::cos(4 * b);
      points.push_back(center +
                       r * Vector3d(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return Assembly::mesh(std::move(points), std::move(triangles));
}

/// Velocities aimed about the obstacle; then those that bisection between one that collides and one that does
/// not asks.
void table(const char* name, const CompositePair& pair, double preparation, const Vector3d& towards) {
  Dice dice(1);
  Times any, near, contact, miss;
  std::size_t of_any = 0, of_near = 0, of_contact = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3d w = towards + 3 * Vector3d(dice.normal(), dice.normal(), dice.normal());
    const auto answer = any.of([&] { return pair.membership(w, Vector3d::Zero()); });
    of_any += answer.has_value();
    if (answer != Membership::in) {
      miss.of([&] { return pair.miss_distance(w); });
      continue;
    }
    of_contact += std::isfinite(contact.of([&] { return pair.first_contact(w); })->latest);
  }
  for (int i = 0; i < 40; ++i) {
    Vector3d in = towards, out = towards.norm() * dice.direction();
    if (pair.membership(out, Vector3d::Zero()) != Membership::out) continue;
    for (int step = 0; step < 30; ++step) {
      const Vector3d w = 0.5 * in + 0.5 * out;
      const auto answer = near.of([&] { return pair.membership(w, Vector3d::Zero()); });
      if (!answer) break;
      ++of_near;
      (*answer == Membership::out ? out : in) = w;
    }
  }
  std::printf("| %s | median | 90 %% | worst | decided |\n| --- | --- | --- | --- | --- |\n", name);
  std::printf("| prepare, relation included | %.3g us | | | |\n", 1e6 * preparation);
  any.row("in, on or out", of_any);
  near.row("the same, nearer and nearer to the boundary", of_near);
  contact.row("first contact of those that collide", of_contact);
  miss.row("miss distance of the others", miss.seconds.size());
  ConeMapOptions options;
  options.resolution = 0.02;
  const double start = cpu_seconds();
  const ConeMap map = cone_map(pair, options);
  std::printf("\nCone map at 0.02 rad: %.3f sr collide, %.3f safe, %.3f undecided, %.2g s.\n\n",
              map.colliding, map.safe, map.undecided, cpu_seconds() - start);
}

void tables(int n) {
  const Assembly obstacle = bumpy(n, {0, 0, 0}, 0.2);
  const CombinedEllipsoid dented(
      Ellipsoid::from_axes({6, 1, 0}, {1.5, 1.2, 1}),
      {hyperboloid(2, {0.5, 0.6, 0.6}), hyperboloid(2, {0.6, 0.6, 0.6}, rotation_from_heading(1.5, 0.2))});
  char name[96];
  double start = cpu_seconds();
  const CompositePair first(dented, obstacle);
  std::snprintf(name, sizeof name, "dented body, mesh of %zu", obstacle.size());
  table(name, first, cpu_seconds() - start, {-6, -1, 0});
  const Assembly agent = bumpy(n, {5, 1, 0}, 0.3);
  start = cpu_seconds();
  const CompositePair second(agent, {}, obstacle);
  std::snprintf(name, sizeof name, "mesh of %zu, mesh of %zu", agent.size(), obstacle.size());
  table(name, second, cpu_seconds() - start, {-5, -1, 0});
}

/// A cube of 12 n^2 triangles.
Assembly cube(int n, const Vector3d& low) {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  for (int side = 0; side < 6; ++side) {
    const auto first = std::uint32_t(points.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        Vector3d x;
        x(side % 3) = side / 3;
        x((side + 1) % 3) = double(i) / n;
        x((side + 2) % 3) = double(j) / n;
        points.push_back(low + x);
        if (i == n || j == n) continue;
        const std::uint32_t a = first + std::uint32_t(i * (n + 1) + j), b = a + std::uint32_t(n) + 1;
        triangles.push_back({a, b, b + 1});
        triangles.push_back({a, b + 1, a + 1});
      }
  }
  return Assembly::mesh(std::move(points), std::move(triangles));
}

/// One cube on another: thousands of pairs of triangles touch.
void at_rest(int n) {
  double start = cpu_seconds();
  const Assembly below = cube(n, {0, 0, 0}), above = cube(n, {0.25, 0.25, 1});
  const double assembled = cpu_seconds() - start;
  start = cpu_seconds();
  const CompositePair pair(above, {}, below);
  const double relation = cpu_seconds() - start;
  std::printf("Two cubes of %zu triangles, one on the other: %s, in %.2g ms, %.2g of their assembly.\n",
              below.size(), pair.relation() == Relation::touching ? "touching" : "wrong", 1e3 * relation,
              relation / assembled);
}

}  // namespace
}  // namespace vericone::benchmarks

int main() {
  for (const int n : {50, 158}) vericone::benchmarks::tables(n);
  vericone::benchmarks::at_rest(85);
}
