// SPDX-License-Identifier: BSD-3-Clause
#include "pursue/pursuit_campaign.h"

#include <vericone/geometry/error.h>
#include <vericone/simulation/run_tables.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "job/job.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "simulate/csv_row.h"
#include "work/file_hash.h"

namespace vericone::pursuit {
namespace {

namespace fs = std::filesystem;
using namespace vision;
using Eigen::Vector2d;

/// Random numbers of one run, whatever the others are.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t run) : engine_(seed * 0x9E3779B97F4A7C15u + run + 1) {
    engine_.discard(8);
  }
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

std::string settings_of(const Pursuit& pursuit, const PursueOptions& options, const char* what) {
  return "# vericone pursue " + fs::path(options.scenario).filename().string() + " (sha256 " +
         sha256_of_file(options.scenario).substr(0, 16) + ")" + ", " + what + ", camera " +
         to_string(pursuit.eyes) + ", tracker " + to_string(pursuit.tracker) + ", law " +
         to_string(pursuit.law) + ", " + to_text(pursuit.duration) + " s, seed " +
         std::to_string(pursuit.seed);
}

simulation::Table read_table(const fs::path& file) {
  return simulation::table_of_csv(content_of(file), file.filename().string());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const double at = share * double(values.size() - 1);
  const auto i = std::size_t(at);
  return i + 1 < values.size() ? values[i] + (at - double(i)) * (values[i + 1] - values[i]) : values[i];
}

/// That an earlier run of either may have left.
const std::vector<std::string> kPictures{"starts.png", "starts.pdf", "occlusions.png", "occlusions.pdf"};

/// One vehicle hidden for 3 s in a run of `kSeconds`, from a time of the scenario on.
struct Trial {
  Pursuit pursuit;
  std::size_t hidden = 0;  // of all cars
  double from = 0, to = 0;
};

/// A road as if its time had begun later.
class Later : public simulation::Road {
 public:
  Later(std::shared_ptr<const simulation::Road> road, double by) : road_(std::move(road)), by_(by) {}
  [[nodiscard]] simulation::RoadPoint at(double t) const override { return road_->at(by_ + t); }

 private:
  std::shared_ptr<const simulation::Road> road_;
  double by_;
};

constexpr double kSeconds = 14, kHidden = 3;

Trial trial_of(const Pursuit& given, std::uint64_t run) {
  Random random(given.seed, run);
  Trial trial{given};
  Pursuit& p = trial.pursuit;
  p.duration = kSeconds;
  p.seed = given.seed + run;
  // The bars are others' matter: one vehicle is hidden, once.
  p.source_view.bars.count = p.perspective_view.bars.count = 0;
  const double begin = random.uniform(0, std::max(0.0, given.duration - kSeconds));
  std::vector<std::size_t> followed;
  Vector2d middle = Vector2d::Zero(), velocity = Vector2d::Zero();
  for (std::size_t i = 0; i < p.cars.size(); ++i) {
    p.cars[i].road = std::make_shared<Later>(p.cars[i].road, begin);
    if (!p.cars[i].followed) continue;
    followed.push_back(i);
    middle += p.cars[i].road->at(0).position;
    velocity += p.cars[i].road->at(0).velocity;
  }
  middle /= double(followed.size());
  velocity /= double(followed.size());
  // In the middle of the pursuit: near the vehicles, nearly with their velocity.
  const double angle = random.uniform(-std::numbers::pi, std::numbers::pi), aside = random.uniform(0, 15);
  p.start.position.head<2>() = middle + aside * Vector2d(std::cos(angle), std::sin(angle));
  p.start.velocity.setZero();
  p.start.velocity.head<2>() = velocity + Vector2d(random.uniform(-1, 1), random.uniform(-1, 1));
  if (p.vertical) p.start.position.z() = p.vertical->altitude;
  trial.hidden = followed[std::size_t(random.uniform(0, double(followed.size())))];
  trial.from = random.uniform(3, 5);
  trial.to = trial.from + kHidden;
  // A roof over its way: it covers all of the vehicle from `from` to `to`.
  const simulation::Road& road = *p.cars[trial.hidden].road;
  Vector2d low = road.at(trial.from).position, high = low;
  for (double t = trial.from; t <= trial.to; t += 0.05) {
    low = low.cwiseMin(road.at(t).position);
    high = high.cwiseMax(road.at(t).position);
  }
  constexpr double kHalfDiagonal = 3.6;  // m, of a vehicle, with some to spare
  Occluder roof;
  roof.centre = 0.5 * (low + high);
  roof.size = high - low + Vector2d::Constant(2 * kHalfDiagonal);
  roof.bottom = roof.top = p.eyes == Eyes::source ? 0 : 5;
  View& view = p.eyes == Eyes::source ? p.source_view : p.perspective_view;
  view.scene.occluders.push_back(roof);
  return trial;
}

std::string occlusion_row(const Pursuit& given, std::uint64_t run) {
  const Trial trial = trial_of(given, run);
  const PursuitRun flown = pursue(trial.pursuit);
  const PursuitSummary summary = summarise(trial.pursuit, flown);
  double longest = 0, said = std::nan(""), regained = std::nan("");
  for (const HiddenTime& hidden : flown.hidden) {
    const double end = hidden.to < 0 ? flown.end : hidden.to;
    if (end - hidden.from <= longest) continue;
    longest = end - hidden.from;
    said = hidden.said.value_or(std::nan(""));
    regained = hidden.regained.value_or(std::nan(""));
  }
  double followed = 0, swaps = 0, false_claims = 0;
  for (const CarSummary& car : summary.cars) {
    followed += car.followed;
    swaps += double(car.swaps);
    false_claims += double(car.false_claims);
  }
  std::string row;
  scenario::CsvRow(row)
      .number(double(run))
      .text(trial.pursuit.cars[trial.hidden].name)
      .number(longest)
      .number(said)
      .number(regained)
      .number(followed)
      .number(double(summary.cars.size()))
      .number(swaps)
      .number(false_claims);
  row.pop_back();
  return row;
}

}  // namespace

