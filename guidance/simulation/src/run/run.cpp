// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/internal/simulation/mesh_track.h>
#include <vericone/internal/simulation/passed.h>
#include <vericone/simulation/run.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>
#include <utility>

#include "names.h"
#include "proof/corridor.h"
#include "tracks/sign_change.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;
using guidance::BodyState;

/// Adds the seconds that it lives to a sum.
class Timed {
 public:
  explicit Timed(double& sum) : sum_(sum) {}
  ~Timed() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Of decisions that took so long, seconds; there may be none. Changes their order.
void summarise(std::vector<double>& seconds, RunTimes& times) {
  times.decisions = seconds.size();
  if (seconds.empty()) return;
  for (const double s : seconds) times.mean += s / double(seconds.size());
  const auto within = seconds.begin() + std::ptrdiff_t((seconds.size() * 99 + 99) / 100 - 1);
  std::nth_element(seconds.begin(), within, seconds.end());
  times.within = *within;
  times.worst = *std::max_element(within, seconds.end());
}

class Runner {
 public:
  Runner(const Scenario& scenario, const RunOptions& options) : scenario_(scenario), options_(options) {
    const std::size_t n = scenario.bodies.size();
    run_.tracks.reserve(n);
    for (const Body& body : scenario.bodies) {
      vehicles_.push_back(body.vehicle ? body.vehicle->launch(body.start, body.appears, scenario.water)
                                       : nullptr);
      if (vehicles_.back())
        run_.tracks.emplace_back(body.shape, vehicles_.back()->motion(), Orientation::fixed, body.appears);
      else if (body.road)
        run_.tracks.emplace_back(body.shape, start_of(*body.road, body.start.position.z()),
                                 Orientation::fixed, body.appears);
      else
        run_.tracks.emplace_back(body.shape, body.start, body.orientation, body.appears);
      if (body.appears > 0)
        event({body.appears, EventKind::appears, run_.tracks.size() - 1, run_.tracks.size() - 1, 0});
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto& pilot = scenario.bodies[i].pilot;
      models_.push_back(pilot ? model_of(*pilot) : nullptr);
      pilots_.push_back(pilot ? models_.back()->launch(scenario, i, options) : nullptr);
    }
    ways_.resize(n);
    states_.resize(n);
    commands_.resize(n);
    spent_.assign(n, 0);
  }

  Run run() {
    double t = 0;
    for (std::uint64_t k = 1; t < scenario_.duration; ++k) {
      // Commands at multiples of the step, and where a body appears.
      const double next = std::min(time_of_step(scenario_, k), scenario_.duration);
      while (t < next && !done_) {
        checkpoint();
        double to = next;
        for (const Body& body : scenario_.bodies)
          if (body.appears > t && body.appears < to) to = body.appears;
        interval(t, to);
        t = to;
      }
      run_.end = t;
      if (options_.progress && !options_.progress(t)) {
        run_.interrupted = true;
        break;
      }
      if (done_ || (scenario_.stop_when_passed && all_passed(t))) break;
    }
    for (std::size_t i = 0; i < vehicles_.size(); ++i)
      if (vehicles_[i] && vehicles_[i]->broken()) run_.limits_broken.push_back({i, *vehicles_[i]->broken()});
    summarise(decisions_, run_.times);
    if (options_.prove && !run_.interrupted) {
      const Timed timed(run_.times.proofs);
      prove_pairs();
      prove_passages();
      prove_corridors();
    }
    std::stable_sort(run_.events.begin(), run_.events.end(),
                     [](const Event& x, const Event& y) { return x.t < y.t; });
    return std::move(run_);
  }

 private:
  void event(const Event& event) { run_.events.push_back(event); }

  /// Asks every pilot whose body is there.
  template <typename Ask>
  void each_pilot(Instant& now, const Ask& ask) {
    for (std::size_t i = 0; i < pilots_.size(); ++i) {
      if (!pilots_[i] || !now.there(i)) continue;
      now.self = i;
      now.vehicle = vehicles_[i].get();
      ask(*pilots_[i]);
    }
  }

