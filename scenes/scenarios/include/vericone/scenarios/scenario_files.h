// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios from YAML; the fields are described in docs/reference/scenarios.md.
#pragma once

#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/simulation/run.h>
#include <vericone/simulation/run_tables.h>
#include <vericone/simulation/scenario.h>
#include <vericone/simulation/trajectory.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vericone::scenario {

/// Reads and checks a scenario, and the files it names, relative to its folder. Throws InputError naming the
/// file or the field, for example "bodies[1].shape.k". A scenario without name is called like the file.
[[nodiscard]] simulation::Scenario read_scenario(const std::string& file);

/// The same from `text`; `file` is named in errors.
[[nodiscard]] simulation::Scenario scenario_of_text(const std::string& text, const std::string& file);

/// Bodies on tracks that somebody else made, and what is to be proved of them.
struct TracksFile {
  std::string name;
  std::vector<simulation::TrackedBody> bodies;
  simulation::CertifyOptions options;
};

/// Reads them, and the files they name, relative to its folder (docs/reference/formats.md). Throws InputError
/// naming the file or the field, for example "bodies[1].track.knots", or line and column of a file.
[[nodiscard]] TracksFile read_tracks(const std::string& file);

/// The same from `text`; `file` is named in errors.
[[nodiscard]] TracksFile tracks_of_text(const std::string& text, const std::string& file);

// A run as files: tables with units in their column names and JSON, described in docs/reference/scenarios.md.
// What does not apply is an empty field.

/// Where a run came from and what it took.
struct RunOrigin {
  std::filesystem::path file;   // of the scenario; empty: a program made it, and no file is copied
  std::string provenance = {};  // JSON: what it takes to get the same result again; empty: not known
  double seconds = 0;           // s, of the computation
  std::string text = {};        // of the file; empty: it is read
};

/// The run's tables and JSON files and a copy of the scenario into `folder`, which must exist; planes.csv
/// where planes are logged, sights.csv where an agent has a sensor, vehicles.csv where there is a vehicle,
/// orifices.csv and orifices.json where there are any. Throws InputError naming "origin.file" or
/// "origin.provenance", before anything is written, and std::system_error naming the path that cannot be
/// written.
void write_run(const simulation::Scenario& scenario, const simulation::Run& run, const RunOrigin& origin,
               const std::filesystem::path& folder);

// A campaign with its table as a file, which grows and can be gone on with (docs/measured/campaign.md).

struct CampaignOptions {
  std::optional<std::filesystem::path> out = {};  // folder for engagements.csv
  int threads = 0;                                // 0: one per processor
  bool resume = true;                             // go on with an unfinished table; otherwise it begins anew
  /// Called with the share done, 0 to 1, as rows come; false stops.
  std::function<bool(double)> progress = nullptr;
  /// Where it is set, what gives the rows from `first` to before `end`, as campaign_rows() does, in place of
  /// this process: called for one block after the other, from the thread of fly_campaign().
  std::function<std::string(std::uint64_t first, std::uint64_t end)> rows = nullptr;
};

struct FlownCampaign {
  simulation::Table table;  // a row for each engagement
  montecarlo::Summary summary;
  std::uint64_t violations = 0;  // flights that met and that a proved statement had called safe: none
  bool finished = true;          // false where `progress` stopped it
};

/// Flies the engagements that are missing. engagements.csv is in `out` once all are there, until then
/// engagements.csv.partial; the result does not depend on threads and stops. Throws InputError naming a
/// setting, "threads", or "out" where it cannot be written to, another run writes to it, or it holds an
/// unfinished run of other settings. Cost: 3 ms an engagement of four laws.
[[nodiscard]] FlownCampaign fly_campaign(const montecarlo::Campaign& campaign,
                                         const CampaignOptions& options = {});

/// The rows of engagements.csv from `first` to before `end`, which is at most all, each with a line break:
/// what another process does for fly_campaign(). Throws InputError naming a setting, or "end".
[[nodiscard]] std::string campaign_rows(const montecarlo::Campaign& campaign, std::uint64_t first,
                                        std::uint64_t end);

}  // namespace vericone::scenario
