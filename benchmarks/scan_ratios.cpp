// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what questions about meshes and maps cost beside brute force and beside FCL, all in
// one run: vericone_scan_ratios [MAP.bt [MESH]].
#include <benchmarks/fcl_map_peer.h>
#include <benchmarks/fcl_peers.h>
#include <vericone/files/files.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/octomap/read_octree.h>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <random>

namespace vericone::benchmarks {
namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Times {
  std::vector<double> seconds;
  double at(double share) {
    std::sort(seconds.begin(), seconds.end());
    return seconds[std::min(seconds.size() - 1, std::size_t(share * double(seconds.size())))];
  }
  void row(const char* what, double peer = 0, double other = 0) {
    std::printf("| %s | %.2f us | %.2f us | %.2f us |", what, at(0.5) * 1e6, at(0.99) * 1e6, at(1) * 1e6);
    if (other > 0) std::printf(" %.3g |", other / at(0.5));
    if (peer > 0)
      std::printf(" %.3g |\n", peer / at(0.5));
    else
      std::printf(" |\n");
  }
};

template <class Call>
auto timed(Times& times, Call&& call) {
  const double start = cpu_seconds();
  auto answer = call();
  asm volatile("" : : "r,m"(&answer) : "memory");
  times.seconds.push_back(cpu_seconds() - start);
  return answer;
}

Eigen::Vector3d within(const Box& box, std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(0, 1);
  return box.low + (box.high - box.low).cwiseProduct(Eigen::Vector3d(u(random), u(random), u(random)));
}

void map_table(const std::string& file) {
  const octomap::Octree tree = octomap::read_octree(file);
  octomap::OctreeMeaning known, cautious;
  known.unknown_occupied = false;
  const Assembly occupied = Assembly::boxes(octomap::obstacle_boxes(tree, known));
  double start = cpu_seconds();
  const Assembly all = Assembly::boxes(octomap::obstacle_boxes(tree, cautious));
  const double build = cpu_seconds() - start;
  const FclMap peer(file);
  std::printf("Map %s: %zu nodes; %zu boxes occupied, %zu with unknown space (assembled in %.2f s).\n\n",
              file.c_str(), tree.nodes, occupied.size(), all.size(), build);

  // Agents of 0.6 m by 0.6 m by 0.4 m in free places, velocities mostly level, looked at over the map's
  // diagonal.
  const Eigen::Vector3d axes(0.3, 0.3, 0.2);
  const double diagonal = (tree.bounds.high - tree.bounds.low).norm();
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Times prepare, in, in_all, contact, miss, coarse, fine;
  Effort effort;
  int places = 0, disagree_coarse = 0, disagree_fine = 0, more = 0, hits = 0;
  const std::size_t steps = std::size_t(diagonal / (0.5 * tree.resolution));
  while (places < 100) {
    const Ellipsoid agent = Ellipsoid::from_axes(within(tree.bounds, random), axes);
    const AssemblyOracle oracle = timed(prepare, [&] { return AssemblyOracle(agent, occupied); });
    if (oracle.relation() != Relation::disjoint) continue;
    const AssemblyOracle cautious_oracle(agent, all);
    if (cautious_oracle.relation() != Relation::disjoint) continue;
    ++places;
    for (int i = 0; i < 10; ++i) {
      Eigen::Vector3d w(normal(random), normal(random), 0.3 * normal(random));
      w.normalize();
      const Membership answer = timed(in, [&] { return oracle.membership(w, &effort); });
      timed(in_all, [&] { return cautious_oracle.membership(w); });
      const auto first = timed(contact, [&] { return oracle.first_contact(w); });
      timed(miss, [&] { return oracle.miss_distance(w).least; });
      const bool hit = first && first->time < diagonal;
      hits += hit;
      const bool by_ten = timed(coarse, [&] { return peer.naive(agent.center(), axes, diagonal * w, 10); });
      disagree_coarse += by_ten != hit;
      if (i < 5) {
        ++more;
        disagree_fine +=
            timed(fine, [&] { return peer.naive(agent.center(), axes, diagonal * w, steps); }) != hit;
      }
      if (answer == Membership::out && hit) std::printf("contradiction\n");
    }
  }
  const double ten = coarse.at(0.5), sound = fine.at(0.5);
  std::printf(
      "| one velocity, %d (%d collide) | median | 99 %% | worst | FCL, half a cell apart / this | FCL, 10 "
      "samples / "
      "this |\n| --- | --- | --- | --- | --- | --- |\n",
      10 * places, hits);
  prepare.row("prepare an agent (relation included)", ten, sound);
  in.row("in, on or out, occupied cells", ten, sound);
  in_all.row("in, on or out, unknown space too", ten, sound);
  contact.row("first contact: time, place, normal", ten, sound);
  miss.row("miss distance (0 where they meet)", ten, sound);
  coarse.row("FCL continuousCollide, naive, 10 samples (its default)", ten, sound);
  char label[96];
  std::snprintf(label, sizeof label, "the same, %zu samples (half a cell apart)", steps);
  fine.row(label, ten, sound);
  std::printf(
      "\nFCL's conservative advancement %s octrees. Its answers differ from the exact ones in %d of %d cases "
      "with "
      "10 samples, %d of %d with %zu. Boxes looked at a velocity: %.1f; pieces %.2f; exact predicates "
      "%.4f.\n\n",
      fcl_octrees_in_table() ? "knows" : "does not know", disagree_coarse, 10 * places, disagree_fine, more,
      steps, double(effort.nodes) / (10 * places), double(effort.pieces) / (10 * places),
      double(effort.exact) / (10 * places));

  // The whole cone from outside.
  const Eigen::Vector3d middle = tree.bounds.center(), half = tree.bounds.half_widths();
  const Ellipsoid outside = Ellipsoid::from_axes(middle + Eigen::Vector3d(0, 3 * half.y() + 3, 0), axes);
  const AssemblyOracle oracle(outside, occupied);
  Effort cone;
  start = cpu_seconds();
  (void)oracle.extremes(middle - outside.center(), 64, 1e-4, &cone);
  const double seconds = cpu_seconds() - start;
  const double nodes = double(occupied.hierarchy().nodes().size());
  std::printf(
      "Cone from outside, 64 half-planes at 1e-4 rad: %.2f ms, %llu visits of boxes, %.2f %% of %g (the tree "
      "of "
      "cells has %zu nodes: %.2f %%), %llu pieces.\n\n",
      1e3 * seconds, static_cast<unsigned long long>(cone.nodes), 100 * double(cone.nodes) / nodes, nodes,
      tree.nodes, 100 * double(cone.nodes) / double(tree.nodes),
      static_cast<unsigned long long>(cone.pieces));
}

void mesh_table(const std::string& file) {
  const files::PointFile scan = files::read_points(file);
  const std::vector<Assembly::Triangle> triangles = files::triangles_of(scan.points, scan.faces);
  double start = cpu_seconds();
  const Assembly body = Assembly::mesh(scan.points, triangles);
  const double build = cpu_seconds() - start;
  const Eigen::Vector3d middle = body.bounds().center();
  const double size = body.bounds().half_widths().norm();
  std::printf(
      "Mesh %s: %zu triangles, assembled in %.2f s. An ellipsoid of 0.2, 0.15, 0.1 of the mesh's half "
      "diagonal, "
      "3 of them away; 20 directions of view.\n\n",
      file.c_str(), body.size(), build);
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Times together, one, near, brute, exact_brute;
  double measured = 0;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d from = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Ellipsoid agent =
        Ellipsoid::from_axes(middle + 3 * size * from, size * Eigen::Vector3d(0.2, 0.15, 0.1));
    const AssemblyOracle oracle(agent, body);
    timed(together, [&] { return oracle.extremes(-from, 64, 1e-4).size(); });
    const Eigen::Vector3d side = from.unitOrthogonal();
    timed(one, [&] { return oracle.extreme(-from, side, 1e-4).low; });
    // Past it, near and far, and now.
    for (int k = 0; k < 8; ++k) {
      Effort effort;
      const Eigen::Vector3d past = k == 0 ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                          : Eigen::Vector3d((0.35 + 0.05 * k) * side - from);
      timed(near, [&] { return oracle.miss_distance(past, 1e-6, &effort).least; });
      measured += double(effort.pieces) / 160;
    }
    // One pass: is any triangle met by one velocity? Distance of the line to each triangle in the agent's
    // frame.
    const Eigen::Matrix3d to_ball = agent.factor().inverse();
    const Eigen::Vector3d w = (to_ball * (0.1 * side - from)).normalized(), u = w.unitOrthogonal(),
                          v = w.cross(u);
    timed(brute, [&] {
      int met = 0;
      for (const Assembly::Triangle& t : triangles) {
        double x[3], y[3];
        for (std::size_t k = 0; k < 3; ++k) {
          const Eigen::Vector3d c = to_ball * (scan.points[t[k]] - agent.center());
          x[k] = c.dot(u);
          y[k] = c.dot(v);
        }
        double least = 1e300;
        int turn = 0;
        for (int k = 0; k < 3; ++k) {
          const int next = (k + 1) % 3;
          const double dx = x[next] - x[k], dy = y[next] - y[k], length = dx * dx + dy * dy;
          const double s = length > 0 ? std::clamp(-(x[k] * dx + y[k] * dy) / length, 0.0, 1.0) : 0;
          const double px = x[k] + s * dx, py = y[k] + s * dy;
          least = std::min(least, px * px + py * py);
          turn += x[k] * dy - y[k] * dx > 0 ? 1 : -1;
        }
        met += least <= 1 || turn == 3 || turn == -3;
      }
      return met;
    });
    if (i == 0)
      timed(exact_brute, [&] {
        int met = 0;
        for (std::size_t k = 0; k < body.size(); k += 100)
          met += HullOracle(agent, body.piece(k)).membership(0.1 * side - from) != Membership::out;
        return met;
      });
  }
  std::printf("| | median | 99 %% | worst | one pass / this |\n| --- | --- | --- | --- | --- |\n");
  const double pass = brute.at(0.5);
  together.row("64 half-planes at 1e-4 rad, certified", pass);
  one.row("one half-plane", pass);
  near.row("miss distance at 1e-6", pass);
  brute.row("one pass of plain doubles over all triangles, one velocity", pass);
  std::printf("\nA miss measures %.1f pieces.\n", measured);
  std::printf("\nThe same pass with the exact predicate of each triangle: %.0f ms (from every 100th).\n",
              1e3 * 100 * exact_brute.at(0.5));
}

}  // namespace
}  // namespace vericone::benchmarks

int main(int argc, char** argv) {
  const std::string map = argc > 1 ? argv[1] : "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";
  try {
    vericone::benchmarks::map_table(map);
    if (argc > 2) vericone::benchmarks::mesh_table(argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
