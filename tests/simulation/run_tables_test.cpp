// SPDX-License-Identifier: BSD-3-Clause
//
// What a run says as tables, and tables as text.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>

#include <limits>
#include <string>

namespace vericone::simulation::run_tables_test {
namespace {

using Eigen::Vector3d;

Body ball(const std::string& name, const Vector3d& position, const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape = RigidShape{CombinedEllipsoid(Ellipsoid())};
  body.start = {position, velocity, Eigen::Matrix3d::Identity()};
  return body;
}

TEST(Table, TextHasUnitsAndKeepsEveryDigit) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  Table table{"of everything",
              {{"t", "s", false, {0.1, 1e300, nothing}, {}}, {"body", "", true, {}, {"A", "B, C", "\"D\""}}}};
  EXPECT_EQ(table.rows(), 3);
  EXPECT_EQ(csv(table), "t [s],body\n0.1,A\n1e+300,\"B, C\"\n,\"\"\"D\"\"\"\n");
  EXPECT_EQ(csv(Table{"empty", {}}), "");
  EXPECT_EQ(Table{}.rows(), 0);
}

TEST(RunTables, HaveARowForEachBodyAndCommand) {
  Scenario scenario;
  scenario.name = "two";
  scenario.duration = 1;
  scenario.step = 0.25;
  scenario.bodies = {ball("A", {0, 0, 0}, {1, 0, 0}), ball("B", {9, 0, 0}, {-1, 0, 0})};
  scenario.bodies[0].pilot.emplace();
  const simulation::Run run = simulate(scenario);
  const std::vector<Table> tables = run_tables(scenario, run);
  ASSERT_EQ(tables.size(), 3);
  EXPECT_EQ(tables[0].name, "bodies");
  EXPECT_EQ(tables[1].name, "encounters");
  EXPECT_EQ(tables[2].name, "events");
  for (const Table& table : tables)
    for (const Column& column : table.columns) {
      EXPECT_EQ(column.text ? column.words.size() : column.numbers.size(), table.rows())
          << table.name << column.name;
      EXPECT_TRUE((column.text ? column.numbers.size() : column.words.size()) == 0) << column.name;
      EXPECT_EQ(column.name.find('['), std::string::npos);
    }
  EXPECT_EQ(tables[0].rows(), 10);  // five times of two bodies
  EXPECT_EQ(tables[0].columns[0].unit, "s");
  EXPECT_EQ(tables[0].columns[1].words[1], "B");
  EXPECT_EQ(tables[0].columns[2].numbers[9], run.tracks[1].motion(1).position.x());
  EXPECT_EQ(tables[1].rows(), run.encounters.size());
  EXPECT_EQ(tables[2].rows(), run.events.size());
}

TEST(RunTables, OfTheRunOfAnotherScenarioAreRefused) {
  Scenario scenario;
  scenario.duration = 1;
  scenario.step = 0.25;
  scenario.bodies = {ball("A", {0, 0, 0}, {1, 0, 0}), ball("B", {9, 0, 0}, {-1, 0, 0})};
  scenario.bodies[0].pilot.emplace();
  const simulation::Run run = simulate(scenario);
  Scenario other = scenario;
  other.bodies.pop_back();
  EXPECT_THROW((void)run_tables(other, run), InputError);
  other = scenario;
  other.step = 0;
  EXPECT_THROW((void)run_tables(other, run), InputError);
  simulation::Run wrong = run;
  wrong.encounters[0].obstacle = 2;
  EXPECT_THROW((void)run_tables(scenario, wrong), InputError);
  wrong = run;
  wrong.encounters[0].t = 7;
  EXPECT_THROW((void)encounters_table(scenario, wrong), InputError);
  wrong = run;
  wrong.events.push_back({0, EventKind::goes_through, 0, 0, 0});
  EXPECT_THROW((void)events_table(scenario, wrong), InputError);
  EXPECT_THROW((void)obstacle_of(scenario, {0, EventKind::passes, 0, 17, 0}), InputError);
}

}  // namespace
}  // namespace vericone::simulation::run_tables_test
