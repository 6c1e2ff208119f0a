// SPDX-License-Identifier: BSD-3-Clause
//
// Pilots of one's own: when they are asked, what they are told, and that what they fly is proved.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/run.h>
#include <cmath>
#include <limits>

namespace vericone::simulation::pilot_test {
namespace {

using Eigen::Vector3d;
using guidance::BodyState;

Body ball(const std::string& name, double radius, const Vector3d& position, const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape =
      RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(radius)))};
  body.start.position = position;
  body.start.velocity = velocity;
  return body;
}

/// Two that meet each other head on, and a third that comes later.
Scenario meeting() {
  Scenario scenario;
  scenario.duration = 4;
  scenario.step = 0.05;
  scenario.bodies = {ball("A", 1, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {30, 0, 0}, {-5, 0, 0}),
                     ball("late", 0.5, {0, 40, 0}, {0, -1, 0})};
  scenario.bodies[2].appears = 1.025;  // between two commands
  return scenario;
}

TEST(FunctionPilot, FliesBesideALawAndIsProved) {
  Scenario scenario = meeting();
  std::vector<double> times;
  const auto aside = [&](double t, const BodyState& agent, const std::vector<BodyState>& others) {
    times.push_back(t);
    EXPECT_EQ(others.size(), t < 1.025 ? 1u : 2u);
    EXPECT_EQ(others[0].position.y(), 0);
    EXPECT_NEAR(agent.velocity.norm(), 5, 1e-9);
    return t < 1 ? Vector3d(Vector3d::UnitZ().cross(agent.velocity)) : Vector3d::Zero().eval();
  };
  scenario.bodies[0].pilot.emplace().own = pilot_by(aside);
  Pilot& other = scenario.bodies[2].pilot.emplace();
  other.guide.law = guidance::Law::clearance;
  other.guide.clearance.most = 5;
  const auto run = simulate(scenario);
  ASSERT_EQ(times.size(), 81u);  // at every step, and where a body appears
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
  EXPECT_NEAR(run.tracks[0].acceleration(0.01).norm(), 5, 1e-9);
  EXPECT_EQ(run.tracks[0].acceleration(1.5).norm(), 0);
  for (const PairOutcome& pair : run.proofs) EXPECT_EQ(pair.proof.verdict, ProofVerdict::avoided);
  scenario.bodies[0].pilot->own =
      pilot_by([](double, const BodyState&, const auto&) { return Vector3d::Zero().eval(); });
  EXPECT_EQ(simulate(scenario).verdict(), ProofVerdict::touched);
}

TEST(FunctionPilot, IsRefusedWhatIsNotFinite) {
  Scenario scenario = meeting();
  scenario.bodies[0].pilot.emplace().own = pilot_by([](double, const BodyState&, const auto&) {
    return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()).eval();
  });
  try {
    static_cast<void>(simulate(scenario));
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "acceleration");
  }
}

/// Notes what it is asked, and commands a partner.
class Noting : public PilotModel {
 public:
  std::unique_ptr<FlyingPilot> launch(const Scenario&, std::size_t self, const RunOptions&) const override {
    EXPECT_EQ(self, 0u);
    return std::make_unique<Flying>(*this);
  }
  double required(const std::string& other) const override { return other == "B" ? 0.25 : 0; }
  mutable std::string asked;
  mutable int with_goal = 0, without = 0;

 private:
  struct Flying : FlyingPilot {
    explicit Flying(const Noting& model) : noting(model) {}
    void look(const Instant&) override { noting.asked += 'l'; }
    void report(const Instant&, Run&) override { noting.asked += 'r'; }
    void command(const Instant& now, std::span<VehicleCommand> commands, Run&) override {
      noting.asked += 'c';
      ++(now.goal ? noting.with_goal : noting.without);
      EXPECT_EQ(now.vehicle, nullptr);
      EXPECT_EQ(now.own().position, now.tracks[0].motion(now.t).position);
      commands[1].acceleration = {0, 2, 0};
    }
    void log(const Instant&, Run&) override { noting.asked += 'g'; }
    void moved(const Instant& now, Run&) override {
      noting.asked += 'm';
      EXPECT_EQ(now.tracks[0].end(), now.until);
      if (now.t >= 0.5) open = true;
    }
    bool goal_opens(std::optional<std::size_t> after) const override {
      EXPECT_EQ(after, 1u);
      return open;
    }
    const Noting& noting;
    bool open = false;
  };
};

TEST(PilotModel, IsAskedInOrderAndToldOfItsGoal) {
  Scenario scenario = meeting();
  scenario.duration = 0.8;
  scenario.bodies.pop_back();
  const auto noting = std::make_shared<Noting>();
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.own = noting;
  pilot.partners = {"B"};
  pilot.goals = {Goal{{100, 0, 0}, 1, "B", 1, Vector3d::Zero(), ""}};
  const auto run = simulate(scenario);
  std::string expected;
  for (int i = 0; i < 16; ++i) expected += "lrcgm";
  EXPECT_EQ(noting->asked, expected);
  EXPECT_EQ(noting->without, 11);  // opened at the end of the step that begins at 0.5 s
  EXPECT_EQ(noting->with_goal, 5);
  EXPECT_NEAR(run.tracks[1].acceleration(0.4).norm(), 2, 1e-12);
  ASSERT_EQ(run.proofs.size(), 1u);
  EXPECT_EQ(run.proofs[0].required, 0.25);
}

}  // namespace
}  // namespace vericone::simulation::pilot_test
