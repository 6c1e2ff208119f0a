// SPDX-License-Identifier: BSD-3-Clause
#include "vericone_c.h"

#include <vericone/cones/certificate.h>
#include <vericone/cones/cone.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/sound_arithmetic.h>
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/bands.h>
#include <vericone/guidance/barrier.h>
#include <vericone/guidance/navigator.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

struct vericone_body {
  vericone::Body body;
};
struct vericone_pair {
  vericone::Pair pair;
};
struct vericone_cone {
  vericone::Cone cone;
};
struct vericone_navigator {
  vericone::guidance::Navigator navigator;
  vericone::guidance::BodyState agent;
  std::vector<vericone::guidance::BodyState> others;  // kept, so that a step allocates nothing
};

namespace {

using namespace vericone;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
thread_local std::array<char, 512> said{};

int32_t failed(int32_t status, const char* text) noexcept {
  const std::size_t length = std::min(std::strlen(text), said.size() - 1);
  std::memcpy(said.data(), text, length);
  said[length] = '\0';
  return status;
}

/// What `make` returns; after an error NULL, the error's number, or NaN.
template <typename Make>
auto answered(Make make) noexcept -> decltype(make()) {
  using Result = decltype(make());
  int32_t status = VERICONE_FAILED;
  try {
    return make();
  } catch (const InputError& e) {
    status = failed(VERICONE_BAD_INPUT, e.what());
  } catch (const std::bad_alloc&) {
    status = failed(VERICONE_NO_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    failed(status, e.what());
  } catch (...) {
    failed(status, "unknown");
  }
  if constexpr (std::is_pointer_v<Result>)
    return nullptr;
  else if constexpr (std::is_floating_point_v<Result>)
    return kNan;
  else
    return status;
}

/// *p; throws InputError naming `name` where there is nothing.
template <typename T>
T& given(T* p, const char* name) {
  if (!p) throw InputError(name, "NULL", "given");
  return *p;
}

Vector3d vector(const double* x, const char* name) { return Vector3d(&given(x, name)); }

Matrix3d rows(const double* rotation) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation);
}
Matrix3d rotation_of(const double* rotation) { return rotation ? rows(rotation) : Matrix3d::Identity(); }
/// All zero, as who names only some fields of a struct leaves it: not turned.
Matrix3d rotation_in(const double (&rotation)[9]) {
  return std::all_of(std::begin(rotation), std::end(rotation), [](double x) { return x == 0; })
             ? Matrix3d::Identity()
             : rows(rotation);
}

std::vector<Vector3d> points_of(const double* points, std::size_t count) {
  if (count > 0) given(points, "points");
  std::vector<Vector3d> list;
  list.reserve(count);
  for (std::size_t i = 0; i < count; ++i) list.emplace_back(points + 3 * i);
  return list;
}

void write(const Vector3d& x, double* to) {
  if (to) std::copy_n(x.data(), 3, to);
}
void write(const std::optional<Vector3d>& x, double* to) { write(x.value_or(Vector3d::Constant(kNan)), to); }

vericone_body* body_of(Body body) { return new vericone_body{std::move(body)}; }

Ellipsoid ellipsoid(const double* center, const double* semi_axes, const double* rotation) {
  return Ellipsoid::from_axes(vector(center, "center"), vector(semi_axes, "semi_axes"),
                              rotation_of(rotation));
}

Placed placed(const vericone_body* body, const double* position, const double* rotation, const char* name) {
  return {given(body, name).body, {vector(position, "position"), rotation_of(rotation)}};
}

Body union_of(const vericone_body* const* bodies, std::size_t count) {
  if (count > 0) given(bodies, "bodies");
  std::vector<CombinedEllipsoid> quadrics;
  std::vector<HullBody> hulls;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "bodies[" + std::to_string(i) + "]";
    const Body& body = given(bodies[i], name.c_str()).body;
    if (const auto* one = body.quadric())
      quadrics.push_back(*one);
    else if (const auto* hull = body.hull())
      hulls.push_back(*hull);
    else
      throw InputError(name, to_string(body.kind()), "an ellipsoid, a combined body or a hull");
    if (!quadrics.empty() && !hulls.empty())
      throw InputError(name, to_string(body.kind()),
                       "of the kind of those before it: ellipsoids and combined bodies, or hulls");
  }
  return hulls.empty() ? Body::pieces(std::move(quadrics)) : Body(Assembly::polyhedra(std::move(hulls)));
}

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

const std::vector<DirectionLoop>& loops_of(const vericone_cone* cone, int32_t which) {
  const Cone& all = given(cone, "cone").cone;
  if (which != 0 && which != 1)
    throw InputError("which", std::to_string(which), "0, the inner cone, or 1, the outer one");
  return which == 0 ? all.inner : all.outer;
}

}  // namespace

