// SPDX-License-Identifier: BSD-3-Clause
#include "measures/expression.h"

#include <muParser.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "input/fields.h"

namespace vericone::paper {

struct Expression::Parser {
  mu::Parser formula;
  std::vector<double> slots;  // the formula reads its names here
};

namespace {

constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
constexpr const char* kDigits = "0123456789";

double degrees(double x) { return x * (180 / std::numbers::pi); }
double radians(double x) { return x * (std::numbers::pi / 180); }
double known(double x) { return std::isnan(x) ? 0 : 1; }
double negated(double x) { return x == 0 ? 1 : 0; }
double hypotenuse(double x, double y) { return std::hypot(x, y); }
double shortened(double x) { return std::trunc(x); }

void define(mu::Parser& formula) {
  // A dot joins the name of a table beside this one and its column.
  formula.DefineNameChars((std::string(kDigits) + kLetters + ".").c_str());
  formula.DefineConst("pi", std::numbers::pi);
  formula.DefineConst("nothing", std::numeric_limits<double>::quiet_NaN());
  formula.DefineFun("degrees", degrees);
  formula.DefineFun("radians", radians);
  formula.DefineFun("known", known);
  formula.DefineFun("hypot", hypotenuse);
  formula.DefineFun("trunc", shortened);
  formula.DefineInfixOprt("!", negated);
}

}  // namespace

Expression::Expression(const Json& given, std::string path)
    : parser_(std::make_shared<Parser>()), path_(std::move(path)) {
  if (!given.is_string() && !given.is_number())
    throw InputError(path_, input::quoted(given), "a number or a formula, as text");
  mu::Parser& formula = parser_->formula;
  define(formula);
  try {
    formula.SetExpr(given.is_string() ? given.get<std::string>() : to_text(given.get<double>()));
    for (const auto& [name, unused] : formula.GetUsedVar()) names_.push_back(name);
    parser_->slots.resize(names_.size());
    for (std::size_t i = 0; i < names_.size(); ++i) formula.DefineVar(names_[i], &parser_->slots[i]);
    formula.Eval();
  } catch (const mu::Parser::exception_type& e) {
    throw InputError(path_, input::quoted(given), "a formula: " + e.GetMsg());
  }
}

double Expression::value(std::span<const double> values) const {
  std::copy(values.begin(), values.end(), parser_->slots.begin());
  return parser_->formula.Eval();
}

bool is_name(const std::string& text) {
  return !text.empty() && std::string(kLetters).find(text[0]) != std::string::npos &&
         text.find_first_not_of(std::string(kLetters) + kDigits) == std::string::npos;
}

}  // namespace vericone::paper
