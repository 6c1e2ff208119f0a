// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/certificate.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/certificates_within.h>
#include <vericone/internal/simulation/mesh_track.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "certificate/meeting.h"
#include "certificate/opening.h"
#include "certificate/planes.h"
#include "certificate/solid.h"
#include "certificate/staying.h"
#include "certificate/tube.h"

namespace vericone::simulation {
namespace certified {
namespace {

constexpr std::size_t kMostPieces = 500'000;  // of a body
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
  bool dents = false;
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
  int along = 0;  // of what passes a hole: the side to which it goes, 1 or -1
};

class Maker {
 public:
  Maker(const Scenario& scenario, const Run& run, const std::vector<double>& radii)
      : scenario_(scenario), run_(run), radii_(radii) {
    slack_.assign(corridor_of(run.corridors.size()), std::numeric_limits<double>::infinity());
    for (const PairOutcome& pair : run.proofs) {
      if (pair.proof.verdict != ProofVerdict::avoided) continue;
      const double slack = pair.proof.least_distance - (pair.kept() ? pair.required : 0);
      for (const std::size_t body : {pair.a, pair.b}) slack_[body] = std::min(slack_[body], slack);
    }
    for (const PassageOutcome& one : run.passages)
      for (const std::size_t body : {one.agent, rim_of(one.orifice), wall_of(one.orifice)})
        slack_[body] = std::min(slack_[body], one.proof.least_distance);
    for (const CorridorOutcome& one : run.corridors)
      slack_[one.agent] = std::min(slack_[one.agent], one.room);
  }

  RunCertificates made(const std::function<bool(double)>& goes_on) {
    std::size_t done = 0;
    for (const PairOutcome& pair : run_.proofs) {
      if (goes_on && !goes_on(static_cast<double>(done++) / static_cast<double>(run_.proofs.size()))) break;
      take(pair);
    }
    for (const PassageOutcome& passage : run_.passages) take(passage);
    for (std::size_t k = 0; k < run_.corridors.size(); ++k) take_corridor(k);
    for (const auto& [claim, pairs] : proved_) found_.made.push_back(written(claim, pairs, RunClaim::apart));
    for (const auto& [says, claim, pair] : others_) found_.made.push_back(written(claim, {pair}, says));
    return std::move(found_);
  }

 private:
  // Numbers of what stands for an orifice, beyond those of the bodies: what must not be touched, and the wall
  // in whose hole it is.
  [[nodiscard]] std::size_t rim_of(std::size_t orifice) const {
    return scenario_.bodies.size() + 2 * orifice;
  }
  [[nodiscard]] std::size_t wall_of(std::size_t orifice) const { return rim_of(orifice) + 1; }
  [[nodiscard]] std::size_t corridor_of(std::size_t leg) const {
    return rim_of(scenario_.orifices.size()) + leg;
  }
  /// Of such a number, or null.
  [[nodiscard]] const MovingOrifice* orifice(std::size_t body) const {
    return body < scenario_.bodies.size() || body >= corridor_of(0)
               ? nullptr
               : &scenario_.orifices[(body - scenario_.bodies.size()) / 2];
  }
  [[nodiscard]] std::string name(std::size_t body) const {
    if (body >= corridor_of(0))
      return "corridor to goal " + std::to_string(run_.corridors[body - corridor_of(0)].goal + 1);
    return orifice(body) ? orifice(body)->name : scenario_.bodies[body].name;
  }
  /// As RunCertificate::pairs has it.
  [[nodiscard]] std::size_t outside_number(std::size_t body) const {
    if (body >= corridor_of(0))
      return scenario_.bodies.size() + scenario_.orifices.size() + body - corridor_of(0);
    return orifice(body) ? scenario_.bodies.size() + (body - scenario_.bodies.size()) / 2 : body;
  }
  [[nodiscard]] std::string names(std::size_t a, std::size_t b) const { return name(a) + ", " + name(b); }

