// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/populations/population.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

namespace vericone::populations {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kChunk = 512;  // encounters drawn together: their columns stay in the cache

bool of_place(Quantity what) { return what < Quantity::vx; }
bool of_turn(Quantity what) { return what >= Quantity::yaw && what <= Quantity::roll; }
bool of_axes(Quantity what) { return what >= Quantity::a && what <= Quantity::c; }
/// Raised bodies stay so high that verdicts are those of the plane: their semi-axes are not drawn.
bool in_plane(Quantity what) {
  using enum Quantity;
  return what == x || what == y || what == yaw || what == vx || what == vy || what == speed || what == course;
}
bool of_polar(Quantity what) { return what >= Quantity::speed; }

/// v by its speed, course and climb.
Vector3d polar_of(const Vector3d& v) {
  const double speed = v.norm();
  return {speed, std::atan2(v.y(), v.x()), speed > 0 ? std::asin(v.z() / speed) : 0};
}

Vector3d velocity_of(const Vector3d& polar) {
  const double level = polar(0) * std::cos(polar(2));
  return {level * std::cos(polar(1)), level * std::sin(polar(1)), polar(0) * std::sin(polar(2))};
}

}  // namespace

const char* to_string(Quantity what) {
  constexpr std::array<const char*, kQuantities> kWords{
      "x", "y", "z", "yaw", "pitch", "roll", "a", "b", "c", "vx", "vy", "vz", "speed", "course", "climb"};
  return kWords[std::size_t(what)];
}

std::string name_of(const Variable& variable) {
  return std::string(variable.obstacle ? "obstacle." : "agent.") + to_string(variable.what);
}

bool Population::proposes() const {
  return std::any_of(variables.begin(), variables.end(), [](const Variable& v) { return bool(v.proposal); });
}

double Population::largest_weight() const {
  double largest = 1;
  if (strata)
    for (std::size_t k = 0; k < strata->count(); ++k)
      largest = k == 0 ? strata->weight(k) : std::max(largest, strata->weight(k));
  return proposes() ? largest / nominal_share : largest;
}

struct Sampler::Columns {
  std::vector<std::array<double, kChunk>> x;  // one a variable
  std::array<double, kChunk> weight;
  std::array<Vector3d, kChunk> agent, obstacle, w;  // m/s
  std::array<Membership, kChunk> membership;
  // While they are drawn.
  std::array<double, kChunk> u, other, log_ratio;
  std::array<bool, kChunk> from_nominal, uncovered;
};

Sampler::Sampler(Population population) : population_(std::move(population)) {
  const scenes::Scene& scene = population_.scene;
  bool places = false;
  for (const bool obstacle : {false, true}) {
    const scenes::SceneBody& body = obstacle ? scene.obstacle : scene.agent;
    if (const Ellipsoid* ellipsoid = body.ellipsoid()) {
      const Matrix3d& factor = ellipsoid->factor();
      const Vector3d axes = factor.colwise().norm();
      const bool by_axes = ellipsoid->defined_by_factor();
      ellipsoids_[obstacle] =
          Axes{ellipsoid->center(), by_axes ? axes : ellipsoid->semi_axes(),
               by_axes ? Matrix3d(factor * axes.cwiseInverse().asDiagonal()) : ellipsoid->axis_directions()};
      Matrix3d& rotation = ellipsoids_[obstacle]->rotation;
      if (rotation.determinant() < 0) rotation.col(2) *= -1;
    }
  }
  for (const Variable& variable : population_.variables) {
    places |= of_place(variable.what);
    polar_[variable.obstacle] |= of_polar(variable.what);
    if (scene.in_plane && !in_plane(variable.what))
      throw InputError("drawn." + name_of(variable), "given",
                       "left out: of bodies in the plane x, y, yaw, vx, vy, speed and course can be drawn");
    if (of_axes(variable.what) && !ellipsoids_[variable.obstacle])
      throw InputError("drawn." + name_of(variable), "given", "left out: only ellipsoids have semi-axes");
  }
  for (const Variable& variable : population_.variables)
    if (variable.what >= Quantity::vx && !of_polar(variable.what) && polar_[variable.obstacle])
      throw InputError("drawn." + name_of(variable), "given", "left out beside speed, course or climb");
  if (population_.velocities > 1 && !places)
    throw InputError("velocities", std::to_string(population_.velocities),
                     "1 where neither places nor bodies are drawn: every encounter has another velocity");
  if (population_.velocities > 1 && population_.weighted())
    throw InputError("velocities", std::to_string(population_.velocities), "1 beside a proposal");
  if (places) return;
  pair_ = scene.pair();
  if (ellipsoids_[0] && ellipsoids_[1])
    oracle_.emplace(*scene.agent.ellipsoid(), *scene.obstacle.ellipsoid());
}

