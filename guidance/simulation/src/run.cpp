// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/guidance/laws.h>
#include <vericone/internal/simulation/mesh_track.h>
#include <vericone/simulation/run.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/navigator.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engagement.h"
#include "observer.h"
#include "run_events.h"
#include "through.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;
using guidance::BodyState;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The acceleration that turns the velocity towards the goal: the most, and in the last step what is missing.
struct Homing {
  Vector3d acceleration;
  bool aligned;
};
Homing towards(const Goal& goal, const Motion& motion, double step) {
  const Vector3d v = motion.velocity, to_goal = goal.point - motion.position;
  const double speed = v.norm();
  const Vector3d aside = to_goal - v * (to_goal.dot(v) / (speed * speed));
  const double angle = std::atan2(aside.norm(), to_goal.dot(v) / speed);
  if (!(angle > 1e-9) || !(speed > 0)) return {Vector3d::Zero(), true};
  // Straight behind: any side is as good.
  const Vector3d side = aside.norm() > 1e-12 * to_goal.norm() ? Vector3d(aside.normalized())
                        : v.z() == 0 && goal.point.z() == 0   ? Vector3d(-v.y(), v.x(), 0) / speed
                                                              : AxisFrame(v).e1;
  const double missing = angle * speed / step;
  return {std::min(goal.most, missing) * side, missing <= goal.most};
}

guidance::NavigatorOptions courses_of(const Pilot& pilot) {
  guidance::NavigatorOptions options;
  options.most = pilot.guide.inversion.most;
  if (pilot.guide.law == guidance::Law::clearance) {
    options.required = pilot.guide.clearance.required;
    options.beyond = pilot.guide.clearance.beyond;
    options.most = pilot.guide.clearance.most;
  }
  options.longitudinal = pilot.guide.clearance.longitudinal;
  return options;
}

