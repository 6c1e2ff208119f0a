// SPDX-License-Identifier: BSD-3-Clause
#include "command/catalogue.h"

#include <algorithm>

namespace vericone {
namespace {

CatalogueEntry core(const char* name, const char* what) { return {name, what, "", ""}; }

CatalogueEntry simulation(const char* name, const char* what) {
  return {name, what, "a command without simulation", "a build with VERICONE_SIMULATION"};
}

}  // namespace

const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> entries{
      core("cone", "The collision cone of one scene"),
      core("query", "Exact verdicts on engagements, one JSON object a line"),
      core("accuracy", "Accuracy of slice and exact cones against planes and samples"),
      core("signmap", "Answers on the doubles around a velocity that grazes exactly"),
      core("gallery", "The cone of every mesh, cloud and octree map given, with pictures"),
      {"scan", "What simulated LiDARs on the agent see of a mesh, and the cone they get from it",
       "a command without LiDARs", "a build with VERICONE_LIDAR"},
      {"fit", "A quadric hull of a scan, with what is proved of it", "a command without fits",
       "a build with VERICONE_FITTING"},
      core("shapes", "Pictures and meshes of combined quadrics"),
      simulation("simulate", "A scenario of moving bodies, with a proof of what was avoided"),
      simulation("campaign", "Guidance laws on random engagements, every outcome proved; 1: a word broken"),
      simulation("claims", "What the source prints in chapters 5 and 6 beside what is measured"),
      simulation("figures", "The figures of the source's chapters 5 and 6, with a report"),
      {"verify", "Hold the library against exact constructions (CGAL); 1: wrong answers",
       "a command without CGAL", "a build with VERICONE_VERIFY"}};
  return entries;
}

const CatalogueEntry* find_entry(const std::string& name) {
  const auto it = std::find_if(catalogue().begin(), catalogue().end(),
                               [&](const CatalogueEntry& entry) { return entry.name == name; });
  return it == catalogue().end() ? nullptr : &*it;
}

}  // namespace vericone
