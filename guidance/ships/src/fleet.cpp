// SPDX-License-Identifier: BSD-3-Clause
#include "fleet.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "products.h"

namespace vericone::ships {

using Eigen::Vector2d;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Courses beside the one to the goal, degrees, to starboard negative; rule 8(b): large enough to be readily
// apparent. Speeds, times the one wished.
constexpr double kCourses[] = {0, -20, -30, -40, -50, -60, -75, -90, -120, 20, 30, 40, 50, 60};
constexpr double kSpeeds[] = {1, 0.6, 0.3};
constexpr double kAhead = 1852;    // m along the line to the goal that a ship aims at
constexpr double kToPort = 1.5;    // times the cost of the same turn to starboard
constexpr double kSlower = 1;      // rad, that a stop costs as much as
constexpr double kChanges = 0.15;  // rad a rad by which a course is not the one before
constexpr double kCloses = 1.5;    // rad, of a course that meets who is to give way
constexpr std::size_t kTried = 4;  // courses whose plans are proved
// Rule 17(b): who stands on acts when the other one, were she to put her rudder over to starboard after
// kNotice seconds, would not keep clear any more.
constexpr double kNotice = 90, kForesight = 900, kLook = 10;  // s
constexpr double kNear = 1.05;                                // times the domain, that who acts then keeps

Domain times(const Domain& domain, double factor) { return {factor * domain.half, factor * domain.center}; }

/// Whether one of both hulls is in the other's domain.
bool intrudes(const Ship& a, const State& at_a, const Ship& b, const State& at_b, double room) {
  const auto meet = [](const Ellipse& x, const Ellipse& y) {
    return sector_by_support(x, y).relation != Relation::disjoint;
  };
  return meet(times(a.domain, room).about(at_a.position, at_a.heading),
              hull_of(b.handling, at_b.position, at_b.heading)) ||
         meet(hull_of(a.handling, at_a.position, at_a.heading),
              times(b.domain, room).about(at_b.position, at_b.heading));
}

[[noreturn]] void refuse(const std::string& field, double value, const char* requirement) {
  throw InputError(field, to_text(value), requirement);
}

void check(const Ship& ship, const std::string& name) {
  const auto positive = [&](double value, const char* field, const char* what) {
    if (!(value > 0) || !std::isfinite(value)) refuse(name + field, value, what);
  };
  positive(ship.handling.length, ".handling.length", "a positive finite number (m)");
  positive(ship.handling.beam, ".handling.beam", "a positive finite number (m)");
  positive(ship.handling.radius, ".handling.radius", "a positive finite number (m)");
  positive(ship.handling.lag, ".handling.lag", "a positive finite number (m)");
  positive(ship.handling.faster, ".handling.faster", "a positive finite number (m/s^2)");
  if (!(ship.handling.slower >= 1e-4 && std::isfinite(ship.handling.slower)))
    refuse(name + ".handling.slower", ship.handling.slower, "at least 1e-4 (m/s^2)");
  positive(ship.domain.half.x(), ".domain.half[0]", "a positive finite number (m)");
  positive(ship.domain.half.y(), ".domain.half[1]", "a positive finite number (m)");
  positive(ship.wished, ".wished", "a positive finite number (m/s)");
  if (!(ship.speed >= 0) || !(ship.speed <= 50)) refuse(name + ".speed", ship.speed, "0 to 50 (m/s)");
  if (!std::isfinite(ship.heading)) refuse(name + ".heading", ship.heading, "a finite number (rad)");
  if (!(std::abs(ship.curvature) * ship.handling.radius <= 1))
    refuse(name + ".curvature", ship.curvature, "within that of the tightest turning circle (1/m)");
  for (const auto& [x, field] :
       {std::pair(ship.position, ".position"), {ship.goal, ".goal"}, {ship.domain.center, ".domain.center"}})
    if (!x.allFinite() || x.lpNorm<Eigen::Infinity>() > 1e6)
      throw InputError(name + field, to_text(x.x()) + ", " + to_text(x.y()), "within 1e6 m");
  if (ship.goal == ship.position) throw InputError(name + ".goal", "the position", "another place");
}

void check(const FleetOptions& options) {
  if (!(options.step >= 1 && options.step <= 20)) refuse("step", options.step, "1 to 20 (s)");
  if (!(options.horizon > 0) || !std::isfinite(options.horizon))
    refuse("horizon", options.horizon, "a positive finite number (s)");
  if (!(options.room >= 1 && options.room <= 10)) refuse("room", options.room, "1 to 10");
  if (!(options.current.norm() <= 10)) refuse("current", options.current.norm(), "at most 10 m/s");
}

}  // namespace

