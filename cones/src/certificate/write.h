// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers and lists as they stand in a certificate (docs/reference/certificates.md).
#pragma once

#include <string>
#include <string_view>

#include "certificate/grid.h"

namespace vericone::certificates {

/// JSON text that grows.
class Text {
 public:
  Text& raw(std::string_view json) {
    text_ += json;
    return *this;
  }
  Text& number(double x);
  Text& number(const Eigen::Vector3d& v);
  Text& number(const Integer& x) { return number(x, 0); }
  /// x 2^exponent: as a double where it is one, else as a fraction.
  Text& number(const Integer& x, int exponent);
  Text& number(const Dyadic& x) { return number(x.numerator, -static_cast<int>(x.exponent)); }
  Text& number(const Vector& v, int exponent = 0);
  /// x 2^exponent.
  Text& number(const Rational& x, int exponent = 0);
  Text& index(std::size_t i) { return raw(std::to_string(i)); }

  [[nodiscard]] std::string take() { return std::move(text_); }
  void reserve(std::size_t size) { text_.reserve(size); }

 private:
  std::string text_;
};

}  // namespace vericone::certificates
