// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/assembly/campaign.h>

#include <cstdio>

#include "assembly/engagement.h"

namespace vericone::verify {
namespace {

std::string cell(const Check& check) {
  std::string text = std::to_string(check.failed);
  text.append("/").append(std::to_string(check.tried));
  if (check.failed) text.append(" #").append(std::to_string(check.first_failed_index));
  return text;
}

std::string cell(const std::array<std::uint64_t, 3>& counts) {
  return std::to_string(counts[0]) + ", " + std::to_string(counts[1]) + ", " + std::to_string(counts[2]);
}

std::string row(std::initializer_list<std::string> cells) {
  std::string out = "|";
  for (const std::string& c : cells) out.append(" ").append(c).append(" |");
  return out.append("\n");
}

}  // namespace

std::uint64_t AssemblyReport::failures() const {
  std::uint64_t sum = 0;
  for (const Check* c :
       {&relation, &membership, &contact, &contact_point, &miss, &extreme, &map_out, &map_in})
    sum += c->failed;
  return sum;
}

AssemblyReport run_assembly_family(AgentKind agent, PieceKind pieces, const AssemblyOptions& options) {
  AssemblyReport report;
  report.agent = agent;
  report.pieces = pieces;
  report.seed = options.seed;
  for (std::uint64_t index = 0; index < options.cases && !(options.stop && options.stop()); ++index) {
    ++report.cases;
    const AssemblyCase c = assembly_case(agent, pieces, options.seed, index);
    AssemblyCase told = c;
    if (options.without_last_piece && c.assembly().size() > 1) {
      // Of several triangles the points stay.
      if (pieces == PieceKind::triangle) told.triangles.pop_back();
      if (pieces == PieceKind::ball) told.points.pop_back();
      if (pieces == PieceKind::box) told.boxes.pop_back();
      if (pieces == PieceKind::hull) told.hulls.pop_back();
    }
    AssemblyEngagement engagement(c, told, index, report);
    if (!engagement.relation()) continue;
    engagement.velocities();
    // Neighbouring indices are of other variations: every variation gets its turn.
    const std::uint64_t turn = index / kAssemblyVariations + index;
    if (turn % options.extremes_every == 0) engagement.extremes();
    if (turn % options.maps_every == 0) engagement.map();
  }
  return report;
}

std::string to_markdown(std::span<const AssemblyReport> reports) {
  std::string out = row({"agent", "pieces", "seed", "cases", "disjoint, touching, overlapping", "in, on, out",
                         "relation", "membership", "contact", "its point", "miss", "extreme", "tolerance",
                         "cells out", "cells in", "contact width"}) +
                    row({"---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---",
                         "---", "---", "---"});
  for (const AssemblyReport& r : reports) {
    char width[32];
    std::snprintf(width, sizeof width, "%.2g #%llu", r.contact_width.value,
                  static_cast<unsigned long long>(r.contact_width.index));
    out += row({to_string(r.agent), to_string(r.pieces), std::to_string(r.seed), std::to_string(r.cases),
                cell(r.relations), cell(r.memberships), cell(r.relation), cell(r.membership), cell(r.contact),
                cell(r.contact_point), cell(r.miss), cell(r.extreme), cell(r.tight), cell(r.map_out),
                cell(r.map_in), width});
  }
  for (const AssemblyReport& r : reports) {
    if (!r.first_failure.empty()) out += "\nWRONG: " + r.first_failure + "\n";
    if (!r.first_loose.empty()) out += "\nwider than asked, not wrong: " + r.first_loose + "\n";
  }
  return out;
}

}  // namespace vericone::verify
