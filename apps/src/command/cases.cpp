// SPDX-License-Identifier: BSD-3-Clause
#include "command/cases.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <limits>
#include <mutex>
#include <optional>
#include <ostream>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "command/case_parser.h"
#include "input/scene.h"
#include "input/text_source.h"
#include "json/json_value.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

constexpr std::size_t kBlockBytes = std::size_t(1) << 20, kPieceLines = 32;

/// Some lines of a block, answered by one thread.
struct Piece {
  std::string_view lines;
  std::size_t number;  // of the first
  std::string answers = {};
  bool bad = false, whole = false, done = false;
  std::exception_ptr failure = {};
};

void answer_line(std::string_view line, std::size_t number, const Answer& answer, CaseParser& parser,
                 Piece& piece) {
  Json result = Json::object();
  std::string id = "null";
  try {
    result = answer(parser.parse(line, number, id));
  } catch (const InputError& e) {
    piece.bad = true;
    result = {{"error", e.what()}};
  }
  piece.answers += "{\"id\":" + id + ",";
  piece.answers += result.dump(-1, ' ', false, Json::error_handler_t::replace).substr(1) + "\n";
}

/// The text up to the end of its first line; `text` goes on behind it.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

void answer_piece(Piece& piece, const Answer& answer, CaseParser& parser) {
  try {
    std::string_view left = piece.lines;
    for (std::size_t number = piece.number; !left.empty(); ++number) {
      if (interrupted()) return;
      const std::string_view line = take_line(left);
      if (line.find_first_not_of(" \t\r") != std::string_view::npos)
        answer_line(line, number, answer, parser, piece);
    }
    piece.whole = true;
  } catch (...) {
    piece.failure = std::current_exception();
  }
}

std::vector<Piece> pieces_of(std::string_view block, std::size_t& number) {
  std::vector<Piece> pieces;
  while (!block.empty()) {
    std::string_view left = block;
    const std::size_t first = number;
    for (std::size_t i = 0; i < kPieceLines && !left.empty(); ++i, ++number) take_line(left);
    pieces.push_back({block.substr(0, block.size() - left.size()), first});
    block = left;
  }
  return pieces;
}

/// Threads that answer the pieces of a block, in any order.
class Workers {
 public:
  Workers(std::vector<Piece>& pieces, const Answer& answer, std::size_t count)
      : pieces_(pieces), answer_(answer) {
    count = std::min(count, pieces.size());
    for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
  }
  ~Workers() {
    next_ = pieces_.size();
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void wait_for(const Piece& piece) {
    std::unique_lock lock(mutex_);
    ready_.wait(lock, [&] { return piece.done; });
  }

 private:
  void work() {
    CaseParser parser;
    for (std::size_t i = next_++; i < pieces_.size(); i = next_++) {
      answer_piece(pieces_[i], answer_, parser);
      const std::lock_guard lock(mutex_);
      pieces_[i].done = true;
      ready_.notify_one();
    }
  }

  std::vector<Piece>& pieces_;
  const Answer& answer_;
  std::vector<std::thread> threads_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable ready_;
};

/// Writes the answers of a block in the order of its lines. Whether any line was bad.
bool answer_block(std::vector<Piece> pieces, const Answer& answer, int threads, CaseParser& parser,
                  std::ostream& out) {
  std::optional<Workers> workers;
  if (threads > 1 && pieces.size() > 1) workers.emplace(pieces, answer, std::size_t(threads));
  bool bad = false;
  for (Piece& piece : pieces) {
    if (workers)
      workers->wait_for(piece);
    else
      answer_piece(piece, answer, parser);
    out << std::exchange(piece.answers, {});
    bad |= piece.bad;
    if (piece.failure) std::rethrow_exception(piece.failure);
    if (!piece.whole) break;  // interrupted; answers of later lines are not for this place
  }
  return bad;
}

/// Whether the first line that is not blank begins as an object with its fields does: {"agent" ...
bool begins_with_case(std::string_view text) {
  constexpr const char* kBlank = " \t\r";
  std::string_view line;
  while (!text.empty() && line.find_first_not_of(kBlank) == std::string_view::npos) line = take_line(text);
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::size_t field = line.find_first_not_of(kBlank, 1);
  return line.empty() || (line[0] == '{' && field != std::string_view::npos && line[field] == '"');
}

/// Throws InputError naming the path where the text is plainly a scene or the like, and says who reads that.
void require_cases(const std::string& text, const std::string& path) {
  if (begins_with_case(text)) return;
  Json fields;
  try {
    fields = input::scene_fields(text, path);
  } catch (const InputError&) {
    return;  // what is wrong is said of its lines
  }
  input::require_kind(fields, input::FileKind::cases, path);
}

/// Of the bytes of a file those of a part, from the first to before the second.
std::pair<std::uint64_t, std::uint64_t> bytes_of(const std::string& path, const std::optional<Part>& part) {
  if (!part) return {0, std::numeric_limits<std::uint64_t>::max()};
  if (!std::filesystem::is_regular_file(path))
    throw InputError("--part", part->text(), "left out, or given with a file: " + path + " is none");
  return share_of(std::filesystem::file_size(path), *part);
}

/// The lines of a block, whose first byte is `at`, that begin in `bytes`; `number` goes on to the first of
/// them.
std::string_view lines_within(std::string_view block, std::uint64_t at,
                              const std::pair<std::uint64_t, std::uint64_t>& bytes, std::size_t& number) {
  // A line begins behind the end of another one.
  const auto first_from = [&](std::uint64_t byte) {
    if (byte <= at) return std::size_t(0);
    return byte - at > block.size() ? block.size()
                                    : std::min(block.find('\n', byte - at - 1), block.size() - 1) + 1;
  };
  const std::size_t begin = first_from(bytes.first), end = first_from(bytes.second);
  number += std::size_t(std::count(block.begin(), block.begin() + std::ptrdiff_t(begin), '\n'));
  return block.substr(begin, end - begin);
}

}  // namespace

Json parse_case(const std::string& line, std::size_t number) {
  std::string id;
  return parse_case_slowly(line, number, id);
}

int answer_cases(const std::string& path, const Answer& answer, std::ostream& out, int threads,
                 const std::optional<Part>& part) {
  input::TextSource cases(path, "a file of cases, one JSON object a line, or - for standard input");
  const auto bytes = bytes_of(path, part);
  CaseParser parser;
  bool bad = false;
  std::string block;
  std::size_t number = 1;
  for (std::uint64_t at = 0; !interrupted() && at < bytes.second && cases.next_lines(block, kBlockBytes);
       at += block.size()) {
    if (at == 0 && path != "-") require_cases(block, path);
    // Many lines as long as the limit would take too much memory at once.
    const bool huge = block.size() > 4 * kBlockBytes;
    block.reserve(block.size() + kCasePadding);
    bad |= answer_block(pieces_of(lines_within(block, at, bytes, number), number), answer, huge ? 1 : threads,
                        parser, out);
    // A consumer that feeds line by line waits for each answer.
    out.flush();
  }
  if (interrupted()) return kExitInterrupted;
  return bad ? 2 : 0;
}

}  // namespace vericone
