// SPDX-License-Identifier: BSD-3-Clause
#include "track/truth.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

namespace vericone::tracking {
namespace {

using vision::Box;

constexpr std::size_t kMostFrames = 100'000'000;

/// The numbers of a line, apart by commas, spaces or tabs; nothing where there is anything else.
std::optional<std::vector<double>> numbers(const std::string& line) {
  std::vector<double> result;
  const char* at = line.data();
  const char* const end = at + line.size();
  const auto skip = [&] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
  };
  for (skip(); at != end; skip()) {
    double value = 0;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    result.push_back(value);
    at = rest;
    skip();
    if (at != end && *at == ',') ++at;
  }
  return result;
}

bool counts(double value) { return value >= 1 && value <= double(kMostFrames) && value == std::floor(value); }

}  // namespace

std::vector<FirstBox> read_boxes(const std::vector<std::string>& words) {
  std::vector<FirstBox> result;
  for (const std::string& word : words) {
    const auto n = numbers(word);
    if (!n || (n->size() != 4 && n->size() != 5) || !((*n)[2] > 0) || !((*n)[3] > 0) ||
        (n->size() == 5 && !counts((*n)[4])))
      throw InputError("--box", word,
                       "X,Y,W,H in pixels with W and H above 0, or X,Y,W,H,FRAME with a frame from 1 up");
    result.push_back({n->size() == 5 ? std::size_t((*n)[4]) : 1, {(*n)[0], (*n)[1], (*n)[2], (*n)[3]}});
  }
  return result;
}

std::size_t Truth::last_frame() const {
  std::size_t last = 0;
  for (const auto& rows : boxes) last = std::max(last, rows.rbegin()->first);
  return last;
}

std::vector<FirstBox> Truth::first() const {
  std::vector<FirstBox> result;
  for (const auto& rows : boxes) result.push_back({rows.begin()->first, rows.begin()->second});
  return result;
}

Truth read_truth(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file))
    throw InputError("--truth", file.string(), "a file of boxes that can be read");
  Truth truth;
  std::string line;
  std::size_t columns = 0, number = 0;
  for (; std::getline(in, line);) {
    ++number;
    const auto n = numbers(line);
    if (n && n->empty()) continue;
    const auto bad = [&](const char* requirement) {
      return InputError("--truth", file.string() + ", line " + std::to_string(number), requirement);
    };
    if (!n || (n->size() != 4 && n->size() < 6)) throw bad("x,y,w,h, or frame,id,x,y,w,h,... in numbers");
    if (columns == 0) columns = n->size() == 4 ? 4 : 6;
    if ((columns == 4) != (n->size() == 4)) throw bad("of as many numbers as the lines before");
    const double* box = n->data() + (columns == 4 ? 0 : 2);
    if (!(box[2] > 0 && box[3] > 0)) throw bad("with w and h above 0");
    std::size_t frame = 1, target = 0;
    if (columns == 4) {
      truth.every_frame = true;
      if (truth.names.empty()) truth.names.push_back("1");
      truth.boxes.resize(1);
      frame = truth.boxes[0].size() + 1;
    } else {
      if (!counts((*n)[0])) throw bad("with a frame from 1 up");
      if (n->size() > 6 && (*n)[6] == 0) continue;
      frame = std::size_t((*n)[0]);
      const std::string name = to_text((*n)[1]);
      target = std::size_t(std::find(truth.names.begin(), truth.names.end(), name) - truth.names.begin());
      if (target == truth.names.size()) {
        truth.names.push_back(name);
        truth.boxes.emplace_back();
      }
    }
    if (!truth.boxes[target].try_emplace(frame, Box{box[0], box[1], box[2], box[3]}).second)
      throw bad("with one box a frame of each target");
  }
  if (truth.names.empty()) throw InputError("--truth", file.string(), "a file with boxes");
  return truth;
}

}  // namespace vericone::tracking
