// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/certificate.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "certificate/bodies.h"
#include "certificate/errors/prove_errors.h"
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

/// The claim up to its bodies and what belongs to it, and the proof.
std::string statement(std::string_view says, const std::string& id, const Question& question,
                      const std::optional<Horizon>& horizon, std::string_view more, std::string_view proof) {
  Text text;
  text.reserve(1024);
  text.raw(R"({"format": "vericone-certificate", "version": 1, "claim": {"says": ")").raw(says).raw("\"");
  if (!id.empty()) text.raw(", \"id\": ").raw(id);
  if (horizon) write_horizon(text, *horizon);
  text.raw(more);
  question.agent.write(text.raw(", \"agent\": "), horizon ? &question.v_a : nullptr);
  question.obstacle.write(text.raw(", \"obstacle\": "), horizon ? &question.v_b : nullptr);
  return text.raw("}, \"proof\": ").raw(proof).raw("}").take();
}

/// Why errors of this kind have no certificate; nothing where they may have one.
const char* unstated(const RelativeErrors& errors, const StatedErrors& position,
                     const StatedErrors& velocity) {
  if (errors.acceleration > 0) return "the format has no accelerations";
  if (errors.attitude_a > 0 || errors.attitude_b > 0) return "the format has no errors of attitude";
  if (errors.size > 0) return "the format has no errors of size";
  if (!position.is_stated() || !velocity.is_stated())
    return "the errors are no ball, ellipsoid or box along the axes, but a sum of some";
  return nullptr;
}

}  // namespace
}  // namespace certificates

Certificate Pair::certificate(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, const Horizon& horizon,
                              const std::string& id) const {
  using namespace certificates;
  const Verdict said = verdict(v_a, v_b, horizon);
  if (said == Verdict::undecided) return {{}, "the verdict is undecided"};
  const Stated a(agent()), b(obstacle());
  const bool now = is_now(said);
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  const Question question{a, b, now ? still : v_a, now ? still : v_b, now ? Horizon{0, 0} : horizon};
  Text proof;
  std::string reason;
  if (!prove(question, said, proof, reason)) return {{}, reason};
  return {
      statement(word_of(said), id, question, now ? std::nullopt : std::optional(horizon), {}, proof.take()),
      {}};
}

Certificate Pair::certificate(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                              const RelativeErrors& errors, const std::string& id) const {
  using namespace certificates;
  const RobustAnswer answer = robust_verdict(*this, v_a, v_b, errors);
  const StatedErrors position(errors.position), velocity(errors.velocity);
  if (const char* reason = unstated(errors, position, velocity)) return {{}, reason};
  const Horizon horizon{0, errors.horizon};
  if (position.none() && velocity.none()) return certificate(v_a, v_b, horizon, id);
  const Stated a(agent()), b(obstacle());
  const UncertainQuestion question{a, b, v_a, v_b, position, velocity, errors.horizon};
  Text proof, more;
  bool proved = false;
  switch (answer.verdict) {
    case RobustVerdict::out:
      proved = prove_all_out(question, answer.normal, proof);
      break;
    case RobustVerdict::in:
      proved = prove_all_in(question, proof);
      break;
    case RobustVerdict::depends:
      proved = prove_depends(question, *this, answer.collides, answer.passes, proof);
      break;
    case RobustVerdict::undecided:
      return {{}, "what the errors lead to is undecided"};
  }
  if (!proved) return {{}, "no short proof was found"};
  if (!position.none()) position.write(more.raw(", \"position_error\": "));
  if (!velocity.none()) velocity.write(more.raw(", \"velocity_error\": "));
  const Question stated{a, b, v_a, v_b, horizon};
  return {statement(to_string(answer.verdict), id, stated, horizon, more.take(), proof.take()), {}};
}

}  // namespace vericone
