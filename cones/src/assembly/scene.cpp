// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/scene.h"

#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/round/round_oracle.h>
#include <vericone/internal/geometry/rotation.h>

#include "ellipsoids/apart.h"
#include "round/contact.h"
#include "round/seam.h"

namespace vericone::assembly {

Place place_of(const Eigen::Vector3d& at, const Pose& pose) {
  return is_upright(pose) ? Place{at, pose.position} : Place{};
}

Ellipsoid in_obstacle_frame(const Ellipsoid& agent, const Eigen::Vector3d& at, const Pose& pose) {
  if (is_upright(pose)) return agent;
  const Eigen::Vector3d center = pose.to_body(agent.center() + at);
  const Eigen::Matrix3d turn = pose.rotation.transpose();
  if (!agent.defined_by_factor()) {
    const Eigen::Matrix3d shape = turn * agent.shape() * pose.rotation;
    return Ellipsoid::from_shape(center, 0.5 * (shape + shape.transpose()));
  }
  Eigen::Matrix3d axes = turn * agent.axis_directions();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  return Ellipsoid::from_axes(center, agent.semi_axes(), axes);
}

namespace {

HullBody in_obstacle_frame(const HullBody& agent, const Eigen::Vector3d& at, const Pose& pose) {
  if (is_upright(pose)) return agent;
  std::vector<Eigen::Vector3d> points = agent.points();
  for (Eigen::Vector3d& x : points) x = pose.to_body(x + at);
  return HullBody(std::move(points));
}

Convex in_obstacle_frame(const Convex& agent, const Eigen::Vector3d& at, const Pose& pose) {
  if (is_upright(pose)) return agent;
  return in_world(agent, {pose.to_body(at), pose.rotation.transpose()});
}

Convex convex_agent(const Scene& scene) {
  if (scene.ellipsoid() != nullptr) return Convex::rounded(*scene.ellipsoid(), 0);
  return scene.hull() != nullptr ? Convex::rounded(*scene.hull(), 0) : *scene.convex();
}

/// Calls ask() with the exact oracle of the agent and the piece.
template <class Ask>
auto with_oracle(const Scene& scene, std::uint32_t slot, Ask&& ask) {
  const Assembly& body = scene.body();
  const Place& at = scene.place();
  if (scene.convex() != nullptr || body.kind() == PieceKind::convex)
    return ask(RoundOracle(convex_agent(scene), body.convex_piece(scene.piece(slot)), at.agent, at.obstacle));
  const auto hull = [&](HullBody piece) {
    return scene.ellipsoid() != nullptr ? ask(HullOracle(*scene.ellipsoid(), piece, at.agent, at.obstacle))
                                        : ask(HullOracle(*scene.hull(), piece, at.agent, at.obstacle));
  };
  switch (body.kind()) {
    case PieceKind::triangle: {
      const auto& corners = body.by_slot().triangles[slot];
      return hull(HullBody({corners.begin(), corners.end()}));
    }
    case PieceKind::box: {
      const Box& box = body.by_slot().boxes[slot];
      return hull(HullBody::box(box.low, box.high));
    }
    case PieceKind::hull:
      return hull(body.by_slot().hulls[slot]);
    case PieceKind::ball:
    case PieceKind::convex:
      break;
  }
  const Eigen::Vector3d& center = body.by_slot().balls[slot];
  if (body.radius() == 0) return hull(HullBody({center}));
  const Ellipsoid ball = Ellipsoid::from_axes(center, Eigen::Vector3d::Constant(body.radius()));
  if (scene.ellipsoid() == nullptr) return ask(HullOracle(*scene.hull(), ball, at.agent, at.obstacle));
  const auto pair = apart(*scene.ellipsoid(), at.agent, ball, at.obstacle);
  return ask(ConeOracle(pair.a, pair.b));
}

}  // namespace

Scene::Scene(const Ellipsoid& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose)
    : body_(body),
      pose_(pose),
      upright_(is_upright(pose)),
      place_(place_of(at, pose)),
      ellipsoid_(in_obstacle_frame(agent, at, pose)),
      frame_(*ellipsoid_, place_) {
  check_range();
}

Scene::Scene(const HullBody& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose)
    : body_(body),
      pose_(pose),
      upright_(is_upright(pose)),
      place_(place_of(at, pose)),
      hull_(in_obstacle_frame(agent, at, pose)),
      frame_(*hull_, place_) {
  check_range();
}

Scene::Scene(const Convex& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose)
    : body_(body),
      pose_(pose),
      upright_(is_upright(pose)),
      place_(place_of(at, pose)),
      convex_(in_obstacle_frame(agent, at, pose)),
      frame_(*convex_, place_) {
  check_range();
}

void Scene::check_range() { frame_.check_range(largest()); }

double Scene::largest() const {
  const Box& bounds = body_.bounds();
  return bounds.low.cwiseAbs().sum() + bounds.high.cwiseAbs().sum() + frame_.origin().cwiseAbs().sum();
}

Core piece_core(const Frame& frame, const Assembly& body, std::uint32_t slot, double radius) {
  const Assembly::Storage& storage = body.by_slot();
  switch (body.kind()) {
    case PieceKind::triangle:
      return Core::of_points(frame, storage.triangles[slot].data(), 3, radius);
    case PieceKind::ball:
      return Core::of_ball(frame, storage.balls[slot], body.radius() + radius);
    case PieceKind::box: {
      const Box& box = storage.boxes[slot];
      if (radius == 0) return Core::of_box(frame, box.low, box.high);
      const HullBody corners = HullBody::box(box.low, box.high);
      return Core::of_points(frame, corners.points().data(), 8, radius);
    }
    case PieceKind::hull:
      return Core::of_points(frame, storage.hulls[slot].points().data(), storage.hulls[slot].size(), radius);
    case PieceKind::convex:
      break;
  }
  return Core::of_convex(frame, storage.convexes[slot], radius);
}

Box piece_box(const Assembly& body, std::uint32_t slot) {
  const Assembly::Storage& storage = body.by_slot();
  switch (body.kind()) {
    case PieceKind::triangle: {
      Box box{storage.triangles[slot][0], storage.triangles[slot][0]};
      for (const Eigen::Vector3d& x : storage.triangles[slot]) box.include({x, x});
      return box;
    }
    case PieceKind::ball: {
      const Eigen::Vector3d& c = storage.balls[slot];
      const Eigen::Vector3d wide = (c.cwiseAbs() * (2 * kUlp)).array() + body.radius() * (1 + 4 * kUlp);
      return {c - wide, c + wide};
    }
    case PieceKind::box:
      return storage.boxes[slot];
    case PieceKind::convex:
      return storage.convexes[slot].bounds();
    case PieceKind::hull:
      break;
  }
  Box box{storage.hulls[slot].points()[0], storage.hulls[slot].points()[0]};
  for (const Eigen::Vector3d& x : storage.hulls[slot].points()) box.include({x, x});
  return box;
}

std::optional<Membership> Scene::exact_membership(std::uint32_t slot, const Eigen::Vector3d& v_a,
                                                  const Eigen::Vector3d& v_b,
                                                  std::vector<exact::Sector>* covered) const {
  return with_oracle(*this, slot, [&](const auto& oracle) -> std::optional<Membership> {
    const auto now = known_relation(oracle);
    if (!now) return std::nullopt;
    if (*now != Relation::disjoint) return Membership::in;
    const std::optional<Membership> answer = known_membership(oracle, v_a, v_b);
    if (answer == Membership::on && body_.size() > 1 && may_join(oracle)) return std::nullopt;
    if (covered != nullptr && answer == Membership::on && is_flat_agent())
      if (const HullScene* hulls = exact::two_hulls(oracle))
        if (const auto sector = exact::image(exact::generators(*hulls),
                                             exact::shadow_rows(exact::difference_on_grid<3>(v_a, v_b))))
          covered->push_back(*sector);
    return answer;
  });
}

std::optional<Relation> Scene::exact_relation(std::uint32_t slot,
                                              std::vector<exact::Generators>* covered) const {
  return with_oracle(*this, slot, [&](const auto& oracle) -> std::optional<Relation> {
    if (oracle.relation() == Relation::touching && body_.size() > 1 && may_join(oracle)) return std::nullopt;
    if (covered != nullptr && oracle.relation() == Relation::touching && is_flat_agent())
      if (const HullScene* hulls = exact::two_hulls(oracle)) covered->push_back(exact::generators(*hulls));
    return oracle.relation();
  });
}

std::optional<Membership> Scene::exact_within(std::uint32_t slot, const Stretch& stretch,
                                              std::vector<exact::Generators>& covered) const {
  // Doubles first: near a contact they tell more than a search by points.
  const RoundScene pair(convex_agent(*this), place_.agent, body_.convex_piece(piece(slot)), place_.obstacle);
  if (const auto inside = round_within(pair, stretch.v_a - stretch.v_b, stretch.from, stretch.until))
    return *inside ? Membership::in : Membership::out;
  return with_oracle(*this, slot, [&](const auto& oracle) -> std::optional<Membership> {
    exact::Generators cone;
    const std::optional<Membership> answer =
        exact::within(oracle, stretch, is_flat_agent() ? &cone : nullptr);
    if (answer == Membership::on && body_.size() > 1 && may_join(oracle)) return std::nullopt;
    if (!cone.empty()) covered.push_back(std::move(cone));
    return answer;
  });
}

std::optional<std::pair<double, double>> Scene::exact_time(std::uint32_t slot,
                                                           const Eigen::Vector3d& w) const {
  return with_oracle(*this, slot, [&](const auto& oracle) {
    const HullScene* hulls = exact::two_hulls(oracle);
    return hulls != nullptr ? exact::first_time(*hulls, w) : std::nullopt;
  });
}

}  // namespace vericone::assembly