Fleet::Fleet(const std::vector<Ship>& ships, const FleetOptions& options) : ships_(ships), options_(options) {
  check(options);
  for (std::size_t i = 0; i < ships.size(); ++i) {
    const std::string name = "ships[" + std::to_string(i) + "]";
    check(ships[i], name);
    // What a piece of the way is known by (after(), its quintics) holds for half a radian.
    const double way = std::max(ships[i].speed, ships[i].wished) * std::max(options.step, kStopPiece);
    if (!(way <= 0.5 * ships[i].handling.radius))
      refuse(name + ".handling.radius", ships[i].handling.radius,
             ("at least " + to_text(2 * way) + " m: half a radian a step, and in 10 s").c_str());
    states_.push_back({ships[i].position, ships[i].heading, ships[i].speed, ships[i].curvature});
    starts_.push_back(ships[i].position);
    stops_.push_back(stop_from(ships[i].handling, states_[i]));
    chosen_.push_back(ships[i].heading);
  }
  pieces_.resize(ships.size());
  plans_.resize(ships.size());
  offers_.resize(ships.size());
  waited_.resize(ships.size());
  busy_.resize(ships.size());
  for (std::size_t i = 0; i < ships.size(); ++i)
    for (std::size_t j = i + 1; j < ships.size(); ++j) {
      PairOfShips pair;
      pair.a = i;
      pair.b = j;
      pair.at_start = closest_approach(states_[i].sighting(), states_[j].sighting());
      pair.nearest = (states_[j].position - states_[i].position).norm();
      pair.starts_as = classify(states_[i].sighting(), states_[j].sighting());
      pairs_.push_back(pair);
      watches_.emplace_back();
      if (!apart(i, stops_[i], j, stops_[j]))
        throw InputError("ships[" + std::to_string(j) + "]", "a start too near to another ship",
                         "one from which both can stop without a hull in the other's domain");
    }
}

std::size_t Fleet::pair_of(std::size_t i, std::size_t j) const {
  const std::size_t low = std::min(i, j), high = std::max(i, j), n = ships_.size();
  return low * n - low * (low + 1) / 2 + high - low - 1;
}

double Fleet::past_goal(std::size_t i) const {
  const Vector2d way = ships_[i].goal - starts_[i];
  return way.normalized().dot(ground(i) - ships_[i].goal);
}

State Fleet::on_course(std::size_t i, double heading, double speed) const {
  return {states_[i].position, heading, speed, 0};
}

Fleet::Course Fleet::base(std::size_t i) const {
  // Towards a place ahead on the line, over the ground: the heading that makes good that track.
  const Vector2d line = (ships_[i].goal - starts_[i]).normalized();
  const Vector2d aim = starts_[i] + (line.dot(ground(i) - starts_[i]) + kAhead) * line;
  const Vector2d track = (aim - ground(i)).normalized(), aside(-track.y(), track.x());
  const double set = std::clamp(-aside.dot(options_.current) / ships_[i].wished, -0.9, 0.9);
  return {std::atan2(track.y(), track.x()) + std::asin(set), ships_[i].wished, 0};
}

Passing Fleet::passing(std::size_t i, const State& mine, std::size_t j, const State& hers,
                       double horizon) const {
  const Vector2d c = hers.position - mine.position, w = mine.velocity() - hers.velocity();
  const double closing = c.dot(w);
  if (closing <= 0) return Passing::opens;
  const Ship& a = ships_[i];
  const Ship& b = ships_[j];
  const Sector sectors[] = {
      sector_by_support(times(a.domain, options_.room).about(mine.position, mine.heading),
                        hull_of(b.handling, hers.position, hers.heading)),
      sector_by_support(hull_of(a.handling, mine.position, mine.heading),
                        times(b.domain, options_.room).about(hers.position, hers.heading))};
  bool port = true, starboard = true;
  for (const Sector& sector : sectors) {
    if (sector.relation != Relation::disjoint) return Passing::meets;
    port = port && cross(sector.right.direction, w) < 0;
    starboard = starboard && cross(sector.left.direction, w) > 0;
  }
  if (port || starboard) return port ? Passing::port : Passing::starboard;
  const double near = c.norm() - options_.room * std::max(a.domain.reach(), b.domain.reach());
  return near > horizon * w.norm() ? Passing::opens : Passing::meets;
}

