// SPDX-License-Identifier: BSD-3-Clause
#include "command/catalogue.h"

#include <algorithm>

namespace vericone {
namespace {

using Examples = std::array<std::string, 2>;

// The groups of the help.
constexpr const char *kCones = "Verdicts and cones", *kFlights = "Flights",
                     *kScans = "Scans, meshes and maps", *kPursuit = "Cameras and pursuit",
                     *kPapers = "Papers and pictures", *kProofs = "How right the answers are";

constexpr const char* kNothing = "nothing is written";
constexpr const char* kGoesOn = "the same command goes on where it stopped";

/// `without`, `option`: what a build without it has not, and what switches it on.
CatalogueEntry command(const char* group, const char* name, const char* what, Examples examples,
                       const char* failed, const char* bad, const char* stopped,
                       const std::string& without = "", const char* option = "") {
  const std::string lacks = without.empty() ? "" : "a command without " + without,
                    needs = without.empty() ? "" : std::string("a build with VERICONE_") + option;
  return {group, name, what, std::move(examples), failed, bad, stopped, lacks, needs};
}

CatalogueEntry simulation(const char* group, const char* name, const char* what, Examples examples,
                          const char* failed, const char* stopped, const char* bad = "") {
  return command(group, name, what, std::move(examples), failed, bad, stopped, "simulation", "SIMULATION");
}

}  // namespace

const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> entries{
      simulation(kCones, "check",
                 "What a scene, a scenario, a pursuit or a body's file means, in plain words",
                 {"check scene.yaml", "check scenario.yaml"}, "", ""),
      command(kCones, "query", "Exact verdicts on engagements, one JSON object a line",
              {"query cases.jsonl", "query --rung - < cases.jsonl"}, "",
              "of a line: it says so, the others are answered", ""),
      command(kCones, "cone", "The collision cone of one scene",
              {"cone scene.yaml --out out/first", "cone scene.yaml --method slice --planes 72 --json"}, "",
              "", kNothing),
      command(kCones, "view", "A scene or a run as a page for any browser, which answers about it, exactly",
              {"view scene.yaml --open", "view out/simulate --out out/run.html"}, "", "", kNothing),
      command(kCones, "bands", "Which headings, speeds and climb rates are safe, one JSON object a line",
              {"bands docs/examples/bands.jsonl", "bands - < cases.jsonl"}, "",
              "of a line: it says so, the others are answered", ""),
      command(kCones, "avoid",
              "The nearest safe velocity, or the proof that there is none, one JSON object a line",
              {"avoid docs/examples/avoid.jsonl", "avoid - < cases.jsonl"}, "",
              "of a line: it says so, the others are answered", ""),
      simulation(kCones, "schema", "The JSON schema of a kind of file, for editors",
                 {"schema scene", "schema scenario > scenario.schema.json"}, "", ""),
      simulation(kFlights, "simulate", "A scenario of moving bodies, with a proof of what was avoided",
                 {"simulate scenario.yaml", "simulate scenario.yaml --json --no-figures --out out/flight"},
                 "", kNothing),
      simulation(kFlights, "reach",
                 "When openings can be reached at the earliest, proved, and by when a run passes them",
                 {"reach scenario.yaml", "reach scenario.yaml --current --json"}, "", kNothing),
      simulation(kFlights, "certify",
                 "Tracks that somebody else made: apart all the time, or when not, proved",
                 {"certify tracks.yaml", "certify tracks.yaml --json --certificate out/certificate.json"}, "",
                 kNothing),
      simulation(kFlights, "campaign", "Guidance laws on random engagements, every outcome proved",
                 {"campaign -N 2000 --laws clearance --required 0.5 --out out/clear",
                  "campaign --verdicts population.yaml -N 1000000"},
                 "a body met that a proved statement had called safe", kGoesOn),
      simulation(kFlights, "swarm", "Many agents that give way to each other, every pair proved",
                 {"swarm circle -N 50", "swarm sphere --method orca --no-figures --json --out out/orca"},
                 "a pair touched that the method promises to keep apart", kNothing),
      simulation(kFlights, "trials", "Laws under noisy measurements, share of trials proved avoided",
                 {"trials scenario.yaml -N 200",
                  "trials scenario.yaml --levels 10:20 --laws di,di-state,clearance --out out/noise"},
                 "", kGoesOn),
      simulation(kFlights, "robust-law",
                 "The correction that keeps noise within a bound, one JSON object a line",
                 {"robust-law cases.jsonl", "robust-law - < cases.jsonl"}, "", "",
                 "of a line: it says so, the others are answered"),
      command(kScans, "fit", "A quadric hull of a scan, with what is proved of it",
              {"fit bunny.ply --mode containing --shape biconvex", "fit bunny.ply --check out/fit/fit.json"},
              "a hull is not proved, a surface has not converged, a certificate does not hold", "", kNothing,
              "fits", "FITTING"),
      command(kScans, "scan",
              "What simulated LiDARs on the agent see of a mesh, and the cone they get from it",
              {"scan scene.yaml", "scan scene.yaml --planes 72 --levels 6 --no-figures --quiet"}, "", "",
              kNothing, "LiDARs", "LIDAR"),
      command(kScans, "gallery", "The cone of every mesh, cloud and octree map given, with pictures",
              {"gallery bunny.ply map.bt", "gallery scans --no-figures --map 0 --out out/scans"}, "",
              "of a file: the table says so, the others are answered", "what was done by then is written"),
      command(kPursuit, "track", "Targets followed through a video, from boxes in its first picture",
              {"track video.mp4 --box 559,333,35,42 --truth video.txt --out out/car",
               "track frames --box 10,20,30,16 60,20,30,16 --tracker source --no-video"},
              "", "of a video that is cut off: what could be read of it is written", kNothing, "cameras",
              "VISION"),
      simulation(kPursuit, "estimate",
                 "Position, velocity and acceleration of a measured track, now hidden, now seen",
                 {"estimate track.csv", "estimate track.csv --hidden source --noise 0.5 --out out/track"}, "",
                 kNothing),
      simulation(kPursuit, "law", "What a pursuit law commands, one JSON object a line",
                 {"law states.jsonl", "law - < states.jsonl"}, "", "",
                 "of a line: it says so, the others are answered"),
      command(kPursuit, "pursue",
              "A UAS that follows vehicles by what its camera sees, from pixels to thrust",
              {"pursue pursuit.yaml",
               "pursue pursuit.yaml --camera exact --law source --starts 40 --out out/starts"},
              "", "",
              "the same command goes on where it stopped, with --starts and --random; otherwise nothing is "
              "written",
              "a camera", "VISION"),
      simulation(kPapers, "figures", "The figures of a paper, with a report of its claims",
                 {"figures 5.6 6.13 --out out/two", "figures --paper chakravarthy1998"}, "",
                 "figures done by then are there"),
      simulation(kPapers, "claims", "What a paper prints beside what is measured, with verdicts",
                 {"claims", "claims --paper chakravarthy1998 --json --quiet"}, "", kNothing),
      simulation(kPapers, "paper", "A new paper: a folder with a scenario, figures and claims to begin with",
                 {"paper new my-paper", "paper new papers/smith2024"}, "", kNothing),
      command(kPapers, "shapes", "Pictures and meshes of combined quadrics",
              {"shapes --figure notch,stars", "shapes --mesh obj --no-figures --out out/bodies"}, "", "",
              kNothing),
      command(kProofs, "accuracy", "Accuracy of slice and exact cones against planes and samples",
              {"accuracy -N 1000 --planes 8,16,32 --semi-axes 0.2 0.5 --distance 2 20",
               "accuracy --cases cases.jsonl --no-figures --out out/mine"},
              "", "", kGoesOn),
      command(
          kProofs, "merge", "The parts of a command's rows, of many machines, become what one run writes",
          {"merge out/part-1 out/part-2 --out out/whole", "merge out/part-* --no-figures --out out/whole"},
          "", "", kGoesOn),
      command(
          kProofs, "rows", "Large tables from text to HDF5 and back, and what is in them",
          {"rows out/campaign/engagements.csv --out out/engagements.h5", "rows out/engagements.h5 --json"},
          "", "", kNothing, "HDF5", "HDF5"),
      command(kProofs, "mpi", "Commands whose results are rows, by all processes that mpirun starts",
              {"mpi accuracy", "mpi trials scenario.yaml"}, "one of the processes has died", "", kGoesOn,
              "MPI", "MPI"),
      command(kProofs, "signmap", "Answers on the doubles around a velocity that grazes exactly",
              {"signmap --seed 12", "signmap --cells 401 --no-figures --out out/grazing"}, "", "", kNothing),
      command(kProofs, "verify", "Hold the library against exact constructions (CGAL)",
              {"verify --cases 1000 --pairs 10", "verify --cases 0 --pairs 100 --seed 7 --json"},
              "an answer was wrong", "", "what was done by then is printed", "CGAL", "VERIFY")};
  return entries;
}

const CatalogueEntry* find_entry(const std::string& name) {
  const auto it = std::find_if(catalogue().begin(), catalogue().end(),
                               [&](const CatalogueEntry& entry) { return entry.name == name; });
  return it == catalogue().end() ? nullptr : &*it;
}

std::string help_end(const CatalogueEntry& entry) {
  const auto also = [](const std::string& more) { return more.empty() ? "" : "; " + more; };
  std::string text = "Examples:\n";
  for (const std::string& words : entry.examples) text += "  vericone " + words + "\n";
  return text +
         "\nExit status:\n"
         "  0    done\n"
         "  1    something outside the program failed, such as a disk" +
         (entry.failed.empty() ? "" : "; or " + entry.failed) +
         "\n"
         "  2    bad input, named in one line" +
         also(entry.bad) +
         "\n"
         "  130  interrupted" +
         also(entry.stopped) + "\n";
}

}  // namespace vericone
