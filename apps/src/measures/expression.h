// SPDX-License-Identifier: BSD-3-Clause
//
// Arithmetic on named numbers, as papers write it (docs/reference/papers.md, "Formulas"). One file knows the
// parser behind it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone::paper {

/// A formula over names. NaN stands for what does not exist: comparisons with it are 0, arithmetic gives NaN.
class Expression {
 public:
  /// A number or text. Throws InputError naming `path` where it is neither, or no formula.
  Expression(const Json& given, std::string path);

  /// Every name that it uses, once.
  const std::vector<std::string>& names() const { return names_; }
  /// `values`: of the names, in their order.
  double value(std::span<const double> values) const;
  const std::string& path() const { return path_; }

 private:
  struct Parser;
  std::shared_ptr<Parser> parser_;
  std::vector<std::string> names_;
  std::string path_;
};

/// Whether a name may stand in formulas: letters, digits and _, no digit first.
bool is_name(const std::string& text);

}  // namespace vericone::paper
