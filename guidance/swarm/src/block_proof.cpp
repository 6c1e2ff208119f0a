// SPDX-License-Identifier: BSD-3-Clause
#include "block_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cells.h"
#include "threads.h"

namespace vericone::swarm {

using Eigen::Vector3d;
using simulation::Curve, simulation::PairProof, simulation::ProofVerdict, simulation::Track;

namespace {

constexpr int kHalvings = 8;

}  // namespace

BlockProof::BlockProof(const std::vector<Agent>& agents, const std::vector<Obstacle>& obstacles, int threads,
                       double from)
    : agents_(agents.size()),
      threads_(threads),
      from_(from),
      least_(std::numeric_limits<double>::infinity()) {
  for (const Agent& agent : agents) solids_.push_back(agent.body);
  for (const Obstacle& obstacle : obstacles) solids_.push_back(obstacle.body);
  for (const Solid& solid : solids_) bodies_.push_back({Prepared(solid)});
  now_ = solids_;
  legs_.resize(solids_.size());
  turns_.resize(solids_.size());
  met_.resize(solids_.size());
  for (const Agent& agent : agents) turning_.push_back(agent.turning > 0);
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    legs_[agents_ + k] = {{0, obstacles[k].position, Vector3d::Zero(), Vector3d::Zero()}};
}

void BlockProof::add(const std::vector<Flown>& flown, double t, double step) {
  for (std::size_t i = 0; i < agents_; ++i) {
    const Flown& way = flown[i];
    const PlanLeg leg{t, way.position, way.velocity, way.acceleration};
    const auto push = [&](const PlanLeg& next, const Vector3d& turn) {
      legs_[i].push_back(next);
      if (!turning_[i]) return;
      turns_[i].push_back(turn);
      now_[i] = turned(now_[i], turn);
      bodies_[i].emplace_back(now_[i]);
    };
    if (way.seconds > 0) push(leg, way.turn);
    if (way.seconds < step)
      push({t + way.seconds, leg.at(t + way.seconds), Vector3d::Zero(), Vector3d::Zero()}, Vector3d::Zero());
  }
}

Way BlockProof::way(std::size_t i) const {
  double most_turn = 0;
  for (const Vector3d& turn : turns_[i]) most_turn = std::max(most_turn, turn.norm());
  return {legs_[i], bodies_[i].data(), bodies_[i].size() - 1, most_turn};
}

BlockProof::Ball BlockProof::swept(std::size_t i, double until) const {
  const std::vector<PlanLeg>& legs = legs_[i];
  Vector3d low = legs.front().position, high = low;
  double beside = 0;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const double end = k + 1 < legs.size() ? legs[k + 1].begin : std::max(until, legs[k].begin);
    const Vector3d last = legs[k].at(end);
    low = low.cwiseMin(legs[k].position).cwiseMin(last);
    high = high.cwiseMax(legs[k].position).cwiseMax(last);
    // A parabola is no farther than that from its chord.
    const double dt = end - legs[k].begin;
    beside = std::max(beside, legs[k].acceleration.norm() * dt * dt / 8);
  }
  return {0.5 * (low + high),
          (0.5 * (high - low).norm() + beside) * (1 + 1e-12) + bodies_[i][0].reach + kPadding};
}

BlockProof::Bound BlockProof::bound(std::size_t a, std::size_t b, double until) const {
  constexpr double kRounding = 4 * kPadding;
  const double gap = proved_gap(way(a), way(b), from_, until, kRounding, kHalvings);
  return {gap > 0 ? gap - kRounding : gap, a, b};
}

bool BlockProof::have_met(std::size_t a, std::size_t b) const {
  return std::find(met_[a].begin(), met_[a].end(), b) != met_[a].end();
}

Track BlockProof::track(std::size_t i, double until) const {
  Solid solid = solids_[i];
  const Vector3d zero = Vector3d::Zero();
  const simulation::RigidShape shape{world_body(solid)};
  const std::vector<PlanLeg>& legs = legs_[i];
  const PlanLeg& first = legs.front();
  Track track(shape, {first.at(from_), first.velocity_at(from_), solid.rotation},
              simulation::Orientation::fixed, from_);
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const double begin = std::max(from_, legs[k].begin),
                 end = k + 1 < legs.size() ? legs[k + 1].begin : until;
    if (!(end > begin)) continue;
    const simulation::Quintic still{zero, zero, zero, zero, zero, zero};
    simulation::Quintic position = still;
    position[0] = legs[k].at(begin);
    position[1] = legs[k].velocity_at(begin);
    position[2] = 0.5 * legs[k].acceleration;
    simulation::Quintic turn = still;
    if (turning_of(i)) turn[1] = turns_[i][k] / (end - begin);
    track.append(Curve(position, turn, solid.rotation, begin, end));
    if (turning_of(i)) solid = turned(solid, turns_[i][k]);
  }
  return track;
}

