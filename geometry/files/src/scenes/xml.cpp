// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/files/xml.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

namespace vericone::xml {
namespace {

constexpr int kMostLevels = 50;
constexpr std::size_t kMostElements = 500'000;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_name(char c) {
  return !is_blank(c) && c != '<' && c != '>' && c != '/' && c != '=' && c != '"' && c != '\'' && c != '&' &&
         c != 0;
}

/// What stands in a message: one line, not too long.
std::string in_line(std::string_view text) {
  std::string line(text.substr(0, 40));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return line + (text.size() > 40 ? "..." : "");
}

void append_utf8(std::string& text, unsigned long code) {
  const auto add = [&](unsigned long byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xc0 | code >> 6);
  } else {
    if (code < 0x10000) {
      add(0xe0 | code >> 12);
    } else {
      add(0xf0 | code >> 18);
      add(0x80 | (code >> 12 & 0x3f));
    }
    add(0x80 | (code >> 6 & 0x3f));
  }
  add(0x80 | (code & 0x3f));
}

struct Delimited {
  const char *begin, *end, *what;
};

class XmlReader {
 public:
  explicit XmlReader(const std::string& text) : text_(text) {}

  Element document() {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    skip_between();
    if (ended() || peek() != '<') refuse(line_, ended() ? "nothing" : in_line(rest()), "an element");
    Element root = element(1);
    skip_between();
    if (!ended()) refuse(line_, in_line(rest()), "the end of the file after its outermost element");
    return root;
  }

 private:
  bool ended() const { return at_ >= text_.size(); }
  char peek() const { return text_[at_]; }
  std::string_view rest() const { return std::string_view(text_).substr(at_); }
  bool starts(const char* with) const { return rest().starts_with(with); }

  void advance(std::size_t count) {
    line_ += int(
        std::count(text_.begin() + std::ptrdiff_t(at_), text_.begin() + std::ptrdiff_t(at_ + count), '\n'));
    at_ += count;
  }
  void skip_blanks() {
    while (!ended() && is_blank(peek())) advance(1);
  }

  /// Over comments and instructions to programs; false where none is there.
  bool skip_other() {
    for (const auto& [begin, end, what] :
         {Delimited{"<!--", "-->", "a comment"}, Delimited{"<?", "?>", "an instruction"}})
      if (starts(begin)) {
        const std::size_t found = text_.find(end, at_ + std::strlen(begin));
        if (found == std::string::npos)
          refuse(line_, std::string(what) + " that does not end", std::string("ended by ") + end);
        advance(found + std::strlen(end) - at_);
        return true;
      }
    if (starts("<!") && !starts("<![CDATA["))
      refuse(line_, in_line(rest()), "left out: declarations of document types and entities are not read");
    return false;
  }
  void skip_between() {
    do skip_blanks();
    while (!ended() && skip_other());
  }

  std::string name(const char* what) {
    const std::size_t begin = at_;
    while (!ended() && is_name(peek())) ++at_;
    if (at_ == begin) refuse(line_, ended() ? "the end of the file" : in_line(rest()), what);
    return text_.substr(begin, at_ - begin);
  }