/// Of encounters or, of velocities alone, of verdicts from `first` on. A variable's numbers do not depend on
/// what else is drawn with it.
void Sampler::draw(std::uint64_t seed, std::uint64_t first, std::size_t count, bool places, bool velocities,
                   Columns& to) const {
  const std::vector<Variable>& variables = population_.variables;
  const bool proposes = population_.proposes();
  const std::optional<Strata>& strata = population_.strata;
  const std::span<double> u(to.u.data(), count);
  // The variable's own uniform numbers, within the encounter's stratum.
  const auto fill = [&](std::size_t k) {
    engagements::Random::fill(seed, first, k, u);
    if (!strata || strata->variable != k) return;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t part = (first + i) % strata->count();
      const double low = strata->edges[part], high = strata->edges[part + 1];
      u[i] = std::min(low + (high - low) * u[i], 1 - 0x1p-53);
    }
  };
  to.x.resize(variables.size());
  if (proposes) {
    engagements::Random::fill(seed, first, variables.size(), u);
    for (std::size_t i = 0; i < count; ++i) to.from_nominal[i] = u[i] < population_.nominal_share;
    std::fill_n(to.log_ratio.begin(), count, 0.0);
  }
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const Variable& variable = variables[k];
    if (of_place(variable.what) ? !places : !velocities) continue;
    fill(k);
    double* const x = to.x[k].data();
    variable.nominal->quantiles(u, x);
    if (!variable.proposal) continue;
    variable.proposal->quantiles(u, to.other.data());
    for (std::size_t i = 0; i < count; ++i) {
      if (!to.from_nominal[i]) x[i] = to.other[i];
      to.log_ratio[i] += variable.nominal->log_density(x[i]) - variable.proposal->log_density(x[i]);
    }
  }
  for (const Correlated& group : population_.correlated) {
    const std::size_t n = group.variables.size();
    if (of_place(variables[group.variables[0]].what) ? !places : !velocities) continue;
    // The last row first: a row needs the scores of those before it.
    std::vector<std::array<double, kChunk>> scores(n);
    for (std::size_t k = 0; k < n; ++k) {
      fill(group.variables[k]);
      for (std::size_t i = 0; i < count; ++i) scores[k][i] = normal_quantile(u[i]);
    }
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < count; ++i) {
        double z = 0;
        for (std::size_t j = 0; j <= k; ++j) z += group.factor[k][j] * scores[j][i];
        to.x[group.variables[k]][i] = variables[group.variables[k]].nominal->from_normal(z);
      }
  }
  if (!population_.weighted()) {
    std::fill_n(to.weight.begin(), count, 1.0);
    std::fill_n(to.uncovered.begin(), count, false);
    return;
  }
  const double share = population_.nominal_share;
  for (std::size_t i = 0; i < count; ++i) {
    to.weight[i] = strata ? strata->weight((first + i) % strata->count()) : 1;
    to.uncovered[i] = false;
    if (!proposes) continue;
    // p / (share p + (1 - share) q), of densities p and q of which one may be 0.
    const double q_to_p = std::exp(-to.log_ratio[i]);
    to.uncovered[i] = (1 - share) * q_to_p < share;
    to.weight[i] *= q_to_p < kInfinite ? 1 / (share + (1 - share) * q_to_p) : 0;
  }
}

