// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace vericone {

/// An input that no answer exists for. Beside it the library throws std::system_error where a file cannot be
/// written, and Interrupted (stop.h) where it was asked to stop.
///
/// `what()` is one line, "FIELD: got VALUE, must be REQUIREMENT", for example
/// "obstacle.semi_axes[1]: got -2, must be a positive finite number". Overlapping bodies, grazing
/// velocities and receding bodies are answers; only what has no value for them, as the edges of a cone,
/// throws.
class InputError : public std::invalid_argument {
 public:
  InputError(std::string field, std::string value, std::string requirement);

  [[nodiscard]] const std::string& field() const { return field_; }
  [[nodiscard]] const std::string& value() const { return value_; }
  [[nodiscard]] const std::string& requirement() const { return requirement_; }

  /// The same error with `prefix` before the field: "semi_axes[1]" becomes "obstacle.semi_axes[1]".
  [[nodiscard]] InputError within(std::string_view prefix) const;

 private:
  std::string field_, value_, requirement_;
};

/// Shortest decimal text that reads back as `x`; "nan", "inf", "-inf" otherwise.
[[nodiscard]] std::string to_text(double x);

}  // namespace vericone
