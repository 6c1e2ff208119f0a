// SPDX-License-Identifier: BSD-3-Clause
#include "track/track_command.h"

#include <vericone/geometry/error.h>
#include <vericone/vision/footage/footage.h>
#include <vericone/vision/tracker.h>
#include <vericone/work/staged_folder.h>
#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <sstream>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "pursue/pursuit_tables.h"
#include "track/metrics.h"
#include "track/own.h"
#include "track/truth.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone {
namespace {

using namespace tracking;
using vision::Image;
using vision::Sighting;

constexpr double kUsualRate = 30;

struct Run {
  std::vector<std::vector<Said>> said;  // by target
  std::vector<double> seconds;          // of each picture but the first
  std::size_t pictures = 0;
  double rate = kUsualRate;
  bool interrupted = false;
};

double rate_of(const vision::Reader& reader, const TrackOptions& options) {
  if (options.rate && !(*options.rate >= 0.1 && *options.rate <= 10'000))
    throw InputError("--rate", to_text(*options.rate), "from 0.1 to 10000 pictures a second");
  if (options.rate) return *options.rate;
  return reader.rate() >= 0.1 ? reader.rate() : kUsualRate;
}

/// `seconds`: from picture to picture.
std::unique_ptr<vision::Tracker> tracker_of(const std::string& name, double seconds) {
  if (name == "source") return vision::source_tracker();
  if (name == "ours" || name.empty()) return vision::tracker({.frame_seconds = seconds});
  throw InputError("--tracker", name, "source or ours");
}

/// A target as the command numbers it: those that are marked later come later.
struct Target {
  FirstBox first;
  std::size_t given;  // its place among those given
};

std::vector<Target> in_order(const std::vector<FirstBox>& boxes) {
  std::vector<Target> targets;
  for (std::size_t i = 0; i < boxes.size(); ++i) targets.push_back({boxes[i], i});
  std::stable_sort(targets.begin(), targets.end(),
                   [](const Target& a, const Target& b) { return a.first.frame < b.first.frame; });
  return targets;
}

Sighting marked(const vision::Box& box) {
  Sighting s;
  s.sight = vision::Sight::no_occlusion;
  s.box = box;
  s.measured = true;
  s.confidence = 1;
  return s;
}

class Follower {
 public:
  Follower(const TrackOptions& options, const std::vector<FirstBox>& boxes, Run& run)
      : options_(options), targets_(in_order(boxes)), run_(run) {
    run_.said.resize(boxes.size());
    if (options.own.empty()) return;
    for (const FirstBox& box : boxes)
      if (box.frame != 1)
        throw InputError("--box", "one of frame " + std::to_string(box.frame), "of frame 1, with --own");
    own_.emplace(read_own(options.own, options.camera));
    if (!options.tracker.empty()) own_->perception.source = options.tracker == "source";
    perception_.emplace(own_->perception,
                        tracker_of(own_->perception.source ? "source" : "ours", own_->seconds));
    estimates_ = pursuit::estimates_header();
  }

  /// Of --own.
  [[nodiscard]] const std::string& estimates() const { return estimates_; }

  /// The next picture, in grey.
  void take(const Image& grey) {
    if (perception_) {
      perceive(grey);
      return;
    }
    const std::size_t frame = ++run_.pictures;
    if (!tracker_) tracker_ = tracker_of(options_.tracker, 1 / run_.rate);
    if (following_ > 0) {
      const auto start = Clock::now();
      const std::vector<Sighting>& sightings = tracker_->step(grey, std::nullopt, {});
      run_.seconds.push_back(seconds_since(start));
      for (std::size_t i = 0; i < following_; ++i)
        run_.said[targets_[i].given].push_back({frame, sightings[i]});
    }
    std::vector<vision::Box> first;
    const std::size_t from = following_;
    while (from + first.size() < targets_.size() && targets_[from + first.size()].first.frame == frame)
      first.push_back(targets_[from + first.size()].first.box);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Target& target = targets_[from + i];
      try {
        if (following_ == 0) {
          tracker_->start(grey, std::span(&first[i], 1));
        } else {
          tracker_->add(first[i]);
        }
      } catch (const InputError& error) {
        throw InputError("--box", error.value(), error.requirement());
      }
      ++following_;
      run_.said[target.given].push_back({frame, marked(first[i])});
    }
  }

  std::size_t waiting() const { return targets_.size() - following_; }
  std::size_t next_frame() const { return targets_[following_].first.frame; }

 private:
  void perceive(const Image& grey) {
    const std::size_t frame = run_.pictures++;
    if (frame >= own_->poses.size())
      throw InputError("--own", options_.own + " of " + std::to_string(own_->poses.size()) + " rows",
                       "a row for each picture");
    const OwnPose& own = own_->poses[frame];
    if (grey.width != own_->perception.camera.width || grey.height != own_->perception.camera.height)
      throw InputError("--camera", options_.camera,
                       "of pictures of " + std::to_string(grey.width) + " x " + std::to_string(grey.height) +
                           " pixels, as these are");
    if (frame == 0) {
      std::vector<vision::Box> boxes;
      for (const Target& target : targets_) boxes.push_back(target.first.box);
      try {
        perception_->start(grey, own.camera, own.t, boxes);
      } catch (const InputError& error) {
        throw InputError("--box", error.value(), error.requirement());
      }
      following_ = targets_.size();
    } else {
      const auto start = Clock::now();
      perception_->step(grey, own.camera, own.t);
      run_.seconds.push_back(seconds_since(start));
    }
    for (std::size_t i = 0; i < following_; ++i)
      run_.said[targets_[i].given].push_back({frame + 1, perception_->vehicles()[i].sighting});
    estimates_ += pursuit::estimates_csv(frame, own.t, perception_->vehicles());
  }

  const TrackOptions& options_;
  std::vector<Target> targets_;
  Run& run_;
  std::unique_ptr<vision::Tracker> tracker_;
  std::optional<Own> own_;
  std::optional<vision::Perception> perception_;
  std::string estimates_;
  std::size_t following_ = 0;
};

void draw(Image& picture, const Run& run) {
  for (std::size_t i = 0; i < run.said.size(); ++i) {
    if (run.said[i].empty() || run.said[i].back().frame != run.pictures) continue;
    const Sighting& s = run.said[i].back().sighting;
    vision::draw_sighting(picture, s, std::to_string(i + 1));
  }
}

std::string fixed(double x, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << std::fixed << x;
  return text.str();
}

std::string csv(const Run& run) {
  struct Row {
    std::size_t frame, target;
    const Sighting* sighting;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < run.said.size(); ++i)
    for (const Said& s : run.said[i]) rows.push_back({s.frame, i + 1, &s.sighting});
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.frame < b.frame; });
  std::string text = "frame,target,state,x,y,w,h,confidence\n";
  for (const Row& r : rows) {
    const vision::Box& b = r.sighting->box;
    text += std::to_string(r.frame) + ',' + std::to_string(r.target) + ',' + to_string(r.sighting->sight);
    for (const double x : {b.x, b.y, b.w, b.h}) text += ',' + fixed(x, 3);
    text += ',' + fixed(r.sighting->confidence, 3) + '\n';
  }
  return text;
}

