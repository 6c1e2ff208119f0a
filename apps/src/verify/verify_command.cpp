// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/verify_command.h"

#include <vericone/internal/verify/assembly/campaign.h>
#include <vericone/internal/verify/planar/methods.h>
#include <vericone/internal/verify/predicates/campaign.h>
#include <vericone/verify/planar/campaign.h>
#include <vericone/verify/spatial/campaign.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "output/part.h"
#include "output/progress.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

struct Results {
  std::vector<verify::PredicateReport> predicates;
  std::vector<verify::PlanarFamilyReport> by_support, by_conics;
  std::vector<verify::SpatialFamilyReport> spatial;
  std::vector<verify::AssemblyReport> assemblies;

  std::uint64_t wrong() const {
    std::uint64_t sum = 0;
    for (const auto& r : predicates) sum += r.wrong;
    for (const auto* reports : {&by_support, &by_conics})
      for (const auto& r : *reports) sum += r.wrong_relations;
    for (const auto& r : spatial) sum += r.failures();
    for (const auto& r : assemblies) sum += r.failures();
    return sum;
  }

  /// What was held against something exact.
  std::uint64_t statements() const {
    std::uint64_t sum = 0;
    for (const auto& r : predicates) sum += r.compared_with_exact + r.checked_against_cgal;
    for (const auto* reports : {&by_support, &by_conics})
      for (const auto& r : *reports) sum += r.cases;
    for (const auto& r : spatial)
      for (const verify::Check* check : {&r.relation, &r.polyhedra, &r.march, &r.perturbed, &r.solid_angle,
                                         &r.inner_bound, &r.outer_bound, &r.slices, &r.clearance})
        sum += check->tried;
    for (const auto& r : assemblies)
      for (const verify::Check* check : {&r.relation, &r.membership, &r.contact, &r.contact_point, &r.miss,
                                         &r.extreme, &r.map_out, &r.map_in})
        sum += check->tried;
    return sum;
  }

  /// True intervals that are not as narrow as they were asked to be.
  std::uint64_t wider_than_asked() const {
    std::uint64_t sum = 0;
    for (const auto& r : assemblies) sum += r.tight.failed;
    return sum;
  }
};

constexpr verify::AgentKind kAgents[] = {verify::AgentKind::ball, verify::AgentKind::ellipsoid,
                                         verify::AgentKind::hull};
constexpr PieceKind kPieces[] = {PieceKind::triangle, PieceKind::ball, PieceKind::box, PieceKind::hull};

/// The reports one after the other, or the part of them that was asked for: every N-th.
Results run(const VerifyOptions& o) {
  Results results;
  Progress progress(o.quiet);
  verify::PredicateOptions options;
  options.cases = o.cases;
  options.seed = o.seed;
  options.threads = o.threads;
  options.truth_every = 64;
  options.stop = interrupted;
  options.progress = [&](const std::string& name, std::uint64_t done, std::uint64_t total) {
    progress.show(name, double(done) / double(total));
  };
  std::vector<std::pair<std::string, std::function<void()>>> reports;
  if (o.cases)
    for (const std::string& name : verify::predicate_names())
      reports.emplace_back(name,
                           [&, name] { results.predicates.push_back(verify::run_predicate(name, options)); });
  const auto planar = [&](const char* name, verify::PlanarAnswer (*answer)(const Ellipse&, const Ellipse&),
                          std::vector<verify::PlanarFamilyReport>& to) {
    for (const auto family : verify::kAllPlanarFamilies)
      reports.emplace_back(name, [&to, answer, family, &o] {
        to.push_back(verify::run_planar_family(answer, family, o.pairs, o.seed, interrupted));
      });
  };
  if (o.pairs) {
    planar("sector_by_support", verify::answer_by_support, results.by_support);
    planar("sector_by_degenerate_conics", verify::answer_by_degenerate_conics, results.by_conics);
    for (const auto family : verify::kAllSpatialFamilies)
      reports.emplace_back("cones in space", [&, family] {
        results.spatial.push_back(verify::run_spatial_family(family, o.pairs, o.seed, interrupted));
      });
    for (const auto agent : kAgents)
      for (const auto pieces : kPieces)
        reports.emplace_back("meshes, clouds and maps", [&, agent, pieces] {
          verify::AssemblyOptions assembly;
          assembly.cases = o.pairs;
          assembly.seed = o.seed;
          assembly.stop = interrupted;
          results.assemblies.push_back(verify::run_assembly_family(agent, pieces, assembly));
        });
  }
  const Part part = part_of(o.part).value_or(Part{});
  for (std::size_t i = part.number - 1; i < reports.size() && !interrupted(); i += part.of) {
    progress.show(reports[i].first, double(i) / double(reports.size()));
    reports[i].second();
  }
  return results;
}

nlohmann::json planar_json(const std::vector<verify::PlanarFamilyReport>& reports) {
  nlohmann::json list = nlohmann::json::array();
  const std::string lines = verify::to_json_lines(reports);
  std::size_t from = 0;
  while (from < lines.size()) {
    const std::size_t end = std::min(lines.find('\n', from), lines.size());
    if (end > from) list.push_back(nlohmann::json::parse(lines.substr(from, end - from)));
    from = end + 1;
  }
  return list;
}