  void take(const PassageOutcome& passage) {
    const std::size_t agent = passage.agent, rim = rim_of(passage.orifice), wall = wall_of(passage.orifice);
    const PassageProof& proof = passage.proof;
    const auto none = [&](const std::string& reason) { found_.none.push_back({names(agent, rim), reason}); };
    if (proof.verdict == PassageVerdict::touched) return none("they touch");
    if (proof.verdict == PassageVerdict::undecided) return none("undecided");
    PairOutcome pair{agent, rim, {}, 0};
    pair.proof.from = proof.from;
    pair.proof.to = proof.to;
    std::string reason;
    std::vector<double> cuts;
    if (proof.verdict == PassageVerdict::passed) {
      pair.b = wall;
      const auto through = proof_of_passage(pair, proof, cuts, reason);
      pair.b = rim;
      if (!through) none("passed: " + reason);
    }
    if (!prove(pair, 0, cuts, reason)) none("apart: " + reason);
  }

  void take_corridor(std::size_t k) {
    const CorridorOutcome& leg = run_.corridors[k];
    const PairOutcome pair{leg.agent, corridor_of(k), {}, 0};
    std::string reason = "it is not proved to stay";
    const Claim claim{leg.from, leg.to, 0};
    const auto proof =
        leg.room < 0 ? std::nullopt : proof_of(pair, claim, reason, [&](const PairQuestion& question) {
          reason = "what is left is less than its track is known to";
          return proof_of_staying(question);
        });
    if (proof)
      others_.push_back({RunClaim::stays, claim, {pair.a, pair.b, *proof}});
    else
      found_.none.push_back({names(pair.a, pair.b), reason});
  }

  /// That it passes between two times, which are found.
  bool proof_of_passage(const PairOutcome& pair, const PassageProof& passage, std::vector<double>& times,
                        std::string& reason) {
    const Claim whole{passage.from, passage.to, 0};
    static_cast<void>(proof_of(pair, whole, reason, [&](const PairQuestion& question) {
      for (const int side : {-1, 1})
        if (const auto t = wholly_beside(question, passage.time, side < 0, side * passage.direction))
          times.push_back(*t);
      return std::optional<std::string>();
    }));
    if (times.size() != 2) {
      if (reason.empty()) reason = "not wholly on both sides by more than the tracks are known to";
      times.clear();
      return false;
    }
    const Claim claim{times[0], times[1], 0};
    const auto proof =
        proof_of(pair, claim, reason, [&](const PairQuestion& question) -> std::optional<std::string> {
          const auto apart = proof_of_pair(question, reason);
          return apart ? proof_of_passing(question, passage.direction, *apart, reason) : std::nullopt;
        });
    if (proof) others_.push_back({RunClaim::passed, claim, {pair.a, pair.b, *proof, passage.direction}});
    return proof.has_value();
  }

  void take(const PairOutcome& pair) {
    const ProofVerdict verdict = pair.proof.verdict;
    std::string reason;
    if (verdict == ProofVerdict::touched) {
      if (prove_near(pair, 0, reason)) return;
      // Whatever they do within the tubes, they come nearer than these are wide.
      const std::string meet = "they meet: " + reason;
      const double wide = width(pair);
      if (!std::isfinite(wide) || !prove_near(pair, wide, reason))
        found_.none.push_back({names(pair.a, pair.b), meet});
      else
        found_.none.push_back({names(pair.a, pair.b), meet + "; as near as " + to_text(wide) + " m"});
      return;
    }
    if (pair.required > 0 && !pair.kept() && !prove_near(pair, pair.required, reason))
      found_.none.push_back(
          {names(pair.a, pair.b), "nearer than " + to_text(pair.required) + " m: " + reason});
    if (verdict != ProofVerdict::avoided) {
      found_.none.push_back({names(pair.a, pair.b), "undecided"});
      return;
    }
    const double required = pair.kept() ? pair.required : 0;
    if (prove(pair, required, {}, reason)) return;
    if (required > 0 && prove(pair, 0, {}, reason)) {
      found_.none.push_back(
          {names(pair.a, pair.b), "apart, but not by " + to_text(required) + " m: " + reason});
      return;
    }
    found_.none.push_back({names(pair.a, pair.b), reason});
  }

  /// `cuts`: times, ascending, between which the proof begins anew; none, or two.
  bool prove(const PairOutcome& pair, double by, const std::vector<double>& cuts, std::string& reason) {
    const Claim claim{pair.proof.from, pair.proof.to, by};
    const auto proof = proof_of(pair, claim, reason, [&](const PairQuestion& question) {
      return proof_by_times(question, cuts, reason);
    });
    if (proof) proved_[claim].push_back({pair.a, pair.b, *proof});
    return proof.has_value();
  }

