// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/bands.h>
#include <vericone/guidance/barrier.h>
#include <vericone/guidance/navigator.h>
#include <cmath>
#include <string>
#include <vector>

#include "common.h"

using namespace vericone;
using namespace vericone::c;

struct vericone_navigator {
  guidance::Navigator navigator;
  guidance::BodyState agent;
  std::vector<guidance::BodyState> others;  // kept, so that a step allocates nothing
};

namespace {

/// Into a state that has one of the kind already, so that nothing is allocated.
void place(const vericone_moving& moving, guidance::BodyState& state) {
  const Pose pose{Vector3d(moving.position), rotation_in(moving.rotation)};
  state.shape = Placed(given(moving.body, "body").body, pose);
  state.position = pose.position;
  state.velocity = Vector3d(moving.velocity);
  state.omega = Vector3d(moving.omega);
}

/// Where it is now, of one that does not turn.
guidance::Intruder straight(const vericone_moving& moving, const std::string& name) {
  const Vector3d omega(moving.omega);
  for (int i = 0; i < 3; ++i)
    if (omega(i) != 0)
      throw InputError(name + ".omega[" + std::to_string(i) + "]", to_text(omega(i)), "0: nothing turns");
  return {Placed(given(moving.body, (name + ".body").c_str()).body,
                 {Vector3d(moving.position), rotation_in(moving.rotation)}),
          Vector3d(moving.velocity)};
}

std::vector<guidance::Intruder> intruders_of(const vericone_moving* others, std::size_t count) {
  if (count > 0) given(others, "others");
  std::vector<guidance::Intruder> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    all.push_back(straight(others[i], "others[" + std::to_string(i) + "]"));
  return all;
}

guidance::Range range(const double (&ends)[2]) { return {ends[0], ends[1]}; }

void write(const std::vector<guidance::Range>& ranges, vericone_range* to, std::size_t capacity,
           const char* name) {
  if (capacity > 0) given(to, name);
  for (std::size_t i = 0; i < std::min(capacity, ranges.size()); ++i) to[i] = {ranges[i].from, ranges[i].to};
}

void write(const guidance::Band& band, vericone_band* to) {
  if (!to) return;
  write(band.free, to->free, to->free_capacity, "free");
  write(band.conflict, to->conflict, to->conflict_capacity, "conflict");
  to->free_count = band.free.size();
  to->conflict_count = band.conflict.size();
  to->last = band.last;
}

guidance::BandOptions options_of(const vericone_band_options& given) {
  guidance::BandOptions options;
  options.horizon = {given.from, given.until};
  options.margin = given.margin;
  options.wind = Vector3d(given.wind);
  options.speed = range(given.speed);
  options.climb = range(given.climb);
  options.altitude = range(given.altitude);
  options.lateral = given.lateral;
  options.longitudinal = given.longitudinal;
  options.vertical = given.vertical;
  options.last = given.last != 0;
  return options;
}

guidance::AvoidOptions options_of(const vericone_avoid_options& given) {
  guidance::AvoidOptions options;
  options.until = given.until;
  options.margin = given.margin;
  options.wind = Vector3d(given.wind);
  options.speed = range(given.speed);
  options.climb = range(given.climb);
  options.lateral = given.lateral;
  options.longitudinal = given.longitudinal;
  options.gap = given.gap;
  options.most = given.most;
  return options;
}

}  // namespace