class Runner {
 public:
  Runner(const Scenario& scenario, const RunOptions& options) : scenario_(scenario), options_(options) {
    run_.tracks.reserve(scenario.bodies.size());
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
    navigators_.resize(scenario.bodies.size());
    throughs_.resize(scenario.bodies.size());
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
      if (!scenario.bodies[i].pilot) continue;
      const Pilot& pilot = *scenario.bodies[i].pilot;
      if (pilot.through) {
        throughs_[i].emplace(i, pilot, scenario);
        continue;
      }
      if (guarded(pilot)) navigators_[i].emplace(courses_of(pilot));
      for (std::size_t j = 0; j < scenario.bodies.size(); ++j)
        if (j != i && (pilot.minds.empty() || contains(pilot.minds, scenario.bodies[j].name)))
          follow(i, j, pilot);
    }
    // What laws see of a map takes 0.3 s to find, and is kept: no decision is to wait for it.
    for (const Followed& f : engagements_)
      for (const std::size_t i : {f.engagement.agent(), f.engagement.obstacle()})
        if (const BodyState body = run_.tracks[i].state(run_.tracks[i].appears()); !body.planar())
          static_cast<void>(body.shape.containing_ellipsoid());
    aligned_.assign(scenario.bodies.size(), false);
    cannot_avoid_.assign(scenario.bodies.size(), false);
    reached_.assign(scenario.bodies.size(), false);
    states_.resize(scenario.bodies.size());
    accelerations_.assign(scenario.bodies.size(), Vector3d::Zero());
    spent_.assign(scenario.bodies.size(), 0);
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
    }
    std::stable_sort(run_.events.begin(), run_.events.end(),
                     [](const Event& x, const Event& y) { return x.t < y.t; });
    return std::move(run_);
  }

 private:
  struct Followed {
    Engagement engagement;
    std::optional<Observer> observer = {};
    bool inside = false;  // at the command before
    bool seen = false;    // both were there at the command before
    bool gone = false;    // passed, at the time reached
    bool has_passed = false;
    bool seen_passed = false;  // as the agent knows it
    std::optional<Passage> passage = {};
  };

  void follow(std::size_t agent, std::size_t obstacle, const Pilot& pilot) {
    Followed& f = engagements_.emplace_back(Followed{Engagement(agent, obstacle, pilot)});
    const Draw draw{scenario_.seed, options_.trial, agent * scenario_.bodies.size() + obstacle, 0};
    if (pilot.sensor) f.observer.emplace(*pilot.sensor, pilot, draw);
  }

  /// The obstacle as the agent has it.
  const BodyState& believed(const Followed& f) const {
    return f.observer ? f.observer->last().believed : states_[f.engagement.obstacle()];
  }

  bool present(std::size_t body, double t) const { return scenario_.bodies[body].appears <= t; }
  void event(const Event& event) { run_.events.push_back(event); }

  /// Commands at t, held until `to`.
  void interval(double t, double to) {
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (present(i, t)) states_[i] = run_.tracks[i].state(t);
    std::fill(accelerations_.begin(), accelerations_.end(), Vector3d::Zero());
    for (Followed& f : engagements_) {
      const Engagement& e = f.engagement;
      if (!present(e.agent(), t) || !present(e.obstacle(), t)) continue;
      if (!f.seen) f.gone = passing_rate(f, t) >= 0;
      f.seen = true;
      {
        const Timed timed(spent_[e.agent()]);
        observe(f, t);
      }
      crossed_cone(f, t);
    }
    ++command_;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      if (!scenario_.bodies[i].pilot || !present(i, t)) continue;
      command(i, t, to);
      decisions_.push_back(std::exchange(spent_[i], 0));
    }
    for (std::size_t i = 0; i < run_.tracks.size(); ++i)
      if (present(i, t)) move(i, t, to);
    for (Followed& f : engagements_) passing(f, t, to);
    for (auto& flight : throughs_)
      if (flight && present(flight->agent(), t))
        if (const auto crossed = flight->fly(run_.tracks[flight->agent()], t, to)) event(*crossed);
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) reaching(i, t, to);
    before_ = t;
  }

  void move(std::size_t i, double t, double to) {
    if (const Body& body = scenario_.bodies[i]; body.road) {
      constexpr double kError = 1e-6;
      for (const Curve& curve : curves_of(*body.road, body.start.position.z(), t, to, kError, body.appears))
        run_.tracks[i].append(curve);
      return;
    }
    if (!vehicles_[i]) {
      run_.tracks[i].advance(accelerations_[i], to);
      return;
    }
    if (options_.log) vehicles_[i]->log(run_.vehicles.emplace_back(VehicleSample{t, i, {}}).values);
    way_.clear();
    VehicleCommand wanted{accelerations_[i], {}};
    if (throughs_[i] && throughs_[i]->sees(t)) {
      const guidance::OrificeAim aim = throughs_[i]->aim(states_[i], t);
      wanted.aim = {aim.point - aim.seconds * aim.velocity, aim.velocity, aim.seconds};
    } else if (const auto& pilot = scenario_.bodies[i].pilot;
               pilot && pilot->goal && goal_open(i, *pilot->goal)) {
      const double speed = states_[i].velocity.norm();
      wanted.aim = {pilot->goal->point, Vector3d::Zero(),
                    speed > 0 ? (pilot->goal->point - states_[i].position).norm() / speed : 0};
    }
    try {
      vehicles_[i]->advance(wanted, t, to, way_);
    } catch (const InputError& e) {
      throw e.within("bodies[" + std::to_string(i) + "]");
    }
    for (const Curve& curve : way_) run_.tracks[i].append(curve);
  }

  void observe(Followed& f, double t) {
    Engagement& e = f.engagement;
    const BodyState &a = states_[e.agent()], &b = states_[e.obstacle()];
    if (!f.observer) {
      e.observe(a, b, t, f.gone);
      return;
    }
    const Observed& seen = f.observer->look(a, b, run_.tracks[e.obstacle()], t, command_);
    e.observe(a, seen.believed, t, false, seen.sight);
    if (!e.step()) return;
    const guidance::GuideStep& said = *e.step();
    if (said.reading ? said.v_r_hat >= 0 : said.status == guidance::LawStatus::receding) f.seen_passed = true;
  }

  void command(std::size_t agent, double t, double to) {
    const Followed* attended = nullptr;
    {
      const Timed timed(spent_[agent]);
      attended = decide(agent, t, to);
    }
    if (options_.log) log(agent, t, attended);
  }

  /// The command, and the obstacle that it is about.
  const Followed* decide(std::size_t agent, double t, double to) {
    const Pilot& pilot = *scenario_.bodies[agent].pilot;
    const Followed* attended = nullptr;
    if (throughs_[agent] && !throughs_[agent]->done()) {
      if (throughs_[agent]->sees(t)) command_through(*throughs_[agent], t);
      return attended;
    }
    for (const Followed& f : engagements_) {
      if (f.engagement.agent() != agent || !present(f.engagement.obstacle(), t) || !f.engagement.demands())
        continue;
      if (attended == nullptr || f.engagement.time_to_go() < attended->engagement.time_to_go()) attended = &f;
    }
    if (navigators_[agent]) {
      guarded_command(agent, t, to - t, attended);
    } else if (attended != nullptr) {
      accelerations_[agent] = attended->engagement.step()->a;
      const std::size_t other = attended->engagement.obstacle();
      if (contains(pilot.partners, scenario_.bodies[other].name))
        accelerations_[other] = attended->engagement.step()->b;
      aligned_[agent] = false;
    } else if (pilot.goal && goal_open(agent, *pilot.goal)) {
      const Homing homing = towards(*pilot.goal, run_.tracks[agent].motion(t), to - t);
      accelerations_[agent] = homing.acceleration;
      if (homing.aligned && !aligned_[agent]) event({to, EventKind::aligned, agent, agent, 0});
      aligned_[agent] = homing.aligned;
    }
    return attended;
  }

  void log(std::size_t agent, double t, const Followed* attended) {
    const Pilot& pilot = *scenario_.bodies[agent].pilot;
    for (Followed& f : engagements_) {
      if (f.engagement.agent() != agent || !present(f.engagement.obstacle(), t)) continue;
      const BodyState &a = states_[agent], &b = states_[f.engagement.obstacle()];
      run_.encounters.push_back(f.engagement.sample(a, b, t, &f == attended));
      if (f.observer) run_.sights.push_back(f.engagement.sight_sample(a, b, t, f.observer->last()));
      if (scenario_.planes_logged > 0 && !f.engagement.passed())
        for (const auto& plane : guidance::all_planes(a, b, pilot.guide.sector, scenario_.planes_logged))
          run_.planes.push_back({t, agent, f.engagement.obstacle(), plane});
    }
  }

  void command_through(ThroughFlight& flight, double t) {
    const BodyState& agent = states_[flight.agent()];
    const guidance::OrificeCommand said = flight.command(agent, t);
    accelerations_[flight.agent()] = said.acceleration;
    if (options_.log) run_.orifices.push_back(flight.sample(agent, t, said));
  }

  /// Of all that it minds, not of the one met first alone.
  void guarded_command(std::size_t agent, double t, double step, const Followed*& attended) {
    const Pilot& pilot = *scenario_.bodies[agent].pilot;
    minded_.clear();
    indices_.clear();
    for (const Followed& f : engagements_) {
      const std::size_t other = f.engagement.obstacle();
      if (f.engagement.agent() != agent || !present(other, t)) continue;
      minded_.push_back(believed(f));
      indices_.push_back(other);
    }
    std::optional<guidance::Destination> destination;
    if (pilot.goal && goal_open(agent, *pilot.goal)) destination = {pilot.goal->point, pilot.goal->most};
    using enum guidance::NavigatorStatus;
    const guidance::NavigatorStep said =
        navigators_[agent]->step(states_[agent], minded_, destination, t, step);
    accelerations_[agent] = said.acceleration;
    if (said.status == homing || said.status == straight) attended = nullptr;
    if (said.status == cannot_avoid && !cannot_avoid_[agent])
      event({t, EventKind::cannot_avoid, agent, indices_[said.nearest], said.least});
    cannot_avoid_[agent] = said.status == cannot_avoid;
    if (said.aligned && !aligned_[agent]) event({t + step, EventKind::aligned, agent, agent, 0});
    aligned_[agent] = said.aligned;
  }

  bool goal_open(std::size_t agent, const Goal& goal) const {
    if (reached_[agent]) return false;
    if (throughs_[agent] && !throughs_[agent]->done()) return false;
    if (goal.after.empty()) return true;
    const std::size_t after = index_of(scenario_, goal.after);
    return std::any_of(engagements_.begin(), engagements_.end(), [&](const Followed& f) {
      return f.engagement.agent() == agent && f.engagement.obstacle() == after &&
             (f.observer ? f.seen_passed : f.has_passed);
    });
  }

  /// The cone was entered or left since the command before.
  void crossed_cone(Followed& f, double t) {
    const Engagement& e = f.engagement;
    if (f.observer) {
      if (options_.log) crossed_true_cone(f, t);
      return;
    }
    const bool inside = e.inside();
    const std::size_t i = e.agent(), j = e.obstacle();
    if (inside != f.inside && e.step() && !e.passed()) {
      const guidance::GuideOptions& guide = scenario_.bodies[i].pilot->guide;
      // Not a change of sides but the first look, or a passage: nothing is crossed.
      const bool first = !(before_ >= 0) || !present(i, before_) || !present(j, before_);
      const bool closing = e.step()->status != guidance::LawStatus::receding;
      double when = t;
      if (!first && closing)
        when = sign_change([&](double s) { return margin(run_.tracks[i], run_.tracks[j], guide, s); },
                           before_, t);
      const bool metres = guide.law == guidance::Law::clearance;
      const double edge = metres ? guide.clearance.required : guide.inversion.cease;
      if (inside) event({when, EventKind::enters_cone, i, j, metres ? e.step()->m : e.step()->y});
      if (!inside && closing) event({when, EventKind::leaves_cone, i, j, edge});
    }
    f.inside = inside;
  }

  /// The same of an agent with a sensor, whose law does not know: on the tracks.
  void crossed_true_cone(Followed& f, double t) {
    const std::size_t i = f.engagement.agent(), j = f.engagement.obstacle();
    const BodyState &a = states_[i], &b = states_[j];
    const guidance::GuideOptions& guide = scenario_.bodies[i].pilot->guide;
    const auto beyond = [&](double s) { return margin(run_.tracks[i], run_.tracks[j], guide, s); };
    const bool closing = (b.position - a.position).dot(b.velocity - a.velocity) < 0;
    const bool inside = closing && beyond(t) < 0;
    const bool first = !(before_ >= 0) || !present(i, before_) || !present(j, before_);
    if (inside != f.inside && !f.has_passed) {
      const bool metres = guide.law == guidance::Law::clearance;
      const double when = first || !closing ? t : sign_change(beyond, before_, t);
      const double value = !inside  ? (metres ? guide.clearance.required : guide.inversion.cease)
                           : metres ? guidance::law_clearance(a, b)
                                    : f.engagement.sample(a, b, t, false).step.y;
      if (inside || closing)
        event({when, inside ? EventKind::enters_cone : EventKind::leaves_cone, i, j, value});
    }
    f.inside = inside;
  }

  void passing(Followed& f, double t, double to) {
    const std::size_t i = f.engagement.agent(), j = f.engagement.obstacle();
    if (!present(i, t) || !present(j, t)) return;
    const Track &a = run_.tracks[i], &b = run_.tracks[j];
    const bool before = f.gone;
    f.gone = passing_rate(f, to) >= 0;
    if (!f.gone) return;
    if (!before) {
      const double when = sign_change([&](double s) { return passing_rate(f, s); }, t, to);
      event({when, EventKind::passes, i, j, f.passage->between(a, b, when).norm()});
    }
    f.has_passed = true;
  }

  double passing_rate(Followed& f, double t) const {
    const std::size_t i = f.engagement.agent(), j = f.engagement.obstacle();
    const Track &a = run_.tracks[i], &b = run_.tracks[j];
    if (!f.passage) f.passage.emplace(a, b);
    return f.passage->rate(a, b, *scenario_.bodies[i].pilot, t);
  }

  void reaching(std::size_t agent, double t, double to) {
    const Body& body = scenario_.bodies[agent];
    if (!body.pilot || !body.pilot->goal || !present(agent, t) || !goal_open(agent, *body.pilot->goal))
      return;
    const Goal& goal = *body.pilot->goal;
    const auto outside = [&](double s) {
      return goal.reached - (run_.tracks[agent].motion(s).position - goal.point).norm();
    };
    if (!(outside(t) < 0) || !(outside(to) >= 0)) return;
    event({sign_change(outside, t, to), EventKind::reaches_goal, agent, agent, goal.reached});
    reached_[agent] = true;
    done_ = true;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i)
      if (scenario_.bodies[i].pilot && scenario_.bodies[i].pilot->goal && !reached_[i]) done_ = false;
  }

  bool all_passed(double t) const {
    for (const Body& body : scenario_.bodies)
      if (body.appears > t || (body.pilot && body.pilot->goal)) return false;
    return std::all_of(engagements_.begin(), engagements_.end(),
                       [](const Followed& f) { return f.has_passed; }) &&
           std::all_of(throughs_.begin(), throughs_.end(),
                       [](const auto& flight) { return !flight || flight->done(); });
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
        const auto& pilot = scenario_.bodies[i].pilot;
        const bool ordered = pilot && pilot->through && contains(pilot->through->orifices, orifice.name);
        if (!(from < run_.end)) {
          // What was ordered and never came is missed.
          if (ordered) run_.passages.push_back({i, k, ordered, {}});
          continue;
        }
        run_.passages.push_back({i, k, ordered, passage(run_.tracks[i], orifice, from)});
      }
    }
  }

  PassageProof passage(const Track& track, const MovingOrifice& orifice, double from) const {
    if (!orifice.window) return prove_passage(track, orifice, from, run_.end, scenario_.proof);
    return prove_passage(track, *orifice.window, mesh_track(orifice, run_.end), from, run_.end,
                         scenario_.proof);
  }

  /// Metres that `agent` is to keep from `other`.
  double required(std::size_t agent, std::size_t other) const {
    const auto& pilot = scenario_.bodies[agent].pilot;
    if (!pilot || pilot->guide.law != guidance::Law::clearance) return 0;
    const bool minds = pilot->minds.empty() || contains(pilot->minds, scenario_.bodies[other].name);
    return minds ? pilot->guide.clearance.required : 0;
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  Run run_;
  std::vector<Followed> engagements_;
  std::vector<BodyState> states_;
  std::vector<Vector3d> accelerations_;
  std::vector<std::unique_ptr<Vehicle>> vehicles_;  // null: a point mass
  std::vector<Curve> way_;
  std::vector<bool> aligned_, reached_, cannot_avoid_;
  std::vector<std::optional<guidance::Navigator>> navigators_;
  std::vector<std::optional<ThroughFlight>> throughs_;
  std::vector<BodyState> minded_;
  std::vector<std::size_t> indices_;
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

}  // namespace vericone::simulation
