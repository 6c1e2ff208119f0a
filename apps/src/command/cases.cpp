// SPDX-License-Identifier: BSD-3-Clause
#include "command/cases.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "input/text_source.h"
#include "json/json_value.h"
#include "output/interrupt.h"

namespace vericone {
namespace {

std::string name_of(std::size_t number) { return "line " + std::to_string(number); }

/// What a look at the characters of a line tells before it is parsed.
struct Outline {
  int levels = 0;       // of lists and mappings within one another
  std::string_view id;  // the value of the outermost field "id", as written
};

Outline outline_of(std::string_view line) {
  Outline outline;
  int level = 0;
  std::size_t text = 0, value = 0;  // where the text or the id that is being read begins
  bool in_text = false, key_next = false, is_id = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c != '"') continue;
      in_text = false;
      if (level == 1 && key_next) is_id = line.substr(text, i - text) == "id";
      key_next = false;
    } else if (c == '"') {
      in_text = true;
      text = i + 1;
    } else if (c == '{' || c == '[') {
      key_next = c == '{';
      outline.levels = std::max(outline.levels, ++level);
    } else if (c == ':' && level == 1 && is_id) {
      value = i + 1;
    } else if (c == ',' || c == '}' || c == ']') {
      if (level == 1 && is_id && value > 0) {
        outline.id = line.substr(value, i - value);
        value = 0;
        is_id = false;
      }
      key_next = c == ',';
      if (c != ',') --level;
    }
  }
  return outline;
}

/// Builds the value of a line and looks at the keys of its mappings. (The parser's own callbacks look through
/// a list again whenever one of its values ends.)
class LineBuilder : public nlohmann::detail::json_sax_dom_parser<Json> {
  using Base = nlohmann::detail::json_sax_dom_parser<Json>;

 public:
  LineBuilder(Json& value, std::size_t number) : Base(value), number_(number) {}

  bool start_object(std::size_t size) {
    keys_.emplace_back();
    return Base::start_object(size);
  }
  bool key(std::string& key) {
    std::vector<std::string>& known = keys_.back();
    if (std::find(known.begin(), known.end(), key) != known.end()) twice_ = key;
    // Every key is compared with those before it.
    if (known.size() == input::kMostFields)
      throw InputError(name_of(number_), "a mapping of more than " + std::to_string(known.size()) + " fields",
                       "one JSON object of fewer");
    known.push_back(key);
    return Base::key(key);
  }
  bool end_object() {
    keys_.pop_back();
    return Base::end_object();
  }

  const std::string& twice() const { return twice_; }

 private:
  std::size_t number_;
  std::vector<std::vector<std::string>> keys_;
  std::string twice_;
};

/// Parses one line; a key given twice is refused, since only one of the two would be used.
Json parse_line(const std::string& line, std::size_t number, int levels) {
  if (levels > input::kMostLevels)
    throw InputError(name_of(number), std::to_string(levels) + " levels of lists and mappings",
                     "nested at most " + std::to_string(input::kMostLevels) + " deep");
  // The parser takes this character for the end.
  if (const auto zero = line.find('\0'); zero != std::string::npos)
    throw InputError(name_of(number), "a zero byte at character " + std::to_string(zero + 1),
                     "one JSON object");
  try {
    Json value;
    LineBuilder builder(value, number);
    Json::sax_parse(line, &builder);
    if (!builder.twice().empty()) throw InputError(builder.twice(), "given twice", "given once");
    return value;
  } catch (const Json::parse_error& e) {
    throw InputError(name_of(number),
                     "a text that breaks off or turns wrong at character " + std::to_string(e.byte),
                     "one JSON object");
  } catch (const Json::out_of_range&) {
    throw InputError(name_of(number), "a number out of range", "one JSON object with numbers up to 1.8e308");
  }
}

/// A value as written, on one line and without the space around it. (Within texts these characters are
/// written as escapes.)
std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  std::string value(text.substr(first, last - first + 1));
  std::replace_if(
      value.begin(), value.end(), [](char c) { return c == '\t' || c == '\r'; }, ' ');
  return value;
}

std::string answer_line(const std::string& line, std::size_t number, const Answer& answer, bool& bad) {
  Json result = Json::object();
  std::string id = "null";
  try {
    const Outline outline = outline_of(line);
    const Json value = parse_line(line, number, outline.levels);
    // As written, digit for digit: a number may have more of them than a double. A name that needs no reading
    // (no escapes) is found by the outline.
    if (value.is_object() && value.contains("id"))
      id = outline.id.empty() ? value["id"].dump() : trimmed(outline.id);
    result.update(answer(value));
  } catch (const InputError& e) {
    bad = true;
    result["error"] = e.what();
  }
  return "{\"id\":" + id + "," + result.dump(-1, ' ', false, Json::error_handler_t::replace).substr(1);
}

}  // namespace

Json parse_case(const std::string& line, std::size_t number) {
  return parse_line(line, number, outline_of(line).levels);
}

int answer_cases(const std::string& path, const Answer& answer, std::ostream& out) {
  input::TextSource cases(path, "a file of cases, one JSON object a line, or - for standard input");
  bool bad = false;
  std::string line;
  // A consumer that feeds line by line waits for each answer.
  const auto flush = [&] { out.flush(); };
  for (std::size_t number = 1; !interrupted() && cases.next_line(line, flush); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    out << answer_line(line, number, answer, bad) << '\n';
    if (!out) throw std::runtime_error("standard output was closed");
  }
  out.flush();
  if (interrupted()) return kExitInterrupted;
  return bad ? 2 : 0;
}

}  // namespace vericone