bool Fleet::obliged(std::size_t i) const {
  for (std::size_t j = 0; j < ships_.size(); ++j) {
    if (j == i) continue;
    const Watch& watch = watches_[pair_of(i, j)];
    if (watch.active && (share_of_effort(watch.role[i < j ? 0 : 1]) > 0 || watch.must_act)) return true;
  }
  return false;
}

void Fleet::watch(std::size_t number) {
  Watch& watch = watches_[number];
  PairOfShips& pair = pairs_[number];
  const std::size_t a = pair.a, b = pair.b;
  const State &at_a = states_[a], &at_b = states_[b];
  const bool risk = passing(a, at_a, b, at_b, options_.horizon) == Passing::meets;
  if (!watch.active) {
    if (!risk) return;
    watch.active = true;
    watch.must_act = false;
    watch.seen = {at_a, at_b};
    // Rule 13(d): who overtakes keeps clear until past and clear, whatever the bearing becomes.
    if (watch.role[0] != Encounter::overtaking && watch.role[0] != Encounter::overtaken)
      watch.role = {classify(at_a.sighting(), at_b.sighting()), classify(at_b.sighting(), at_a.sighting())};
    if (pair.seen < 0) {
      pair.seen = time_;
      pair.encounter = watch.role[0];
    }
    return;
  }
  const Vector2d c = at_b.position - at_a.position;
  const auto based = [&](std::size_t i) {
    const Course course = base(i);
    return on_course(i, course.heading, course.speed);
  };
  if (c.dot(at_a.velocity() - at_b.velocity()) <= 0 &&
      passing(a, based(a), b, at_b, options_.horizon) != Passing::meets &&
      passing(a, at_a, b, based(b), options_.horizon) != Passing::meets) {
    watch.active = false;
    watch.role = {Encounter::none, Encounter::none};
    return;
  }
  for (const int k : {0, 1}) {
    const std::size_t i = k == 0 ? a : b, j = k == 0 ? b : a;
    if (share_of_effort(watch.role[static_cast<std::size_t>(k)]) > 0) continue;
    if (!watch.must_act && risk && must_act(i, j)) watch.must_act = pair.stand_on_acted = true;
    if (!busy_[i])
      pair.stand_on_turned =
          std::max(pair.stand_on_turned,
                   std::abs(states_[i].heading - watch.seen[static_cast<std::size_t>(k)].heading));
  }
}

bool Fleet::must_act(std::size_t i, std::size_t j) const {
  const State mine = states_[i];
  State hers = states_[j];
  const Handling& handling = ships_[j].handling;
  const double over = hers.heading - 0.5 * std::numbers::pi;
  for (double t = 0; t < kForesight; t += kLook) {
    State me = mine;
    me.position += t * mine.velocity();
    if (intrudes(ships_[i], me, ships_[j], hers, options_.room)) return true;
    const Command command = t < kNotice ? Command{} : steer(handling, hers, over, hers.speed, kLook);
    hers = after(handling, {hers, command, kLook}, kLook);
  }
  return false;
}

bool Fleet::clears_by_sailing(std::size_t i, const Course& course, std::size_t j) const {
  State mine = states_[i], hers = states_[j];
  const Handling& handling = ships_[i].handling;
  for (double t = 0; t < kForesight; t += kLook) {
    if (intrudes(ships_[i], mine, ships_[j], hers, kNear)) return false;
    mine = after(handling, {mine, steer(handling, mine, course.heading, course.speed, kLook), kLook}, kLook);
    hers.position += kLook * hers.velocity();
  }
  return true;
}