/// In the form of a truth file: what was claimed, and absence where nothing was.
std::string claims(const Run& run) {
  std::string text;
  const auto box = [&](const vision::Box& b) {
    return fixed(b.x, 3) + ',' + fixed(b.y, 3) + ',' + fixed(b.w, 3) + ',' + fixed(b.h, 3);
  };
  if (run.said.size() == 1 && run.said[0].size() == run.pictures) {
    for (const Said& s : run.said[0])
      text += (s.sighting.measured ? box(s.sighting.box) : std::string("nan,nan,nan,nan")) + '\n';
    return text;
  }
  std::vector<std::pair<std::size_t, std::string>> rows;
  for (std::size_t i = 0; i < run.said.size(); ++i)
    for (const Said& s : run.said[i])
      if (s.sighting.measured)
        rows.emplace_back(s.frame, std::to_string(s.frame) + ',' + std::to_string(i + 1) + ',' +
                                       box(s.sighting.box) + ",1\n");
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& row : rows) text += row.second;
  return text;
}

void check_length(const Truth& truth, std::size_t pictures, const TrackOptions& options) {
  const std::size_t last = truth.last_frame();
  const bool part = options.frames && std::size_t(*options.frames) < last;
  if (!part && (truth.every_frame ? last != pictures : last > pictures))
    throw InputError("--truth", options.truth + " of " + std::to_string(last) + " frames",
                     "of the video's length, " + std::to_string(pictures) + " pictures");
}

Json metrics_json(const TrackOptions& options, const Run& run, const Truth* truth,
                  const std::optional<std::string>& broken) {
  std::vector<double> ms = run.seconds;
  for (double& x : ms) x *= 1e3;
  Json result{{"video", options.video},
              {"tracker", options.tracker.empty() ? "ours" : options.tracker},
              {"targets", run.said.size()},
              {"pictures", run.pictures},
              {"rate", run.rate},
              {"cut_off", broken ? Json(*broken) : Json(nullptr)},
              {"truth_rows", nullptr},
              {"success_auc", nullptr},
              {"precision_20px", nullptr},
              {"claims", nullptr},
              {"claims_right", nullptr},
              {"false_claims", nullptr},
              {"absent_rows", nullptr},
              {"absent_claims", nullptr},
              {"longest_loss", longest_loss(run.said)},
              {"ms_median", quantile(ms, 0.5)},
              {"ms_p99", quantile(ms, 0.99)}};
  if (truth) {
    const Metrics m = compare(run.said, *truth);
    result["truth_rows"] = m.rows;
    result["success_auc"] = m.success_auc;
    result["precision_20px"] = m.precision_20px;
    result["claims"] = m.claims;
    result["claims_right"] = m.claims_right ? Json(*m.claims_right) : Json(nullptr);
    result["false_claims"] = m.false_claims;
    result["absent_rows"] = m.absent_rows;
    result["absent_claims"] = m.absent_claims;
  }
  return result;
}

