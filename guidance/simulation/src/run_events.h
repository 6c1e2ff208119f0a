// SPDX-License-Identifier: BSD-3-Clause
//
// When between two commands something happened: roots on the tracks; and how long deciding took.
#pragma once

#include <vericone/simulation/run.h>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace vericone::simulation {

/// A time in [from, to] at which `value` changes its sign, to 1e-12 of the interval; it is to differ at the
/// two ends. A value that is not finite counts as that of `to`.
double sign_change(const std::function<double(double)>& value, double from, double to);

/// Whether one body has passed another, looked at time after time.
class Passage {
 public:
  Passage(const Track& a, const Track& b);

  /// Negative until B is passed: c.V, and once that is not negative V_r_hat of the plane chosen, where there
  /// is one: followed from the time asked before. Where V_r_hat is positive on every plane c.V stands for it.
  /// A placed body may have rooms, and its reference point be anywhere: it is passed when the middle of its
  /// bounds recedes and A is out of them.
  double rate(const Track& a, const Track& b, const Pilot& pilot, double t);
  /// From A's reference point to that of B, in place of which a placed B has the middle of its bounds.
  [[nodiscard]] Eigen::Vector3d between(const Track& a, const Track& b, double t) const;

 private:
  /// Metres from A's reference point to the bounds of a placed B, negative within. Requires placed_.
  [[nodiscard]] double outside(const Track& a, const Track& b, double t) const;

  double reach_;                    // of both bodies, metres
  const Placed* placed_ = nullptr;  // B in its own frame
  guidance::GuideMemory seen_;
};

/// Negative on a collision course as the law sees it: m - required, or -1 and 1.
double margin(const Track& a, const Track& b, const guidance::GuideOptions& options, double t);

/// Of a body; their number where none has the name.
std::size_t index_of(const Scenario& scenario, const std::string& name);

/// Adds the seconds that it lives to a sum.
class Timed {
 public:
  explicit Timed(double& sum) : sum_(sum) {}
  ~Timed() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Of decisions that took so long, seconds; there may be none. Changes their order.
void summarise(std::vector<double>& seconds, RunTimes& times);

}  // namespace vericone::simulation
