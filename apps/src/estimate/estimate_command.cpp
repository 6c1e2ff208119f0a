// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/estimation/filters.h>
#include <vericone/internal/guidance/estimation/kalman.h>
#include <vericone/work/staged_folder.h>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.h"
#include "input/fields.h"
#include "input/text_source.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone {
namespace {

using guidance::Innovation, guidance::SingerFilter, guidance::SingerOptions;

struct EstimateOptions {
  std::string track;                           // CSV: t, x, y, and r where given; - for standard input
  double alpha = 0.1;                          // 1/s
  std::vector<double> variance = {0.1, 0.05};  // m^2/s^4, along x and y
  double noise = 1;                            // m, where the track has no r
  std::string hidden = "skip";                 // or "source"
  std::optional<std::string> out;
  bool json = false;
  std::string command_line;
};

constexpr std::array kColumns{"t",  "x",  "y",   "vx",  "vy",  "ax",  "ay",
                              "sx", "sy", "svx", "svy", "sax", "say", "nis"};
/// How much larger the source's R is where the target is hidden: 10 m^2 for 1 m^2.
constexpr double kHiddenNoise = 10;

struct Row {
  double t = 0;
  std::optional<Eigen::Vector2d> measured;
  std::optional<double> deviation;
};

/// Fields of a line, without the space around them.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string field = line.substr(begin, end - begin);
    const auto first = field.find_first_not_of(" \t\r"), last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

/// A track line by line; every mistake names its line and column.
class TrackReader {
 public:
  explicit TrackReader(const std::string& path)
      : source_(path,
                "a CSV file with the columns t, x, y and, where it has one, r; or - for standard input") {
    std::string line;
    if (!next(line)) throw InputError("line 1", "nothing", "a header with the columns t, x, y");
    header_ = fields_of(line);
    for (std::size_t i = 0; i < header_.size(); ++i) {
      std::size_t known = 0;
      while (known < kKnown.size() && header_[i] != kKnown[known]) ++known;
      if (known == kKnown.size())
        throw InputError(where("a column"), quoted(header_[i]), "one of t, x, y, r");
      if (place_[known]) throw InputError(where(kKnown[known]), "two columns", "one");
      place_[known] = i;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (!place_[k]) throw InputError(where(kKnown[k]), "no such column", "a header with t, x, y");
  }

  /// The next line that is not blank; nothing after the last.
  std::optional<Row> next_row() {
    std::string line;
    if (!next(line)) return {};
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != header_.size())
      throw InputError("line " + std::to_string(number_),
                       std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields"),
                       "as many as the header: " + std::to_string(header_.size()));
    Row row;
    // Seconds since 1970 too, but not milliseconds.
    const char* seconds = "a number up to 1e11 in magnitude (s)";
    const auto t = number(fields, 0, seconds, 1e11);
    if (!t) throw InputError(where("t"), "nothing", seconds);
    row.t = *t;
    if (last_ && !(row.t > *last_))
      throw InputError(where("t"), quoted(fields[*place_[0]]), "later than the line before (s)");
    last_ = row.t;
    const char* measured = "a number up to 1e9 in magnitude (m), or nothing where the target is hidden";
    const auto x = number(fields, 1, measured), y = number(fields, 2, measured);
    if (x.has_value() != y.has_value())
      throw InputError(where(x ? "y" : "x"), "nothing", "given with the other, or both nothing");
    if (x) row.measured = Eigen::Vector2d(*x, *y);
    if (place_[3]) {
      const char* right = "a positive number (m), or nothing for --noise";
      row.deviation = number(fields, 3, right);
      if (row.deviation && !(*row.deviation > 0))
        throw InputError(where("r"), quoted(fields[*place_[3]]), right);
    }
    return row;
  }

 private:
  static constexpr std::array kKnown{"t", "x", "y", "r"};

  static std::string quoted(const std::string& text) { return input::quoted(Json(text)); }
  std::string where(const std::string& column) const {
    return "line " + std::to_string(number_) + ", " + column;
  }
  bool next(std::string& line) {
    while (!interrupted() && source_.next_line(line)) {
      ++number_;
      if (line.find_first_not_of(" \t\r") != std::string::npos) return true;
    }
    if (interrupted()) throw std::runtime_error("interrupted");
    return false;
  }
  std::optional<double> number(const std::vector<std::string>& fields, std::size_t column,
                               const char* requirement, double most = 1e9) const {
    const std::string& text = fields[*place_[column]];
    if (text.empty()) return {};
    double x = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, x);
    if (read.ec != std::errc() || read.ptr != end || !(std::abs(x) <= most))
      throw InputError(where(kKnown[column]), quoted(text), requirement);
    return x;
  }

  input::TextSource source_;
  std::vector<std::string> header_;
  std::array<std::optional<std::size_t>, 4> place_;
  std::optional<double> last_;
  std::size_t number_ = 0;
};

SingerOptions checked(const EstimateOptions& options) {
  const auto not_negative = [](const char* name, double x, const char* unit) {
    if (!(x >= 0) || !(x <= 1e9))
      throw InputError(name, to_text(x), std::string("a number, 0 or more, up to 1e9 ") + unit);
  };
  not_negative("--alpha", options.alpha, "(1/s)");
  for (const double x : options.variance) not_negative("--variance", x, "(m^2/s^4)");
  if (!(options.noise > 0) || !(options.noise <= 1e9))
    throw InputError("--noise", to_text(options.noise), "a positive number, up to 1e9 (m)");
  if (options.hidden != "skip" && options.hidden != "source")
    throw InputError("--hidden", options.hidden, "skip or source");
  SingerOptions singer;
  singer.alpha = options.alpha;
  singer.variance = {options.variance.at(0), options.variance.at(1)};
  return singer;
}

