// SPDX-License-Identifier: BSD-3-Clause
//
// Two parsers of one line: what the fast one says is what the other says, value, id and message.
#include <gtest/gtest.h>

#include <vericone/geometry/error.h>
#include <random>
#include <string>

#include "command/case_parser.h"
#include "json/json_value.h"

namespace vericone {
namespace {

/// The value with the types of its numbers, and the id; or the message.
template <typename Parse>
std::string told(Parse parse) {
  std::string id;
  try {
    const Json value = parse(id);
    std::string text = id + " " + value.dump(-1, ' ', false, Json::error_handler_t::replace);
    const Json numbers = value.flatten();
    for (const Json& x : numbers) text += std::string(" ") + x.type_name();
    return text;
  } catch (const InputError& e) {
    return e.what();
  } catch (const Json::type_error&) {  // flatten() of a list
    return "no object, id " + id;
  }
}

class CaseParserTest : public testing::Test {
 protected:
  void same(const std::string& line) {
    std::string padded = line;
    padded.reserve(line.size() + kCasePadding);
    const auto fast = told([&](std::string& id) {
      return parser_.parse({padded.data(), line.size()}, 7, id);
    });
    const auto slow = told([&](std::string& id) { return parse_case_slowly(line, 7, id); });
    EXPECT_EQ(fast, slow) << line;
  }

  CaseParser parser_;
};

TEST_F(CaseParserTest, NumbersAndIdsAsWritten) {
  for (const std::string x : {"0",
                              "-0",
                              "-0.0",
                              "1",
                              "-1",
                              "1.0",
                              "1e5",
                              "1E+5",
                              "0.1",
                              "5e-324",
                              "2e-324",
                              "1e-400",
                              "1e400",
                              "-1e400",
                              "18446744073709551615",
                              "18446744073709551616",
                              "-9223372036854775808",
                              "-9223372036854775809",
                              "123456789012345678901234567890",
                              "9007199254740993",
                              "0.30000000000000004441",
                              "1.7976931348623157e308",
                              "1.7976931348623159e308",
                              "01",
                              "1.",
                              ".5",
                              "+1",
                              "-",
                              "1e",
                              "NaN",
                              "Infinity",
                              "0x10",
                              "null",
                              "true",
                              "false",
                              "\"\"",
                              "\"a\"",
                              "\"\\u0041\"",
                              "\"\\ud800\"",
                              "\"\\\"\"",
                              "\"\xc3\xa9\"",
                              "\"\xff\"",
                              "\"\x01\"",
                              "[1,2]",
                              "{\"a\":1}",
                              "[]",
                              "{}"})
    for (const std::string form : {"{\"id\": X}", "{\"id\":X,\"v\":[X, 1]}", "{ \"v\" : X , \"id\" :\tX }",
                                   "{\"v\":{\"id\":X}}", "X", "[X]", "{\"id\":7,\"v\":X,\"v\":X}"}) {
      std::string line = form;
      for (auto at = line.find('X'); at != std::string::npos; at = line.find('X', at + x.size()))
        line.replace(at, 1, x);
      same(line);
    }
}

TEST_F(CaseParserTest, Limits) {
  for (const int levels : {1, 19, 20, 21, 22}) {
    same(std::string(std::size_t(levels), '[') + std::string(std::size_t(levels), ']'));
    same("{\"id\":1,\"v\":" + std::string(std::size_t(levels), '[') + std::string(std::size_t(levels), ']') +
         "}");
  }
  for (const int fields : {99, 100, 101}) {
    std::string line = "{\"id\":1";
    for (int i = 1; i < fields; ++i) line += ",\"f" + std::to_string(i) + "\":0";
    same(line + "}");
  }
  same(std::string("{\"id\":1}\0", 9));
  same(std::string("{\"id\":\"\0\"}", 10));
  same("{\"id\":1} {\"id\":2}");
  same("\xef\xbb\xbf{\"id\":1}");
}

/// Characters taken out, put in, doubled and exchanged in good lines.
TEST_F(CaseParserTest, MutatedLines) {
  std::mt19937_64 random(1);
  const std::string good =
      R"({"id": "a b", "agent": {"center": [0.5, -1e3, 7], "semi_axes": [1, 2, 3]}, "x": [true, null, {}]} )";
  const std::string put = "{}[]\",:0123456789.eE+-\\ \t\rnul\xc3\xa9\x7f\x80trueid";
  for (int i = 0; i < 20'000; ++i) {
    std::string line = good;
    for (std::uint64_t k = random() % 4; k < 4 && !line.empty(); ++k) {
      const std::size_t at = random() % line.size();
      switch (random() % 4) {
        case 0:
          line.erase(at, 1 + random() % 3);
          break;
        case 1:
          line.insert(at, 1, put[random() % put.size()]);
          break;
        case 2:
          line.insert(at, line.substr(random() % line.size(), random() % 12));
          break;
        default:
          line[at] = put[random() % put.size()];
      }
    }
    same(line);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace vericone
