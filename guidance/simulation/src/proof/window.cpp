// SPDX-License-Identifier: BSD-3-Clause
//
// Passages through a window of a mesh: the mesh is kept off by the proof of the pair, and the way of the
// agent's middle, as the mesh sees it, is counted where it crosses the fan that spans the window's rim.
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/proof.h>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proof/convex.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The fan of MeshWindow as a body.
Placed fan_of(const MeshWindow& window) {
  std::vector<Vector3d> points = window.rim();
  const auto n = static_cast<std::uint32_t>(points.size());
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& x : points) middle += x / static_cast<double>(n);
  points.push_back(middle);
  std::vector<Assembly::Triangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) triangles.push_back({i, (i + 1) % n, n});
  return Placed(vericone::Body(Assembly::mesh(std::move(points), std::move(triangles))));
}

/// The agent's middle in the frame of the mesh at a time.
struct OnWay {
  double t = 0;
  Vector3d place;
  Motion agent, mesh;
};

class WindowPassage {
 public:
  /// `off`: how far the agent is from the mesh, proved, beside all that it may be off its track.
  WindowPassage(const Track& agent, const MeshWindow& window, const Track& mesh, double off)
      : agent_(agent), window_(window), mesh_(mesh), fan_(fan_of(window)), off_(off) {
    middle_ = convex_around(agent.shape(), agent.appears(), agent.appears()).center;
  }

  struct Through {
    double time = 0;
    int direction = 0;
  };

  /// The first time that it is clear of the window on the other side.
  std::optional<Through> search(double from, double to) {
    const OnWay first = at(from);
    note(first);
    follow(first, at(to), 0);
    return through_;
  }

 private:
  OnWay at(double t) const {
    const Motion a = agent_.motion(t), m = mesh_.motion(t);
    return {t, m.rotation.transpose() * (a.position + a.rotation * middle_ - m.position), a, m};
  }

  /// Halves the way until it is nearer to its chord than to the mesh: then the chord can be moved to it
  /// without crossing the rim, and crosses the fan as often, as signs count.
  void follow(const OnWay& from, const OnWay& to, int depth) {
    if (through_) return;
    constexpr int kDeepest = 40;
    const double half = 0.5 * (from.t + to.t);
    if (depth < kDeepest && half > from.t && half < to.t && !(deviation(from, to) < off_)) {
      const OnWay mid = at(half);
      follow(from, mid, depth + 1);
      follow(mid, to, depth + 1);
      return;
    }
    if (const int crossed = window_.crossings(from.place, to.place); crossed != 0) {
      if (count_ == since_) crossing_ = when(from, to);
      count_ += crossed;
    }
    note(to);
  }

  /// In the frame of the mesh, whose turning bounds hold for directions.
  double deviation(const OnWay& from, const OnWay& to) const {
    const double dt = to.t - from.t;
    const Track::Bounds a = agent_.bounds(from.t, to.t), m = mesh_.bounds(from.t, to.t);
    const double reach = middle_.norm();
    const double blows = a.velocity_jumps + m.velocity_jumps;
    const double speed = (from.agent.velocity - from.mesh.velocity).norm() +
                         (a.acceleration + m.acceleration) * dt + blows + product(reach, a.turn_rate);
    const double away = from.place.norm() + speed * dt;
    const double bend = a.acceleration + m.acceleration + product(reach, a.turn_acceleration) +
                        product(2 * speed, m.turn_rate) + product(away, m.turn_acceleration);
    const double jumps = blows + product(reach, a.turn_jumps) + product(away, m.turn_jumps);
    return (bend * dt * dt / 8 + jumps * dt / 4) * (1 + 1e-9) + 1e-12 * away;
  }
  static double product(double length, double rate) { return length == 0 || rate == 0 ? 0 : length * rate; }

  /// Where the agent is clear of the window it is on one side of it.
  void note(const OnWay& way) {
    if (known_ && count_ == since_) return;
    const WorldBody body = shape_at(agent_.shape(), way.t,
                                    way.mesh.rotation.transpose() * (way.agent.position - way.mesh.position),
                                    way.mesh.rotation.transpose() * way.agent.rotation);
    const std::optional<Relation> relation = Pair(body.as_placed(), fan_).relation();
    if (!relation || *relation != Relation::disjoint) return;
    if (known_) through_ = Through{crossing_, count_ > since_ ? 1 : -1};
    known_ = true;
    since_ = count_;
  }

  double when(const OnWay& from, const OnWay& to) const {
    double before = from.t, after = to.t;
    for (int i = 0; i < 50; ++i) {
      const double half = 0.5 * (before + after);
      (window_.crossings(from.place, at(half).place) == 0 ? before : after) = half;
    }
    return after;
  }

  const Track& agent_;
  const MeshWindow& window_;
  const Track& mesh_;
  Placed fan_;
  double off_;
  Vector3d middle_;
  int count_ = 0, since_ = 0;  // crossings until now, and until it was clear of the window last
  bool known_ = false;         // it has been clear of it
  double crossing_ = 0;
  std::optional<Through> through_;
};

}  // namespace

PassageProof prove_passage(const Track& agent, const MeshWindow& window, const Track& mesh, double from,
                           double to, const ProofOptions& options) {
  if (planar(agent.shape()))
    throw InputError("agent", "a body of the plane", "a body of space, which a window can let through");
  if (const WorldBody* rigid = agent.shape().rigid();
      rigid && rigid->placed() && !rigid->placed()->body.hull() && !rigid->placed()->body.quadric())
    throw InputError("agent", std::string("a body of kind ") + to_string(rigid->placed()->body.kind()),
                     "an ellipsoid, a delimited body or a hull");
  const PairProof apart = prove(agent, mesh, from, to, options);
  PassageProof proof;
  proof.from = apart.from;
  proof.to = apart.to;
  proof.place = apart.place;
  proof.pieces = apart.pieces;
  switch (apart.verdict) {
    case ProofVerdict::touched:
      proof.verdict = PassageVerdict::touched;
      proof.time = apart.to;
      return proof;
    case ProofVerdict::undecided:
      proof.verdict = PassageVerdict::undecided;
      proof.time = apart.from;
      return proof;
    case ProofVerdict::avoided:
      break;
  }
  proof.least_distance = apart.least_distance;
  proof.time = proof.least_time = apart.least_time;
  const auto through = WindowPassage(agent, window, mesh, apart.least_distance).search(from, to);
  if (!through) return proof;
  proof.verdict = PassageVerdict::passed;
  proof.time = through->time;
  proof.direction = through->direction;
  const Motion m = agent.motion(proof.time);
  proof.place = m.position + m.rotation * convex_around(agent.shape(), proof.time, proof.time).center;
  return proof;
}

}  // namespace vericone::simulation