  /// Commands at t, held until `to`.
  void interval(double t, double to) {
    Instant now{t, to, before_, command_, 0, states_, run_.tracks, nullptr, nullptr};
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (now.there(i)) states_[i] = run_.tracks[i].state(t);
    std::fill(commands_.begin(), commands_.end(), VehicleCommand{});
    each_pilot(now, [&](FlyingPilot& pilot) {
      {
        const Timed timed(spent_[now.self]);
        pilot.look(now);
      }
      pilot.report(now, run_);
    });
    each_pilot(now, [&](FlyingPilot& pilot) {
      now.goal = open_goal(now.self, t);
      {
        const Timed timed(spent_[now.self]);
        pilot.command(now, commands_, run_);
      }
      if (options_.log) pilot.log(now, run_);
      decisions_.push_back(std::exchange(spent_[now.self], 0));
    });
    for (std::size_t i = 0; i < run_.tracks.size(); ++i)
      if (now.there(i)) move(i, t, to);
    each_pilot(now, [&](FlyingPilot& pilot) { pilot.moved(now, run_); });
    each_pilot(now, [&](FlyingPilot&) { reaching(now.self, t, to); });
    before_ = t;
    ++command_;
  }

  void move(std::size_t i, double t, double to) {
    if (const Body& body = scenario_.bodies[i]; body.road) {
      constexpr double kError = 1e-6;
      for (const Curve& curve : curves_of(*body.road, body.start.position.z(), t, to, kError, body.appears))
        run_.tracks[i].append(curve);
      return;
    }
    VehicleCommand& wanted = commands_[i];
    if (!vehicles_[i]) {
      run_.tracks[i].advance(wanted.acceleration, to);
      return;
    }
    if (options_.log) vehicles_[i]->log(run_.vehicles.emplace_back(VehicleSample{t, i, {}}).values);
    if (const Goal* goal = open_goal(i, t); goal && !wanted.aim) {
      const double speed = states_[i].velocity.norm();
      wanted.aim = {goal->point, goal->velocity,
                    speed > 0 ? (goal->point - states_[i].position).norm() / speed : 0};
    }
    way_.clear();
    try {
      vehicles_[i]->advance(wanted, t, to, way_);
    } catch (const InputError& e) {
      throw e.within("bodies[" + std::to_string(i) + "]");
    }
    for (const Curve& curve : way_) run_.tracks[i].append(curve);
  }

  const std::vector<Goal>& goals(std::size_t agent) const {
    static const std::vector<Goal> kNone;
    const auto& pilot = scenario_.bodies[agent].pilot;
    return pilot ? pilot->goals : kNone;
  }

  /// Of the point of a goal, m and m/s, at t; what it follows is there then.
  std::pair<Vector3d, Vector3d> whereabouts(const Goal& goal, double t) const {
    std::pair<Vector3d, Vector3d> at{goal.point, goal.velocity};
    if (goal.velocity.any()) at.first += t * goal.velocity;
    if (goal.follows.empty()) return at;
    const Motion followed = run_.tracks[index_of(scenario_.bodies, goal.follows)].motion(t);
    return {followed.position + at.first, followed.velocity + at.second};
  }

  /// Where a pilot may go at t, until it is asked again; null: nowhere.
  const Goal* open_goal(std::size_t agent, double t) {
    if (ways_[agent].next == goals(agent).size()) return nullptr;
    const Goal& goal = goals(agent)[ways_[agent].next];
    if (!goal.follows.empty() && run_.tracks[index_of(scenario_.bodies, goal.follows)].appears() > t)
      return nullptr;
    std::optional<std::size_t> after;
    if (!goal.after.empty()) after = index_of(scenario_.bodies, goal.after);
    if (!pilots_[agent]->goal_opens(after)) return nullptr;
    goal_ = goal;
    std::tie(goal_.point, goal_.velocity) = whereabouts(goal, t);
    if (std::isfinite(goal.corridor) && !goal.from) {
      const std::size_t next = ways_[agent].next;
      goal_.from = next > 0 ? goals(agent)[next - 1].point : scenario_.bodies[agent].start.position;
    }
    return &goal_;
  }

  /// Whether its agent has come to its goal between t and `to`, and stayed.
  void reaching(std::size_t agent, double t, double to) {
    if (open_goal(agent, t) == nullptr) return;
    Way& way = ways_[agent];
    const Goal& goal = goals(agent)[way.next];
    if (!way.since) {
      const auto inside = [&](double s) {
        return goal.reached - (run_.tracks[agent].motion(s).position - whereabouts(goal, s).first).norm();
      };
      if (!(inside(to) >= 0)) return;
      const bool at_once = inside(t) >= 0;
      // Who starts within its only goal would be done before it has flown.
      if (at_once && goals(agent).size() == 1 && goal.stay == 0) return;
      way.since = at_once ? t : sign_change(inside, t, to);
      event({*way.since, EventKind::reaches_goal, agent, agent, double(way.next + 1)});
    }
    if (to - *way.since < goal.stay) return;
    legs_.push_back({agent, way.next, way.began, to});
    way.began = to;
    ++way.next;
    way.since.reset();
    done_ = true;
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (ways_[i].next < goals(i).size()) done_ = false;
  }

