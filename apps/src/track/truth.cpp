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

/// The numbers of a line, nan among them, apart by commas, spaces or tabs; nothing where there is anything
/// else.
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
    if (error != std::errc() || std::isinf(value)) return std::nullopt;
    result.push_back(value);
    at = rest;
    skip();
    if (at != end && *at == ',') ++at;
  }
  return result;
}

bool all_known(const double* values, std::size_t count) {
  return std::none_of(values, values + count, [](double value) { return std::isnan(value); });
}

bool counts(double value) { return value >= 1 && value <= double(kMostFrames) && value == std::floor(value); }

}  // namespace

std::vector<FirstBox> read_boxes(const std::vector<std::string>& words) {
  std::vector<FirstBox> result;
  for (const std::string& word : words) {
    const auto n = numbers(word);
    if (!n || (n->size() != 4 && n->size() != 5) || !all_known(n->data(), 2) || !((*n)[2] > 0) ||
        !((*n)[3] > 0) || (n->size() == 5 && !counts((*n)[4])))
      throw InputError("--box", word,
                       "X,Y,W,H in pixels with W and H above 0, or X,Y,W,H,FRAME with a frame from 1 up");
    result.push_back({n->size() == 5 ? std::size_t((*n)[4]) : 1, {(*n)[0], (*n)[1], (*n)[2], (*n)[3]}});
  }
  return result;
}

std::size_t Truth::last_frame() const {
  std::size_t last = 0;
  for (const auto& rows : boxes) last = std::max(last, rows.rbegin()->first);
  for (const auto& frames : absent)
    if (!frames.empty()) last = std::max(last, *frames.rbegin());
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
    const bool away = std::all_of(box, box + 4, [](double value) { return std::isnan(value); });
    if (!away && !(all_known(box, 4) && box[2] > 0 && box[3] > 0))
      throw bad("with w and h above 0, or nan,nan,nan,nan where the target is absent");
    std::size_t frame = 1, target = 0;
    if (columns == 4) {
      truth.every_frame = true;
      if (truth.names.empty()) truth.names.push_back("1");
      truth.boxes.resize(1);
      truth.absent.resize(1);
      frame = truth.boxes[0].size() + truth.absent[0].size() + 1;
    } else {
      if (!counts((*n)[0]) || std::isnan((*n)[1]))
        throw bad("with a frame from 1 up, and a number of its target");
      if (n->size() > 6 && (*n)[6] == 0) continue;
      frame = std::size_t((*n)[0]);
      const std::string name = to_text((*n)[1]);
      target = std::size_t(std::find(truth.names.begin(), truth.names.end(), name) - truth.names.begin());
      if (target == truth.names.size()) {
        truth.names.push_back(name);
        truth.boxes.emplace_back();
        truth.absent.emplace_back();
      }
    }
    auto& known = truth.boxes[target];
    auto& absent = truth.absent[target];
    if (known.contains(frame) || absent.contains(frame)) throw bad("with one box a frame of each target");
    if (away) {
      absent.insert(frame);
    } else {
      known.emplace(frame, Box{box[0], box[1], box[2], box[3]});
    }
  }
  if (truth.names.empty() ||
      std::any_of(truth.boxes.begin(), truth.boxes.end(), [](const auto& known) { return known.empty(); }))
    throw InputError("--truth", file.string(), "a file with a box at least of each target");
  return truth;
}

}  // namespace vericone::tracking