extern "C" {

int32_t vericone_pair_barrier(const vericone_pair* pair, const double agent_velocity[3],
                              const double obstacle_velocity[3], double until, vericone_barrier* barrier) {
  return answered([&] {
    const guidance::Barrier found =
        guidance::barrier(given(pair, "pair").pair, vector(agent_velocity, "agent_velocity"),
                          vector(obstacle_velocity, "obstacle_velocity"), until);
    vericone_barrier& to = given(barrier, "barrier");
    to = {found.h, found.least, {}, {}, {}, found.time};
    write(found.by_position, to.by_position);
    write(found.by_velocity, to.by_velocity);
    write(found.by_rotation, to.by_rotation);
    return int32_t{VERICONE_OK};
  });
}

vericone_navigator* vericone_navigator_new(double required, double acceleration, int32_t longitudinal) {
  return answered([&] {
    guidance::NavigatorOptions options;
    if (!std::isnan(required)) options.required = required;
    options.most = acceleration;
    options.longitudinal = longitudinal != 0;
    return new vericone_navigator{guidance::Navigator(options), {}, {}};
  });
}

void vericone_navigator_free(vericone_navigator* navigator) { delete navigator; }

int32_t vericone_navigator_step(vericone_navigator* navigator, const vericone_moving* agent,
                                const vericone_moving* others, size_t count, const double destination[3],
                                double destination_acceleration, double time, double step,
                                vericone_command* command) {
  return answered([&] {
    vericone_navigator& own = given(navigator, "navigator");
    place(given(agent, "agent"), own.agent);
    if (count > 0) given(others, "others");
    own.others.resize(count);
    for (std::size_t i = 0; i < count; ++i) place(others[i], own.others[i]);
    std::optional<guidance::Destination> wanted;
    if (destination) wanted = {Vector3d(destination), destination_acceleration};
    const guidance::NavigatorStep found = own.navigator.step(own.agent, own.others, wanted, time, step);
    if (command) {
      *command = {{}, found.least, int64_t(found.nearest), int32_t(found.status), int32_t(found.aligned)};
      write(found.acceleration, command->acceleration);
    }
    return int32_t(found.status);
  });
}

int32_t vericone_band_defaults(vericone_band_options* options) {
  return answered([&] {
    vericone_band_options plain{};
    plain.until = std::numeric_limits<double>::infinity();
    given(options, "options") = plain;
    return int32_t{VERICONE_OK};
  });
}

int32_t vericone_bands(const vericone_moving* agent, const vericone_moving* others, size_t count,
                       const vericone_band_options* options, vericone_band* heading, vericone_band* speed,
                       vericone_band* climb, vericone_band* altitude, vericone_course* course) {
  return answered([&] {
    const guidance::Intruder own = straight(given(agent, "agent"), "agent");
    const guidance::Bands found = guidance::bands(own.body, own.velocity, intruders_of(others, count),
                                                  options_of(given(options, "options")));
    write(found.heading, heading);
    write(found.speed, speed);
    write(found.climb, climb);
    write(found.altitude, altitude);
    if (course)
      *course = {found.time_to_violation.value_or(std::numeric_limits<double>::infinity()),
                 found.recovery ? found.recovery->heading : kNan,
                 found.recovery ? found.recovery->time : kNan};
    return int32_t(found.time_to_violation.has_value());
  });
}

int32_t vericone_avoid_defaults(vericone_avoid_options* options) {
  return answered([&] {
    const guidance::AvoidOptions plain;
    given(options, "options") = {plain.until,
                                 plain.margin,
                                 {},
                                 {plain.speed.from, plain.speed.to},
                                 {plain.climb.from, plain.climb.to},
                                 plain.lateral,
                                 plain.longitudinal,
                                 plain.gap,
                                 plain.most};
    return int32_t{VERICONE_OK};
  });
}

int32_t vericone_avoid(const vericone_moving* agent, const double wanted[3], const vericone_moving* others,
                       size_t count, const vericone_avoid_options* options, vericone_avoidance* found) {
  return answered([&] {
    const guidance::Intruder own = straight(given(agent, "agent"), "agent");
    const guidance::Avoidance answer =
        guidance::avoid(own.body, own.velocity, vector(wanted, "wanted"), intruders_of(others, count),
                        options_of(given(options, "options")));
    if (found) {
      *found = {{},
                answer.distance,
                answer.lower,
                answer.safe_until,
                answer.latest,
                answer.first ? answer.first->time : kNan,
                answer.first ? int64_t(answer.first->obstacle) : int64_t{-1}};
      write(answer.velocity, found->velocity);
    }
    return int32_t(answer.status);
  });
}

}  // extern "C"