Placed Sampler::placed(bool obstacle, const Columns& drawn, std::size_t i) const {
  const scenes::SceneBody& body = obstacle ? population_.scene.obstacle : population_.scene.agent;
  Vector3d shift = Vector3d::Zero(), angles = Vector3d::Zero();
  std::optional<Axes> axes = ellipsoids_[obstacle];
  bool any = false, turned = false;
  for (std::size_t k = 0; k < population_.variables.size(); ++k) {
    const Variable& variable = population_.variables[k];
    if (variable.obstacle != obstacle || !of_place(variable.what)) continue;
    const double x = drawn.x[k][i];
    any = true;
    turned |= of_turn(variable.what);
    if (of_axes(variable.what))
      axes->semi_axes(std::size_t(variable.what) - std::size_t(Quantity::a)) = x;
    else if (of_turn(variable.what))
      angles(std::size_t(variable.what) - std::size_t(Quantity::yaw)) = x;
    else
      shift(std::size_t(variable.what)) = x;
  }
  if (!any) return body.placed;
  Matrix3d turn = Matrix3d::Identity();
  if (turned)
    turn = (Eigen::AngleAxisd(angles(0), Vector3d::UnitZ()) *
            Eigen::AngleAxisd(angles(1), Vector3d::UnitY()) * Eigen::AngleAxisd(angles(2), Vector3d::UnitX()))
               .toRotationMatrix();
  if (axes)
    return Body(
        Ellipsoid::from_axes(axes->center + shift, axes->semi_axes, orthonormal<3>(axes->rotation * turn)));
  const Pose& pose = body.placed.pose;
  if (!turned) return {body.placed.body, {pose.position + shift, pose.rotation}};
  const CombinedEllipsoid* quadric = body.quadric();
  const Vector3d centre = quadric ? quadric->center() : Vector3d::Zero();
  const Matrix3d rotation = orthonormal<3>(pose.rotation * turn);
  return {body.placed.body, {pose.to_world(centre) + shift - rotation * centre, rotation}};
}

void Sampler::fill_velocities(const Columns& drawn, std::size_t count, Columns& to) const {
  const std::vector<Variable>& variables = population_.variables;
  for (const bool obstacle : {false, true}) {
    const Vector3d& base = (obstacle ? population_.scene.obstacle : population_.scene.agent).velocity;
    std::array<Vector3d, kChunk>& v = obstacle ? to.obstacle : to.agent;
    const bool polar = polar_[obstacle];
    std::fill_n(v.begin(), count, polar ? polar_of(base) : base);
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const Quantity what = variables[k].what;
      if (variables[k].obstacle != obstacle || of_place(what)) continue;
      const double* x = drawn.x[k].data();
      const auto j = Eigen::Index(what) - Eigen::Index(polar ? Quantity::speed : Quantity::vx);
      for (std::size_t i = 0; i < count; ++i) v[i](j) = polar ? x[i] : base(j) + x[i];
    }
    if (polar)
      for (std::size_t i = 0; i < count; ++i) v[i] = velocity_of(v[i]);
  }
  for (std::size_t i = 0; i < count; ++i) to.w[i] = to.agent[i] - to.obstacle[i];
}

void Sampler::tally_fixed(std::uint64_t seed, std::uint64_t first, std::uint64_t count, Tally& to) const {
  const auto columns = std::make_unique<Columns>();
  const Horizon horizon{0, population_.within.value_or(0)};
  const bool whole = !population_.within;
  const bool apart = oracle_ && oracle_->relation() == Relation::disjoint;
  const bool plain = apart && whole && !population_.weighted();
  for (std::uint64_t done = 0; done < count; done += kChunk) {
    checkpoint();
    const auto n = std::size_t(std::min<std::uint64_t>(kChunk, count - done));
    draw(seed, first + done, n, true, true, *columns);
    fill_velocities(*columns, n, *columns);
    if (apart) oracle_->memberships({columns->w.data(), n}, {columns->membership.data(), n});
    const auto of = [&](Membership m) {
      return std::uint64_t(std::count(columns->membership.data(), columns->membership.data() + n, m));
    };
    if (plain && of(Membership::on) == 0) {
      const std::uint64_t in = of(Membership::in);
      to.in += in;
      to.weight += double(n);
      to.weight_squares += double(n);
      to.sure.add(1, in);
      to.possible.add(1, in);
      continue;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = columns->weight[i];
      to.weight += weight;
      to.weight_squares += weight * weight;
      if (apart && columns->membership[i] == Membership::out) continue;
      Verdict verdict = Verdict::in;
      if (!apart || columns->membership[i] == Membership::on || !whole)
        verdict = whole ? pair_->verdict(columns->agent[i], columns->obstacle[i])
                        : pair_->verdict(columns->agent[i], columns->obstacle[i], horizon);
      const bool in = verdict == Verdict::in || verdict == Verdict::overlapping;
      const bool undecided = verdict == Verdict::undecided;
      to.in += in;
      to.overlapping += verdict == Verdict::overlapping;
      to.on += verdict == Verdict::on || verdict == Verdict::touching;
      to.undecided += undecided;
      to.uncovered += in && columns->uncovered[i];
      if (in) to.sure.add(weight);
      if (in || undecided) to.possible.add(weight);
    }
  }
  to.verdicts += count;
}

