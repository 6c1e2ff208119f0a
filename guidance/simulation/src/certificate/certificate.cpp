// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/certificate.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/certificates_within.h>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "certificate/meeting.h"
#include "certificate/planes.h"
#include "certificate/solid.h"
#include "certificate/tube.h"

namespace vericone::simulation {
namespace certified {
namespace {

constexpr std::size_t kMostPieces = 200'000;  // of a body
constexpr double kFinest = 1e-6,
                 kCoarsest = 1e-3;  // m, and of the body's reach: how near polynomials are fitted

std::string quoted(const std::string& words) {
  std::string text = "\"";
  for (const char c : words) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return text + "\"";
}

/// A body over a time: what a certificate states of it.
struct Stated {
  Solid solid;
  bool dents = false, has_words = true;
  std::optional<StatedTrack> track;
};

/// Pairs that stand in one certificate.
struct Claim {
  double from, to, by;
  bool operator<(const Claim& other) const {
    return std::tie(from, to, by) < std::tie(other.from, other.to, other.by);
  }
};
struct Proved {
  std::size_t a, b;
  std::string proof;
};

class Maker {
 public:
  Maker(const Scenario& scenario, const Run& run, const std::vector<double>& radii)
      : scenario_(scenario), run_(run), radii_(radii) {
    slack_.assign(scenario.bodies.size(), std::numeric_limits<double>::infinity());
    for (const PairOutcome& pair : run.proofs) {
      if (pair.proof.verdict != ProofVerdict::avoided) continue;
      const double slack = pair.proof.least_distance - (pair.kept() ? pair.required : 0);
      for (const std::size_t body : {pair.a, pair.b}) slack_[body] = std::min(slack_[body], slack);
    }
  }

