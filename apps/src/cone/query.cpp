// SPDX-License-Identifier: BSD-3-Clause
#include "cone/query.h"

#include <filesystem>

#include "command/cases.h"
#include "cone/answer.h"
#include "input/body.h"
#include "json/json_value.h"

namespace vericone {

int run_query(const std::string& path, bool with_rung, std::ostream& out) {
  const std::filesystem::path folder = path == "-" ? "" : std::filesystem::path(path).parent_path();
  return answer_cases(
      path,
      [&](const Json& value) {
        return answer(input::read_engagement(value, input::Velocities::required, {"id"}, folder), with_rung);
      },
      out);
}

}  // namespace vericone