  /// Over all that both are there.
  [[nodiscard]] Claim nearness(const PairOutcome& pair, double by) const {
    const Track &a = run_.tracks[pair.a], &b = run_.tracks[pair.b];
    return {std::max(a.appears(), b.appears()), std::min(a.end(), b.end()), by};
  }
  /// A little above both tubes' radii, m; infinite where one has none.
  double width(const PairOutcome& pair) {
    const Claim claim = nearness(pair, 0);
    double sum = 0;
    for (const std::size_t body : {pair.a, pair.b}) {
      const auto& track = stated(body, claim.from, claim.to).track;
      sum += track ? track->radius : std::numeric_limits<double>::infinity();
    }
    return std::isfinite(sum) ? std::stod(to_text(1.01 * sum + 1e-6)) : sum;
  }

  /// That they come as near as `by` at a time.
  bool prove_near(const PairOutcome& pair, double by, std::string& reason) {
    const Claim claim = nearness(pair, by);
    const auto proof = proof_of(pair, claim, reason, [&](const PairQuestion& question) {
      reason = question.dents ? "one has dents" : "no deeper than their tracks are known";
      PairQuestion looked = question;
      looked.times = {pair.proof.to, pair.proof.least_time};
      for (double later = claim.to - pair.proof.to; later > 1e-6; later /= 2)
        looked.times.push_back(pair.proof.to + later);
      return proof_of_nearness(looked);
    });
    if (proof)
      others_.push_back({by == 0 ? RunClaim::meet : RunClaim::near, claim, {pair.a, pair.b, *proof}});
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
    if (a.solid.size() == 0 || b.solid.size() == 0) {
      reason = "its outline is not star-shaped, or its middle goes round in circles";
      return std::nullopt;
    }
    for (const auto& [which, body] : {std::pair{&a, pair.a}, std::pair{&b, pair.b}}) {
      if (which->track) continue;
      reason = which->solid.size() > kMostPieces
                   ? name(body) + " has more than " + std::to_string(kMostPieces) + " pieces"
                   : "how " + name(body) + " turns has no bound";
      return std::nullopt;
    }
    return prove({a.solid, b.solid, *a.track, *b.track, claim.by, claim.from, claim.to, a.dents || b.dents});
  }