std::optional<double> Fleet::judged(std::size_t i, const Course& course, bool strict) const {
  const State mine = on_course(i, course.heading, course.speed);
  double cost = course.cost;
  for (std::size_t j = 0; j < ships_.size(); ++j) {
    if (j == i) continue;
    const Watch& watch = watches_[pair_of(i, j)];
    const std::size_t k = i < j ? 0 : 1;
    const State& hers = states_[j];
    const Passing now = passing(i, mine, j, hers, options_.horizon);
    if (!watch.active) {
      if (now != Passing::meets) continue;
      // A course may not make a new encounter in which she is to keep out of the way.
      if (share_of_effort(classify(mine.sighting(), hers.sighting())) > 0) return std::nullopt;
      cost += kCloses;
      continue;
    }
    const Encounter role = watch.role[k];
    if (share_of_effort(role) > 0) {
      // As she goes now, and as she went when the risk was seen: who has turned may turn back.
      State before = hers;
      before.heading = watch.seen[1 - k].heading;
      before.speed = watch.seen[1 - k].speed;
      for (const Passing one : {now, passing(i, mine, j, before, options_.horizon)}) {
        if (one == Passing::meets) return std::nullopt;
        if (strict && role != Encounter::overtaking && one == Passing::starboard) return std::nullopt;
      }
    } else if (watch.must_act) {
      const double turn = std::remainder(course.heading - states_[i].heading, 2 * std::numbers::pi);
      const bool to_port = cross(states_[i].ahead(), hers.position - states_[i].position) > 0;
      if (strict && to_port && turn > kDegree) return std::nullopt;  // rule 17(c)
      if (!clears_by_sailing(i, course, j)) return std::nullopt;
    } else if (now == Passing::meets) {
      cost += kCloses;
    }
  }
  return cost;
}

std::vector<Fleet::Course> Fleet::courses(std::size_t i) const {
  const Course straight = base(i);
  std::vector<Course> all;
  for (const double speed : kSpeeds)
    for (const double degrees : kCourses) {
      Course course{straight.heading + degrees * kDegree, speed * straight.speed, 0};
      const double change = std::remainder(course.heading - chosen_[i], 2 * std::numbers::pi);
      course.cost = std::abs(degrees) * kDegree * (degrees > 0 ? kToPort : 1) + kSlower * (1 - speed) +
                    kChanges * std::abs(change);
      all.push_back(course);
    }
  std::stable_sort(all.begin(), all.end(), cheaper);
  return all;
}

bool Fleet::offer(std::size_t i, const Course& course) {
  const Command command = steer(ships_[i].handling, states_[i], course.heading, course.speed, options_.step);
  const Piece piece{states_[i], command, options_.step};
  // Far from all others the stop after it need not be known.
  plans_[i] = alone(i) ? std::vector<Piece>{piece} : plan_of(ships_[i].handling, piece);
  if (!clear_of_stops(i, plans_[i])) return false;
  offers_[i] = 1;
  chosen_[i] = course.heading;
  return true;
}

void Fleet::choose(std::size_t i) {
  offers_[i] = 0;
  const Course straight = base(i);
  const bool free = !ships_[i].gives_way || (!obliged(i) && judged(i, straight, true));
  if ((free && offer(i, straight)) || !ships_[i].gives_way) return;
  const std::vector<Course> all = courses(i);
  for (const bool strict : {true, false}) {
    std::vector<Course> found;
    double least = std::numeric_limits<double>::infinity();
    for (const bool rest : {false, true}) {
      // The cheapest first; the others only where its plan is not proved.
      for (const Course& course : all) {
        if ((course.cost >= least) != rest) continue;
        const std::optional<double> cost = judged(i, course, strict);
        if (!cost) continue;
        found.push_back({course.heading, course.speed, *cost});
        if (!rest) least = std::min(least, *cost);
      }
      std::stable_sort(found.begin(), found.end(), cheaper);
      for (std::size_t k = rest ? 1 : 0; k < std::min(found.size(), rest ? kTried : 1); ++k)
        if (offer(i, found[k])) return;
    }
    if (!found.empty()) return;
    if (strict) give_up_sides(i);
  }
}

