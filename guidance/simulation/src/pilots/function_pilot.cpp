// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/flying_pilot.h>
#include <utility>

namespace vericone::simulation {
namespace {

class FlyingFunction : public FlyingPilot {
 public:
  explicit FlyingFunction(const Steering& steering) : steering_(steering) {}

  void command(const Instant& now, std::span<VehicleCommand> commands, Run&) override {
    others_.clear();
    for (std::size_t i = 0; i < now.bodies.size(); ++i)
      if (i != now.self && now.there(i)) others_.push_back(now.bodies[i]);
    const Eigen::Vector3d said = steering_(now.t, now.own(), others_);
    if (!said.allFinite()) throw InputError("acceleration", "a number that is not finite", "finite (m/s^2)");
    commands[now.self].acceleration = said;
  }

 private:
  const Steering& steering_;
  std::vector<guidance::BodyState> others_;
};

class FunctionPilot : public PilotModel {
 public:
  explicit FunctionPilot(Steering steering) : steering_(std::move(steering)) {}
  std::unique_ptr<FlyingPilot> launch(const Scenario&, std::size_t, const RunOptions&) const override {
    return std::make_unique<FlyingFunction>(steering_);
  }
  bool may_rest() const override { return true; }

 private:
  Steering steering_;
};

}  // namespace

std::shared_ptr<const PilotModel> pilot_by(Steering steering) {
  return std::make_shared<FunctionPilot>(std::move(steering));
}

}  // namespace vericone::simulation
