// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/prove.h"

#include "certificate/pieces.h"
#include "certificate/verdicts/groups.h"

namespace vericone::certificates {

bool prove(const Question& question, Verdict verdict, Text& proof, std::string& reason) {
  const bool single = question.agent.size() == 1 && question.obstacle.size() == 1;
  Groups groups(question);
  bool proved = false;
  switch (verdict) {
    case Verdict::out:
      proved = groups.prove_out(proof, false);
      break;
    case Verdict::in:
    case Verdict::overlapping:
      proved = groups.prove_in(proof);
      break;
    case Verdict::on:
    case Verdict::touching:
      proved = groups.prove_out(proof, true);
      break;
    case Verdict::undecided:
      break;
  }
  if (!proved) reason = single ? "no short proof was found" : "no proof by pieces was found";
  return proved;
}

}  // namespace vericone::certificates
