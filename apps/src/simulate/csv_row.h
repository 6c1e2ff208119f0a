// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <Eigen/Core>
#include <cmath>
#include <string>

namespace vericone::scenario {

/// Appends rows to a table. Numbers are the shortest that read back as the same doubles; NaN is nothing.
class CsvRow {
 public:
  explicit CsvRow(std::string& table) : table_(table) {}
  ~CsvRow() { table_ += '\n'; }
  CsvRow(const CsvRow&) = delete;
  CsvRow& operator=(const CsvRow&) = delete;

  CsvRow& text(const std::string& text) {
    separate();
    table_ += simulation::csv_field(text);
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