void Fleet::give_up_sides(std::size_t i) {
  for (std::size_t j = 0; j < ships_.size(); ++j) {
    if (j == i) continue;
    const Watch& watch = watches_[pair_of(i, j)];
    if (watch.active && share_of_effort(watch.role[i < j ? 0 : 1]) > 0)
      pairs_[pair_of(i, j)].side_kept = false;
  }
}

bool Fleet::near(std::size_t i, std::size_t j) const {
  // What a step, the fastest that she can be after it, and the stop from there cover.
  const auto covered = [&](std::size_t k) {
    const Handling& handling = ships_[k].handling;
    const double fast = states_[k].speed + handling.faster * options_.step;
    return fast * options_.step + 0.5 * fast * fast / handling.slower + ships_[k].domain.reach() +
           std::max(handling.length, handling.beam);
  };
  return (states_[i].position - states_[j].position).norm() <= covered(i) + covered(j);
}

bool Fleet::alone(std::size_t i) const {
  for (std::size_t j = 0; j < ships_.size(); ++j)
    if (j != i && near(i, j)) return false;
  return true;
}

bool Fleet::apart(std::size_t i, const std::vector<Piece>& mine, std::size_t j,
                  const std::vector<Piece>& hers) const {
  if (!near(i, j)) return true;
  const Ship &a = ships_[i], &b = ships_[j];
  const double until = std::max(seconds_of(mine), seconds_of(hers));
  // The water's current carries both alike.
  const Vector2d none = Vector2d::Zero();
  return prove_domains(sailed(a, mine, none, 0, until), sailed(b, hers, none, 0, until), 0, until).verdict ==
         simulation::ProofVerdict::avoided;
}

bool Fleet::clear_of_stops(std::size_t i, const std::vector<Piece>& plan) const {
  for (std::size_t j = 0; j < ships_.size(); ++j)
    if (j != i && !apart(i, plan, j, stops_[j])) return false;
  return true;
}

bool Fleet::agreed(std::size_t i) const {
  for (std::size_t j = 0; j < ships_.size(); ++j) {
    const bool outranked = waited_[j] != waited_[i] ? waited_[j] > waited_[i] : j < i;
    if (j != i && offers_[j] && outranked && !apart(i, plans_[i], j, plans_[j])) return false;
  }
  return true;
}

void Fleet::step() {
  for (std::size_t k = 0; k < pairs_.size(); ++k) watch(k);
  for (std::size_t i = 0; i < ships_.size(); ++i) {
    if (obliged(i)) busy_[i] = 1;
    choose(i);
  }
  std::vector<std::uint8_t> sails(ships_.size());
  for (std::size_t i = 0; i < ships_.size(); ++i) sails[i] = offers_[i] && agreed(i);
  for (std::size_t i = 0; i < ships_.size(); ++i) {
    ++counts_.commands;
    waited_[i] = sails[i] ? 0 : waited_[i] + 1;
    if (!sails[i] && states_[i].speed > 0) ++counts_.fallbacks;
    // A step of the plan, or of the stop, which may end before.
    double left = options_.step;
    if (!sails[i] && stops_[i].empty()) stops_[i] = stop_from(ships_[i].handling, states_[i]);
    for (const Piece& piece : sails[i] ? plans_[i] : stops_[i]) {
      if (!(left > 1e-9)) break;
      Piece part = piece;
      part.seconds = std::min(left, piece.seconds);
      pieces_[i].push_back(part);
      states_[i] = after(ships_[i].handling, part, part.seconds);
      left -= part.seconds;
    }
    if (left > 1e-9) pieces_[i].push_back({states_[i], {0, 0}, left});
  }
  time_ += options_.step;
  for (std::size_t i = 0; i < ships_.size(); ++i)
    stops_[i] = alone(i) ? std::vector<Piece>{} : stop_from(ships_[i].handling, states_[i]);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    PairOfShips& pair = pairs_[k];
    const Vector2d c = states_[pair.b].position - states_[pair.a].position;
    if (c.norm() >= pair.nearest) continue;
    pair.nearest = c.norm();
    pair.risk_when_nearest = watches_[k].active;
    // With b to port a moves, seen from it, to the right of it.
    const Vector2d w = states_[pair.a].velocity() - states_[pair.b].velocity();
    pair.passed = cross(c, w) < 0 ? Side::port : Side::starboard;
  }
}

}  // namespace vericone::ships