struct Estimates {
  std::string table;          // CSV
  Json rows = Json::array();  // the same numbers
  std::size_t measured = 0, hidden = 0;
  double nis_sum = 0;
  std::size_t nis_count = 0;
};

Estimates estimate(const EstimateOptions& options) {
  SingerFilter filter(checked(options));
  TrackReader track(options.track);
  Estimates all;
  for (const char* name : kColumns) all.table.append(all.table.empty() ? "" : ",").append(name);
  all.table += '\n';
  while (const std::optional<Row> row = track.next_row()) {
    const double deviation = row->deviation.value_or(options.noise);
    const Eigen::Matrix2d noise = deviation * deviation * Eigen::Matrix2d::Identity();
    const bool first = !filter.started();
    const Innovation<2> said = row->measured || options.hidden == "skip"
                                   ? filter.step(row->measured, noise, row->t)
                                   : filter.step_as_source(kHiddenNoise * noise, row->t);
    ++(row->measured ? all.measured : all.hidden);
    std::array<double, kColumns.size()> numbers;
    numbers.fill(std::nan(""));
    numbers[0] = row->t;
    if (filter.started()) {
      const auto& [mean, covariance] = filter.belief();
      constexpr std::array kOrder{0, 3, 1, 4, 2, 5};  // x, y, vx, vy, ax, ay
      for (std::size_t k = 0; k < kOrder.size(); ++k) {
        numbers[1 + k] = mean[kOrder[k]];
        numbers[7 + k] = std::sqrt(covariance(kOrder[k], kOrder[k]));
      }
      if (row->measured && !first) {
        numbers.back() = said.nis;
        all.nis_sum += said.nis;
        ++all.nis_count;
      }
    }
    Json json = Json::array();
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (k > 0) all.table += ',';
      if (!std::isnan(numbers[k])) all.table += to_text(numbers[k]);
      json.push_back(number_or_null(numbers[k]));
    }
    all.table += '\n';
    if (options.json) all.rows.push_back(std::move(json));
  }
  if (all.measured == 0) throw InputError("x", "no measurement", "at least one in the track");
  return all;
}

/// `vericone estimate`: Singer's filter over a measured track (docs/explanation/pursuit.md). Prints the table
/// of estimates, or writes estimate.csv, estimate.json and provenance.json to `out`. Throws InputError naming
/// the line and column, or the option.
void run_estimate(const EstimateOptions& options, std::ostream& out) {
  const Estimates all = estimate(options);
  const double nis = all.nis_count > 0 ? all.nis_sum / double(all.nis_count) : std::nan("");
  Json summary = {{"measured", all.measured},        {"hidden", all.hidden},
                  {"nis_mean", number_or_null(nis)}, {"alpha", options.alpha},
                  {"variance", options.variance},    {"noise", options.noise},
                  {"hidden_targets", options.hidden}};
  if (options.out) {
    work::StagedFolder folder(*options.out, "--out");
    write_whole(folder.path() / "estimate.csv", all.table);
    write_whole(folder.path() / "estimate.json", json_text(summary) + "\n");
    std::vector<std::filesystem::path> inputs;
    if (options.track != "-") inputs.emplace_back(options.track);
    write_whole(folder.path() / "provenance.json",
                json_text(provenance(options.command_line, 1, inputs)) + "\n");
    folder.publish({"estimate.csv", "estimate.json", "provenance.json"});
  }
  if (options.json) {
    Json columns = Json::array();
    for (const char* name : kColumns) columns.push_back(name);
    summary["columns"] = std::move(columns);
    summary["rows"] = all.rows;
    out << summary.dump() << '\n';
  } else if (options.out) {
    const std::filesystem::path shown = *options.out;
    out << all.measured << " measurements, " << all.hidden << " hidden; mean nis "
        << (std::isnan(nis) ? "-" : number_text(nis)) << " (2 where the model is right)\n"
        << "tables    " << (shown / "estimate.csv").string() << ", " << (shown / "estimate.json").string()
        << ", " << (shown / "provenance.json").string() << '\n';
  } else {
    out << all.table;
  }
}

}  // namespace

int estimate_command(CommandLine& line) {
  EstimateOptions estimate;
  std::string out;
  line.option("track", estimate.track,
              "CSV with the columns t, x, y (s, m; x and y empty where hidden) and, where it has one, r (m); "
              "- for "
              "standard input")
      .required();
  line.option("--alpha", estimate.alpha, "Of Singer's model, 1/s");
  line.option("--variance", estimate.variance, "Of the acceleration along x and y, m^2/s^4")
      .words(2, 2)
      .shown_type("X Y")
      .shown_default("0.1 0.05");
  line.option("--noise", estimate.noise,
              "Standard deviation of a measured coordinate, m, where r does not say");
  line.option(
      "--hidden", estimate.hidden,
      "skip: a hidden target gives no measurement; source: its last estimate, with 10 times the variance");
  const auto folder =
      line.option("--out", out, "Folder for the table of estimates; if not given, it is printed");
  line.flag("--json", estimate.json, "Print JSON");
  line.quiet();
  line.read();
  if (folder.given()) estimate.out = out;
  estimate.command_line = line.text();
  run_estimate(estimate, std::cout);
  return 0;
}

}  // namespace vericone