  RunCertificates made(const std::function<bool(double)>& goes_on) {
    std::size_t done = 0;
    for (const PairOutcome& pair : run_.proofs) {
      if (goes_on && !goes_on(static_cast<double>(done++) / static_cast<double>(run_.proofs.size()))) break;
      take(pair);
    }
    for (const PassageOutcome& passage : run_.passages)
      found_.none.push_back(
          {scenario_.bodies[passage.agent].name + ", " + scenario_.orifices[passage.orifice].name,
           "certificates do not tell of passages"});
    for (const auto& [claim, pairs] : proved_) found_.made.push_back(written(claim, pairs, false));
    for (const auto& [claim, pair] : near_) found_.made.push_back(written(claim, {pair}, true));
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::string names(std::size_t a, std::size_t b) const {
    return scenario_.bodies[a].name + ", " + scenario_.bodies[b].name;
  }

  void take(const PairOutcome& pair) {
    const ProofVerdict verdict = pair.proof.verdict;
    std::string reason;
    if (verdict == ProofVerdict::touched) {
      if (!prove_near(pair, 0, reason))
        found_.none.push_back({names(pair.a, pair.b), "they meet: " + reason});
      return;
    }
    if (verdict != ProofVerdict::avoided) {
      found_.none.push_back({names(pair.a, pair.b), "undecided"});
      return;
    }
    if (pair.required > 0 && !pair.kept()) prove_near(pair, pair.required, reason);
    const double required = pair.kept() ? pair.required : 0;
    if (prove(pair, required, reason)) return;
    if (required > 0 && prove(pair, 0, reason)) {
      found_.none.push_back(
          {names(pair.a, pair.b), "apart, but not by " + to_text(required) + " m: " + reason});
      return;
    }
    found_.none.push_back({names(pair.a, pair.b), reason});
  }

  bool prove(const PairOutcome& pair, double by, std::string& reason) {
    const Claim claim{pair.proof.from, pair.proof.to, by};
    const auto proof = proof_of(
        pair, claim, reason, [&](const PairQuestion& question) { return proof_of_pair(question, reason); });
    if (proof) proved_[claim].push_back({pair.a, pair.b, *proof});
    return proof.has_value();
  }

  /// That they come as near as `by` at a time, over all that both are there.
  bool prove_near(const PairOutcome& pair, double by, std::string& reason) {
    const Track &a = run_.tracks[pair.a], &b = run_.tracks[pair.b];
    const Claim claim{std::max(a.appears(), b.appears()), std::min(a.end(), b.end()), by};
    const auto proof = proof_of(pair, claim, reason, [&](const PairQuestion& question) {
      reason = "no deeper than their tracks are known, or no ellipsoids";
      return proof_of_nearness(question);
    });
    if (proof) near_.push_back({claim, {pair.a, pair.b, *proof}});
    return proof.has_value();
  }

  template <typename Prove>
  std::optional<std::string> proof_of(const PairOutcome& pair, const Claim& claim, std::string& reason,
                                      const Prove& prove) {
    if (!(claim.from < claim.to)) {
      reason = "they are there together at one time only";
      return std::nullopt;
    }
    const Stated &a = stated(pair.a, claim.from, claim.to), &b = stated(pair.b, claim.from, claim.to);
    for (const auto& [which, body] : {std::pair{&a, pair.a}, std::pair{&b, pair.b}}) {
      if (which->track) continue;
      reason = !which->has_words ? "of " + scenario_.bodies[body].name + " certificates have no words"
               : which->solid.size() > kMostPieces
                   ? scenario_.bodies[body].name + " has more than " + std::to_string(kMostPieces) + " pieces"
                   : "how " + scenario_.bodies[body].name + " turns has no bound";
      return std::nullopt;
    }
    return prove({a.solid, b.solid, *a.track, *b.track, claim.by, claim.from, claim.to, a.dents || b.dents});
  }

  const Stated& stated(std::size_t body, double from, double to) {
    const auto [at, fresh] = stated_.try_emplace({body, from, to});
    Stated& found = at->second;
    if (!fresh) return found;
    const Track& track = run_.tracks[body];
    OwnFrame own = in_own_frame(track.shape(), from, to);
    found.solid = std::move(own.solid);
    found.dents = own.dents;
    found.has_words = own.has_words;
    if (!found.has_words) return found;
    found.has_words = own.has_words;
    if (!found.has_words) return found;
    if (found.solid.size() > kMostPieces) return found;
    TubeQuestion question{};
    question.from = from;
    question.to = to;
    question.reach = reach(track.shape());
    question.tolerance =
        std::max(kFinest, std::min(slack_[body] / 20, kCoarsest * std::max(1.0, question.reach)));
    question.turns_matter = !found.solid.is_ball();
    question.padding =
        scenario_.proof.padding + scenario_.proof.drift * (to - track.appears()) + own.rounding;
    // That of position and orientation together, while a padding counts for each.
    if (!radii_.empty()) question.padding += 0.5 * radii_[body];
    found.track = tube(track, question);
    return found;
  }

  [[nodiscard]] RunCertificate written(const Claim& claim, const std::vector<Proved>& pairs,
                                       bool near) const {
    std::set<std::size_t> bodies;
    for (const Proved& pair : pairs) bodies.insert({pair.a, pair.b});
    std::map<std::size_t, std::string> number;
    std::string names, solids, tracks, list, proofs;
    for (const std::size_t body : bodies) {
      const Stated& its = stated_.at({body, claim.from, claim.to});
      const char* between = number.empty() ? "" : ", ";
      number.emplace(body, std::to_string(number.size()));
      names.append(between).append(scenario_.bodies[body].name);
      solids.append(between).append(text_of(its.solid));
      tracks.append(between).append(text_of(*its.track));
    }
    RunCertificate certificate{{}, claim.by, claim.from, claim.to, {}, near};
    for (const Proved& pair : pairs) {
      const char* between = list.empty() ? "" : ", ";
      const std::string &a = number.at(pair.a), &b = number.at(pair.b);
      list.append(between).append("[" + a + ", " + b + "]");
      proofs.append(between).append("\"" + a + " " + b + "\": " + pair.proof);
      certificate.pairs.emplace_back(pair.a, pair.b);
    }
    const bool meet = near && claim.by == 0;
    certificate.text =
        std::string(R"({"format": "vericone-certificate", "version": 1, "claim": {"says": ")") +
        (meet   ? "meet"
         : near ? "near"
                : "apart") +
        "\", \"id\": " + quoted(scenario_.name + ": " + names) +
        (meet ? "" : ", \"by\": " + text_of(claim.by)) + ", \"from\": " + text_of(claim.from) +
        ", \"to\": " + text_of(claim.to) + ", \"bodies\": [" + solids + "], \"tracks\": [" + tracks +
        (near ? "], \"pair\": " + list + "}, \"proof\": " + pairs.front().proof + "}"
              : "], \"pairs\": [" + list + R"(]}, "proof": {"rule": "pairs", "pairs": {)" + proofs + "}}}");
    return certificate;
  }

  const Scenario& scenario_;
  const Run& run_;
  const std::vector<double>& radii_;
  std::vector<double> slack_;  // m, of each body: what its nearest pair leaves
  std::map<std::tuple<std::size_t, double, double>, Stated> stated_;
  std::map<Claim, std::vector<Proved>> proved_;
  std::vector<std::pair<Claim, Proved>> near_;
  RunCertificates found_;
};

}  // namespace
}  // namespace certified

RunCertificates certificates(const Scenario& scenario, const Run& run,
                             const std::function<bool(double)>& goes_on) {
  return certificates_within(scenario, run, {}, goes_on);
}

RunCertificates certificates_within(const Scenario& scenario, const Run& run,
                                    const std::vector<double>& radii,
                                    const std::function<bool(double)>& goes_on) {
  if (run.tracks.size() != scenario.bodies.size())
    throw InputError("run", std::to_string(run.tracks.size()) + " tracks",
                     std::to_string(scenario.bodies.size()) + ", one for each body of the scenario");
  return certified::Maker(scenario, run, radii).made(goes_on);
}

}  // namespace vericone::simulation
