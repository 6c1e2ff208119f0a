// SPDX-License-Identifier: BSD-3-Clause
//
// One step of guidance: from two bodies at an instant to accelerations in space.
#pragma once

#include <vericone/guidance/laws.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/guidance/robust_law.h>
#include <cstdint>
#include <optional>

namespace vericone::guidance {

enum class Law : std::uint8_t {
  avoidance,               // (5.12), (6.17)
  cooperative_avoidance,   // (6.19), ratio mu
  cooperative_rendezvous,  // (5.14)
  matching_rendezvous,     // (5.16)-(5.17)
  clearance,               // clearance_law of laws.h
};
[[nodiscard]] const char* to_string(Law law);

/// Where psi' and theta_b' come from.
enum class GuideRates : std::uint8_t {
  analytic,
  differenced,
  backward,  // the source's: from the step before, kept in the memory; zero on the first step
};

struct GuideOptions {
  Law law = Law::avoidance;
  SectorMethod sector = SectorMethod::true_cone;
  GuideRates rates = GuideRates::analytic;
  PlaneOptions plane;
  LawOptions inversion;
  ClearanceOptions clearance;
  double mu = 0;                           // ratio; cooperative avoidance: a_B = mu a_A
  double gain_speed = 1;                   // 1/s, K_2 of matching
  PlaneFilterOptions filter;               // of what is read on the plane; of the avoidance law alone
  std::optional<OuterLoopOptions> robust;  // (7.14) of the avoidance law
  /// Standard deviations to keep: of y (7.7), added to reference and cease of the avoidance law; of the miss
  /// distance, position and velocity together, added to the metres that the clearance law requires.
  double margin = 0;
  /// Standard deviations: the clearance law keeps its metres for all errors of position and of velocity
  /// within balls of so many, the worst of both together (ClearanceOptions::position_error).
  double errors = 0;
};

/// Throws InputError naming the field: those of check() for the laws' options, "mu", "gain_speed",
/// "plane.planes" unless from 1 to 10000, "plane.wind". guide() does not look.
void check(const GuideOptions& options);

/// What one step hands to the next; a fresh one starts an engagement.
struct GuideMemory {
  std::optional<Eigen::Vector3d> across;  // unit
  struct Past {
    double time, psi, theta_b;      // s, rad, rad; theta_b against fixed axes
    Eigen::Vector3d line_of_sight;  // unit
  };
  std::optional<Past> past;
  EdgeMemory edges;
  std::optional<PlaneFilters> filters;
};

/// What the avoidance law read on its plane, and what its outer loop added.
struct GuideReading {
  PlanarState state;       // with the errors of measurement
  PlaneCone cone;          // its rates are those used
  Measured deviations;     // standard deviations of these, as far as the agent knows them
  double y = 0;            // dimensionless, as used: filtered where y is
  double inner = 0;        // m/s^2, lateral acceleration of the inner loop, saturated
  RobustCorrection outer;  // of the outer loop, where there is one; else as it starts
  bool corrected = false;  // the outer loop was asked
};

struct GuideStep {
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = Eigen::Vector3d::Zero();  // accelerations of both, m/s^2
  LawStatus status = LawStatus::clear;
  double demanded = 0;          // m/s^2, |a| before saturation
  double y = 0, v_r_hat = 0;    // on the plane of `across`, v_r_hat m/s; of the clearance law 0
  double psi = 0, theta_b = 0;  // rad; theta_b from the line of sight
  double m = 0;                 // metres, clearance law only
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  // unit
  std::optional<GuideReading> reading;  // of avoidance that measures, filters or corrects, where it looked
};

/// Avoidance in space first asks on_collision_course(): that decides whether anything is commanded, the plane
/// chosen only how. Where the plane chosen says that all is well although it is not (the projection of the
/// relative velocity on it has left its sector, the relative velocity has not left the cone) the plane of the
/// relative velocity is taken. Where nothing is commanded, y, psi and theta_b are not computed: NaN. Bodies
/// that have no slices (has_sectors()) are asked by their true cone alone: avoidance in space by slices says
/// `no_sector` where they will meet.
///
/// Nothing where the bodies are not apart as the method sees them. `time`, seconds, for backward differences.
/// No allocation and no throw with ellipsoids. Cost: docs/measured/benchmarks.md.
///
/// `b` is what the agent believes of B. `sight` says how wrong that may be, and carries the errors of sensors
/// that measure on the plane. Where y is filtered or has a margin, avoidance in space is decided by y on the
/// plane chosen, not by on_collision_course(): a filter needs every measurement, and a noisy course has no
/// exact answer.
std::optional<GuideStep> guide(const BodyState& a, const BodyState& b, const GuideOptions& options,
                               GuideMemory& memory, double time, const Sight& sight = {});

}  // namespace vericone::guidance
