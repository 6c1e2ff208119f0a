// SPDX-License-Identifier: BSD-3-Clause
//
// The robust law against an interior-point solver of the source's semidefinite program (7.20)-(7.24). CSDP is
// asked the normalised problem: Q = z^2 q, Y = z^2 y / B, Gamma = z^2 g, and the row of D scaled by sqrt(mu).
// As printed the entries differ by ten decades and it fails.
#include <gtest/gtest.h>
#include <vericone/guidance/robust_law.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "guidance/robust_problems.h"
#include "support/campaign.h"

extern "C" {
#include <csdp/declarations.h>
}

namespace vericone::guidance::robust_law_sdp_test {
namespace {

constexpr int kVariables = 3;  // g, q, y
constexpr int kBlocks = 6, kSizes[kBlocks] = {2, 4, 4, 4, 4, 2};

/// F_0, F_1, ... of sum x_i F_i - F_0 >= 0, a block each.
using Blocks = std::array<Eigen::MatrixXd, kBlocks>;
using Program = std::array<Blocks, kVariables + 1>;

/// The blocks are linear in (g, q, y) but for (7.21)'s ones: read off at unit vectors.
Program program_of(const RobustInstance& x) {
  const auto corners = printed_corners(x.model);
  const double b = std::abs(corners[0](1)), mu = x.options.mu, root = std::sqrt(mu);
  const auto blocks = [&](double g, double q, double y) {
    Blocks all;
    all[0] = Eigen::Matrix2d{{0, 0}, {0, q}};  // (7.21): [1 1; 1 q], its ones below
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d& c = corners[static_cast<std::size_t>(i)];
      all[static_cast<std::size_t>(1 + i)] = decay_lmi(c, q, y / b, g, x.options);
      Eigen::Matrix4d m = attenuation_lmi(c, q, y / b, g, mu);
      m.row(1) /= root;
      m.col(1) /= root;
      all[static_cast<std::size_t>(3 + i)] = m;
    }
    // (7.24), each row in parts of its larger coefficient
    const double step = std::abs(x.z) / b, high = x.high, low = x.low, z = x.z / b;
    all[5] = Eigen::Matrix2d::Zero();
    all[5](0, 0) = (high * q - z * y) / std::max(std::abs(high), step);
    all[5](1, 1) = (z * y - low * q) / std::max(std::abs(low), step);
    return all;
  };
  Program program{blocks(0, 0, 0), blocks(1, 0, 0), blocks(0, 1, 0), blocks(0, 0, 1)};
  program[0][0] = Eigen::Matrix2d{{-1, -1}, {-1, 0}};
  return program;
}

struct Solution {
  int status = -1;
  double g = 0, y = 0;
};

double* memory(int count) {
  return static_cast<double*>(std::calloc(static_cast<std::size_t>(count), sizeof(double)));
}

Solution solve(const Program& f) {
  blockmatrix c{};
  c.nblocks = kBlocks;
  c.blocks = static_cast<blockrec*>(std::calloc(kBlocks + 1, sizeof(blockrec)));
  int n = 0;
  for (int k = 0; k < kBlocks; ++k) {
    const int size = kSizes[k];
    n += size;
    blockrec& block = c.blocks[k + 1];
    block.blockcategory = MATRIX;
    block.blocksize = size;
    block.data.mat = memory(size * size);
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) block.data.mat[i + j * size] = f[0][static_cast<std::size_t>(k)](i, j);
  }
  double* a = memory(kVariables + 1);
  a[1] = 1;  // least g
  auto* constraints = static_cast<constraintmatrix*>(std::calloc(kVariables + 1, sizeof(constraintmatrix)));
  for (int v = 1; v <= kVariables; ++v)
    for (int k = kBlocks; k >= 1; --k) {
      const int size = kSizes[k - 1], entries = size * (size + 1) / 2;
      auto* block = static_cast<sparseblock*>(std::calloc(1, sizeof(sparseblock)));
      block->blocknum = k;
      block->blocksize = size;
      block->constraintnum = v;
      block->entries = memory(entries + 1);
      using Index = std::remove_reference_t<decltype(*block->iindices)>;
      block->iindices =
          static_cast<Index*>(std::calloc(static_cast<std::size_t>(entries) + 1, sizeof(Index)));
      block->jindices =
          static_cast<Index*>(std::calloc(static_cast<std::size_t>(entries) + 1, sizeof(Index)));
      block->numentries = entries;
      int e = 1;
      for (int i = 0; i < size; ++i)
        for (int j = i; j < size; ++j, ++e) {
          block->iindices[e] = static_cast<Index>(i + 1);
          block->jindices[e] = static_cast<Index>(j + 1);
          block->entries[e] = f[static_cast<std::size_t>(v)][static_cast<std::size_t>(k - 1)](i, j);
        }
      block->next = constraints[v].blocks;
      constraints[v].blocks = block;
    }
  blockmatrix x{}, z{};
  double *y = nullptr, primal = 0, dual = 0;
  initsoln(n, kVariables, c, a, constraints, &x, &y, &z);
  Solution solution;
  solution.status = easy_sdp(n, kVariables, c, a, constraints, 0.0, &x, &y, &z, &primal, &dual);
  solution.g = y[1];
  solution.y = y[3] / y[2];
  free_prob(n, kVariables, c, a, constraints, x, y, z);
  return solution;
}

