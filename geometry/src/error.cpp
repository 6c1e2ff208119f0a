// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>

#include <array>
#include <charconv>
#include <cmath>

namespace vericone {
namespace {

std::string sentence(const std::string& field, const std::string& value, const std::string& requirement) {
  return field + ": got " + value + ", must be " + requirement;
}

}  // namespace

InputError::InputError(std::string field, std::string value, std::string requirement)
    : std::invalid_argument(sentence(field, value, requirement)),
      field_(std::move(field)),
      value_(std::move(value)),
      requirement_(std::move(requirement)) {}

InputError InputError::within(std::string_view prefix) const {
  const bool joined = field_.empty() || field_.front() == '[';
  return {std::string(prefix) + (joined ? "" : ".") + field_, value_, requirement_};
}

std::string to_text(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  return {buffer.data(), result.ptr};
}

}  // namespace vericone
