// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/scenarios/scenario_files.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>

#include "commands.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "scenarios/tracks_json.h"
#include "simulate/run_text.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

using namespace simulation;
using scenario::print_line, scenario::TracksFile;

struct CertifyCommand {
  std::string tracks, certificate, out;  // out: folder of the picture, or none
  bool figures = true, quiet = false, json = false;
};

constexpr std::size_t kMostPairs = 12;

std::string five_digits(double x) { return number_text(x, 5); }

std::string place_text(const Eigen::Vector3d& x) {
  return "(" + five_digits(x.x()) + ", " + five_digits(x.y()) + ", " + five_digits(x.z()) + ") m";
}

std::string pair_text(const TracksFile& tracks, const PairOnTracks& pair) {
  const TrackedBody &a = tracks.bodies[pair.a], &b = tracks.bodies[pair.b];
  const std::string names = a.name + ", " + b.name + ": ";
  const double required = tracks.options.required;
  const bool loose = a.radius + b.radius > 0;
  const std::string wanted = required > 0 ? five_digits(required) + " m" : "contact";
  switch (pair.verdict) {
    case TrackVerdict::apart:
      return names + "apart by " + at_least_text(pair.least_distance, 5) + " m or more, proved from " +
             five_digits(pair.from) + " to " + five_digits(pair.to) + " s; nearest at " +
             five_digits(pair.least_time) + " s";
    case TrackVerdict::contact:
      return names + "apart before " + bounds_text(pair.from, pair.to, " s, meeting at ") + " s at " +
             place_text(pair.place) + ", both proved";
    case TrackVerdict::nearer: {
      std::string text = names + (required > 0 ? "nearer than " + wanted : "in contact") +
                         (loose ? " for some motions within the radii" : "") + ": not before " +
                         bounds_text(pair.from, pair.to, " s, by ") + " s, both proved";
      if (pair.stated && pair.stated->verdict == ProofVerdict::avoided)
        text +=
            "; the tracks themselves are apart by " + at_least_text(pair.stated->least_distance, 5) + " m";
      return text;
    }
    case TrackVerdict::undecided:
      return names + "nearer to " + wanted + " than the proof resolves between " +
             bounds_text(pair.from, pair.to) + " s, near " + place_text(pair.place);
  }
  return names;
}

std::string limit_text(const TracksFile& tracks, const LimitOnTrack& one) {
  const bool speed = one.derivative == 1;
  const std::string unit = speed ? " m/s" : " m/s^2";
  std::string text = tracks.bodies[one.body].name + ": " + (speed ? "speed" : "acceleration") + " at most " +
                     five_digits(one.limit) + unit + ": " + to_string(one.verdict);
  const Greatest& greatest = one.greatest;
  text += one.verdict == LimitVerdict::undecided ? "" : ", proved";
  text += one.verdict == LimitVerdict::kept
              ? "; never above " + at_most_text(greatest.most, 5) + unit
              : "; " + at_least_text(greatest.least, 5) + unit + " at " + five_digits(greatest.time) + " s";
  if (!speed && greatest.jump > tracks.options.join)
    text += "; its velocity jumps by " + at_least_text(greatest.jump, 5) + " m/s";
  return text;
}

/// Contacts first, then what is nearest.
bool worse(const PairOnTracks& x, const PairOnTracks& y) {
  if (x.verdict != y.verdict) return x.verdict < y.verdict;
  return x.verdict == TrackVerdict::apart ? x.least_distance < y.least_distance : x.to < y.to;
}

/// All of a few; of many those that are not kept.
void print_limits(const TracksFile& tracks, const CertifiedTracks& certified, std::ostream& out) {
  const std::size_t count = certified.limits.size();
  std::size_t kept = 0;
  std::string label = "limits";
  for (const LimitOnTrack& one : certified.limits) {
    kept += one.verdict == LimitVerdict::kept;
    if (count > kMostPairs && one.verdict == LimitVerdict::kept) continue;
    print_line(out, label, limit_text(tracks, one));
    label.clear();
  }
  if (count > kMostPairs)
    print_line(out, label, std::to_string(kept) + " of " + std::to_string(count) + " kept, proved: --json");
}

void print_certified(const TracksFile& tracks, const CertifiedTracks& certified, double seconds,
                     std::ostream& out) {
  print_line(out, "tracks", tracks.name);
  const std::size_t count = certified.pairs.size();
  std::string verdict =
      count == 0 ? "none: no two bodies are there together" : to_string(certified.verdict());
  if (count > 0 && certified.verdict() != TrackVerdict::undecided) verdict += ", proved";
  if (tracks.options.required > 0) verdict += "; required " + five_digits(tracks.options.required) + " m";
  print_line(out, "verdict", verdict);
  std::vector<PairOnTracks> pairs = certified.pairs;
  if (count > kMostPairs) std::stable_sort(pairs.begin(), pairs.end(), worse);
  for (std::size_t i = 0; i < std::min(count, kMostPairs); ++i)
    print_line(out, "", pair_text(tracks, pairs[i]));
  if (count > kMostPairs)
    print_line(out, "", "and " + std::to_string(count - kMostPairs) + " more pairs: --json");
  print_limits(tracks, certified, out);
  print_line(out, "time", number_text(seconds, 2) + " s");
}

struct Written {
  Json json{{"pairs", 0}, {"none", Json::array()}};
  std::vector<std::string> lines;
};

