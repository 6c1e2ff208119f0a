// SPDX-License-Identifier: BSD-3-Clause
#include "pursue/pursue_command.h"

#include <vericone/geometry/error.h>
#include <vericone/vision/footage/footage.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <ostream>
#include <sstream>

#include "command/output_line.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "json/plain_text.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "pursue/pursuit_campaign.h"
#include "pursue/pursuit_tables.h"
#include "pursuits/read_pursuit.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone::pursuit {
namespace {

namespace fs = std::filesystem;
using namespace vision;

template <typename Choice>
Choice chosen(const std::string& option, const std::string& word, Choice otherwise,
              std::initializer_list<std::pair<const char*, Choice>> choices) {
  if (word.empty()) return otherwise;
  std::string list;
  for (const auto& [name, choice] : choices) {
    if (word == name) return choice;
    list.append(list.empty() ? "" : ", ").append(name);
  }
  throw InputError(option, word, "one of " + list);
}

Pursuit read(const PursueOptions& options, const std::string& text) {
  const fs::path file = options.scenario;
  const Json fields = input::scene_fields(text, file.string());
  input::require_kind(fields, input::FileKind::pursuit, file.string());
  const Eyes eyes =
      chosen<Eyes>("--camera", options.camera, Eyes::perspective,
                   {{"perspective", Eyes::perspective}, {"source", Eyes::source}, {"exact", Eyes::exact}});
  Pursuit pursuit = read_pursuit(fields, plain_text(file.stem().string()), file.parent_path(), eyes);
  const auto whose = {std::pair("ours", Whose::ours), std::pair("source", Whose::source)};
  pursuit.tracker = chosen<Whose>("--tracker", options.tracker, Whose::ours, whose);
  pursuit.law = chosen<Whose>("--law", options.law, Whose::ours, whose);
  if (pursuit.eyes == Eyes::exact && (!options.video.empty() || !options.frames.empty()))
    throw InputError(options.video.empty() ? "--frames" : "--video",
                     options.video.empty() ? options.frames : options.video,
                     "left out with --camera exact, which has no pictures");
  if (options.duration) {
    if (!(*options.duration > 0))
      throw InputError("--duration", to_text(*options.duration), "a positive number (s)");
    pursuit.duration = *options.duration;
  }
  if (options.seed) pursuit.seed = *options.seed;
  return pursuit;
}

Json summary_json(const Pursuit& pursuit, const PursuitRun& run, const PursuitSummary& summary) {
  Json cars = Json::array();
  for (const CarSummary& car : summary.cars) {
    Json one{{"name", car.name}};
    if (pursuit.eyes != Eyes::exact)
      one.update({{"pixels_rms", car.pixels_rms},
                  {"error_rms", car.error_rms},
                  {"swaps", car.swaps},
                  {"false_claims", car.false_claims},
                  {"in_view", car.in_view},
                  {"followed", car.followed}});
    cars.push_back(one);
  }
  Json boxes = Json::array();
  for (const vision::Box& box : run.boxes) boxes.push_back({box.x, box.y, box.w, box.h});
  return {{"pursuit", pursuit.name},
          {"camera", to_string(pursuit.eyes)},
          {"tracker", to_string(pursuit.tracker)},
          {"law", to_string(pursuit.law)},
          {"end", run.end},
          {"pictures", run.samples.size()},
          {"mean_distance", summary.mean_distance},
          {"most_distance", summary.most_distance},
          {"mean_speed_error", summary.mean_speed_error},
          {"layer_share", summary.layer_share},
          {"boxes", boxes},
          {"hidden_times", run.hidden.size()},
          {"cars", cars}};
}

void print(const Pursuit& pursuit, const PursuitRun& run, const PursuitSummary& summary, double seconds,
           std::ostream& out) {
  const auto line = [&](const std::string& label, const std::string& text) {
    out << std::left << std::setw(20) << label << text << '\n';
  };
  line("pursuit", pursuit.name);
  line("seen by",
       std::string("camera ") + to_string(pursuit.eyes) +
           (pursuit.eyes == Eyes::exact ? "" : std::string(", tracker ") + to_string(pursuit.tracker)) +
           ", law " + to_string(pursuit.law));
  line("end", number_text(run.end) + " s, " + std::to_string(run.samples.size()) + " pictures");
  line("distance", "mean " + number_text(summary.mean_distance, 4) + " m, at most " +
                       number_text(summary.most_distance, 4) +
                       " m, of the UAS from the vehicles' centre, over the last two thirds");
  line("speed", "mean error " + number_text(summary.mean_speed_error, 3) + " m/s");
  if (pursuit.law == Whose::source)
    line("layer",
         number_text(100 * summary.layer_share, 3) + " % of the commands, where the law has none of its own");
  if (pursuit.eyes != Eyes::exact)
    for (const CarSummary& car : summary.cars)
      line(car.name, std::string(car.followed ? "followed to the end" : "lost at the end") +
                         (car.in_view ? "" : ", not in the picture") + "; " + number_text(car.pixels_rms, 3) +
                         " px RMS where it is seen, " + number_text(car.error_rms, 3) + " m on the ground; " +
                         std::to_string(car.false_claims) + " false claims, " + std::to_string(car.swaps) +
                         " swaps");
  std::size_t regained = 0, ended = 0;
  for (const HiddenTime& hidden : run.hidden) {
    ended += hidden.to >= 0;
    regained += hidden.regained.has_value();
  }
  if (!run.hidden.empty())
    line("hidden", std::to_string(run.hidden.size()) + " times; regained " + std::to_string(regained) +
                       " of " + std::to_string(ended));
  line("time", number_text(seconds, 3) + " s");
}

Image in_colour(const Image& image) {
  if (image.channels == 3) return image;
  Image result(image.width, image.height, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    std::fill_n(result.data.begin() + std::ptrdiff_t(3 * i), 3, image.data[i]);
  return result;
}

/// Everything that `track --own` needs to repeat the run's estimates.
class Recorder {
 public:
  /// `out`: the folder of all else, where the video may be too.
  Recorder(const PursueOptions& options, const Pursuit& pursuit, const work::StagedFolder& out)
      : pursuit_(pursuit) {
    for (const Car& car : pursuit.cars)
      if (car.followed) names_.push_back(car.name);
    const auto is_out = [&](const fs::path& folder) {
      return fs::weakly_canonical(folder) == fs::weakly_canonical(options.out);
    };
    if (!options.frames.empty()) {
      if (is_out(options.frames)) throw InputError("--frames", options.frames, "another folder than --out");
      frames_.emplace(options.frames, "--frames");
    }
    if (!options.video.empty()) {
      const fs::path file = options.video,
                     folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
      if (file.extension() != ".mp4") throw InputError("--video", options.video, "a file ending in .mp4");
      if (!is_out(folder)) video_.emplace(folder, "--video");
      const View& view = pursuit.eyes == Eyes::source ? pursuit.source_view : pursuit.perspective_view;
      writer_.emplace((video_ ? *video_ : out).path() / file.filename(), view.camera.width,
                      view.camera.height, 1 / pursuit.picture_step);
    }
    estimates_ = estimates_header();
  }

  void add(const Image& image, const PursuitSample& sample, const std::vector<Followed>& vehicles) {
    estimates_ += estimates_csv(count_, sample.camera_time, vehicles);
    if (frames_) {
      std::ostringstream name;
      name << std::setw(6) << std::setfill('0') << count_ << ".png";
      write_picture(frames_->path() / name.str(), image);
    }
    const bool shown = shown_.empty() && sample.t >= kShown * pursuit_.duration;
    if (writer_ || shown) {
      Image marked = in_colour(image);
      for (std::size_t i = 0; i < vehicles.size(); ++i)
        draw_sighting(marked, vehicles[i].sighting, names_[i]);
      if (writer_) writer_->add(marked);
      if (shown) shown_ = std::move(marked);
    }
    ++count_;
  }

  [[nodiscard]] const std::string& estimates() const { return estimates_; }
  /// A picture of about the middle of the run, with boxes; empty of a run that has none.
  [[nodiscard]] const Image& shown() const { return shown_; }

  void finish(const PursuitRun& run) {
    if (writer_) {
      writer_->close();
      if (video_) video_->publish({});
    }
    if (!frames_) return;
    write_whole(frames_->path() / "own.csv", own_csv(run));
    write_whole(
        frames_->path() / "camera.yaml",
        perception_json({perception_of(pursuit_), pursuit_.picture_step}).dump(1) + "\n");  // JSON is YAML
    std::string boxes;
    for (const vision::Box& box : run.boxes)
      boxes += "--box " + to_text(box.x) + "," + to_text(box.y) + "," + to_text(box.w) + "," +
               to_text(box.h) + "\n";
    write_whole(frames_->path() / "boxes.txt", boxes);
    frames_->publish({});
  }

 private:
  static constexpr double kShown = 0.55;  // of the duration

  const Pursuit& pursuit_;
  Image shown_;
  std::vector<std::string> names_;
  std::optional<work::StagedFolder> frames_, video_;
  std::optional<VideoWriter> writer_;
  std::string estimates_;
  std::size_t count_ = 0;
};

int run_one(const Pursuit& pursuit, const PursueOptions& options, const std::string& text,
            std::ostream& out) {
  work::StagedFolder folder(options.out, "--out");
  Recorder recorder(options, pursuit, folder);
  PursuitRun run;
  PursuitSummary summary;
  double seconds = 0;
  {
    Progress progress(options.quiet);
    PursuitOptions flight;
    flight.picture = [&](const Image& image, const PursuitSample& sample,
                         const std::vector<Followed>& vehicles) { recorder.add(image, sample, vehicles); };
    flight.progress = [&](double t) {
      return progress.show("pursuing " + pursuit.name, t / pursuit.duration);
    };
    const auto start = Clock::now();
    run = pursue(pursuit, flight);
    seconds = seconds_since(start);
    if (run.interrupted) return kExitInterrupted;
    progress.show("writing", 0);
    summary = summarise(pursuit, run);
    write_whole(folder.path() / "uas.csv", uas_csv(run));
    write_whole(folder.path() / "cars.csv", cars_csv(pursuit, run));
    if (pursuit.eyes != Eyes::exact) {
      write_whole(folder.path() / "own.csv", own_csv(run));
      write_whole(folder.path() / "estimates.csv", recorder.estimates());
      write_whole(folder.path() / "truth.csv", truth_csv(run));
      write_whole(folder.path() / "times.csv", times_csv(run));
      write_whole(folder.path() / "hidden.csv", hidden_csv(pursuit, run));
    }
    write_whole(folder.path() / "pursuit.yaml", text);
    Json json = summary_json(pursuit, run, summary);
    json["seconds"] = seconds;
    json["provenance"] = provenance(options.command_line, 1, {options.scenario});
    write_whole(folder.path() / "run.json", json.dump(1) + "\n");
    recorder.finish(run);
    if (options.figures) {
      progress.show("drawing", 0);
      if (!recorder.shown().empty()) write_picture(folder.path() / "seen.png", recorder.shown());
      draw_figures("pursuit.py", folder.path());
    }
  }
  const std::vector<fs::path> files = folder.publish(
      {"own.csv", "estimates.csv", "truth.csv", "times.csv", "hidden.csv", "pursuit.png", "pursuit.pdf"});
  if (options.json) {
    Json json = summary_json(pursuit, run, summary);
    json["seconds"] = seconds;
    out << json.dump(1) << '\n';
    return 0;
  }
  print(pursuit, run, summary, seconds, out);
  std::string list;
  for (const fs::path& file : files) list.append(list.empty() ? "" : ", ").append(file.filename().string());
  out << "written             " << options.out << ": " << list << '\n';
  if (!options.video.empty()) out << "video               " << options.video << '\n';
  if (!options.frames.empty()) out << "frames              " << options.frames << '\n';
  return 0;
}

}  // namespace

int run_pursue(const PursueOptions& options, std::ostream& out) {
  const std::string text = input::read_scene_text(options.scenario);
  const Pursuit pursuit = read(options, text);
  if (options.starts > 0 && options.random > 0)
    throw InputError("--random", std::to_string(options.random), "given without --starts");
  if ((options.starts > 0 || options.random > 0) && !(options.video.empty() && options.frames.empty()))
    throw InputError(options.video.empty() ? "--frames" : "--video",
                     options.video.empty() ? options.frames : options.video, "left out with many runs");
  for (const auto& [name, value] : {std::pair("--part", options.part), std::pair("--rows", options.rows)})
    if (!value.empty() && options.starts == 0 && options.random == 0)
      throw InputError(name, value, "left out, or given with --starts or --random");
  if (options.starts > 0) return run_starts(pursuit, options, out);
  if (options.random > 0) return run_random(pursuit, options, out);
  return run_one(pursuit, options, text, out);
}

}  // namespace vericone::pursuit