extern "C" {

const char* vericone_error(void) { return said.data(); }
const char* vericone_version(void) { return VERICONE_VERSION; }
int32_t vericone_sound_arithmetic(void) {
  return answered([] {
    require_sound_arithmetic();
    return int32_t{VERICONE_OK};
  });
}

vericone_body* vericone_body_ellipsoid(const double center[3], const double semi_axes[3],
                                       const double rotation[9]) {
  return answered([&] { return body_of(ellipsoid(center, semi_axes, rotation)); });
}

vericone_body* vericone_body_combined(const double center[3], const double semi_axes[3],
                                      const double rotation[9], const vericone_hyperboloid* hyperboloids,
                                      size_t count) {
  return answered([&] {
    const Ellipsoid whole = ellipsoid(center, semi_axes, rotation);
    if (count > 0) given(hyperboloids, "hyperboloids");
    std::vector<Delimiter<3>> delimiters;
    for (std::size_t i = 0; i < count; ++i) {
      const vericone_hyperboloid& one = hyperboloids[i];
      try {
        delimiters.push_back(hyperboloid(one.sheets, Vector3d(one.semi_axes),
                                         rotation_of(rotation) * rotation_in(one.rotation)));
      } catch (const InputError& e) {
        throw e.within("hyperboloids[" + std::to_string(i) + "]");
      }
    }
    return body_of(CombinedEllipsoid(whole, std::move(delimiters)));
  });
}

vericone_body* vericone_body_hull(const double* points, size_t count) {
  return answered([&] { return body_of(HullBody(points_of(points, count))); });
}

vericone_body* vericone_body_box(const double low[3], const double high[3]) {
  return answered([&] { return body_of(HullBody::box(vector(low, "low"), vector(high, "high"))); });
}

vericone_body* vericone_body_mesh(const double* points, size_t count, const uint32_t* triangles,
                                  size_t triangle_count) {
  return answered([&] {
    if (triangle_count > 0) given(triangles, "triangles");
    std::vector<Assembly::Triangle> list(triangle_count);
    for (std::size_t i = 0; i < triangle_count; ++i) std::copy_n(triangles + 3 * i, 3, list[i].data());
    return body_of(Assembly::mesh(points_of(points, count), std::move(list)));
  });
}

vericone_body* vericone_body_cloud(const double* points, size_t count, double radius) {
  return answered([&] { return body_of(Assembly::cloud(points_of(points, count), radius)); });
}

vericone_body* vericone_body_boxes(const double* boxes, size_t count) {
  return answered([&] {
    if (count > 0) given(boxes, "boxes");
    std::vector<Box> list;
    for (std::size_t i = 0; i < count; ++i)
      list.push_back({Vector3d(boxes + 6 * i), Vector3d(boxes + 6 * i + 3)});
    return body_of(Assembly::boxes(std::move(list)));
  });
}

vericone_body* vericone_body_union(const vericone_body* const* bodies, size_t count) {
  return answered([&] { return body_of(union_of(bodies, count)); });
}

void vericone_body_free(vericone_body* body) { delete body; }

int32_t vericone_body_kind(const vericone_body* body) {
  return answered([&] { return int32_t(given(body, "body").body.kind()); });
}

int32_t vericone_body_bounds(const vericone_body* body, double low[3], double high[3]) {
  return answered([&] {
    const Box box = given(body, "body").body.bounds();
    write(box.low, low);
    write(box.high, high);
    return int32_t{VERICONE_OK};
  });
}

double vericone_body_support(const vericone_body* body, const double n[3]) {
  return answered([&] { return given(body, "body").body.support(vector(n, "n")); });
}

int32_t vericone_body_containing_ellipsoid(const vericone_body* body, double center[3], double shape[9]) {
  return answered([&] {
    const Ellipsoid& around = given(body, "body").body.containing_ellipsoid();
    write(around.center(), center);
    if (shape) std::copy_n(around.shape().data(), 9, shape);  // symmetric
    return int32_t{VERICONE_OK};
  });
}

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

int64_t vericone_pair_certificate(const vericone_pair* pair, const double agent_velocity[3],
                                  const double obstacle_velocity[3], double from, double until, char* text,
                                  size_t capacity) {
  return answered([&] {
    const Certificate found =
        certificate(given(pair, "pair").pair, vector(agent_velocity, "agent_velocity"),
                    vector(obstacle_velocity, "obstacle_velocity"), Horizon{from, until});
    if (capacity > 0) given(text, "text");
    const std::string& told = found.text.empty() ? found.reason : found.text;
    if (capacity > 0) text[told.copy(text, capacity - 1)] = '\0';
    return int64_t(found.text.size());
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
