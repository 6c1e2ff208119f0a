// SPDX-License-Identifier: BSD-3-Clause
#include "command/case_parser.h"

#include <simdjson.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "input/text_source.h"
#include "json/json_value.h"

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
Json parse_line(std::string_view line, std::size_t number, int levels) {
  if (levels > input::kMostLevels)
    throw InputError(name_of(number), std::to_string(levels) + " levels of lists and mappings",
                     "nested at most " + std::to_string(input::kMostLevels) + " deep");
  // The parser takes this character for the end.
  if (const auto zero = line.find('\0'); zero != std::string_view::npos)
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

/// The value of what simdjson read; nothing where a limit does not hold or a field is given twice: then the
/// other parser says so.
bool copy(const simdjson::dom::element& from, int levels, Json& to) {
  using Type = simdjson::dom::element_type;
  switch (from.type()) {
    case Type::OBJECT: {
      if (levels == input::kMostLevels) return false;
      const simdjson::dom::object fields = simdjson::dom::object(from);
      const std::size_t size = fields.size();
      if (size > input::kMostFields) return false;
      to = Json::object();
      auto& list = to.get_ref<Json::object_t&>();
      list.reserve(size);
      for (const auto& [key, value] : fields) {
        for (const auto& known : list)
          if (known.first == key) return false;
        list.emplace_back(std::string(key), Json());
        if (!copy(value, levels + 1, list.back().second)) return false;
      }
      return true;
    }
    case Type::ARRAY: {
      if (levels == input::kMostLevels) return false;
      const simdjson::dom::array values = simdjson::dom::array(from);
      to = Json::array();
      auto& list = to.get_ref<Json::array_t&>();
      list.reserve(values.size());
      for (const simdjson::dom::element value : values)
        if (!copy(value, levels + 1, list.emplace_back())) return false;
      return true;
    }
    case Type::STRING:
      to = std::string(std::string_view(from));
      return true;
    case Type::DOUBLE:
      to = double(from);
      return true;
    case Type::INT64: {
      // What is not negative is unsigned, as the other parser has it.
      const std::int64_t x = from;
      if (x < 0)
        to = x;
      else
        to = std::uint64_t(x);
      return true;
    }
    case Type::UINT64:
      to = std::uint64_t(from);
      return true;
    case Type::BOOL:
      to = bool(from);
      return true;
    case Type::NULL_VALUE:
      to = nullptr;
      return true;
  }
  return false;
}

/// The id where it is written as its value is shown; nothing where one must look.
std::optional<std::string> plain_id(const Json& value) {
  if (!value.is_object()) return "null";
  const auto id = value.find("id");
  if (id == value.end()) return "null";
  if (id->is_string()) return "\"" + id->get_ref<const std::string&>() + "\"";
  if (id->is_number_unsigned() && *id != 0) return id->dump();
  return std::nullopt;
}

}  // namespace

struct CaseParser::Fast {
  simdjson::dom::parser parser{2 * input::kMostBytes};
};

CaseParser::CaseParser() : fast_(std::make_unique<Fast>()) {}
CaseParser::~CaseParser() = default;

Json CaseParser::parse(std::string_view line, std::size_t number, std::string& id) {
  // Escapes are left to the other parser, so that an id without any is as written.
  const bool escapes = std::memchr(line.data(), '\\', line.size()) != nullptr;
  simdjson::dom::element root;
  Json value;
  if (escapes || fast_->parser.parse(line.data(), line.size(), false).get(root) != simdjson::SUCCESS ||
      !copy(root, 0, value))
    return parse_case_slowly(line, number, id);
  auto plain = plain_id(value);
  id = plain ? std::move(*plain) : trimmed(outline_of(line).id);
  return value;
}

Json parse_case_slowly(std::string_view line, std::size_t number, std::string& id) {
  id = "null";
  const Outline outline = outline_of(line);
  Json value = parse_line(line, number, outline.levels);
  // A name that needs no reading (no escapes) is found by the outline.
  if (value.is_object() && value.contains("id"))
    id = outline.id.empty() ? value["id"].dump() : trimmed(outline.id);
  return value;
}

}  // namespace vericone
