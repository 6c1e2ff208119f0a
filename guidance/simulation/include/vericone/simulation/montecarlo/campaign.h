// SPDX-License-Identifier: BSD-3-Clause
//
// Random engagements of two moving ellipsoids for the campaign of guidance laws (docs/measured/campaign.md).
#pragma once

#include <vericone/simulation/scenario.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vericone::montecarlo {

// What became of an encounter under one law, with what is proved of it.

/// A law as the campaign flies it.
struct Flown {
  std::string name;  // slice, exact, motion, clearance; with the limit, "slice-15"
  guidance::GuideOptions guide;
};

/// What the laws are told.
struct FlightSettings {
  double step = 0.05;       // s
  double most = 15;         // m/s^2, with saturation
  double gain = 4;          // 1/s
  double reference = 0.05;  // of y, dimensionless
  double required = 1;      // m, of the clearance law
};

enum class Fate : std::uint8_t {
  avoided,    // proved, also for the straight flight after the run
  met,        // proved to touch
  undecided,  // not proved either way
};
[[nodiscard]] const char* to_string(Fate fate);

/// What became of one flight.
struct Outcome {
  Fate fate = Fate::undecided;
  /// The law's last word before the contact, or the end, was that nothing need be done: y > 0, m > required,
  /// or receding.
  bool called_safe = false;
  double least_distance = std::numeric_limits<double>::quiet_NaN();  // m, proved; avoided only
  double peak = 0;                                                   // m/s^2
  double left_cone = std::numeric_limits<double>::quiet_NaN();  // s, first time; NaN: was not in it or never
};

/// Straight flight: what becomes of it, and what the cones said of it at the start, on the plane of the line
/// of sight and the relative velocity.
struct StraightOutcome {
  Outcome outcome;  // called_safe: by the exact predicate
  double y_slice = 0, y_exact = 0;
  bool slice_called_safe = false, exact_called_safe = false;
};

// A campaign: random engagements under every law, with a proof of what became of each
// (docs/measured/campaign.md).

/// What decides every row.
struct Campaign {
  std::uint64_t engagements = 10'000, seed = 1;
  std::vector<std::string> laws{"slice", "exact", "motion", "clearance"};
  FlightSettings flight;
};

/// The laws that are flown: those named, each with saturation and without. Throws InputError naming
/// "engagements", "laws", "most", "gain", "reference", "required" or "step".
[[nodiscard]] std::vector<Flown> laws_of(const Campaign& campaign);

/// The first line of its table: whoever goes on with an unfinished table compares it.
[[nodiscard]] std::string settings_line(const Campaign& campaign);

// A campaign's table: one row an engagement (columns: docs/measured/campaign.md).

/// One engagement under every law.
struct Row {
  double distance = 0, speed_agent = 0, speed_obstacle = 0, closing = 0;  // m, m/s
  StraightOutcome straight;
  std::vector<Outcome> outcomes;  // one a law
};

/// Engagement `index` of a campaign. Depends on its arguments alone. Cost: 3 ms for four laws.
[[nodiscard]] Row measure(std::uint64_t seed, std::uint64_t index, const std::vector<Flown>& laws,
                          const FlightSettings& settings);

/// The line of columns, and a row as a line, both without their ends.
[[nodiscard]] std::string csv_header(const std::vector<Flown>& laws);
[[nodiscard]] std::string csv_row(std::uint64_t index, const Row& row);
/// The row of such a line, of as many laws. Throws InputError naming "row" for another.
[[nodiscard]] Row row_of(const std::string& line, std::size_t laws);
/// Reads a file of a line of settings, csv_header() and rows. Throws InputError naming file and line.
[[nodiscard]] std::vector<Row> read_table(const std::filesystem::path& file, std::size_t laws);

// What the rows of a campaign say together.

inline constexpr double kBin = 0.25, kLastBin = 15;  // m

/// Outcomes of one law, or of straight flight.
struct Counts {
  std::uint64_t avoided = 0, infeasible = 0, called_safe_and_met = 0, undecided = 0;
  double median_peak = 0, median_left_cone = 0;  // m/s^2, s; NaN where there is none
  /// Histogram of the proved least distances of those avoided: how many (no unit) in each bin of kBin; the
  /// last has all from kLastBin on.
  std::vector<double> least_distances;

  [[nodiscard]] std::uint64_t met() const { return infeasible + called_safe_and_met; }
};

/// Counts of outcomes, and what was called safe and met all the same.
struct Summary {
  struct OfLaw {
    std::string name;
    double most = 0;             // m/s^2
    bool word_is_proof = false;  // what it calls safe is a theorem about the straight flight that follows
    Counts counts;
    std::uint64_t made_worse = 0;
  };
  std::size_t engagements = 0;
  Counts straight;
  std::uint64_t slice_called_safe_and_met = 0, exact_called_safe_and_met = 0,
                predicate_called_safe_and_met = 0, exact_called_unsafe_and_avoided = 0;  // straight on
  std::vector<OfLaw> laws;
};

/// Of rows with an outcome for each of the laws.
[[nodiscard]] Summary summarise(const std::vector<Row>& rows, const std::vector<Flown>& laws);

/// Runs that a statement proved to be right called safe and that met: there are none.
[[nodiscard]] std::uint64_t violations(const Summary& summary);

}  // namespace vericone::montecarlo