nlohmann::json spatial_json(const std::vector<verify::SpatialFamilyReport>& reports) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& r : reports) {
    nlohmann::json checks;
    const auto add = [&](const char* name, const verify::Check& c) {
      checks[name] = {{"tried", c.tried}, {"failed", c.failed}};
    };
    add("relation", r.relation), add("polyhedra", r.polyhedra), add("march", r.march);
    add("perturbed", r.perturbed), add("solid_angle", r.solid_angle), add("inner_bound", r.inner_bound);
    add("outer_bound", r.outer_bound), add("slices", r.slices), add("clearance", r.clearance);
    list.push_back({{"family", verify::name(r.family)},
                    {"seed", r.seed},
                    {"cases", r.cases},
                    {"checks", checks},
                    {"time_relative", r.time.value},
                    {"gap_slope", r.gap_slope}});
  }
  return list;
}

nlohmann::json assembly_json(const std::vector<verify::AssemblyReport>& reports) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& r : reports) {
    nlohmann::json checks;
    const auto add = [&](const char* name, const verify::Check& c) {
      checks[name] = {{"tried", c.tried}, {"failed", c.failed}};
    };
    add("relation", r.relation), add("membership", r.membership), add("contact", r.contact);
    add("contact_point", r.contact_point), add("miss", r.miss), add("extreme", r.extreme);
    add("map_out", r.map_out), add("map_in", r.map_in);
    list.push_back({{"agent", verify::to_string(r.agent)},
                    {"pieces", to_string(r.pieces)},
                    {"seed", r.seed},
                    {"cases", r.cases},
                    {"checks", checks}});
  }
  return list;
}

void print_json(const VerifyOptions& o, const Results& r, std::ostream& out) {
  Json j;
  j["seed"] = o.seed;
  j["cases"] = o.cases;
  j["pairs"] = o.pairs;
  j["wrong"] = r.wrong();
  j["statements"] = r.statements();
  j["wider_than_asked"] = r.wider_than_asked();
  j["interrupted"] = interrupted();
  j["predicates"] = Json::parse(verify::to_json(r.predicates));
  j["sector_by_support"] = planar_json(r.by_support);
  j["sector_by_degenerate_conics"] = planar_json(r.by_conics);
  j["cones_in_space"] = spatial_json(r.spatial);
  j["assemblies"] = assembly_json(r.assemblies);
  out << j.dump(2) << '\n';
}

/// What was run for what was asked: predicates take whole blocks, and some a part of the cases.
std::string what_ran(const VerifyOptions& o, const Results& r) {
  std::string text;
  if (!r.predicates.empty()) {
    std::uint64_t least = r.predicates.front().cases, most = least;
    for (const auto& p : r.predicates) least = std::min(least, p.cases), most = std::max(most, p.cases);
    text += "--cases " + std::to_string(o.cases) + ": " + std::to_string(most) +
            " of each predicate, in blocks of " + std::to_string(verify::kCasesPerBlock);
    if (least < most) text += ", " + std::to_string(least) + " of the slowest";
  }
  if (!o.part.empty()) text += (text.empty() ? "" : "; ") + ("part " + o.part + " of the reports");
  if (o.pairs)
    text += (text.empty() ? "" : "; ") + ("--pairs " + std::to_string(o.pairs)) + " of each family";
  return text;
}

void print_tables(const VerifyOptions& o, const Results& r, std::ostream& out) {
  if (!r.predicates.empty()) out << "predicates\n\n" << verify::to_markdown(r.predicates) << '\n';
  if (!r.by_support.empty()) out << "sector_by_support\n\n" << verify::to_markdown(r.by_support) << '\n';
  if (!r.by_conics.empty())
    out << "sector_by_degenerate_conics\n\n" << verify::to_markdown(r.by_conics) << '\n';
  if (!r.spatial.empty()) out << "cones in space\n\n" << verify::to_markdown(r.spatial) << '\n';
  if (!r.assemblies.empty())
    out << "meshes, clouds and maps\n\n" << verify::to_markdown(r.assemblies) << '\n';
  for (const auto& p : r.predicates)
    if (p.first_wrong)
      out << "WRONG: " << p.predicate << ", " << p.wrong << " cases, the first is replay_predicate(\""
          << p.predicate << "\", " << p.seed << ", " << *p.first_wrong << ")\n";
  out << what_ran(o, r) << '\n'
      << (interrupted() ? "interrupted; by then " : "") << r.wrong() << " wrong of " << r.statements()
      << " statements; " << r.wider_than_asked() << " intervals wider than asked (not wrong)\n";
}

}  // namespace

int run_verify(const VerifyOptions& options, std::ostream& out) {
  end_by_ourselves();
  const Results results = run(options);
  options.json ? print_json(options, results, out) : print_tables(options, results, out);
  out.flush();
  if (results.wrong()) return 1;
  return interrupted() ? kExitInterrupted : 0;
}

}  // namespace vericone
