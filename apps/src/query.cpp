// SPDX-License-Identifier: BSD-3-Clause
#include "query.h"

#include <vericone/geometry/error.h>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "answer.h"
#include "json_value.h"

namespace vericone {
namespace {

/// Parses one line; a key given twice is refused, since only one of the two would be used.
Json parse_line(const std::string& line, std::size_t number) {
  std::vector<std::vector<std::string>> keys;
  std::string twice;
  const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key) {
      const auto key = parsed.get<std::string>();
      if (std::find(keys.back().begin(), keys.back().end(), key) != keys.back().end()) twice = key;
      keys.back().push_back(key);
    }
    return true;
  };
  const std::string where = "line " + std::to_string(number);
  try {
    Json value = Json::parse(line, watch);
    if (!twice.empty()) throw InputError(twice, "given twice", "given once");
    return value;
  } catch (const Json::parse_error& e) {
    throw InputError(where, "a text that breaks off or turns wrong at character " + std::to_string(e.byte),
                     "one JSON object");
  } catch (const Json::out_of_range&) {
    throw InputError(where, "a number out of range", "one JSON object with numbers up to 1.8e308");
  }
}

Json answer_line(const std::string& line, std::size_t number, bool with_rung,
                 const std::filesystem::path& folder, bool& bad) {
  Json result;
  result["id"] = nullptr;
  try {
    const Json value = parse_line(line, number);
    if (value.is_object() && value.contains("id")) result["id"] = value["id"];
    result.update(
        answer(input::read_engagement(value, input::Velocities::required, {"id"}, folder), with_rung));
  } catch (const InputError& e) {
    bad = true;
    result["error"] = e.what();
  }
  return result;
}

}  // namespace

Json parse_case(const std::string& line, std::size_t number) { return parse_line(line, number); }

int run_query(const std::string& path, bool with_rung, std::ostream& out) {
  std::ifstream file;
  if (path != "-") {
    file.open(path);
    if (!file)
      throw InputError(path, "no readable file",
                       "a file of cases, one JSON object a line, or - for standard input");
  }
  std::istream& in = path == "-" ? std::cin : file;
  const std::filesystem::path folder = path == "-" ? "" : std::filesystem::path(path).parent_path();
  bool bad = false;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    out << answer_line(line, number, with_rung, folder, bad)
               .dump(-1, ' ', false, Json::error_handler_t::replace)
        << '\n';
    // A consumer that feeds line by line waits for each answer.
    if (path == "-" && in.rdbuf()->in_avail() <= 0) out.flush();
    if (!out) throw std::runtime_error("standard output was closed");
  }
  out.flush();
  return bad ? 2 : 0;
}

}  // namespace vericone
