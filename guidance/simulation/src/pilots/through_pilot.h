// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/scenario.h>

namespace vericone::simulation {

/// Through orifices, one after the other; then to its goal. It sees no bodies.
class ThroughPilot : public PilotModel {
 public:
  /// Requires pilot.through.
  explicit ThroughPilot(const Pilot& pilot) : pilot_(pilot), through_(*pilot.through) {}

  void check(const Scenario& scenario, const Body& self) const override;
  [[nodiscard]] std::unique_ptr<FlyingPilot> launch(const Scenario& scenario, std::size_t self,
                                                    const RunOptions& options) const override;
  [[nodiscard]] double most() const override;
  [[nodiscard]] ReachLimits limits(const Body& self, double step) const override;
  [[nodiscard]] std::vector<std::string> orifices() const override { return through_.orifices; }

 private:
  const Pilot& pilot_;
  const Through& through_;
};

}  // namespace vericone::simulation
