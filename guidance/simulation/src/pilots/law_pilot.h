// SPDX-License-Identifier: BSD-3-Clause
//
// Pilots that mind bodies, one engagement each.
#pragma once

#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/scenario.h>

#include "pilots/engagement.h"
#include "pilots/homing.h"

namespace vericone::simulation {

/// As the source does: the command of one law for the body met first, without regard of others.
class LawPilot : public PilotModel {
 public:
  explicit LawPilot(const Pilot& pilot) : pilot_(pilot) {}

  void check(const Scenario& scenario, const Body& self) const override;
  [[nodiscard]] std::unique_ptr<FlyingPilot> launch(const Scenario& scenario, std::size_t self,
                                                    const RunOptions& options) const override;
  [[nodiscard]] double most() const override;
  [[nodiscard]] double required(const std::string& other) const override;
  [[nodiscard]] bool in_metres() const override { return pilot_.guide.law == guidance::Law::clearance; }

 protected:
  /// It asks its law of the sector, on a plane.
  [[nodiscard]] virtual bool by_sector() const { return !in_metres(); }
  const Pilot& pilot_;

 private:
  void check_courses() const;
  void check_kinds(const Scenario& scenario, const Body& self) const;
  void check_sensing(double step) const;
};

class FlyingLaw : public FlyingPilot {
 public:
  FlyingLaw(const Pilot& pilot, const Scenario& scenario, std::size_t self, const RunOptions& options);

  void look(const Instant& now) override;
  void report(const Instant& now, Run& run) override;
  void command(const Instant& now, std::span<VehicleCommand> commands, Run& run) override;
  void log(const Instant& now, Run& run) override;
  void moved(const Instant& now, Run& run) override;
  [[nodiscard]] bool passed_all() const override;
  [[nodiscard]] bool goal_opens(std::optional<std::size_t> after) const override;

 protected:
  /// Follows the obstacle whose law demands something and that is met first; nothing where there is none.
  void attend(const Instant& now);

  std::vector<Engagement> engagements_;
  const Engagement* attended_ = nullptr;
  Homing homing_;

 private:
  const Pilot& pilot_;
  const Scenario& scenario_;
  bool log_;
};

}  // namespace vericone::simulation