void Sampler::tally_placed(std::uint64_t seed, std::uint64_t first, std::uint64_t count, Tally& to) const {
  const auto places = std::make_unique<Columns>(), velocities = std::make_unique<Columns>();
  const auto each = std::uint64_t(population_.velocities);
  for (std::uint64_t done = 0; done < count; done += kChunk) {
    const auto n = std::size_t(std::min<std::uint64_t>(kChunk, count - done));
    draw(seed, first + done, n, true, each == 1, *places);
    if (each == 1) fill_velocities(*places, n, *places);
    for (std::size_t p = 0; p < n; ++p) {
      if (p % 16 == 0) checkpoint();
      const Placed agent = placed(false, *places, p), obstacle = placed(true, *places, p);
      const Pair pair(agent, obstacle);
      std::uint64_t in = 0, undecided = 0;
      for (std::uint64_t j = 0; j < each; ++j) {
        const std::size_t i = each == 1 ? p : std::size_t(j % kChunk);
        if (each > 1 && i == 0) {
          // Other numbers than those of the places.
          const auto more = std::size_t(std::min<std::uint64_t>(kChunk, each - j));
          draw(~seed, (first + done + p) * each + j, more, false, true, *velocities);
          fill_velocities(*velocities, more, *velocities);
        }
        const Columns& from = each == 1 ? *places : *velocities;
        const Verdict verdict = population_.within
                                    ? pair.verdict(from.agent[i], from.obstacle[i], {0, *population_.within})
                                    : pair.verdict(from.agent[i], from.obstacle[i]);
        in += verdict == Verdict::in || verdict == Verdict::overlapping;
        undecided += verdict == Verdict::undecided;
        to.overlapping += verdict == Verdict::overlapping;
        to.on += verdict == Verdict::on || verdict == Verdict::touching;
      }
      const double weight = places->weight[p], share = weight / double(each);
      to.in += in;
      to.undecided += undecided;
      to.weight += weight;
      to.weight_squares += weight * weight;
      to.uncovered += in > 0 && places->uncovered[p];
      if (in > 0) to.sure.add(share * double(in));
      if (in + undecided > 0) to.possible.add(share * double(in + undecided));
    }
  }
  to.verdicts += count * each;
}

Tally Sampler::tally(std::uint64_t seed, std::uint64_t first, std::uint64_t count) const {
  Tally tally;
  tally.encounters = count;
  if (pair_)
    tally_fixed(seed, first, count, tally);
  else
    tally_placed(seed, first, count, tally);
  return tally;
}

Encounter Sampler::encounter(std::uint64_t seed, std::uint64_t index) const {
  const auto columns = std::make_unique<Columns>();
  draw(seed, index, 1, true, population_.velocities == 1, *columns);
  const double weight = columns->weight[0];
  Placed agent = placed(false, *columns, 0), obstacle = placed(true, *columns, 0);
  if (population_.velocities > 1)
    draw(~seed, index * std::uint64_t(population_.velocities), 1, false, true, *columns);
  fill_velocities(*columns, 1, *columns);
  return {std::move(agent), std::move(obstacle), columns->agent[0], columns->obstacle[0], weight};
}

}  // namespace vericone::populations
