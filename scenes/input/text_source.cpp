// SPDX-License-Identifier: BSD-3-Clause
#include "input/text_source.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <vericone/geometry/error.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace vericone::input {
namespace {

std::string why(int error) { return std::generic_category().message(error); }

std::string megabytes() { return std::to_string(kMostBytes >> 20) + " MiB"; }

}  // namespace

TextSource::TextSource(std::string path, std::string requirement)
    : path_(std::move(path)), requirement_(std::move(requirement)) {
  file_ = path_ == "-" ? STDIN_FILENO : open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ >= 0) return;
  const int error = errno;
  throw InputError(path_, error == ENOENT ? "no such file" : "a file that cannot be read: " + why(error),
                   requirement_);
}

TextSource::~TextSource() {
  if (file_ > STDIN_FILENO) close(file_);
}

bool TextSource::next_line(std::string& line) {
  while (!take_line(line)) {
    if (ended_) return take_rest(line);
    read_more();
  }
  return true;
}

bool TextSource::next_lines(std::string& lines, std::size_t most) {
  std::size_t end = begin_;  // of the last whole line
  for (;;) {
    const std::size_t last = std::string_view(buffer_).substr(searched_).rfind('\n');
    if (last != std::string_view::npos) end = searched_ + last + 1;
    searched_ = buffer_.size();
    const bool whole = end > begin_;
    if (whole && (end - begin_ >= most || ended_ || buffer_.size() - end > kMostBytes || !more_at_hand())) {
      lines.assign(buffer_, begin_, end - begin_);
      begin_ = end;
      lines_ += std::size_t(std::count(lines.begin(), lines.end(), '\n'));
      return true;
    }
    if (ended_) return take_rest(lines);
    if (buffer_.size() - end > kMostBytes) refuse_line();
    end -= begin_;
    read_more();
  }
}

bool TextSource::more_at_hand() const {
  pollfd file{file_, POLLIN, 0};
  return poll(&file, 1, 0) > 0;
}

void TextSource::refuse_line() const {
  throw InputError(path_ + ":" + std::to_string(lines_ + 1), "a line of more than " + megabytes(),
                   "lines of at most " + megabytes());
}

bool TextSource::take_line(std::string& line) {
  const std::size_t end = buffer_.find('\n', searched_);
  if (end == std::string::npos) {
    searched_ = buffer_.size();
    if (buffer_.size() - begin_ > kMostBytes) refuse_line();
    return false;
  }
  line.assign(buffer_, begin_, end - begin_);
  begin_ = searched_ = end + 1;
  ++lines_;
  return true;
}

bool TextSource::take_rest(std::string& line) {
  if (begin_ == buffer_.size()) return false;
  line.assign(buffer_, begin_);
  begin_ = searched_ = buffer_.size();
  ++lines_;
  return true;
}

void TextSource::read_more() {
  constexpr std::size_t kPiece = std::size_t(1) << 16;
  buffer_.erase(0, begin_);
  searched_ -= begin_;
  begin_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kPiece);
  ssize_t got = 0;
  do got = read(file_, buffer_.data() + before, kPiece);
  while (got < 0 && errno == EINTR);
  const int error = errno;
  buffer_.resize(before + (got > 0 ? std::size_t(got) : 0));
  if (got < 0) throw InputError(path_, "a file that cannot be read: " + why(error), requirement_);
  ended_ = got == 0;
}

std::string TextSource::whole() {
  while (!ended_) {
    read_more();
    if (buffer_.size() > kMostBytes)
      throw InputError(path_, "more than " + megabytes(), requirement_ + " of at most " + megabytes());
  }
  return std::exchange(buffer_, {});
}

}  // namespace vericone::input