  /// Up to `end`, with its five entities and numbers of characters.
  std::string characters(std::size_t end) {
    std::string out;
    while (at_ < end) {
      const std::size_t next = std::min(text_.find('&', at_), end);
      out.append(text_, at_, next - at_);
      advance(next - at_);
      if (at_ < end) out += entity();
    }
    return out;
  }
  std::string entity() {
    const std::size_t end = text_.find(';', at_);
    constexpr std::size_t kLongest = 12;
    if (end != std::string::npos && end - at_ < kLongest) {
      const std::string given = text_.substr(at_ + 1, end - at_ - 1);
      const std::pair<const char*, const char*> known[] = {
          {"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"apos", "'"}};
      for (const auto& [entity_name, meant] : known)
        if (given == entity_name) return advance(end + 1 - at_), meant;
      if (given.starts_with('#')) {
        const bool hex = given.size() > 1 && given[1] == 'x';
        const char *first = given.data() + (hex ? 2 : 1), *last = given.data() + given.size();
        unsigned long code = 0;
        const auto [stop, error] = std::from_chars(first, last, code, hex ? 16 : 10);
        if (error == std::errc() && stop == last && code > 0 && code < 0x110000) {
          std::string text;
          append_utf8(text, code);
          return advance(end + 1 - at_), text;
        }
      }
    }
    refuse(line_, in_line(rest()), "one of &lt; &gt; &amp; &quot; &apos; or the number of a character");
  }

  void attributes(Element& element) {
    for (;;) {
      skip_blanks();
      if (ended()) refuse(line_, "the end of the file", "the end of the element " + in_line(element.name));
      if (peek() == '>' || starts("/>")) return;
      std::string attribute_name = name("an attribute or the end of an element");
      skip_blanks();
      if (ended() || peek() != '=') refuse(line_, in_line(attribute_name), "an attribute with = and a value");
      advance(1);
      skip_blanks();
      if (ended() || (peek() != '"' && peek() != '\''))
        refuse(line_, in_line(rest()), "the value of " + in_line(attribute_name) + " in quotation marks");
      const char mark = peek();
      advance(1);
      const std::size_t end = text_.find(mark, at_);
      if (end == std::string::npos) refuse(line_, in_line(attribute_name), "a value that ends");
      if (element.attribute(attribute_name)) refuse(line_, in_line(attribute_name), "given once");
      std::string value = characters(end);
      advance(1);
      element.attributes.emplace_back(std::move(attribute_name), std::move(value));
    }
  }

  Element element(int level) {
    if (level > kMostLevels)
      refuse(line_, "more levels", "at most " + std::to_string(kMostLevels) + " elements within one another");
    if (++count_ > kMostElements) refuse(line_, "more elements", "at most " + std::to_string(kMostElements));
    Element result;
    result.line = line_;
    advance(1);
    result.name = name("the name of an element");
    attributes(result);
    if (starts("/>")) return advance(2), result;
    advance(1);
    for (;;) {
      const std::size_t next = std::min(text_.find('<', at_), text_.size());
      result.text += characters(next);
      if (ended())
        refuse(line_, "the end of the file",
               "</" + in_line(result.name) + ">, of line " + std::to_string(result.line));
      if (starts("</")) break;
      if (starts("<![CDATA[")) {
        const std::size_t end = text_.find("]]>", at_);
        if (end == std::string::npos) refuse(line_, "CDATA that does not end", "ended by ]]>");
        result.text.append(text_, at_ + 9, end - at_ - 9);
        advance(end + 3 - at_);
      } else if (!skip_other()) {
        result.children.push_back(element(level + 1));
      }
    }
    advance(2);
    const std::string ended_name = name("the name of an element");
    skip_blanks();
    if (ended_name != result.name || ended() || peek() != '>')
      refuse(line_, "</" + in_line(ended_name),
             "</" + in_line(result.name) + ">, of line " + std::to_string(result.line));
    advance(1);
    return result;
  }

  const std::string& text_;
  std::size_t at_ = 0, count_ = 0;
  int line_ = 1;
};

}  // namespace

const std::string* Element::attribute(const std::string& wanted) const {
  for (const auto& [key, value] : attributes)
    if (key == wanted) return &value;
  return nullptr;
}

const Element* Element::child(const std::string& wanted) const {
  for (const Element& one : children)
    if (one.name == wanted) return &one;
  return nullptr;
}

void refuse(int line, const std::string& value, const std::string& requirement) {
  std::string in_one_line = value;
  for (char& c : in_one_line)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  throw InputError("line " + std::to_string(line), in_one_line, requirement);
}

Element parse(const std::string& text) {
  if (text.find('\0') != std::string::npos) refuse(1, "a byte 0", "XML, as text");
  return XmlReader(text).document();
}

}  // namespace vericone::xml