namespace vericone {

int pursue_command(CommandLine& line) {
  pursuit::PursueOptions pursue;
  line.option("scenario", pursue.scenario, "Pursuit, YAML (docs/reference/pursuits.md)").required();
  line.option("--camera", pursue.camera, "perspective, source (straight down, clean) or exact (no pictures)")
      .shown_default("perspective");
  line.option("--tracker", pursue.tracker, "ours or source").shown_default("ours");
  line.option("--law", pursue.law, "ours or source").shown_default("ours");
  line.option("--duration", pursue.duration, "Seconds").shown_default("the scenario's");
  line.option("--seed", pursue.seed, "Seed of all random numbers").shown_default("the scenario's");
  line.option("--video", pursue.video, "Also a video (MP4) of what the camera sees, with boxes");
  line.option("--frames", pursue.frames,
              "Also every picture as PNG, with own.csv, camera.yaml and boxes.txt for vericone track --own");
  line.option("--starts", pursue.starts, "In place of one run: so many, from starts near each other")
      .within(0, 100'000);
  line.option("--within", pursue.within, "Metres between the starts of --starts, at most");
  line.option("--random", pursue.random,
              "In place of one run: so many short ones, each with one vehicle hidden for 3 s")
      .within(0, 100'000);
  read_job_line(line, pursue);
  return pursuit::run_pursue(pursue, std::cout);
}

}  // namespace vericone