void BlockProof::settle(std::vector<Bound> bounds, double until) {
  // What is open, then what may be nearest, each by the proof of runs.
  std::sort(bounds.begin(), bounds.end());
  std::vector<PairProof> proofs(bounds.size());
  const auto open = static_cast<std::size_t>(
      std::find_if(bounds.begin(), bounds.end(), [](const Bound& one) { return one.gap > 0; }) -
      bounds.begin());
  const auto prove_one = [&](std::size_t k) {
    proofs[k] = simulation::prove(track(bounds[k].a, until), track(bounds[k].b, until), from_, until);
  };
  on_threads(open, threads_, [&](std::size_t k, std::size_t) { prove_one(k); });
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    if (k >= open) {
      if (bounds[k].gap >= least_) break;
      prove_one(k);
    }
    const Bound& pair = bounds[k];
    const PairProof& proof = proofs[k];
    if (proof.verdict == ProofVerdict::avoided) {
      least_ = std::min(least_, std::max(pair.gap, proof.least_distance));
      continue;
    }
    const auto before = std::find_if(undecided_.begin(), undecided_.end(), [&](const TouchedPair& one) {
      return one.a == pair.a && one.b == pair.b;
    });
    if (proof.verdict == ProofVerdict::undecided) {
      if (before == undecided_.end()) undecided_.push_back({pair.a, pair.b, proof.from, proof.to});
      continue;
    }
    touched_.push_back({pair.a, pair.b, before == undecided_.end() ? proof.from : before->from, proof.to});
    if (before != undecided_.end()) undecided_.erase(before);
    met_[pair.a].push_back(pair.b);
  }
}

void BlockProof::prove(double until) {
  std::vector<Ball> balls;
  std::vector<Vector3d> middles;
  std::vector<std::size_t> apart_from_cells;
  double widest = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    balls.push_back(swept(i, until));
    middles.push_back(balls[i].middle);
    if (i < agents_) widest = std::max(widest, balls[i].radius);
  }
  // Bodies that are much larger than agents are asked by all; the others stand in cells.
  std::vector<std::uint32_t> numbers;
  std::vector<Vector3d> places;
  double in_cells = widest;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (i >= agents_ && balls[i].radius > 4 * widest) {
      apart_from_cells.push_back(i);
      continue;
    }
    in_cells = std::max(in_cells, balls[i].radius);
    numbers.push_back(static_cast<std::uint32_t>(i));
    places.push_back(middles[i]);
  }
  double spread = 0;
  for (const Vector3d& place : places) spread = std::max(spread, (place - places.front()).norm());
  // Who stands in no neighbouring cell is farther away than `beyond`: wider, until that is no less than what
  // is said of the others, or nobody is left out.
  for (double beyond = 0.5 * widest;; beyond *= 4) {
    const Cells cells(places, widest + in_cells + beyond);
    std::vector<std::vector<Bound>> found(static_cast<std::size_t>(std::max(1, threads_)));
    on_threads(agents_, threads_, [&](std::size_t a, std::size_t k) {
      const auto consider = [&](std::size_t b) {
        if (b <= a) return;
        const double far = balls[a].radius + balls[b].radius;
        // Beyond it by more than the least distance so far nothing changes.
        const double distance = (balls[a].middle - balls[b].middle).norm();
        if (distance > far * (1 + 1e-12) && distance - far > least_) return;
        if (have_met(a, b)) return;
        if (const Bound one = bound(a, b, until); one.gap < least_) found[k].push_back(one);
      };
      cells.around(middles[a], [&](std::uint32_t number) { consider(numbers[number]); });
      for (const std::size_t b : apart_from_cells) consider(b);
    });
    std::vector<Bound> all;
    for (const std::vector<Bound>& part : found) all.insert(all.end(), part.begin(), part.end());
    settle(std::move(all), until);
    if (least_ <= beyond || beyond > 2 * spread) break;
  }
  from_ = until;
  for (std::size_t i = 0; i < agents_; ++i) {
    legs_[i].clear();
    turns_[i].clear();
    bodies_[i] = {bodies_[i].back()};
  }
  solids_ = now_;
}

}  // namespace vericone::swarm