void print(const Json& m, std::ostream& out) {
  out << "followed            " << m["targets"] << (m["targets"] == 1 ? " target" : " targets") << " through "
      << m["pictures"] << " pictures\n";
  if (!m["truth_rows"].is_null()) {
    out << "success (AUC)       " << number_text(m["success_auc"].get<double>(), 3) << " of "
        << m["truth_rows"] << " true boxes, 21 overlaps\n"
        << "precision           " << number_text(m["precision_20px"].get<double>(), 3) << " within 20 px\n"
        << "claims              " << m["claims"] << ", of which " << m["false_claims"]
        << " do not meet the true box\n";
    if (m["absent_rows"] != 0)
      out << "absent              " << m["absent_rows"] << " frames, claimed in " << m["absent_claims"]
          << '\n';
  }
  out << "longest loss        " << m["longest_loss"] << " pictures\n"
      << "time a picture      median " << number_text(m["ms_median"].get<double>(), 3) << " ms, 99 % within "
      << number_text(m["ms_p99"].get<double>(), 3) << " ms\n";
}

}  // namespace

int run_track(const TrackOptions& options, std::ostream& out) {
  std::vector<FirstBox> boxes = read_boxes(options.boxes);
  std::optional<Truth> truth;
  if (!options.truth.empty()) truth = read_truth(options.truth);
  if (boxes.empty() && truth) boxes = truth->first();
  if (boxes.empty())
    throw InputError("--box", "none", "at least one, or --truth to take the first ones from");
  if (truth && truth->boxes.size() != boxes.size())
    throw InputError("--truth", options.truth + " of " + std::to_string(truth->boxes.size()) + " targets",
                     "of as many targets as there are boxes, " + std::to_string(boxes.size()));
  if (options.frames && *options.frames < 2)
    throw InputError("--frames", std::to_string(*options.frames), "2 or more");
  Run run;
  static_cast<void>(tracker_of(options.tracker, 1 / run.rate));  // a wrong name is told before any work
  if (options.own.empty() != options.camera.empty())
    throw InputError(options.own.empty() ? "--own" : "--camera", "nothing", "given with the other one");
  const auto reader = vision::open_footage(options.video, 3, "video");
  run.rate = rate_of(*reader, options);

  work::StagedFolder folder(options.out, "--out");
  const std::filesystem::path& stage = folder.path();
  Progress progress(options.quiet);
  Follower follower(options, boxes, run);
  std::optional<vision::VideoWriter> video;
  Image picture;
  const std::size_t most = options.frames ? std::size_t(*options.frames) : std::size_t(-1);
  const double all = double(std::min(most, std::max<std::size_t>(1, reader->frames().value_or(1))));
  while (run.pictures < most && reader->next(picture)) {
    follower.take(vision::grey_of(picture));
    if (options.figures && run.pictures == 1) write_picture(stage / "first_picture.png", picture);
    if (options.figures && options.video_out) {
      if (!video) video.emplace(stage / "tracks.mp4", picture.width, picture.height, run.rate);
      draw(picture, run);
      video->add(picture);
    }
    if (!progress.show("following", double(run.pictures) / all)) return kExitInterrupted;
  }
  if (video) video->close();
  const std::optional<std::string> broken = reader->broken();
  if (follower.waiting() > 0)
    throw InputError("--box", "one of frame " + std::to_string(follower.next_frame()),
                     "of a frame of the video, which has " + std::to_string(run.pictures));
  if (truth && !broken) check_length(*truth, run.pictures, options);

  const Json metrics = metrics_json(options, run, truth ? &*truth : nullptr, broken);
  write_whole(stage / "tracks.csv", csv(run));
  write_whole(stage / "claims.txt", claims(run));
  if (!options.own.empty()) write_whole(stage / "estimates.csv", follower.estimates());
  write_whole(stage / "metrics.json", metrics.dump(1) + "\n");
  std::vector<std::filesystem::path> inputs;
  if (std::filesystem::is_regular_file(options.video)) inputs.emplace_back(options.video);
  if (truth) inputs.emplace_back(options.truth);
  write_whole(stage / "provenance.json", provenance(options.command_line, 1, inputs).dump(1) + "\n");
  if (options.figures) draw_figures("tracks.py", stage);
  const auto files =
      folder.publish({"estimates.csv", "tracks.pdf", "tracks.png", "tracks.mp4", "first_picture.png"});
  if (options.json) {
    out << metrics.dump(1) << '\n';
  } else {
    print(metrics, out);
    const std::filesystem::path shown = options.out;
    out << "written             " << (shown / "tracks.csv").string() << ", "
        << (shown / "claims.txt").string() << ", " << (shown / "metrics.json").string() << '\n';
    if (video) out << "video               " << (shown / "tracks.mp4").string() << '\n';
    for (const auto& file : pictures_of(files)) out << "picture             " << file.string() << '\n';
  }
  out.flush();
  if (broken) throw InputError("video", options.video + ", of which " + *broken, "a whole video");
  return 0;
}

}  // namespace vericone