TEST(RobustLawAgainstAnSdpSolver, AgreesWhereItConvergesAndNeverContradictsFeasibility) {
  // The solver reads its settings where it stands: silent.
  const auto folder =
      std::filesystem::temp_directory_path() /
      ("vericone-csdp-" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
  std::filesystem::create_directory(folder);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  std::ofstream("param.csdp")
      << "axtol=1.0e-9\natytol=1.0e-9\nobjtol=1.0e-9\npinftol=1.0e8\ndinftol=1.0e8\n"
         "maxiter=100\nminstepfrac=0.90\nmaxstepfrac=0.97\nminstepp=1.0e-8\nminstepd=1.0e-8\n"
         "usexzgap=1\ntweakgap=0\naffine=0\nprintlevel=0\nperturbobj=1\nfastmode=0\n";

  const int count = testing::campaign_size(300, 3000);
  std::mt19937_64 random(testing::from_environment("VERICONE_SEED", 1));
  int solved = 0, compared = 0, infeasible = 0, said_infeasible = 0;
  std::vector<double> differences;
  double seconds_theirs = 0, seconds_ours = 0;
  for (int i = 0; i < count; ++i) {
    const RobustInstance x = random_instance(random);
    const auto begin = std::chrono::steady_clock::now();
    const RobustCorrection ours = robust_correction(x.z, x.low, x.high, x.model, x.options);
    const auto start = std::chrono::steady_clock::now();
    seconds_ours += std::chrono::duration<double>(start - begin).count();
    const Solution theirs = solve(program_of(x));
    seconds_theirs += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const bool feasible = ours.status == RobustStatus::solved;
    (feasible ? solved : infeasible) += 1;
    if (theirs.status == 0) {
      EXPECT_TRUE(feasible) << i << ": " << to_string(ours.status);
      if (!feasible) continue;
      ++compared;
      const double gamma = ours.gamma / (x.z * x.z);
      differences.push_back(std::abs(theirs.g - gamma) / gamma);
      EXPECT_LT(differences.back(), 1e-6) << i << " theirs " << theirs.g << " ours " << gamma;
    } else if (theirs.status == 1 || theirs.status == 2) {
      // Infeasible, with a certificate: of the dual here, as the problem is stated.
      ++said_infeasible;
      EXPECT_FALSE(feasible) << i << " status " << theirs.status;
    }
  }
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
  std::sort(differences.begin(), differences.end());
  std::cout << count << " problems: " << solved << " solved, " << compared << " of them by both; "
            << infeasible << " without a solution, " << said_infeasible
            << " of them with their certificate; relative difference of Gamma, p90 "
            << differences[differences.size() * 9 / 10] << ", most " << differences.back() << "; CSDP "
            << 1e6 * seconds_theirs / count << " us a problem, ours " << 1e6 * seconds_ours / count << " us, "
            << seconds_theirs / seconds_ours << " times faster\n";
  EXPECT_GT(compared, solved * 9 / 10);
  EXPECT_GT(said_infeasible, infeasible / 2);
}

}  // namespace
}  // namespace vericone::guidance::robust_law_sdp_test
