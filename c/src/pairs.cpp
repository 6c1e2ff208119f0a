// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/cone.h>
#include <cstddef>
#include <vector>

#include "common.h"

using namespace vericone;
using namespace vericone::c;

struct vericone_cone {
  Cone cone;
};

namespace {

const std::vector<DirectionLoop>& loops_of(const vericone_cone* cone, int32_t which) {
  const Cone& all = given(cone, "cone").cone;
  if (which != 0 && which != 1)
    throw InputError("which", std::to_string(which), "0, the inner cone, or 1, the outer one");
  return which == 0 ? all.inner : all.outer;
}

}  // namespace

extern "C" {

vericone_pair* vericone_pair_new(const vericone_body* agent, const double agent_position[3],
                                 const double agent_rotation[9], const vericone_body* obstacle,
                                 const double obstacle_position[3], const double obstacle_rotation[9],
                                 double tolerance) {
  return answered([&] {
    PairOptions options;
    if (tolerance != 0) options.tolerance = tolerance;
    return new vericone_pair{Pair(placed(agent, agent_position, agent_rotation, "agent"),
                                  placed(obstacle, obstacle_position, obstacle_rotation, "obstacle"),
                                  options)};
  });
}

void vericone_pair_free(vericone_pair* pair) { delete pair; }

int32_t vericone_pair_exact(const vericone_pair* pair) {
  return answered([&] { return int32_t(given(pair, "pair").pair.guarantee().exact); });
}

int32_t vericone_pair_relation(const vericone_pair* pair) {
  return answered([&] {
    const auto relation = given(pair, "pair").pair.relation();
    return relation ? int32_t(*relation) : int32_t{VERICONE_RELATION_UNKNOWN};
  });
}

int32_t vericone_pair_verdict(const vericone_pair* pair, const double agent_velocity[3],
                              const double obstacle_velocity[3]) {
  return answered([&] {
    return int32_t(given(pair, "pair")
                       .pair.verdict(vector(agent_velocity, "agent_velocity"),
                                     vector(obstacle_velocity, "obstacle_velocity")));
  });
}

int32_t vericone_pair_rung(const vericone_pair* pair, const double agent_velocity[3],
                           const double obstacle_velocity[3]) {
  return answered([&] {
    const auto rung = given(pair, "pair")
                          .pair.rung(vector(agent_velocity, "agent_velocity"),
                                     vector(obstacle_velocity, "obstacle_velocity"));
    return rung ? int32_t(*rung) : int32_t{VERICONE_CERTIFIED};
  });
}

int32_t vericone_pair_verdict_within(const vericone_pair* pair, const double agent_velocity[3],
                                     const double obstacle_velocity[3], double from, double until) {
  return answered([&] {
    return int32_t(given(pair, "pair")
                       .pair.verdict(vector(agent_velocity, "agent_velocity"),
                                     vector(obstacle_velocity, "obstacle_velocity"), Horizon{from, until}));
  });
}

int64_t vericone_pair_verdicts(const vericone_pair* pair, const double* agent_velocities, size_t count,
                               const double obstacle_velocity[3], uint8_t* verdicts) {
  return answered([&] {
    const Pair& asked = given(pair, "pair").pair;
    const Vector3d other = vector(obstacle_velocity, "obstacle_velocity");
    if (count > 0) given(agent_velocities, "agent_velocities");
    int64_t colliding = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Verdict verdict = asked.verdict(Vector3d(agent_velocities + 3 * i), other);
      colliding += may_collide(verdict);
      if (verdicts) verdicts[i] = uint8_t(verdict);
    }
    return colliding;
  });
}

int32_t vericone_pair_contact(const vericone_pair* pair, const double agent_velocity[3],
                              const double obstacle_velocity[3], vericone_contact* contact) {
  return answered([&] {
    const auto found = given(pair, "pair")
                           .pair.contact(vector(agent_velocity, "agent_velocity"),
                                         vector(obstacle_velocity, "obstacle_velocity"));
    if (found && contact) {
      *contact = {found->earliest, found->latest, found->time, {}, {}};
      write(found->point, contact->point);
      write(found->normal, contact->normal);
    }
    return int32_t(found.has_value());
  });
}

int32_t vericone_pair_miss(const vericone_pair* pair, const double agent_velocity[3],
                           const double obstacle_velocity[3], vericone_miss* miss) {
  return answered([&] {
    const Miss found = given(pair, "pair")
                           .pair.miss(vector(agent_velocity, "agent_velocity"),
                                      vector(obstacle_velocity, "obstacle_velocity"));
    vericone_miss& to = given(miss, "miss");
    to = {found.least, found.most, found.depth, {}, found.time, found.distance};
    write(found.normal, to.normal);
    return int32_t{VERICONE_OK};
  });
}

int32_t vericone_pair_sector(const vericone_pair* pair, const double across[3], vericone_sector* sector) {
  return answered([&] {
    const auto found = given(pair, "pair").pair.sector(vector(across, "across"));
    if (found && sector) {
      *sector = {{},
                 {},
                 found->distance,
                 found->left.angle,
                 found->right.angle,
                 found->left.error,
                 found->right.error};
      write(found->line_of_sight, sector->line_of_sight);
      write(found->across, sector->across);
    }
    return int32_t(found.has_value());
  });
}

vericone_cone* vericone_cone_new(const vericone_pair* pair, double tolerance, double resolution,
                                 int32_t threads) {
  return answered([&] {
    ConeOptions options;
    if (tolerance != 0) options.tolerance = tolerance;
    if (resolution != 0) options.resolution = resolution;
    options.threads = threads;
    return new vericone_cone{given(pair, "pair").pair.cone(options)};
  });
}

void vericone_cone_free(vericone_cone* cone) { delete cone; }

int32_t vericone_cone_contains(const vericone_cone* cone, const double w[3]) {
  return answered([&] { return int32_t(given(cone, "cone").cone.contains(vector(w, "w"))); });
}

int32_t vericone_cone_solid_angle(const vericone_cone* cone, double* least, double* most) {
  return answered([&] {
    const Interval angle = given(cone, "cone").cone.solid_angle;
    if (least) *least = angle.lo();
    if (most) *most = angle.hi();
    return int32_t{VERICONE_OK};
  });
}

int64_t vericone_cone_loops(const vericone_cone* cone, int32_t which) {
  return answered([&] { return int64_t(loops_of(cone, which).size()); });
}

int64_t vericone_cone_loop(const vericone_cone* cone, int32_t which, size_t index, double* directions,
                           size_t capacity) {
  return answered([&] {
    const auto& loops = loops_of(cone, which);
    if (index >= loops.size())
      throw InputError("index", std::to_string(index),
                       "below the number of loops, " + std::to_string(loops.size()));
    const DirectionLoop& loop = loops[index];
    if (capacity > 0) given(directions, "directions");
    for (std::size_t i = 0; i < std::min(capacity, loop.size()); ++i) write(loop[i], directions + 3 * i);
    return int64_t(loop.size());
  });
}

}  // extern "C"
