// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what certificates of verdicts cost and how long they are; of how many cases there is
// none. With a second argument the certificates go to that file, a line each, for the checkers.
//
// Usage: vericone_certificate_costs [CASES [FILE]]
#include <vericone/cones/certificate.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace vericone;
using Eigen::Vector3d;
using vericone::testing::RandomBodies;

/// A wavy closed surface about the origin.
Assembly wavy(unsigned n) {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j) {
      const double u = std::numbers::pi * i / (n - 1), v = 2 * std::numbers::pi * j / (n - 1);
      const double r = 2 + 0.3 * std::sin(5 * v) * std::sin(3 * u);
      points.emplace_back(r * std::sin(u) * std::cos(v), r * std::sin(u) * std::sin(v), r * std::cos(u));
    }
  for (unsigned i = 0; i + 1 < n; ++i)
    for (unsigned j = 0; j + 1 < n; ++j) {
      triangles.push_back({i * n + j, i * n + j + 1, (i + 1) * n + j});
      triangles.push_back({i * n + j + 1, (i + 1) * n + j, (i + 1) * n + j + 1});
    }
  return Assembly::mesh(points, triangles);
}

struct Seen {
  std::vector<double> seconds;
  std::vector<double> bytes;  // of the proof
  int none = 0;
};

double quantile(std::vector<double> all, double part) {
  if (all.empty()) return 0;
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
}

using Table = std::map<std::string, Seen>;

/// Makes one, and notes what it cost and how long it is.
template <typename Make>
void note(Table& table, const std::string& verdict, const Make& make, std::ofstream* file) {
  const auto begin = std::chrono::steady_clock::now();
  const Certificate made = make();
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Seen& seen = table[verdict];
  if (made.text.empty()) {
    ++seen.none;
    return;
  }
  seen.seconds.push_back(took);
  seen.bytes.push_back(static_cast<double>(made.text.size() - made.text.find("\"proof\"")));
  if (file) *file << made.text << '\n';
}

void print(const char* name, const Table& table) {
  for (const auto& [verdict, seen] : table)
    std::printf("| %s | %s | %zu | %d | %.3f, %.3f | %.0f, %.0f |\n", name, verdict.c_str(),
                seen.seconds.size() + static_cast<std::size_t>(seen.none), seen.none,
                1e3 * quantile(seen.seconds, 0.5), 1e3 * quantile(seen.seconds, 0.99),
                quantile(seen.bytes, 0.5), quantile(seen.bytes, 1));
}

/// What all errors of two ellipsoids lead to.
void row_of_errors(int cases, std::ofstream* file) {
  RandomBodies random(2);
  Table table;
  for (int i = 0; i < cases; ++i) {
    const auto body = [&] {
      return Ellipsoid::from_axes({0, 0, 0},
                                  {random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)},
                                  random.rotation());
    };
    Placed other(body());
    other.pose.position = random.uniform(5, 12) * random.direction();
    const Vector3d w = other.pose.position * random.uniform(0.2, 1) + 1.5 * random.direction();
    const Pair pair(Placed(body()), other);
    RelativeErrors errors;
    errors.position = ErrorSet::ball(random.uniform(0.05, 0.8));
    errors.velocity = ErrorSet::ball(random.uniform(0, 0.2));
    const RobustVerdict verdict = robust_verdict(pair, w, Vector3d::Zero(), errors).verdict;
    if (verdict == RobustVerdict::undecided) continue;
    note(
        table, to_string(verdict), [&] { return pair.certificate(w, Vector3d::Zero(), errors); }, file);
  }
  print("an ellipsoid, with errors", table);
}

void row(const char* name, int cases, const std::function<Placed(RandomBodies&)>& obstacle,
         std::ofstream* file) {
  RandomBodies random(1);
  Table table;
  for (int i = 0; i < cases; ++i) {
    const Placed agent(Ellipsoid::from_axes(
        {0, 0, 0}, {random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)},
        random.rotation()));
    Placed other = obstacle(random);
    other.pose.position = random.uniform(5, 12) * random.direction();
    const Vector3d w = other.pose.position * random.uniform(0.2, 1) + 2.5 * random.direction();
    const Pair pair(agent, other);
    const Verdict verdict = pair.verdict(w, Vector3d::Zero());
    note(
        table, to_string(verdict), [&] { return pair.certificate(w, Vector3d::Zero()); }, file);
  }
  print(name, table);
}

}  // namespace

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 1000;
  std::ofstream to;
  if (argc > 2) to.open(argv[2]);
  std::ofstream* const file = argc > 2 ? &to : nullptr;
  std::printf(
      "| an ellipsoid and | verdict | cases | none | to make, ms: median, 99 %% | proof, bytes: median, most "
      "|\n"
      "|---|---|---|---|---|---|\n");
  row(
      "an ellipsoid", cases,
      [](RandomBodies& r) {
        return Placed(Ellipsoid::from_axes(
            {0, 0, 0}, {r.uniform(0.3, 3), r.uniform(0.3, 3), r.uniform(0.3, 3)}, r.rotation()));
      },
      file);
  row(
      "a hull of 12 points", cases,
      [](RandomBodies& r) {
        std::vector<Vector3d> points;
        for (int i = 0; i < 12; ++i) points.push_back(r.uniform(0.5, 2) * r.direction());
        return Placed(HullBody(points));
      },
      file);
  row(
      "a dented ellipsoid", cases,
      [](RandomBodies& r) {
        return Placed(CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {3, 2, 2}),
                                        {hyperboloid(1, Vector3d(r.uniform(0.5, 1), 1, 1))}));
      },
      file);
  row_of_errors(cases, file);
  const Body mesh(wavy(51));
  row(
      "a mesh of 5,000 triangles", std::max(1, cases / 20), [&](RandomBodies&) { return Placed(mesh); },
      file);
}
