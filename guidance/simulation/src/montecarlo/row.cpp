// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace vericone::montecarlo {
namespace {

std::string field(double x) { return std::isnan(x) ? "" : to_text(x); }

std::string outcome_fields(const Outcome& o) {
  return std::string(to_string(o.fate)) + "," + (o.called_safe ? "1" : "0") + "," + field(o.least_distance);
}

/// The fields of a line, one after the other.
class Fields {
 public:
  explicit Fields(std::string_view line) : left_(line) {}

  std::string_view text() {
    if (ended_) throw InputError("row", "too few fields", "one that csv_row() wrote for as many laws");
    const std::size_t end = left_.find(',');
    const std::string_view value = left_.substr(0, end);
    ended_ = end == std::string_view::npos;
    left_.remove_prefix(ended_ ? left_.size() : end + 1);
    return value;
  }
  double number() {
    const std::string_view value = text();
    if (value.empty()) return std::numeric_limits<double>::quiet_NaN();
    double x = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), x);
    if (error != std::errc() || end != value.data() + value.size())
      throw InputError("row", "'" + std::string(value) + "'", "a number there");
    return x;
  }
  bool flag() { return number() != 0; }
  Outcome outcome() {
    Outcome o;
    const std::string fate(text());
    if (!fate_of(fate)) throw InputError("row", "'" + fate + "'", "the name of a fate there");
    o.fate = *fate_of(fate);
    o.called_safe = flag();
    o.least_distance = number();
    return o;
  }

 private:
  std::string_view left_;
  bool ended_ = false;
};

}  // namespace

Row measure(std::uint64_t seed, std::uint64_t index, const std::vector<Flown>& laws,
            const FlightSettings& settings) {
  const Encounter encounter = random_encounter(seed, index);
  Row row;
  row.distance = (encounter.obstacle.start.position - encounter.agent.start.position).norm();
  row.speed_agent = encounter.agent.start.velocity.norm();
  row.speed_obstacle = encounter.obstacle.start.velocity.norm();
  row.closing = encounter.relative_velocity().norm();
  row.straight = fly_straight(encounter);
  // The second half of the laws is the first without saturation. A run that stays below the limit without it
  // is the same run with it.
  const std::size_t half = laws.size() / 2;
  row.outcomes.resize(laws.size());
  for (std::size_t i = 0; i < half; ++i) {
    Outcome& free = row.outcomes[half + i];
    free = fly(encounter, laws[half + i], settings);
    row.outcomes[i] = free.peak < settings.most ? free : fly(encounter, laws[i], settings);
  }
  return row;
}

std::string csv_header(const std::vector<Flown>& laws) {
  std::string header =
      "index,distance [m],agent speed [m/s],obstacle speed [m/s],relative speed [m/s],straight,straight safe,"
      "straight least distance [m],y slice,slice safe,y exact,exact safe";
  for (const Flown& law : laws)
    for (const char* column : {"", " safe", " least distance [m]", " peak [m/s^2]", " left cone [s]"})
      header += "," + law.name + column;
  return header;
}

std::string csv_row(std::uint64_t index, const Row& row) {
  std::string text = std::to_string(index);
  for (const double x : {row.distance, row.speed_agent, row.speed_obstacle, row.closing})
    text += "," + field(x);
  const StraightOutcome& s = row.straight;
  text += "," + outcome_fields(s.outcome);
  text += "," + field(s.y_slice) + (s.slice_called_safe ? ",1" : ",0");
  text += "," + field(s.y_exact) + (s.exact_called_safe ? ",1" : ",0");
  for (const Outcome& o : row.outcomes)
    text += "," + outcome_fields(o) + "," + field(o.peak) + "," + field(o.left_cone);
  return text;
}

Row row_of(const std::string& line, std::size_t laws) {
  Fields fields(line);
  Row row;
  fields.text();  // the index
  for (double* x : {&row.distance, &row.speed_agent, &row.speed_obstacle, &row.closing}) *x = fields.number();
  row.straight.outcome = fields.outcome();
  row.straight.y_slice = fields.number();
  row.straight.slice_called_safe = fields.flag();
  row.straight.y_exact = fields.number();
  row.straight.exact_called_safe = fields.flag();
  for (std::size_t i = 0; i < laws; ++i) {
    Outcome o = fields.outcome();
    o.peak = fields.number();
    o.left_cone = fields.number();
    row.outcomes.push_back(o);
  }
  return row;
}

void each_row(const std::filesystem::path& file, std::size_t laws, const std::function<void(Row)>& take) {
  std::ifstream in(file);
  if (!in) throw InputError("file", file.string(), "a table that can be read");
  std::string line;
  std::getline(in, line);  // settings
  std::getline(in, line);  // header
  for (std::size_t number = 3; std::getline(in, line); ++number) {
    Row row;
    try {
      row = row_of(line, laws);
    } catch (const InputError& error) {
      throw InputError(file.string() + ":" + std::to_string(number), error.value(), error.requirement());
    }
    take(std::move(row));
  }
}

std::vector<Row> read_table(const std::filesystem::path& file, std::size_t laws) {
  std::vector<Row> rows;
  each_row(file, laws, [&](Row row) { rows.push_back(std::move(row)); });
  return rows;
}

}  // namespace vericone::montecarlo
