// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/work/staged_folder.h>
#include <cstdint>
#include <filesystem>
#include <string>

#include "work/resumable_table.h"

namespace vericone {

/// The file of a sample of a table's rows.
[[nodiscard]] std::string sample_of(const std::string& table);

/// What becomes of the rows of a job once they are told: --rows.
class KeptRows {
 public:
  /// "", "none", "sample:N", or the name of a file that ends with .csv or .h5, which is HDF5 by the program
  /// vericone-rows. Throws InputError naming --rows.
  KeptRows(const std::string& text, std::size_t tables);

  /// The file that holds of a table what is kept; empty: none.
  [[nodiscard]] std::string file_of(const std::string& table) const;

  /// Writes that file beside the finished table in `folder`, where it is another one. A sample has the rows
  /// whose numbers have the least hashes, so that it depends on nothing but how many rows there are. Memory
  /// does not grow with the rows.
  void write(const work::ResumableTable& table, work::StagedFolder& folder) const;

  /// Once the folder is published, and not before: whoever is interrupted goes on with the table. Leaves of
  /// it what is kept.
  void give_up_others(const std::string& table, const std::filesystem::path& folder) const;

 private:
  bool none_;
  std::uint64_t sample_ = 0;
  std::string file_;
  std::filesystem::path converter_;  // of HDF5
};

}  // namespace vericone
