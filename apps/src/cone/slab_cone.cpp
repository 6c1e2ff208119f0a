// SPDX-License-Identifier: BSD-3-Clause
#include "cone/slab_cone.h"

#include <vericone/geometry/error.h>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include "cone/answer.h"
#include "cone/cone.h"
#include "json/json_value.h"
#include "output/number_text.h"

namespace vericone {
namespace {

void refuse_more(const ConeCommand& options) {
  const auto refuse = [](const char* option) {
    throw InputError(option, "given", "left out beside what has no end; its part within an extent is a body");
  };
  if (options.method != "exact") refuse("--method");
  if (options.tangents != "all") refuse("--tangents");
  if (options.tolerance) refuse("--tolerance");
  if (options.samples) refuse("--samples");
  if (options.planes) refuse("--planes");
  if (options.map) refuse("--map");
  if (options.certificate) refuse("--certificate");
  if (!options.glb.empty()) refuse("--glb");
  if (!options.picture_folder.empty()) refuse("--out");
}

}  // namespace

void run_slab_cone(const ConeCommand& options, const scenes::Scene& scene, const Slab& slab,
                   std::ostream& out) {
  using std::numbers::pi;
  refuse_more(options);
  const SlabPair pair(scene.agent.placed, slab);
  const auto safe = pair.safe_half_space();
  const bool disjoint = pair.relation() == Relation::disjoint;
  // Of an agent in front of one side; about its axis.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  if (safe) axis += safe->normal.stableNormalized();  // a zero without a sign
  const Horizon ever{0, std::numeric_limits<double>::infinity()};
  const Json found = slab_answer(scene, slab, ever, false);
  if (options.json) {
    Json result{{"method", "half-space"}, {"relation", to_string(pair.relation())}};
    result["axis"] = safe ? vector_json(axis) : Json(nullptr);
    if (scene.in_plane) {
      result["psi"] = disjoint ? Json(safe ? pi : 2 * pi) : Json(nullptr);
      result["theta_b"] = safe ? Json(std::atan2(axis.y(), axis.x())) : Json(nullptr);
    } else {
      result["half_angle"] = safe ? Json(pi / 2) : Json(nullptr);
      result["solid_angle"] = disjoint ? Json(safe ? 2 * pi : 4 * pi) : Json(nullptr);
    }
    result["answer"] = found;
    out << result.dump(1) << '\n';
    return;
  }
  out << "verdict             " << found["verdict"].get<std::string>()
      << " (of the scene's velocities, exact)\n";
  const auto number = [&](const char* field) { return number_text(found[field].get<double>()); };
  if (found["time_to_contact"].is_number())
    out << "first contact       after " << number("time_to_contact") << " s\n";
  if (found["verdict"] == "out") out << "nearest now         " << number("clearance") << " m\n";
  out << "bodies              " << to_string(pair.relation()) << '\n';
  if (!disjoint) return;
  out << "cone                all relative velocities ";
  if (safe)
    out << "towards it: axis (" << number_text(axis.x()) << ", " << number_text(axis.y())
        << (scene.in_plane ? "" : ", " + number_text(axis.z()))
        << "), half-angle 90 degrees; along it none\n";
  else
    out << "but those along it: the agent has parts on both sides\n";
}

}  // namespace vericone
