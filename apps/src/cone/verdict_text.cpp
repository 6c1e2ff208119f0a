// SPDX-License-Identifier: BSD-3-Clause
#include "cone/verdict_text.h"

#include <vericone/cones/pair.h>
#include <vericone/internal/scenes/words.h>
#include <cmath>
#include <ostream>

#include "cone/answer.h"
#include "output/number_text.h"

namespace vericone {
namespace {

void print_contact(const Contact& contact, bool planar, std::ostream& out) {
  if (!std::isfinite(contact.time)) return;
  // The end is open where they graze closer than rounding tells.
  out << "first contact       after "
      << (std::isfinite(contact.latest) ? between_text(contact.earliest, contact.latest)
                                        : number_text(contact.time))
      << " s";
  if (contact.point) {
    const Eigen::Vector3d& x = *contact.point;
    out << " at (" << number_text(x.x()) << ", " << number_text(x.y())
        << (planar ? "" : ", " + number_text(x.z())) << ") m";
  }
  out << '\n';
}

}  // namespace

void print_verdict(const scenes::Scene& scene, std::ostream& out) {
  const Pair pair = scene.pair();
  const Eigen::Vector3d &v_a = scene.agent.velocity, &v_b = scene.obstacle.velocity;
  const Verdict verdict = pair.verdict(v_a, v_b);
  out << "verdict             " << to_string(verdict) << " (of the scene's velocities, "
      << verdict_kind(scene) << ")\n";
  if (verdict == Verdict::in || verdict == Verdict::on)
    print_contact(*pair.contact(v_a, v_b), scene.in_plane, out);
  if (verdict == Verdict::out)
    if (const Miss miss = pair.miss(v_a, v_b); std::isfinite(miss.least)) {
      const double time = nearest_time(pair, v_a, v_b);
      out << (time > 0 ? "passes at           " : "nearest now         ")
          << between_text(miss.least, miss.most) << " m";
      if (time > 0) out << " after " << number_text(time) << " s";
      out << '\n';
    }
  for (const scenes::SceneBody* body : {&scene.agent, &scene.obstacle})
    if (body->reading)
      for (const std::string& note : scenes::reading_words(*body->reading))
        out << "note                " << note << '\n';
}

}  // namespace vericone
