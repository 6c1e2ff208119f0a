// SPDX-License-Identifier: BSD-3-Clause
//
// Several processes that mpirun has started compute the rows of one command: the first one carries it out as
// a process alone does, and gets blocks of rows from the others.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "work/resumable_table.h"

namespace vericone::mpi {

/// One of the processes. Made once, by the thread that calls it from then on.
class Ranks {
 public:
  Ranks(int& argc, char**& argv);
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] bool first() const { return rank_ == 0; }

  /// Waits until the first one has a table. False where it has none and has ended. Of the others.
  bool table_comes();

  /// For share_rows(). Of the first one: gives the table rows that all of them compute. Of the others:
  /// computes what they are asked for; false where another table comes. Throws Answered where all is done,
  /// std::runtime_error where the first one's table is another one, and InputError naming --threads other
  /// than 1.
  bool share(work::ResumableTable& table);

  /// The exit status of this process: the last call. Where rows are missing it ends all processes.
  int finish(int status);

 private:
  struct Message {
    int from, tag;
    std::string text;
  };
  enum Tag { kTable = 1, kBlock, kRows, kDone };

  static void send(int to, Tag tag, const std::string& text);
  static std::optional<Message> received();
  Message wait();
  void help(const work::ResumableTable& table);
  void give(std::uint64_t begin, std::uint64_t end);
  std::string rows(const work::ResumableTable& table, std::uint64_t begin);

  int rank_ = 0;
  std::optional<Message> table_;  // that the first one has announced
  bool done_ = false;             // the first one has ended
  // Of the first one:
  std::vector<int> given_;             // blocks that each of the others has and has not sent
  std::optional<std::uint64_t> next_;  // row that nobody has yet
  std::map<std::uint64_t, std::string>
      come_;  // blocks that are there and not yet asked for, by their first row
  std::uint64_t own_begin_ = 0, own_next_ = 0,
                own_end_ = 0;  // block that the first one computes between two messages
  std::string own_rows_;
};

}  // namespace vericone::mpi
