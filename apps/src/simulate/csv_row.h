// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>
#include <cmath>
#include <string>

namespace vericone::scenario {

/// Text as a field of a table: in quotes where a comma, a quote or a new line is in it.
inline std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// Appends rows to a table. Numbers are the shortest that read back as the same doubles; NaN is nothing.
class CsvRow {
 public:
  explicit CsvRow(std::string& table) : table_(table) {}
  ~CsvRow() { table_ += '\n'; }
  CsvRow(const CsvRow&) = delete;
  CsvRow& operator=(const CsvRow&) = delete;

  CsvRow& text(const std::string& text) {
    separate();
    table_ += csv_text(text);
    return *this;
  }
  CsvRow& number(double x) {
    separate();
    if (!std::isnan(x)) table_ += to_text(x);
    return *this;
  }
  CsvRow& vector(const Eigen::Vector3d& v) { return number(v.x()).number(v.y()).number(v.z()); }
  CsvRow& empty(int fields = 1) {
    for (int i = 0; i < fields; ++i) separate();
    return *this;
  }

 private:
  void separate() {
    if (!first_) table_ += ',';
    first_ = false;
  }
  std::string& table_;
  bool first_ = true;
};

}  // namespace vericone::scenario
