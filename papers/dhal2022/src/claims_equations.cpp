// SPDX-License-Identifier: BSD-3-Clause
//
// Equations that are printed wrong, by what they give at the instants and in the runs that the source shows.
// All of them, with the tests that hold the right ones: docs/errata.md, 3.
#include <vericone/guidance/kinematics.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "claims.h"
#include "printed_law.h"

namespace vericone::dhal2022 {
namespace {

/// F1 and F3 of 5.4.1 when F3 appears.
struct Meeting {
  guidance::BodyState a, b;
  guidance::PlaneView view;
};
Meeting when_f3_appears(PaperRuns& runs) {
  const PaperRun& run = runs.run("5.4.1");
  const guidance::BodyState a = run.track("F1").state(2.13), b = run.track("F3").state(2.13);
  const auto view = guidance::plane_view(a, b, Eigen::Vector3d::UnitZ(), guidance::SectorMethod::slice,
                                         guidance::RateMethod::none);
  if (!view) throw std::runtime_error("5.4.1: no cone of F3 when it appears");
  return {a, b, *view};
}

/// Foci of the two conics of F3.
Claim confocal(PaperRuns& runs) {
  const auto shape = std::get<CombinedEllipse>(when_f3_appears(runs).b.shape);
  const Eigen::Matrix2d& factor = shape.ellipsoid().factor();
  const double of_ellipse = std::sqrt(std::abs(factor.col(0).squaredNorm() - factor.col(1).squaredNorm()));
  // x^T M x = level: semi-axes^2 are level over the eigenvalues, of both signs.
  const Delimiter<2>& hyperbola = shape.delimiters().at(0);
  const Eigen::Vector2d eigen =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(hyperbola.matrix).eigenvalues();
  const double of_hyperbola = std::sqrt(hyperbola.level * (1 / std::abs(eigen[0]) + 1 / std::abs(eigen[1])));
  return printed_right(
      {"5.5/confocal",
       "5.2",
       {"5.6"},
       "5.2.2.1, the two conics of (5.5), for F3",
       "they share their foci for k = b_c^2 / a_c^2 alone; the equation is right (docs/errata.md, "
       "3.5)"},
      "share the same focal points", std::abs(of_ellipse - of_hyperbola) < 1e-9,
      "foci at " + short_text(of_ellipse, 4) + " m (ellipse) and " + short_text(of_hyperbola, 4) +
          " m (hyperbola) from the centre");
}

/// (5.6) as printed, and corrected, for the tangents from a corner of F3 to F1: how far its lines are from
/// touching F1, m, at worst; nothing where it has no real angle.
std::optional<double> off_tangent(const CombinedEllipse& ellipse, const Eigen::Vector2d& corner,
                                  Print print) {
  const Eigen::Vector2d c = ellipse.center();
  const Eigen::Matrix2d s = ellipse.ellipsoid().factor() * ellipse.ellipsoid().factor().transpose();
  Eigen::Matrix3d dual;  // the inverse of the ellipse's matrix
  dual << s - c * c.transpose(), -c, -c.transpose(), -1;
  const double u = corner.x(), v = corner.y(), a = dual(0, 0), b = dual(1, 1), d = dual(0, 2), e = dual(1, 2),
               f = dual(2, 2);
  const double k_2 = (b - a) + 2 * (d * u - e * v) + f * (v * v - u * u);
  const double k_0 = (print == Print::as_printed ? a * a : a) - 2 * d * u + f * u * u;
  const double k_1 = -2 * (dual(0, 1) - (d * v + e * u) + f * u * v);
  const double sine = (2 * k_0 + k_2) / std::hypot(k_1, k_2);
  if (std::abs(sine) > 1) return std::nullopt;
  const double first = print == Print::as_printed ? std::atan(k_1 / k_2) : std::atan2(k_1, k_2);
  double worst = 0;
  for (const double sign : {-1.0, 1.0}) {
    const double gamma = 0.5 * (first + sign * (std::asin(sine) + std::numbers::pi / 2));
    const Eigen::Vector2d normal(-std::sin(gamma), std::cos(gamma));
    worst = std::max(worst, std::abs(std::abs(normal.dot(c - corner)) - std::sqrt(normal.dot(s * normal))));
  }
  return worst;
}
Claim tangents(PaperRuns& runs) {
  const Meeting meeting = when_f3_appears(runs);
  const auto& f1 = std::get<CombinedEllipse>(meeting.a.shape);
  const Eigen::Vector2d corner = corners(std::get<CombinedEllipse>(meeting.b.shape)).at(0).point;
  const auto off = off_tangent(f1, corner, Print::as_printed),
             right = off_tangent(f1, corner, Print::corrected);
  return printed_right(
      {"5.6/gamma",
       "5.2",
       {"5.6"},
       "(5.6), tangents to F1 from a corner of F3 when it appears",
       "a'^2 for a' in K_0, and the arctangent of a quotient; v' is read as v (docs/errata.md, 3.5)"},
      "tangents", off && *off < 1e-9,
      (off ? "off by " + short_text(*off, 3) + " m" : std::string("no real angle")) + "; corrected, off by " +
          (right ? short_text(*right, 1) + " m" : std::string("no real angle")));
}

/// A coefficient as printed against what the kinematics say, in multiples of the right one.
Claim coefficient(const std::string& id, const std::string& what, const std::string& note, double printed,
                  double right) {
  return printed_right({id, "5.3", {"5.9"}, what, note + " (docs/errata.md, 3.5)"}, short_text(printed, 4),
                       std::abs(printed - right) <= 1e-6 * std::abs(right),
                       short_text(right, 4) + ", by the change of the motion itself");
}
/// (5.14)'s A_12 and (5.17)'s A_16 of F1 and F3 when F3 appears.
Claim rendezvous(PaperRuns& runs) {
  const Meeting meeting = when_f3_appears(runs);
  const guidance::PlanarState s = meeting.view.state;
  // y after a moment of a unit acceleration of A or of B, the cone as it is.
  const auto y_by = [&](const guidance::PlanarInputs& inputs) {
    const double h = 1e-5;
    const guidance::PlanarRates rest = guidance::planar_rates(s, {}),
                                moved = guidance::planar_rates(s, inputs);
    const auto y = [&](double by) {
      guidance::PlanarState at = s;
      at.v_r += by * (moved.v_r - rest.v_r);
      at.v_theta += by * (moved.v_theta - rest.v_theta);
      return guidance::cone_rates(at, meeting.view.cone).y;
    };
    return (y(h) - y(-h)) / (2 * h);
  };
  guidance::PlanarInputs by_a, by_b;
  by_a.lateral_a = by_b.lateral_b = 1;
  const double alpha = s.alpha - s.theta, beta = s.beta - s.theta;
  const double a_11 = s.v_r * std::cos(alpha) + s.v_theta * std::sin(alpha);
  const double a_12 = -(s.v_r * std::cos(beta) - s.v_theta * std::sin(beta));
  return coefficient("5.14/A_12", "(5.14), A_12 / A_11: what a_B changes of y beside a_A",
                     "the second term's sign is + inside", a_12 / a_11, y_by(by_b) / y_by(by_a));
}
Claim matching(PaperRuns& runs) {
  const guidance::PlanarState s = when_f3_appears(runs).view.state;
  guidance::PlanarInputs ahead;
  ahead.longitudinal_a = 1;
  const guidance::PlanarRates rest = guidance::planar_rates(s, {}), moved = guidance::planar_rates(s, ahead);
  const double right = 2 * (s.v_r * (moved.v_r - rest.v_r) + s.v_theta * (moved.v_theta - rest.v_theta));
  const double beta = s.beta - s.theta;
  return coefficient("5.17/A_16", "(5.17), A_16: what a_long,A changes of V^2",
                     "what is printed belongs to the lateral acceleration of B",
                     2 * s.v_theta * std::cos(beta) - 2 * s.v_r * std::sin(beta), right);
}

/// (5.9) as printed at the instant when F3 appears, against the components along and across the bisector.
Claim bisector_components(PaperRuns& runs) {
  const auto [a, b, view] = when_f3_appears(runs);
  // theta - theta_b: the printed theta_b is from the x axis, ours from the line of sight.
  const double angle = -view.cone.theta_b, v_r = view.state.v_r, v_theta = view.state.v_theta;
  const Eigen::Vector2d printed(std::cos(angle) * v_r + std::sin(angle) * v_theta,
                                -std::sin(angle) * v_r + std::cos(angle) * v_theta);
  const Eigen::Vector3d bisector = std::cos(-angle) * view.line_of_sight + std::sin(-angle) * view.across,
                        normal = -std::sin(-angle) * view.line_of_sight + std::cos(-angle) * view.across,
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
  claims.push_back(confocal(runs));
  claims.push_back(tangents(runs));
  claims.push_back(bisector_components(runs));
  claims.push_back(rendezvous(runs));
  claims.push_back(matching(runs));
  claims.push_back(determinants());
  claims.push_back(spatial_row(runs));
  claims.push_back(cooperative_law(runs));
}

}  // namespace vericone::dhal2022
