// SPDX-License-Identifier: BSD-3-Clause
//
// Populations of encounters, of which verdicts are asked without flying (docs/measured/population.md).
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/scenes/scene.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/populations/distribution.h"

namespace vericone::populations {

/// What of a body can be drawn. Places, turns and velocities by components are added to those of the scene;
/// the others take the place of the scene's.
enum class Quantity : std::uint8_t {
  x,
  y,
  z,  // m, of where it stands
  yaw,
  pitch,
  roll,  // rad, about z, then y, then x of the body as the scene turns it, at its centre
  a,
  b,
  c,  // m, semi-axes of an ellipsoid
  vx,
  vy,
  vz,  // m/s
  speed,
  course,
  climb  // m/s, rad from x towards y, rad above the plane
};
inline constexpr std::size_t kQuantities = 15;
[[nodiscard]] const char* to_string(Quantity what);

/// A number that is drawn.
struct Variable {
  bool obstacle = false;  // otherwise the agent's
  Quantity what = Quantity::x;
  DistributionPtr nominal;
  DistributionPtr proposal;  // what is drawn instead; none: as nominal
};

/// "obstacle.speed".
[[nodiscard]] std::string name_of(const Variable& variable);

/// Variables whose normal scores z = normal_quantile(probability) have these correlations.
struct Correlated {
  std::vector<std::size_t> variables;
  std::vector<std::vector<double>> factor;  // lower triangular; its rows times independent scores
};

/// A variable whose values are drawn from parts of its distribution by turns, so that each part has as many
/// encounters; they have weights by how probable the part is.
struct Strata {
  std::size_t variable = 0;
  std::vector<double> edges;  // probabilities of values below, from 0 to 1, ascending
  [[nodiscard]] std::size_t count() const { return edges.size() - 1; }
  [[nodiscard]] double weight(std::size_t k) const { return double(count()) * (edges[k + 1] - edges[k]); }
};

struct Population {
  std::string name;
  scenes::Scene scene;
  std::vector<Variable> variables;
  std::vector<Correlated> correlated;
  /// The share of encounters drawn from the nominal distributions where there is a proposal: no weight is
  /// above its inverse (a defensive mixture: Hesterberg, Technometrics 37 (1995)).
  double nominal_share = 0.1;
  std::optional<Strata> strata;    // of a variable without proposal, beside one velocity each
  int velocities = 1;              // asked of each pair of bodies and places
  std::optional<double> within;    // s: contacts within so long alone
  std::optional<double> per_hour;  // encounters an hour, of which a share collides

  /// Whether what is drawn is not the population itself, so that encounters have weights.
  [[nodiscard]] bool weighted() const { return proposes() || strata; }
  [[nodiscard]] bool proposes() const;
  [[nodiscard]] double largest_weight() const;
};

/// Sums over observations x >= 0: an encounter's weight times the share of its velocities that collide.
struct Moments {
  double sum = 0, squares = 0, largest = 0;
  void add(double x, std::uint64_t times = 1) {
    sum += double(times) * x;
    squares += double(times) * (x * x);
    if (times > 0 && x > largest) largest = x;
  }
};

/// Of encounters one after the other.
struct Tally {
  std::uint64_t encounters = 0, verdicts = 0;
  std::uint64_t in = 0;           // verdicts: they will overlap, or do so now
  std::uint64_t overlapping = 0;  // of these: they do so now
  std::uint64_t on = 0;           // they touch or will touch, and no more
  std::uint64_t undecided = 0;
  std::uint64_t uncovered = 0;  // encounters that collide where the proposal hardly draws: rather by `drawn`
  double weight = 0, weight_squares = 0;
  Moments sure, possible;  // of `in`; of `in` and `undecided`
};

/// One encounter as it is drawn.
struct Encounter {
  Placed agent, obstacle;
  Eigen::Vector3d agent_velocity, obstacle_velocity;  // m/s
  double weight = 1;
};

/// Prepared to be drawn from. What is drawn depends on seed and index alone. May be used by several threads
/// at once; a copy is as good.
class Sampler {
 public:
  /// Throws InputError naming "drawn.agent.x" and the like where the scene's bodies have no such thing.
  explicit Sampler(Population population);

  [[nodiscard]] const Population& population() const { return population_; }

  /// Verdicts of the encounters from `first` on. Throws Interrupted where this thread is asked to stop. Cost:
  /// 10 ns and 1 to 9 ns for each number drawn, of two ellipsoids whose places are not drawn; otherwise that
  /// of preparing a pair, 1 us of ellipsoids. No memory that grows with `count`.
  [[nodiscard]] Tally tally(std::uint64_t seed, std::uint64_t first, std::uint64_t count) const;

  /// The encounter `index`, with its first velocities.
  [[nodiscard]] Encounter encounter(std::uint64_t seed, std::uint64_t index) const;

 private:
  struct Columns;
  void draw(std::uint64_t seed, std::uint64_t first, std::size_t count, bool places, bool velocities,
            Columns& to) const;
  [[nodiscard]] Placed placed(bool obstacle, const Columns& drawn, std::size_t i) const;
  void fill_velocities(const Columns& drawn, std::size_t count, Columns& to) const;
  void tally_fixed(std::uint64_t seed, std::uint64_t first, std::uint64_t count, Tally& to) const;
  void tally_placed(std::uint64_t seed, std::uint64_t first, std::uint64_t count, Tally& to) const;

  Population population_;
  std::optional<Pair> pair_;          // where no place and no body is drawn
  std::optional<ConeOracle> oracle_;  // of it, of two ellipsoids
  struct Axes {
    Eigen::Vector3d center, semi_axes;
    Eigen::Matrix3d rotation;
  };
  std::array<std::optional<Axes>, 2> ellipsoids_;  // agent and obstacle
  std::array<bool, 2> polar_{};                    // velocity drawn by speed, course or climb
};

}  // namespace vericone::populations
