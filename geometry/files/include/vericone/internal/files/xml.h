// SPDX-License-Identifier: BSD-3-Clause
//
// XML as robots and meshes are described in it: elements, attributes and text. Declarations of document
// types, and with them entities and other files, are refused.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vericone::xml {

struct Element {
  std::string name;
  int line = 0;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Element> children;
  std::string text;  // of its own, joined

  /// Null where there is none.
  [[nodiscard]] const std::string* attribute(const std::string& wanted) const;
  /// The first of this name; null where there is none.
  [[nodiscard]] const Element* child(const std::string& wanted) const;
};

/// What is wrong in a line of a file, and what would be right: an InputError of the field "line N".
[[noreturn]] void refuse(int line, const std::string& value, const std::string& requirement);

/// The outermost element. Throws InputError of refuse(). Memory: some ten times the text, at most 500,000
/// elements, 50 within one another.
[[nodiscard]] Element parse(const std::string& text);

}  // namespace vericone::xml