/// Nothing where it was interrupted.
std::optional<Written> write_certificates(const TracksFile& tracks, const CertifiedTracks& certified,
                                          const std::string& file, Progress& progress) {
  CertifyOptions options = tracks.options;
  bool stopped = false;
  options.goes_on = [&](double share) {
    stopped = !progress.show("certificates of " + tracks.name, share);
    return !stopped;
  };
  const RunCertificates made = certificates(tracks.bodies, certified, options);
  if (stopped) return std::nullopt;
  Written written;
  std::string text;
  std::size_t pairs = 0;
  for (const RunCertificate& one : made.made) {
    text.append(one.text).append("\n");
    pairs += one.pairs.size();
    written.lines.push_back(scenario::certificate_text(one) + ": " + file);
  }
  written.json["pairs"] = pairs;
  for (const WithoutCertificate& none : made.none) {
    written.json["none"].push_back({{"what", none.what}, {"reason", none.reason}});
    written.lines.push_back("none of " + none.what + ": " + none.reason);
  }
  if (!text.empty()) write_whole(file, text);
  return written;
}

/// What the picture is drawn from: the answer, and where the bodies are over time.
Json picture_json(const TracksFile& tracks, const CertifiedTracks& certified) {
  constexpr int kPlaces = 400;
  Json data = scenario::certified_json(tracks, certified);
  data["required"] = tracks.options.required;
  data["bodies"] = Json::array();
  for (std::size_t i = 0; i < tracks.bodies.size(); ++i) {
    const Track& track = certified.tracks[i].track;
    Json positions = Json::array();
    for (int k = 0; k < kPlaces; ++k) {
      const double share = static_cast<double>(k) / (kPlaces - 1);
      const double t = track.appears() + share * (track.end() - track.appears());
      positions.push_back(vector_json(track.motion(std::min(t, track.end())).position));
    }
    data["bodies"].push_back({{"name", tracks.bodies[i].name},
                              {"radius", tracks.bodies[i].radius},
                              {"from", track.appears()},
                              {"to", track.end()},
                              {"positions", std::move(positions)}});
  }
  for (std::size_t i = 0; i < certified.pairs.size(); ++i) {
    const Track &a = certified.tracks[certified.pairs[i].a].track,
                &b = certified.tracks[certified.pairs[i].b].track;
    data["pairs"][i]["there"] = {
        std::max({a.appears(), b.appears(), tracks.options.from.value_or(a.appears())}),
        std::min({a.end(), b.end(), tracks.options.to.value_or(a.end())})};
  }
  return data;
}

/// Where its files are.
std::string write_picture(const TracksFile& tracks, const CertifiedTracks& certified,
                          const CertifyCommand& options, work::StagedFolder& folder) {
  write_whole(folder.path() / "certified.json", picture_json(tracks, certified).dump(1) + "\n");
  if (options.figures) draw_figures("certify/certified.py", folder.path());
  std::string list;
  for (const auto& file : folder.publish({"certified.json", "certified.pdf", "certified.png"}))
    list.append(list.empty() ? "" : ", ").append(file.filename().string());
  return options.out + ": " + list;
}

/// Proves what a file of tracks asks. Returns the exit status: 0 whatever the answers are, 130 interrupted.
/// Throws InputError.
int run_certify(const CertifyCommand& options, std::ostream& out) {
  TracksFile tracks = scenario::tracks_of_text(input::read_scene_text(options.tracks), options.tracks);
  std::optional<work::StagedFolder> folder;
  if (!options.out.empty()) folder.emplace(options.out, "--out");
  std::optional<Written> written;
  std::optional<CertifiedTracks> certified;
  std::string picture;
  double seconds = 0;
  {
    Progress progress(options.quiet);
    tracks.options.goes_on = [&](double share) { return progress.show("proving " + tracks.name, share); };
    const auto start = Clock::now();
    certified = scenario::certified_of(tracks);
    seconds = seconds_since(start);
    if (certified->interrupted) return kExitInterrupted;
    if (!options.certificate.empty()) {
      written = write_certificates(tracks, *certified, options.certificate, progress);
      if (!written) return kExitInterrupted;
    }
    if (folder) {
      progress.show("drawing", 0);
      picture = write_picture(tracks, *certified, options, *folder);
    }
  }
  if (options.json) {
    Json answer = scenario::certified_json(tracks, *certified);
    if (written) answer["certificate"] = written->json;
    out << answer.dump(1) << '\n';
    return 0;
  }
  print_certified(tracks, *certified, seconds, out);
  if (written)
    for (const std::string& line : written->lines)
      print_line(out, &line == &written->lines.front() ? "certificate" : "", line);
  if (folder) print_line(out, "written", picture);
  return 0;
}

}  // namespace

int certify_command(CommandLine& line) {
  CertifyCommand certify;
  line.option("tracks", certify.tracks,
              "File of bodies and the tracks that somebody else made for them, YAML or JSON "
              "(docs/reference/formats.md)")
      .required();
  line.option("--certificate", certify.certificate,
              "Also write here what proves that bodies stay apart, for programs that check it "
              "(docs/reference/certificates.md)");
  line.option("--out", certify.out,
              "Folder for a picture of the tracks and of what is proved when, certified.png, and its data");
  line.negative_flag("--no-figures", certify.figures, "Data of the picture only");
  line.flag("--quiet", certify.quiet, "No progress");
  line.flag("--json", certify.json, "Print JSON");
  line.read();
  return run_certify(certify, std::cout);
}

}  // namespace vericone
