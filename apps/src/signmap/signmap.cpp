// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "command/default_seed.h"
#include "command/output_line.h"
#include "commands.h"
#include "job/job.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "work/provenance.h"

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

struct SignMapOptions : OutputOptions {
  SignMapOptions() { out = "out/signmap"; }
  int cells = 193;                    // along each axis, 3 to 2001; an even number means one more
  std::uint64_t seed = kDefaultSeed;  // of the engagement
};

/// Two axes of the map are stretched by this: flat bodies, on which plain doubles are visibly wrong.
constexpr double kFlatness = 0x1p4;

struct Grazing {
  Ellipsoid a, b;
  Vector3d w;
};

/// Two ellipsoids and a velocity exactly on the boundary of their cone, all in whole numbers below 2^53. With
/// the factor G = [g; (0, 0, k)] a body's support point along e_z is its centre plus G e_z, k above it; then
/// c = w + G_A e_z + G_B e_z with w normal to e_z makes the plane at the height k_A support both bodies from
/// opposite sides, and w carries one contact point to the other. A matrix M maps it to a general position.
Grazing grazing_engagement(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto integer = [&engine](int low, int high) {
    return low + static_cast<int>(engine() % static_cast<std::uint64_t>(high - low + 1));
  };
  const auto factor = [&] {
    Matrix3d g;
    do
      for (int i = 0; i < 9; ++i) g(i) = integer(-9, 9);
    while (std::abs(g(0, 0) * g(1, 1) - g(0, 1) * g(1, 0)) < 20);
    g.row(2) = Vector3d(0, 0, integer(3, 9)).transpose();
    return g;
  };
  for (;;) {
    const Matrix3d ga = factor(), gb = factor();
    Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i) = integer(-99, 99);
    m.leftCols(2) *= kFlatness;
    const Vector3d w0(integer(20, 60), integer(-60, 60), 0);
    const Vector3d c = w0 + ga.col(2) + gb.col(2), w = m * w0;
    const Vector3d normal = m.col(0).cross(m.col(1));
    // Neither axis of the map along the boundary, and ulps of like size on both.
    const double slope = std::abs(normal.x() / normal.y());
    if (!(slope > 0.4 && slope < 2.5) || std::abs(m.determinant()) < 1e5 * kFlatness * kFlatness) continue;
    if (w.x() == 0 || w.y() == 0 || std::ilogb(w.x()) != std::ilogb(w.y())) continue;
    const auto body = [&m](const Matrix3d& g, const Vector3d& center) {
      const Matrix3d f = m * g;
      return Ellipsoid::from_shape(m * center, f * f.transpose());
    };
    return {body(ga, Vector3d::Zero()), body(gb, c), w};
  }
}

/// x and the doubles around it, `half` on each side.
std::vector<double> neighbours(double x, int half) {
  std::vector<double> values(2 * static_cast<std::size_t>(half) + 1, x);
  const auto middle = static_cast<std::size_t>(half);
  for (std::size_t i = 1; i <= middle; ++i) {
    values[middle + i] = std::nextafter(values[middle + i - 1], std::numeric_limits<double>::infinity());
    values[middle - i] = std::nextafter(values[middle - i + 1], -std::numeric_limits<double>::infinity());
  }
  return values;
}

Json ellipsoid_json(const Ellipsoid& body) {
  return {{"center", vector_json(body.center())}, {"shape", matrix_json(body.shape())}};
}

/// `vericone signmap`: the answers in, on, out for all doubles around a velocity that grazes exactly, by
/// plain double arithmetic and by the library, and the rung that decided. Writes signmap.csv, signmap.json,
/// provenance.json and the figure to `out`. Throws InputError naming "--cells".
int run_signmap(const SignMapOptions& options, std::ostream& out) {
  if (options.cells < 3 || options.cells > 2001)
    throw InputError("--cells", std::to_string(options.cells), "between 3 and 2001");
  work::StagedFolder folder(options.out, "--out");
  const Grazing g = grazing_engagement(options.seed);
  const ConeOracle oracle(g.a, g.b);
  const int half = options.cells / 2, cells = 2 * half + 1;
  const auto xs = neighbours(g.w.x(), half), ys = neighbours(g.w.y(), half);
  std::string table = "ulps_x,ulps_y,naive,library,rung\n";
  std::array<int, 3> answers{}, rungs{};
  int wrong = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const Vector3d w(xs[static_cast<std::size_t>(i)], ys[static_cast<std::size_t>(j)], g.w.z());
      Rung rung{};
      const Membership library = oracle.membership(w, &rung), naive = oracle.naive_membership(w);
      ++answers.at(static_cast<std::size_t>(library));
      ++rungs.at(static_cast<std::size_t>(rung));
      wrong += library != naive;
      table.append(std::to_string(i - half)).append(",").append(std::to_string(j - half)).append(",");
      table.append(to_string(naive)).append(",").append(to_string(library)).append(",");
      table.append(to_string(rung)).append("\n");
    }
  Json summary = {{"agent", ellipsoid_json(g.a)},
                  {"obstacle", ellipsoid_json(g.b)},
                  {"velocity", vector_json(g.w)},
                  {"ulp",
                   {std::nextafter(std::abs(g.w.x()), 1e308) - std::abs(g.w.x()),
                    std::nextafter(std::abs(g.w.y()), 1e308) - std::abs(g.w.y())}},
                  {"cells", cells},
                  {"naive_wrong", wrong},
                  {"answers", Json::object()},
                  {"rungs", Json::object()}};
  for (const Membership m : {Membership::in, Membership::on, Membership::out})
    summary["answers"][to_string(m)] = answers.at(static_cast<std::size_t>(m));
  for (const Rung r : {Rung::triage, Rung::interval, Rung::exact})
    summary["rungs"][to_string(r)] = rungs.at(static_cast<std::size_t>(r));
  write_whole(folder.path() / "signmap.csv", table);
  Results results{.summary = std::move(summary),
                  .origin = provenance(options.command_line, 1, {}),
                  .scripts = {"signmap.py"},
                  .summary_file = "signmap.json",
                  .files = {"signmap.csv", "signmap.json", "provenance.json"},
                  .old = {"signmap.pdf", "signmap.png"}};
  results.origin["seed"] = options.seed;
  results.origin["cells"] = cells;
  results.text << cells * cells << " velocities around an exactly grazing one: plain doubles wrong on "
               << wrong << "; decided by triage " << rungs.at(0) << ", interval " << rungs.at(1) << ", exact "
               << rungs.at(2) << '\n';
  return publish(results, options, folder, out);
}

}  // namespace

int signmap_command(CommandLine& line) {
  SignMapOptions signmap;
  line.option("--cells", signmap.cells, "Doubles along each axis");
  line.option("--seed", signmap.seed, "Seed of the engagement");
  read_files_line(line, signmap);
  return run_signmap(signmap, std::cout);
}

}  // namespace vericone
