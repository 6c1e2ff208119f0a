// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/combined/planar_campaign.h>

#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/verify/combined/planar_truth.h>
#include <vericone/internal/verify/seeded_random.h>

#include <cmath>
#include <numbers>

namespace vericone::verify {
namespace {

using Eigen::Vector2d;

constexpr std::uint32_t kDirections = 0x504d;
constexpr double kSourceTolerance = 1e-6;

Vector2d turned(const Vector2d& d, double angle) { return {d.x() - angle * d.y(), d.y() + angle * d.x()}; }

struct EdgeJudgement {
  bool inside_is_in, outside_is_out;
  bool right() const { return inside_is_in && outside_is_out; }
};

/// `side`: +1 for the counter-clockwise edge.
EdgeJudgement judge(const CombinedPlanarTruth& truth, const SectorEdge& edge, double side, double tolerance) {
  return {truth.contains(turned(edge.direction, -side * tolerance)),
          !truth.contains(turned(edge.direction, side * tolerance))};
}

void count_source(SourceCount& count, const Ellipse& a, const CombinedEllipse& b, TangentChoice choice,
                  const Sector& ours, const CombinedPlanarTruth& truth, std::uint64_t index) {
  ++count.asked;
  const std::optional<Sector> source = sector_by_source(a, b, choice);
  if (!source || source->relation != Relation::disjoint) {
    ++count.none;
    return;
  }
  const auto close = [](const Vector2d& x, const Vector2d& y) { return (x - y).norm() < kSourceTolerance; };
  if (close(source->left.direction, ours.left.direction) &&
      close(source->right.direction, ours.right.direction))
    return;
  const EdgeJudgement left = judge(truth, source->left, 1, kSourceTolerance),
                      right = judge(truth, source->right, -1, kSourceTolerance);
  if (left.right() && right.right()) return;
  if (count.wrong++ == 0) count.first_wrong = index;
  count.too_small += !left.outside_is_out || !right.outside_is_out;
}

}  // namespace

CombinedPlanarReport run_combined_planar(CombinedPlanarFamily family, std::uint64_t cases,
                                         std::uint64_t seed) {
  CombinedPlanarReport report;
  report.family = family;
  report.seed = seed;
  report.cases = cases;
  for (std::uint64_t index = 0; index < cases; ++index) {
    const auto [a, b] = combined_planar_pair(family, seed, index);
    const CombinedSector answer = combined_sector(a, b);
    const CombinedPlanarTruth truth(a, b);
    const std::optional<bool> disjoint = truth.disjoint();
    if (!disjoint) {
      ++report.undecided;
      continue;
    }
    bool wrong = *disjoint != (answer.sector.relation == Relation::disjoint);
    report.wrong_relation += wrong;
    report.disjoint += *disjoint;
    if (*disjoint && !wrong) {
      report.hulls_overlap += answer.hulls_overlap;
      // The narrower ones ask for exact numbers often.
      const bool narrow = index % CombinedPlanarReport::kNarrowEvery == 0;
      report.narrow += narrow;
      for (int i = 0; i < (narrow ? 3 : 1); ++i) {
        const double tolerance = CombinedPlanarReport::kTolerances[i];
        const bool off = !judge(truth, answer.sector.left, 1, tolerance).right() ||
                         !judge(truth, answer.sector.right, -1, tolerance).right();
        report.wrong_edge[i] += off;
        wrong = wrong || (i == 0 && off);
      }
      SeededRandom random(kDirections + static_cast<std::uint32_t>(family), seed, index);
      bool told_wrongly = false;
      for (int i = 0; i < 4; ++i) {
        const Vector2d w = random.direction<2>();
        const double off =
            std::abs(std::remainder(std::atan2(w.y(), w.x()) - answer.sector.theta_b, 2 * std::numbers::pi));
        told_wrongly = told_wrongly || (off < answer.sector.psi / 2) != truth.contains(w);
      }
      report.wrong_direction += told_wrongly;
      wrong = wrong || told_wrongly;
      if (a.is_ellipsoid() && b.delimiters().size() <= 1) {
        count_source(report.printed, a.ellipsoid(), b, TangentChoice::printed, answer.sector, truth, index);
        count_source(report.keep_both, a.ellipsoid(), b, TangentChoice::keep_both, answer.sector, truth,
                     index);
        count_source(report.by_sides, a.ellipsoid(), b, TangentChoice::by_sides, answer.sector, truth, index);
      }
    }
    if (wrong && report.wrong() == 1) report.first_wrong = index;
    report.exact_answers += truth.exact_answers();
  }
  return report;
}

std::string to_markdown(std::span<const CombinedPlanarReport> reports) {
  std::string text =
      "| family | seed | pairs | disjoint | hulls overlap | relation undecided | wrong relation | wrong edge "
      "1e-10 | wrong direction | asked narrowly | wrong edge 1e-12 | 1e-14 | exact numbers needed |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  const auto cell = [&](std::uint64_t x) { text += " " + std::to_string(x) + " |"; };
  for (const CombinedPlanarReport& r : reports) {
    text += std::string("| ") + name(r.family) + " |";
    for (const std::uint64_t x :
         {r.seed, r.cases, r.disjoint, r.hulls_overlap, r.undecided, r.wrong_relation, r.wrong_edge[0],
          r.wrong_direction, r.narrow, r.wrong_edge[1], r.wrong_edge[2], r.exact_answers})
      cell(x);
    text += "\n";
  }
  text +=
      "\n| family | asked | printed: none | wrong | too small | first | both kept: none | wrong | too small "
      "| "
      "first | by sides: none | wrong | too small | first |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const CombinedPlanarReport& r : reports) {
    if (r.printed.asked == 0) continue;
    text += std::string("| ") + name(r.family) + " |";
    cell(r.printed.asked);
    for (const SourceCount& s : {r.printed, r.keep_both, r.by_sides}) {
      cell(s.none);
      cell(s.wrong);
      cell(s.too_small);
      text += s.wrong ? " #" + std::to_string(s.first_wrong) + " |" : " |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace vericone::verify