  bool all_passed(double t) const {
    for (const Body& body : scenario_.bodies)
      if (body.appears > t || (body.pilot && !body.pilot->goals.empty())) return false;
    return std::all_of(pilots_.begin(), pilots_.end(),
                       [](const auto& pilot) { return !pilot || pilot->passed_all(); });
  }

  /// Whether two bodies stay as they are to each other: pieces of one, perhaps.
  bool move_together(std::size_t i, std::size_t j) const {
    const auto steady = [&](std::size_t k) {
      const bool rigid = run_.tracks[k].shape().rigid() != nullptr;
      return rigid && std::none_of(run_.tracks[k].legs().begin(), run_.tracks[k].legs().end(),
                                   [](const auto& leg) { return leg->accelerated(); });
    };
    const Body &a = scenario_.bodies[i], &b = scenario_.bodies[j];
    return !flown(i) && !flown(j) && a.start.velocity == b.start.velocity && steady(i) && steady(j);
  }

  /// Moved by a law, its own or a partner's.
  bool flown(std::size_t i) const {
    if (scenario_.bodies[i].pilot || vehicles_[i]) return true;
    return std::any_of(scenario_.bodies.begin(), scenario_.bodies.end(), [&](const Body& other) {
      return other.pilot && contains(other.pilot->partners, scenario_.bodies[i].name);
    });
  }

  /// Whether there is to be another proof.
  bool another() {
    const double n = double(run_.tracks.size()),
                 all = n * (n - 1) / 2 + n * double(scenario_.orifices.size());
    if (!run_.interrupted && options_.proving && !options_.proving(double(asked_++) / all))
      run_.interrupted = true;
    return !run_.interrupted;
  }

  void prove_pairs() {
    for (std::size_t i = 0; i < run_.tracks.size(); ++i)
      for (std::size_t j = i + 1; j < run_.tracks.size(); ++j) {
        if (!another()) return;
        const double from = std::max(run_.tracks[i].appears(), run_.tracks[j].appears());
        if (!(from < run_.end)) continue;
        if (move_together(i, j)) {
          run_.not_checked.push_back({i, j});
          continue;
        }
        PairOutcome outcome{i, j, {}, std::max(required(i, j), required(j, i))};
        outcome.proof = prove(run_.tracks[i], run_.tracks[j], from, run_.end, scenario_.proof);
        if (outcome.proof.verdict == ProofVerdict::touched)
          event({outcome.proof.to, EventKind::contact, i, j, outcome.proof.from});
        run_.proofs.push_back(outcome);
      }
  }

  void prove_passages() {
    for (std::size_t i = 0; i < run_.tracks.size(); ++i) {
      if (!flown(i) || !(run_.tracks[i].appears() < run_.end)) continue;
      for (std::size_t k = 0; k < scenario_.orifices.size(); ++k) {
        if (!another()) return;
        const MovingOrifice& orifice = scenario_.orifices[k];
        const double from = std::max(run_.tracks[i].appears(), orifice.appears);
        const bool ordered = models_[i] && contains(models_[i]->orifices(), orifice.name);
        if (!(from < run_.end)) {
          // What was ordered and never came is missed.
          if (ordered) run_.passages.push_back({i, k, ordered, {}});
          continue;
        }
        run_.passages.push_back({i, k, ordered, passage(run_.tracks[i], orifice, from)});
      }
    }
  }

