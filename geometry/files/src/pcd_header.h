// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "source.h"

namespace vericone::files {

/// A field of a PCD file: `count` values of `size` bytes each, signed (I), unsigned (U) or floating-point
/// (F).
struct PcdField {
  std::string name;
  std::size_t size = 4;
  char type = 'F';
  std::size_t count = 1;
};

struct PcdHeader {
  enum class Data { ascii, binary, binary_compressed } data = Data::ascii;
  std::vector<PcdField> fields;
  /// Where among the fields x, y and z are.
  std::array<std::size_t, 3> coordinates{};
  std::size_t width = 0, height = 0, points = 0;
  std::size_t size = 0;   // of the header in bytes, with the end of its last line
  std::size_t lines = 0;  // of the header

  /// Bytes of a point.
  std::size_t stride() const;
};

PcdHeader read_pcd_header(const Source& source);

}  // namespace vericone::files
