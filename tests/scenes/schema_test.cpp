// SPDX-License-Identifier: BSD-3-Clause
//
// The schemas in docs/schemas are what the tables of fields say.
#include <gtest/gtest.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenarios/schema.h"

namespace vericone::schema_test {
namespace {

TEST(Schemas, OfScenariosAreTheirTables) {
  std::ifstream file(VERICONE_SCHEMAS "/scenario.schema.json");
  const nlohmann::json written = nlohmann::json::parse(file);
  const nlohmann::json tables = nlohmann::json::parse(scenario::scenario_schema().dump());
  for (const auto& [name, node] : tables["$defs"].items()) EXPECT_EQ(written["$defs"][name], node) << name;
  EXPECT_EQ(written["properties"], tables["properties"]);
  EXPECT_EQ(written["required"], tables["required"]);
}

}  // namespace
}  // namespace vericone::schema_test
