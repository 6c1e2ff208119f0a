// SPDX-License-Identifier: BSD-3-Clause
#include "mpi/ranks.h"

#include <mpi.h>
#include <vericone/geometry/error.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>

#include "command/command_line.h"
#include "work/build_info.h"
#include "work/interrupt.h"

namespace vericone::mpi {
namespace {

constexpr int kAhead = 2;  // blocks that a process has, so that it need not wait for the next one
constexpr std::uint64_t kWaiting =
    64;  // blocks a process that may wait for one before them: memory stays small

/// MPI's own waiting takes a processor.
void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

std::string text_of(std::uint64_t begin, std::uint64_t end) {
  return std::to_string(begin) + " " + std::to_string(end);
}

/// What has to be the same everywhere.
std::string identity(const work::ResumableTable& table) {
  return std::string(build_info::version()) + " " + build_info::commit() + ", " + table.settings + ", rows " +
         text_of(table.first, table.count) + ", " + table.header;
}

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
  int level = 0, count = 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  given_.resize(std::size_t(count), 0);
}

void Ranks::send(int to, Tag tag, const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

std::optional<Ranks::Message> Ranks::received() {
  int there = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (!there) return std::nullopt;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(std::size_t(size), '\0')};
  MPI_Recv(message.text.data(), size, MPI_CHAR, message.from, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

Ranks::Message Ranks::wait() {
  for (;;) {
    if (auto message = received()) return std::move(*message);
    if (interrupted()) throw std::runtime_error("interrupted");
    pause();
  }
}

bool Ranks::table_comes() {
  table_ = wait();
  done_ = table_->tag == kDone;
  return !done_;
}

bool Ranks::share(work::ResumableTable& table) {
  if (table.threads != 1)
    throw InputError("--threads", std::to_string(table.threads),
                     "1, or left out: every process computes one row at a time");
  if (!first()) {
    help(table);
    return false;
  }
  for (int to = 1; to < static_cast<int>(given_.size()); ++to) send(to, kTable, identity(table));
  next_.reset();
  own_next_ = own_end_ = 0;
  table.rows = [this, copy = table](std::uint64_t begin, std::uint64_t) { return rows(copy, begin); };
  return true;
}

void Ranks::help(const work::ResumableTable& table) {
  if (table_->text != identity(table))
    throw std::runtime_error("rank " + std::to_string(rank_) + " would compute other rows than rank 0: \"" +
                             identity(table) + "\" for \"" + table_->text + "\"");
  for (;;) {
    Message message = wait();
    if (message.tag == kTable) {
      table_ = std::move(message);
      return;
    }
    done_ = message.tag == kDone;
    if (done_) throw Answered{};
    const std::size_t space = message.text.find(' ');
    const std::uint64_t begin = std::stoull(message.text), end = std::stoull(message.text.substr(space));
    std::string text = std::to_string(begin) + "\n";
    for (std::uint64_t i = begin; i < end; ++i) {
      if (interrupted()) throw std::runtime_error("interrupted");
      text += table.row(i) + "\n";
    }
    send(0, kRows, text);
  }
}

void Ranks::give(std::uint64_t begin, std::uint64_t end) {
  const auto least = std::min_element(given_.begin() + 1, given_.end());
  ++*least;
  send(static_cast<int>(least - given_.begin()), kBlock, text_of(begin, end));
}

std::string Ranks::rows(const work::ResumableTable& table, std::uint64_t begin) {
  if (!next_) next_ = begin;
  const std::uint64_t all = std::min(table.count, begin + kWaiting * given_.size() * table.block);
  const auto take_next = [&](std::uint64_t& from, std::uint64_t& to) {
    from = *next_;
    next_ = to = from + std::min(table.block, table.count - from);
  };
  while (!come_.contains(begin)) {
    checkpoint();
    if (interrupted()) return "";
    const auto idle = [&] {
      return std::any_of(given_.begin() + 1, given_.end(), [](int n) { return n < kAhead; });
    };
    while (*next_ < all && idle()) {
      std::uint64_t from = 0, to = 0;
      take_next(from, to);
      give(from, to);
    }
    if (auto message = received()) {
      const std::size_t line = message->text.find('\n');
      --given_[std::size_t(message->from)];
      come_[std::stoull(message->text)] = message->text.substr(line + 1);
    } else if (own_next_ < own_end_) {
      own_rows_ += table.row(own_next_++) + "\n";
      if (own_next_ == own_end_) come_[own_begin_] = std::exchange(own_rows_, {});
    } else if (*next_ < all) {
      take_next(own_begin_, own_end_);
      own_next_ = own_begin_;
    } else {
      pause();
    }
  }
  return come_.extract(begin).mapped();
}

int Ranks::finish(int status) {
  const bool whole = first() ? std::accumulate(given_.begin(), given_.end(), 0) == 0 : done_;
  if (!whole) MPI_Abort(MPI_COMM_WORLD, status ? status : 1);
  if (first())
    for (int to = 1; to < static_cast<int>(given_.size()); ++to) send(to, kDone, "");
  MPI_Finalize();
  return status;
}

}  // namespace vericone::mpi
