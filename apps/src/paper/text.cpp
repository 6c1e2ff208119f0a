// SPDX-License-Identifier: BSD-3-Clause
#include "paper/text.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "input/field_table.h"
#include "input/fields.h"

namespace vericone::paper {

std::string short_text(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value == 0 ? 0.0 : value);
  return text;
}

std::vector<Text::Piece> Text::pieces_of(const std::string& text, const std::string& path) {
  std::vector<Piece> pieces(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '{') {
      pieces.back().words += text[i];
      continue;
    }
    const std::size_t end = text.find('}', i);
    if (end == std::string::npos) throw InputError(path, input::quoted(text), "text whose braces are closed");
    std::string inner = text.substr(i + 1, end - i - 1);
    i = end;
    // "x:3": three digits. Formulas have a colon after a question mark only.
    const std::size_t colon = inner.rfind(':');
    const std::string digits = colon == std::string::npos ? "" : inner.substr(colon + 1);
    if (!digits.empty() && digits.size() < 3 &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; })) {
      pieces.back().digits = std::max(1, std::min(17, std::stoi(digits)));
      inner.resize(colon);
    }
    pieces.back().number.emplace(inner, path);
    pieces.emplace_back();
  }
  return pieces;
}

Text::Text(const Json& given, const std::string& path) {
  const bool list = given.is_array();
  for (std::size_t i = 0; i < (list ? given.size() : 1); ++i) {
    const Json& part = list ? given[i] : given;
    const std::string place = list ? input::at(path, i) : path;
    if (part.is_string()) {
      parts_.push_back({{}, pieces_of(part.get<std::string>(), place)});
      continue;
    }
    if (!part.is_object()) throw InputError(place, input::quoted(part), "text, or {if: FORMULA, text: ...}");
    input::require_known(part, place, {"if", "text"});
    const Json& words = input::require_field(part, place, "text", "text");
    parts_.push_back({Expression(input::require_field(part, place, "if", "a formula"), place + ".if"),
                      pieces_of(input::text("a sentence").read(words, place + ".text"), place + ".text")});
  }
}

std::vector<std::string> Text::names() const {
  std::vector<std::string> names;
  const auto add = [&](const std::optional<Expression>& formula) {
    if (formula) names.insert(names.end(), formula->names().begin(), formula->names().end());
  };
  for (const Part& part : parts_) {
    add(part.when);
    for (const Piece& piece : part.pieces) add(piece.number);
  }
  return names;
}

std::string Text::written(Measures& measures, Scope& scope) const {
  std::string all;
  for (const Part& part : parts_) {
    if (part.when) {
      const double holds = measures.value(*part.when, scope);
      if (std::isnan(holds) || holds == 0) continue;
    }
    std::string text;
    bool whole = true;
    for (const Piece& piece : part.pieces) {
      text += piece.words;
      if (!piece.number) continue;
      const double x = measures.value(*piece.number, scope);
      whole = whole && !std::isnan(x);
      text += short_text(x, piece.digits);
    }
    if (whole) all += text;
  }
  return all;
}

}  // namespace vericone::paper
