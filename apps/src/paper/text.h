// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measures/measure.h"

namespace vericone::paper {

/// Sentences with measured numbers in braces (docs/reference/papers.md, "Texts").
class Text {
 public:
  Text() = default;
  /// Text, or a list of parts: text, or {if: FORMULA, text: ...}. Throws InputError naming `path`.
  Text(const Json& given, const std::string& path);

  /// Without the parts whose condition is not met, or one of whose numbers does not exist.
  std::string written(Measures& measures, Scope& scope) const;
  /// Every name that its numbers and conditions use.
  std::vector<std::string> names() const;

 private:
  struct Piece {
    std::string words;  // before the number
    std::optional<Expression> number;
    int digits = 5;
  };
  struct Part {
    std::optional<Expression> when;
    std::vector<Piece> pieces;
  };
  std::vector<Part> parts_;

  static std::vector<Piece> pieces_of(const std::string& text, const std::string& path);
};

/// At most `digits` significant digits.
std::string short_text(double value, int digits = 5);

}  // namespace vericone::paper
