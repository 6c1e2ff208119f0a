// SPDX-License-Identifier: BSD-3-Clause
#include "paper/shuffle.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "input/scene.h"
#include "output/output_file.h"
#include "output/temporary_folder.h"
#include "work/provenance.h"

namespace vericone::paper {
namespace {

namespace fs = std::filesystem;
using engagements::Random;

/// A chosen number, by its index in `of`, and where it lies in each draw.
struct Drawn {
  std::string path;  // of claims.yaml
  const Chosen& of;
  std::size_t index;
  std::vector<double> values;
};

/// A value in each of `count` equal parts of the range, in random order (a Latin hypercube): few draws reach
/// all of it, and as many draws as there are whole numbers take each of them once.
std::vector<double> drawn(const Chosen& chosen, std::size_t index, std::size_t count, Random& random) {
  std::vector<std::size_t> parts(count);
  std::iota(parts.begin(), parts.end(), 0);
  for (std::size_t i = count; i-- > 1;)
    std::swap(parts[i], parts[std::size_t(random.uniform() * double(i + 1))]);
  const auto [from, to] = chosen.ranges[index];
  std::vector<double> values;
  for (const std::size_t part : parts) {
    const double share = (double(part) + random.uniform()) / double(count);
    values.push_back(chosen.whole         ? std::floor(from + (to - from + 1) * share)
                     : chosen.logarithmic ? from * std::pow(to / from, share)
                                          : from + (to - from) * share);
  }
  return values;
}

std::vector<Drawn> draws_of(const Paper& paper, const ClaimsOptions& options) {
  for (const std::string& name : options.only)
    if (std::none_of(paper.fits().begin(), paper.fits().end(),
                     [&](const auto& f) { return f->name == name; }))
      throw InputError("--only", name, "the name of one of fits in claims.yaml");
  std::vector<Drawn> list;
  for (const auto& fit : paper.fits()) {
    if (!options.only.empty() &&
        std::find(options.only.begin(), options.only.end(), fit->name) == options.only.end())
      continue;
    for (const Chosen& chosen : fit->chosen)
      for (std::size_t i = 0; i < chosen.paths.size(); ++i) {
        Random random(options.seed, list.size());
        list.push_back({"claims.yaml: fits." + fit->name + "." + chosen.name, chosen, i,
                        drawn(chosen, i, options.shuffle, random)});
      }
  }
  if (list.empty())
    throw InputError("--shuffle", std::to_string(options.shuffle), "left out: no range is stated");
  return list;
}

/// A copy of the paper in `folder` whose chosen numbers are those of one draw.
void write_draw(const Paper& paper, const std::vector<Drawn>& list, std::size_t draw,
                const fs::path& folder) {
  fs::copy(paper.folder, folder, fs::copy_options::recursive);
  std::map<std::string, Json> changed;
  for (const Drawn& one : list)
    for (const std::string& file : one.of.files) {
      if (!fs::exists(folder / file))
        throw InputError(one.path + ".in", file, "a file in " + paper.folder.string());
      if (!changed.contains(file)) changed[file] = input::read_scene_fields((folder / file).string());
      const std::string& path = one.of.paths[one.index];
      const auto there = pointer_to(changed[file], path);
      if (!there || !changed[file].at(*there).is_number())
        throw InputError(one.path + ".at", path, "the path of a number in " + file);
      changed[file][*there] = one.values[draw];
      if (one.of.whole) changed[file][*there] = std::int64_t(one.values[draw]);
    }
  for (const auto& [file, fields] : changed)
    write_whole(folder / file, fields.dump(1) + "\n");  // JSON is YAML
}

struct Outcome {
  Claim chosen;
  int agrees = 0;      // draws in which it does
  bool moved = false;  // the verdict, or a number by more than its tolerance
  std::optional<double> least, greatest;

  void add(const Claim& claim) {
    agrees += paper::agrees(claim.verdict);
    moved = moved || claim.verdict != chosen.verdict ||
            (claim.ours_value && chosen.ours_value &&
             std::abs(*claim.ours_value - *chosen.ours_value) > chosen.tolerance.value_or(0));
    if (!claim.ours_value) return;
    least = std::min(least.value_or(*claim.ours_value), *claim.ours_value);
    greatest = std::max(greatest.value_or(*claim.ours_value), *claim.ours_value);
  }
  const char* says(std::uint64_t draws) const {
    if (!paper::agrees(chosen.verdict)) return agrees > 0 ? "not met as chosen" : "holds for none";
    return std::uint64_t(agrees) == draws ? "holds for any" : "fitted";
  }
  /// It rests on what was chosen, and claims.yaml does not say so.
  bool unnamed() const { return moved && chosen.fits.empty(); }
};

Json to_json(const Outcome& o, std::uint64_t draws) {
  return {{"id", o.chosen.id},
          {"ours", o.chosen.ours},
          {"verdict", to_string(o.chosen.verdict)},
          {"agrees", o.agrees},
          {"least", number_or_null(o.least)},
          {"greatest", number_or_null(o.greatest)},
          {"moved", o.moved},
          {"names_a_fit", !o.chosen.fits.empty()},
          {"says", o.says(draws)}};
}

}  // namespace

int shuffle_claims(const ClaimsOptions& options, Paper& paper, const Which& which, Progress& progress,
                   std::ostream& out) {
  if (!options.out.empty()) throw InputError("--out", options.out, "left out with --shuffle");
  const std::vector<Drawn> draws = draws_of(paper, options);
  const Which ours = [&](const Claim& claim) {
    return (claim.kind == Kind::result || claim.kind == Kind::code) && which(claim);
  };
  const auto measured = [&](Paper& of, std::size_t done) {
    Sources sources(of.folder, [&](const std::string& what, double) {
      return progress.show("measuring " + what, double(done) / double(options.shuffle + 1));
    });
    return of.measured_claims(sources, ours);
  };
  std::vector<Outcome> outcomes;
  for (Claim& claim : measured(paper, 0)) outcomes.push_back({std::move(claim), 0, false, {}, {}});
  for (std::size_t i = 0; i < options.shuffle; ++i) {
    const TemporaryFolder folder;
    write_draw(paper, draws, i, folder.path() / paper.name());
    Paper other((folder.path() / paper.name()).string());
    const std::vector<Claim> claims = measured(other, i + 1);
    for (std::size_t c = 0; c < claims.size(); ++c) outcomes[c].add(claims[c]);
  }
  if (options.json) {
    Json list = Json::array(), values = Json::object();
    for (const Outcome& o : outcomes) list.push_back(to_json(o, options.shuffle));
    for (const Drawn& one : draws)
      values[one.path.substr(std::string("claims.yaml: fits.").size())][one.of.paths[one.index]] = one.values;
    out << Json{{"claims", list},
                {"draws", values},
                {"seed", options.seed},
                {"provenance", provenance(options.command_line, 1, {paper.folder / "claims.yaml"})}}
               .dump(1)
        << '\n';
    return 0;
  }
  for (const Outcome& o : outcomes) {
    out << o.chosen.id << ": " << o.chosen.what << '\n'
        << "  as chosen   " << o.chosen.ours << ": " << to_string(o.chosen.verdict) << '\n'
        << "  shuffled    agrees in " << o.agrees << " of " << options.shuffle << " draws";
    if (o.least) out << ", from " << short_text(*o.least) << " to " << short_text(*o.greatest);
    out << '\n' << "  says        " << o.says(options.shuffle) << '\n';
    if (o.unnamed()) out << "  missing     a fit: it rests on what was chosen\n";
  }
  return 0;
}

}  // namespace vericone::paper
