// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/certificate.h>

#include <cmath>

#include "certificate/bodies.h"
#include "certificate/prove.h"
#include "certificate/write.h"

namespace vericone {
namespace certificates {
namespace {

const char* word_of(Verdict verdict) {
  if (verdict == Verdict::overlapping) return "overlapping";
  return to_string(verdict);
}

bool is_now(Verdict verdict) { return verdict == Verdict::touching || verdict == Verdict::overlapping; }

void write_horizon(Text& text, const Horizon& horizon) {
  text.raw(", \"horizon\": ");
  const bool ever = std::isinf(horizon.until);
  if (horizon.from == 0) {
    ever ? text.raw("null") : text.number(horizon.until);
    return;
  }
  text.raw("[").number(horizon.from).raw(", ");
  (ever ? text.raw("null") : text.number(horizon.until)).raw("]");
}

}  // namespace
}  // namespace certificates

Certificate certificate(const Pair& pair, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                        const Horizon& horizon, const std::string& id) {
  using namespace certificates;
  const Verdict verdict = pair.verdict(v_a, v_b, horizon);
  if (verdict == Verdict::undecided) return {{}, "the verdict is undecided"};
  const Stated agent(pair.agent()), obstacle(pair.obstacle());
  if (!agent.has_words() || !obstacle.has_words())
    return {{}, "a body with round parts beside others, or a margin, has no certificates"};
  const bool now = is_now(verdict);
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  const Question question{agent, obstacle, now ? still : v_a, now ? still : v_b,
                          now ? Horizon{0, 0} : horizon};
  Text proof;
  std::string reason;
  if (!prove(question, verdict, proof, reason)) return {{}, reason};
  Text text;
  text.reserve(1024);
  text.raw(R"({"format": "vericone-certificate", "version": 1, "claim": {"says": ")").raw(word_of(verdict));
  text.raw("\"");
  if (!id.empty()) text.raw(", \"id\": ").raw(id);
  if (!now) write_horizon(text, horizon);
  agent.write(text.raw(", \"agent\": "), now ? nullptr : &v_a);
  obstacle.write(text.raw(", \"obstacle\": "), now ? nullptr : &v_b);
  text.raw("}, \"proof\": ").raw(proof.take()).raw("}");
  return {text.take(), {}};
}

}  // namespace vericone
