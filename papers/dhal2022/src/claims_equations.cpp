// SPDX-License-Identifier: BSD-3-Clause
//
// Equations that are printed wrong, by what they give at the instants and in the runs that the source shows.
// All of them, with the tests that hold the right ones: docs/errata.md, 3.
#include <vericone/guidance/kinematics.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "claims.h"
#include "printed_law.h"

namespace vericone::dhal2022 {
namespace {

/// (5.9) as printed at the instant when F3 appears, against the components along and across the bisector.
Claim bisector_components(PaperRuns& runs) {
  const PaperRun& run = runs.run("5.4.1");
  const double t = 2.13;
  const guidance::BodyState a = run.track("F1").state(t), b = run.track("F3").state(t);
  const auto view = guidance::plane_view(a, b, Eigen::Vector3d::UnitZ(), guidance::SectorMethod::slice,
                                         guidance::RateMethod::none);
  if (!view) throw std::runtime_error("5.4.1: no cone of F3 when it appears");
  // theta - theta_b: the printed theta_b is from the x axis, ours from the line of sight.
  const double angle = -view->cone.theta_b, v_r = view->state.v_r, v_theta = view->state.v_theta;
  const Eigen::Vector2d printed(std::cos(angle) * v_r + std::sin(angle) * v_theta,
                                -std::sin(angle) * v_r + std::cos(angle) * v_theta);
  const Eigen::Vector3d bisector = std::cos(-angle) * view->line_of_sight + std::sin(-angle) * view->across,
                        normal = -std::sin(-angle) * view->line_of_sight + std::cos(-angle) * view->across,
                        v = b.velocity - a.velocity;
  const Eigen::Vector2d right(v.dot(bisector), v.dot(normal));
  const double off = (printed - right).norm();
  return printed_right(
      {"5.9/matrix",
       "5.3",
       {"5.9"},
       "(5.9), the relative velocity along and across the bisector",
       "the matrix is transposed; (5.10) as printed agrees with the right one (docs/errata.md, 3.5)"},
      "V_r_hat, V_theta_hat", off < 1e-9 * v.norm(), "off by " + short_text(off, 3) + " m/s when F3 appears");
}

/// The V_phi row of (6.10), without accelerations, against the motion itself.
Claim spatial_row(PaperRuns& runs) {
  const PaperRun& run = runs.run("6.5-noncooperative");
  const auto state = [&](double t) {
    const simulation::Motion a = run.body("A").start, b = run.body("B").start;
    return guidance::spatial_state(
        {a.position + t * a.velocity, a.velocity, b.position + t * b.velocity, b.velocity});
  };
  const double h = 1e-4;
  const guidance::SpatialState s = state(0);
  const double moved = (state(h).v_phi - state(-h).v_phi) / (2 * h);
  const double row = (-s.v_theta * s.v_r - s.v_theta * s.v_theta * std::tan(s.phi)) / s.r;
  return printed_right({"6.10/V_phi",
                        "6.2",
                        {"6.10"},
                        "(6.10), the row of V_phi' of A and B at 0 s, unaccelerated",
                        "-V_phi V_r where -V_theta V_r is printed (docs/errata.md, 3.6)"},
                       short_text(std::abs(row) < 1e-12 ? 0 : row, 4) + " m/s^2",
                       std::abs(row - moved) < 1e-5, short_text(moved, 4) + " m/s^2, by the motion itself");
}

Claim determinants() {
  const auto det = [](double x, double y, double z) {
    return Eigen::Vector4d(x, y, z, -1).asDiagonal().toDenseMatrix().determinant();
  };
  const double ellipsoid = det(1, 1, 1), one = det(1, 1, -1), two = det(1, -1, -1);
  return printed_right({"6.1/det",
                        "6.1",
                        {"6.8"},
                        "6.1, the sign of det(Q)",
                        "the two hyperboloids are swapped (docs/errata.md, 3.6)"},
                       "negative: ellipsoid or one-sheeted; positive: two-sheeted",
                       ellipsoid < 0 && one < 0 && two > 0,
                       "unit ellipsoid " + short_text(ellipsoid) + ", one-sheeted " + short_text(one) +
                           ", two-sheeted " + short_text(two));
}

/// Whether the source can have flown what it prints.
Claim cooperative_law(PaperRuns& runs) {
  const simulation::Scenario& scenario = runs.run("6.5-cooperative").scenario;
  constexpr double kGains[][2] = {{4, 0.08}, {2, 0.1}, {1, 0.05}, {4, 0.02}, {2, 0.2}};
  constexpr double kUntil = 5.5;  // s, when B2 appears
  int touched = 0, corrected = 0, all = 0;
  double first = kUntil, last = 0;
  for (const auto& [gain, reference] : kGains) {
    ++all;
    const simulation::PairProof proof = fly_6_19(scenario, Print::as_printed, gain, reference, kUntil);
    corrected += fly_6_19(scenario, Print::corrected, gain, reference, kUntil).verdict ==
                 simulation::ProofVerdict::avoided;
    if (proof.verdict != simulation::ProofVerdict::touched) continue;
    ++touched;
    first = std::min(first, proof.to);
    last = std::max(last, proof.to);
  }
  std::string ours =
      "A touches B1 in " + std::to_string(touched) + " of " + std::to_string(all) + " sets of gains";
  if (touched > 0) ours += ", proved, at " + short_text(first, 3) + " to " + short_text(last, 3) + " s";
  ours += "; the corrected law avoids in " + std::to_string(corrected);
  return printed_right(
      {"6.19/flown",
       "6.5",
       {"6.14", "6.17", "6.19"},
       "(6.19) as printed, flown by A and B1",
       "so the source cannot have flown what it prints; the limit and the step are those of the "
       "cooperative scenario (docs/errata.md, 3.6)"},
      "cooperatively avoided", touched == 0, ours);
}

}  // namespace

void claims_of_equations(PaperRuns& runs, std::vector<Claim>& claims) {
  claims.push_back(bisector_components(runs));
  claims.push_back(determinants());
  claims.push_back(spatial_row(runs));
  claims.push_back(cooperative_law(runs));
}

}  // namespace vericone::dhal2022
