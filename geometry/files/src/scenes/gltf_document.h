// SPDX-License-Identifier: BSD-3-Clause
//
// A glTF file's JSON and the bytes that it names, each read checked.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "../source.h"

namespace vericone::files {

/// A value of the JSON and where it stands, for messages. What is missing or of another type is refused.
class GltfValue {
 public:
  GltfValue(const Source& source, const nlohmann::json* value, std::string where)
      : source_(&source), value_(value), where_(std::move(where)) {}

  [[nodiscard]] bool there() const { return value_ != nullptr; }
  /// A member, which may be missing; of no object none is there.
  GltfValue operator[](const char* name) const;
  /// A member of an array, which has to be there.
  GltfValue operator[](std::size_t i) const;
  /// How many members the array has; 0 where it is missing.
  std::size_t size() const;

  std::uint64_t whole() const;
  std::uint64_t whole_or(std::uint64_t otherwise) const { return there() ? whole() : otherwise; }
  double number() const;
  std::string text() const;
  bool flag() const;  // false where it is missing
  /// So many numbers, or none where it is missing.
  std::vector<double> numbers(std::size_t count) const;

  /// `value`: what the file has there, by default the value itself.
  [[noreturn]] void refuse(const std::string& requirement, const std::string& value = {}) const;

 private:
  const Source* source_;
  const nlohmann::json* value_;
  std::string where_;
};

class GltfDocument {
 public:
  explicit GltfDocument(const Source& source);

  GltfValue root() const { return {source_, &json_, ""}; }
  const Source& source() const { return source_; }
  bool is_binary() const { return is_binary_; }
  /// After what a binary file's header counts.
  std::size_t trailing_bytes() const { return trailing_; }
  /// Of the file and its buffers.
  std::size_t size() const { return size_; }

  std::vector<Eigen::Vector3d> positions(std::size_t accessor) const;
  std::vector<std::uint32_t> indices(std::size_t accessor) const;

 private:
  /// Where the elements of an accessor stand.
  struct Elements {
    const char* at;  // null: all zero
    std::size_t stride, component, components, count;
    std::uint64_t type;
    bool normalized;
    double operator()(std::size_t element, std::size_t i) const;
  };

  void read_binary();
  void parse(std::string_view text);
  std::string buffer(const GltfValue& one, std::size_t number) const;
  std::string_view view(const GltfValue& view_number, std::uint64_t offset, std::size_t count,
                        std::size_t element, std::size_t& stride) const;
  Elements elements(const GltfValue& accessor, std::size_t components) const;
  template <typename Replace>
  void replace_sparse(const GltfValue& accessor, const Elements& like, const Replace& replace) const;

  const Source& source_;
  nlohmann::json json_;
  bool is_binary_ = false, has_chunk_ = false;
  std::string_view chunk_;
  std::size_t trailing_ = 0, size_ = 0;
  std::vector<std::string> buffers_;
};

}  // namespace vericone::files