  /// Of each leg that was flown, the one that was not ended too.
  void prove_corridors() {
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (ways_[i].next < goals(i).size()) legs_.push_back({i, ways_[i].next, ways_[i].began, run_.end});
    std::sort(legs_.begin(), legs_.end(), [](const CorridorOutcome& x, const CorridorOutcome& y) {
      return std::pair(x.agent, x.goal) < std::pair(y.agent, y.goal);
    });
    for (CorridorOutcome leg : legs_) {
      const Goal& goal = goals(leg.agent)[leg.goal];
      const Track& track = run_.tracks[leg.agent];
      leg.from = std::max(leg.from, track.appears());
      if (!std::isfinite(goal.corridor) || !(leg.from < leg.to)) continue;
      const Vector3d from = goal.from      ? *goal.from
                            : leg.goal > 0 ? goals(leg.agent)[leg.goal - 1].point
                                           : scenario_.bodies[leg.agent].start.position;
      const CorridorProof proof = prove_corridor(track, {from, goal.point, goal.corridor}, leg.from, leg.to);
      leg.room = proof.room;
      leg.left = proof.left;
      run_.corridors.push_back(leg);
    }
  }

  PassageProof passage(const Track& track, const MovingOrifice& orifice, double from) const {
    if (!orifice.window) return prove_passage(track, orifice, from, run_.end, scenario_.proof);
    return prove_passage(track, *orifice.window, mesh_track(orifice, run_.end), from, run_.end,
                         scenario_.proof);
  }

  /// Metres that `agent` is to keep from `other`.
  double required(std::size_t agent, std::size_t other) const {
    return models_[agent] ? models_[agent]->required(scenario_.bodies[other].name) : 0;
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  Run run_;
  std::vector<std::shared_ptr<const PilotModel>> models_;  // null: none
  std::vector<std::unique_ptr<FlyingPilot>> pilots_;
  std::vector<std::unique_ptr<Vehicle>> vehicles_;  // null: a point mass
  std::vector<BodyState> states_;
  std::vector<VehicleCommand> commands_;
  std::vector<Curve> way_;
  /// Of an agent, to its goals.
  struct Way {
    std::size_t next = 0;         // the one that it goes to
    std::optional<double> since;  // s, when it came there
    double began = 0;             // s, when it set out
  };
  std::vector<Way> ways_;
  std::vector<CorridorOutcome> legs_;      // that were flown to their goals, without what is proved
  Goal goal_;                              // as it is now, for who is asked
  std::vector<double> spent_, decisions_;  // s: at this command by each agent, and all that are done
  double before_ = -1;
  std::uint64_t command_ = 0;  // number of the command, from 0
  std::size_t asked_ = 0;      // proofs that were come to
  bool done_ = false;
};

}  // namespace

ProofVerdict Run::verdict() const {
  ProofVerdict worst = ProofVerdict::avoided;
  for (const PairOutcome& pair : proofs) {
    if (pair.proof.verdict == ProofVerdict::touched) return ProofVerdict::touched;
    if (pair.proof.verdict == ProofVerdict::undecided) worst = ProofVerdict::undecided;
  }
  for (const PassageOutcome& passage : passages) {
    if (passage.proof.verdict == PassageVerdict::touched) return ProofVerdict::touched;
    if (passage.proof.verdict == PassageVerdict::undecided) worst = ProofVerdict::undecided;
  }
  return worst;
}

Run simulate(const Scenario& scenario, const RunOptions& options) {
  check(scenario);
  return Runner(scenario, options).run();
}

const char* to_string(EventKind kind) {
  constexpr const char* kWords[] = {"appears",      "enters-cone",  "leaves-cone", "passes",
                                    "aligned",      "reaches-goal", "contact",     "cannot-avoid",
                                    "goes-through", "goes-beside",  "sees",        "loses"};
  return kWords[std::size_t(kind)];
}

std::optional<Event> find_event(const Scenario& scenario, const Run& run, EventKind kind,
                                const std::string& agent, const std::string& obstacle, double after) {
  const std::size_t i = index_of(scenario.bodies, agent), j = index_of(scenario.bodies, obstacle);
  for (const Event& event : run.events)
    if (event.kind == kind && event.agent == i && event.obstacle == j && event.t >= after) return event;
  return std::nullopt;
}

std::optional<EncounterSample> sample_at(const Scenario& scenario, const Run& run, const std::string& agent,
                                         const std::string& obstacle, double t) {
  const std::size_t i = index_of(scenario.bodies, agent), j = index_of(scenario.bodies, obstacle);
  std::optional<EncounterSample> nearest;
  for (const EncounterSample& sample : run.encounters)
    if (sample.agent == i && sample.obstacle == j &&
        (!nearest || std::abs(sample.t - t) < std::abs(nearest->t - t)))
      nearest = sample;
  if (nearest && !(std::abs(nearest->t - t) <= scenario.step * (1 + 1e-9))) nearest.reset();
  return nearest;
}

}  // namespace vericone::simulation