  const Stated& stated(std::size_t body, double from, double to) {
    const auto [at, fresh] = stated_.try_emplace({body, from, to});
    Stated& found = at->second;
    if (!fresh) return found;
    if (orifice(body)) {
      state_opening(body, from, to, found);
      return found;
    }
    if (body >= corridor_of(0)) {
      state_corridor(run_.corridors[body - corridor_of(0)], from, to, found);
      return found;
    }
    const Track& track = run_.tracks[body];
    OwnFrame own = in_own_frame(track.shape(), from, to);
    found.solid = std::move(own.solid);
    found.dents = own.dents;
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

  /// An orifice as what must not be touched, or as the wall with its hole; no pieces where it is no ring.
  void state_opening(std::size_t body, double from, double to, Stated& found) const {
    const MovingOrifice& its = *orifice(body);
    const bool rim = (body - scenario_.bodies.size()) % 2 == 0;
    TubeQuestion question{from, to, 0, 0, true, 0};
    std::optional<Track> track;
    if (rim && its.window) {
      OwnFrame own = in_own_frame(RigidShape{its.window->mesh()}, from, to);
      found.solid = std::move(own.solid);
      track = mesh_track(its, to);
      question.reach = reach(track->shape());
      question.padding = own.rounding;
    } else if (const auto hole = star_shaped_within(its.opening)) {
      track = hole_track(its, *hole, to);
      if (!track) return;
      // Further than any agent is from its middle.
      double far = its.opening.reach();
      for (const PassageOutcome& passage : run_.passages)
        if (const Track& agent = run_.tracks[passage.agent]; &its == &scenario_.orifices[passage.orifice])
          far = std::max(far,
                         farthest(agent, *track, std::max(from, agent.appears()), std::min(to, agent.end())) +
                             2 * reach(agent.shape()));
      found.solid =
          ring(*hole, rim && !its.wall ? kRim : std::exp2(std::ceil(std::log2(4 * far / hole->inner))));
      for (const Eigen::Vector3d& x : found.solid.points) question.reach = std::max(question.reach, x.norm());
      question.padding = 1e-13 * (question.reach + far + track->motion(from).position.norm());
    } else {
      return;
    }
    question.tolerance =
        std::max(kFinest, std::min(slack_[body] / 20, kCoarsest * std::max(1.0, question.reach)));
    found.track = tube(*track, question);
  }

  /// All that is within its radius of the leg.
  void state_corridor(const CorridorOutcome& its, double from, double to, Stated& found) const {
    const Body& body = scenario_.bodies[its.agent];
    const std::vector<Goal>& goals = body.pilot->goals;
    const Goal& goal = goals[its.goal];
    const Eigen::Vector3d begin = goal.from      ? *goal.from
                                  : its.goal > 0 ? goals[its.goal - 1].point
                                                 : body.start.position;
    std::vector<vericone::Convex::Piece> ends{{begin}};
    if (begin != goal.point) ends.push_back({goal.point});
    found.solid.kind = Solid::Kind::convexes;
    found.solid.convexes = {vericone::Convex::of_pieces(std::move(ends), goal.corridor)};
    found.track = StatedTrack{{from, to}, 0, {{{{0, 0, 0}}, {}}}, false, 0};
  }

  /// Of the two positions, at some times.
  static double farthest(const Track& a, const Track& b, double from, double to) {
    constexpr int kLooks = 200;
    double most = 0;
    for (int i = 0; i <= kLooks && from <= to; ++i) {
      const double t = i == kLooks ? to : from + (to - from) * i / kLooks;
      most = std::max(most, (a.motion(t).position - b.motion(t).position).norm());
    }
    return most;
  }

  [[nodiscard]] RunCertificate written(const Claim& claim, const std::vector<Proved>& pairs,
                                       RunClaim says) const {
    constexpr const char* kWords[] = {"apart", "near", "meet", "passed", "stays"};
    std::set<std::size_t> bodies;
    for (const Proved& pair : pairs) bodies.insert({pair.a, pair.b});
    std::map<std::size_t, std::string> number;
    std::string names, solids, tracks, list, proofs;
    for (const std::size_t body : bodies) {
      const Stated& its = stated_.at({body, claim.from, claim.to});
      const char* between = number.empty() ? "" : ", ";
      number.emplace(body, std::to_string(number.size()));
      names.append(between).append(name(body));
      solids.append(between).append(text_of(its.solid));
      tracks.append(between).append(text_of(*its.track));
    }
    RunCertificate certificate{{}, claim.by, claim.from, claim.to, {}, says};
    for (const Proved& pair : pairs) {
      const char* between = list.empty() ? "" : ", ";
      const std::string &a = number.at(pair.a), &b = number.at(pair.b);
      list.append(between).append("[" + a + ", " + b + "]");
      proofs.append(between).append("\"" + a + " " + b + "\": " + pair.proof);
      certificate.pairs.emplace_back(pair.a, outside_number(pair.b));
    }
    const bool by = says == RunClaim::apart || says == RunClaim::near;
    std::string text = R"({"format": "vericone-certificate", "version": 1, "claim": {"says": ")";
    text.append(kWords[static_cast<std::size_t>(says)]).append("\", \"id\": ");
    text += quoted(scenario_.name + ": " + names) + (by ? ", \"by\": " + text_of(claim.by) : "") +
            ", \"from\": " + text_of(claim.from) + ", \"to\": " + text_of(claim.to) + ", \"bodies\": [" +
            solids + "], \"tracks\": [" + tracks + "], ";
    if (says == RunClaim::apart) {
      text += "\"pairs\": [" + list + R"(]}, "proof": {"rule": "pairs", "pairs": {)" + proofs + "}}}";
    } else {
      const Proved& pair = pairs.front();
      text += "\"pair\": " + list +
              (says == RunClaim::passed ? ", \"along\": " + std::to_string(pair.along) : "") +
              "}, \"proof\": " + pair.proof + "}";
    }
    certificate.text = std::move(text);
    return certificate;
  }

  const Scenario& scenario_;
  const Run& run_;
  const std::vector<double>& radii_;
  std::vector<double> slack_;  // m, of each body and opening: what its nearest pair leaves
  std::map<std::tuple<std::size_t, double, double>, Stated> stated_;
  std::map<Claim, std::vector<Proved>> proved_;
  std::vector<std::tuple<RunClaim, Claim, Proved>> others_;
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
