// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints, in Markdown, what the minimum-volume ellipsoid costs beside CGAL's at equal epsilon, all in one
// run: vericone_min_volume_ratios [ROUNDS [FILE...]]. Clouds of 100,000 points, then the points of the files.
#include <vericone/files/files.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/min_ellipsoid_check.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

namespace vericone::benchmarks {
namespace {

using Eigen::Vector3d;
using verify::SeededRandom;

constexpr int kPoints = 100'000;
constexpr double kEpsilons[] = {1e-2, 1e-3, 1e-4};

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

struct Cloud {
  std::string name;
  std::vector<Vector3d> points;
};

std::vector<Cloud> clouds() {
  const auto cube = [](SeededRandom& r) {
    Vector3d x;
    for (int k = 0; k < 3; ++k) x(k) = r.uniform(-1, 1);
    return x;
  };
  const auto sphere = [](SeededRandom& r) { return r.direction<3>(); };
  const auto ball = [](SeededRandom& r) {
    const double radius = std::cbrt(r.uniform(0, 1));
    return Vector3d(radius * r.direction<3>());
  };
  // Box and Muller's.
  const auto gauss = [](SeededRandom& r) {
    Vector3d x;
    for (int k = 0; k < 3; ++k) {
      const double radius = std::sqrt(-2 * std::log(1 - r.uniform(0, 1)));
      x(k) = radius * std::cos(6.283185307179586 * r.uniform(0, 1));
    }
    return x;
  };
  const auto ellipsoid = [&](SeededRandom& r) { return Vector3d(10, 3, 1).cwiseProduct(sphere(r)).eval(); };
  const std::pair<const char*, std::function<Vector3d(SeededRandom&)>> kinds[] = {
      {"Gaussian", gauss},
      {"uniform in a ball", ball},
      {"on a sphere", sphere},
      {"on an ellipsoid 10 : 3 : 1", ellipsoid},
      {"uniform in a cube", cube}};
  std::vector<Cloud> all;
  for (const auto& [name, draw] : kinds) {
    SeededRandom random(500, 1, all.size());
    Cloud cloud{name, {}};
    for (int k = 0; k < kPoints; ++k) cloud.points.push_back(draw(random));
    all.push_back(std::move(cloud));
  }
  return all;
}

/// The file's points about their mean, divided by their extent: CGAL's certificate holds near the origin.
Cloud from_file(const std::filesystem::path& path) {
  Cloud cloud{path.filename().string(), files::read_points(path).points};
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : cloud.points) mean += p / static_cast<double>(cloud.points.size());
  double extent = 0;
  for (Vector3d& p : cloud.points) {
    p -= mean;
    extent = std::max(extent, p.cwiseAbs().maxCoeff());
  }
  for (Vector3d& p : cloud.points) p /= extent;
  return cloud;
}

/// The optimality gap that promises a volume of at most 1 + epsilon times the least (min_volume_ellipsoid.h).
double gap_for(double epsilon) { return 0.75 * (std::pow(1 + epsilon, 2.0 / 3) - 1); }

struct Summary {
  double worst_gap = 0, longest = 0, least_ratio = 1e300, least_plain = 1e300;
};

void rows(const Cloud& cloud, int rounds, Summary& summary) {
  const auto time_ours = [&](double tolerance, std::vector<double>& seconds) {
    const double start = cpu_seconds();
    const MinVolumeResult<3> r = min_volume_ellipsoid<3>(cloud.points, {.tolerance = tolerance});
    seconds.push_back(cpu_seconds() - start);
    return r;
  };
  const auto row = [&](const std::string& asked, const MinVolumeResult<3>& r, double ours) {
    std::printf("| %s | %zu | %s | %.1e%s | %.1e | %.1f ms |", cloud.name.c_str(), cloud.points.size(),
                asked.c_str(), r.optimality_gap, r.converged() ? "" : " (not converged)",
                r.volume_ratio_bound - 1, 1e3 * ours);
  };
  std::vector<double> by_default;
  MinVolumeResult<3> best;
  for (int k = 0; k < rounds; ++k) best = time_ours(MinVolumeOptions{}.tolerance, by_default);
  row("gap 1e-07", best, median(by_default));
  std::printf(" | | | |\n");
  summary.worst_gap = std::max(summary.worst_gap, best.optimality_gap);
  summary.longest = std::max(summary.longest, median(by_default));
  for (const double epsilon : kEpsilons) {
    std::vector<double> ours, theirs, ratios, plain;
    MinVolumeResult<3> r;
    verify::CgalMinEllipsoid<3> cgal;
    for (int k = 0; k < rounds; ++k) {
      r = time_ours(gap_for(epsilon), ours);
      cgal = verify::cgal_min_ellipsoid<3>(cloud.points, epsilon);
      theirs.push_back(cgal.seconds);
      ratios.push_back(theirs.back() / ours.back());
      plain.push_back(verify::cgal_min_ellipsoid<3>(cloud.points, epsilon, true).seconds / ours.back());
    }
    char asked[32];
    std::snprintf(asked, sizeof asked, "epsilon %.0e", epsilon);
    row(asked, r, median(ours));
    std::printf(" %.1e | %.0f ms | %.0f | %.2g |\n", cgal.ratio_bound - 1, 1e3 * median(theirs),
                median(ratios), median(plain));
    std::fflush(stdout);
    summary.least_ratio = std::min(summary.least_ratio, median(ratios));
    summary.least_plain = std::min(summary.least_plain, median(plain));
  }
}

void run(int count, char** arguments) {
  const int rounds = count > 1 ? std::max(1, std::atoi(arguments[1])) : 3;
  std::vector<Cloud> all = clouds();
  const std::size_t generated = all.size();
  for (int k = 2; k < count; ++k) all.push_back(from_file(arguments[k]));
  std::printf(
      "| points | how many | asked | our gap | our bound of the excess | time | CGAL's bound | "
      "CGAL's time | CGAL / this | without its certificate |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  Summary large, everything;
  for (std::size_t k = 0; k < all.size(); ++k) {
    rows(all[k], rounds, everything);
    if (k + 1 == generated) large = everything;
  }
  const auto verdict = [](const char* what, double value, bool met) {
    std::printf("| %s | %.3g | %s |\n", what, value, met ? "met" : "**not met**");
  };
  std::printf("\n| requirement | measured | |\n| --- | --- | --- |\n");
  verdict("largest gap, all of the above, below 1e-6", everything.worst_gap, everything.worst_gap < 1e-6);
  verdict("longest time for 100,000 points at gap 1e-7, below 0.3 s", large.longest, large.longest < 0.3);
  verdict("least CGAL / this at equal epsilon, 100,000 points, at least 10", large.least_ratio,
          large.least_ratio >= 10);
  std::printf("| the same without CGAL's certificate | %.2g | no requirement |\n", large.least_plain);
  verdict("CGAL, certificate included, / this, all of the above", everything.least_ratio,
          everything.least_ratio >= 10);
}

}  // namespace
}  // namespace vericone::benchmarks

int main(int count, char** arguments) {
  try {
    vericone::benchmarks::run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