int run_starts(const Pursuit& pursuit, const PursueOptions& options, std::ostream& out) {
  if (!(options.within >= 0)) throw InputError("--within", to_text(options.within), "0 or more (m)");
  work::ResumableTable table{"starts.csv"};
  table.settings = settings_of(pursuit, options, ("starts within " + to_text(options.within) + " m").c_str());
  table.header = "start,dx [m],dy [m],mean_r [m],most_r [m],speed_error [m/s],layer [1]";
  table.count = options.starts;
  table.block = 2;
  table.row = [&](std::uint64_t i) {
    Random random(pursuit.seed, i);
    Pursuit one = pursuit;
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi),
                 far = i == 0 ? 0 : options.within * std::sqrt(random.uniform(0, 1));
    const Vector2d moved = far * Vector2d(std::cos(angle), std::sin(angle));
    one.start.position.head<2>() += moved;
    const PursuitSummary summary = summarise(one, pursue(one));
    std::string row;
    scenario::CsvRow(row)
        .number(double(i))
        .number(moved.x())
        .number(moved.y())
        .number(summary.mean_distance)
        .number(summary.most_distance)
        .number(summary.mean_speed_error)
        .number(summary.layer_share);
    row.pop_back();
    return row;
  };
  const auto tell = [&](Results& found, work::StagedFolder& folder) {
    const simulation::Table rows = read_table(folder.resumable(table.name));
    const std::vector<double>& means = rows.find("mean_r")->numbers;
    found.summary = {{"settings", table.settings},
                     {"starts", means.size()},
                     {"mean_r",
                      {{"least", quantile(means, 0)},
                       {"quartile", quantile(means, 0.25)},
                       {"median", quantile(means, 0.5)},
                       {"third_quartile", quantile(means, 0.75)},
                       {"greatest", quantile(means, 1)}}},
                     {"layer", quantile(rows.find("layer")->numbers, 0.5)}};
    found.text << "starts              " << means.size() << ", within " << number_text(options.within)
               << " m\n"
               << "mean distance       least " << number_text(quantile(means, 0), 4) << ", quartiles "
               << number_text(quantile(means, 0.25), 4) << " " << number_text(quantile(means, 0.5), 4) << " "
               << number_text(quantile(means, 0.75), 4) << ", greatest " << number_text(quantile(means, 1), 4)
               << " m\n";
    found.scripts = {"pursuit_starts.py"};
    found.files = {table.name, "summary.json"};
    found.old = kPictures;
  };
  return run_job({options, {options.scenario}, {{table, "starts"}}}, tell, out);
}

int run_random(const Pursuit& pursuit, const PursueOptions& options, std::ostream& out) {
  if (pursuit.eyes == Eyes::exact)
    throw InputError("--camera", "exact", "source or perspective, with --random");
  work::ResumableTable table{"occlusions.csv"};
  table.settings = settings_of(pursuit, options, "random occlusions");
  table.header = "run,body,hidden [s],said [s],regained [s],followed,cars,swaps,false_claims";
  table.count = options.random;
  table.block = 2;
  table.row = [&](std::uint64_t i) { return occlusion_row(pursuit, i); };
  const auto tell = [&](Results& found, work::StagedFolder& folder) {
    constexpr double kSoon = 0.5, kFrames = 3;  // s; pictures
    const simulation::Table rows = read_table(folder.resumable(table.name));
    const auto &regained = rows.find("regained")->numbers, &said = rows.find("said")->numbers,
               &swaps = rows.find("swaps")->numbers, &lies = rows.find("false_claims")->numbers;
    std::size_t soon = 0, quick = 0;
    double all_swaps = 0, all_lies = 0;
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      soon += regained[i] <= kSoon + 1e-9;
      quick += said[i] <= kFrames * pursuit.picture_step + 1e-9;
      all_swaps += swaps[i];
      all_lies += lies[i];
    }
    const double runs = double(rows.rows());
    found.summary = {
        {"settings", table.settings},        {"runs", rows.rows()}, {"regained_soon", double(soon) / runs},
        {"said_soon", double(quick) / runs}, {"swaps", all_swaps},  {"false_claims", all_lies}};
    found.text << "runs                " << rows.rows() << ", each with one vehicle hidden for "
               << number_text(kHidden) << " s\n"
               << "regained            within " << number_text(kSoon) << " s in "
               << number_text(100 * double(soon) / runs, 4) << " %\n"
               << "total said          within 3 pictures in " << number_text(100 * double(quick) / runs, 4)
               << " %\n"
               << "claims              " << number_text(all_lies)
               << " pictures with a box beside its vehicle, " << number_text(all_swaps)
               << " on another one\n";
    found.scripts = {"pursuit_occlusions.py"};
    found.files = {table.name, "summary.json"};
    found.old = kPictures;
  };
  return run_job({options, {options.scenario}, {{table, "runs"}}}, tell, out);
}

}  // namespace vericone::pursuit
