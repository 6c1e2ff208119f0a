// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what the library costs beside the source's slices and beside FCL: every time of a
// table is taken in turn in each of several rounds, and the figures are medians over the rounds.
#include <benchmarks/accuracy.h>
#include <benchmarks/agreement.h>
#include <benchmarks/combined_pairs.h>
#include <benchmarks/items.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/internal/cones/combined/cone.h>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

namespace vericone::benchmarks {
namespace {

double median_ratio(const Item& over, const Item& under) {
  std::vector<double> ratios;
  for (std::size_t r = 0; r < over.times.size(); ++r) ratios.push_back(over.times[r] / under.times[r]);
  return median(ratios);
}

std::string nanoseconds(double t) {
  char text[32];
  if (t < 1e3)
    std::snprintf(text, sizeof text, "%.1f ns", t);
  else if (t < 1e6)
    std::snprintf(text, sizeof text, "%.1f us", t * 1e-3);
  else
    std::snprintf(text, sizeof text, "%.2f ms", t * 1e-6);
  return text;
}

void requirement(const char* what, bool met, double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  std::printf("| %s | %s | %s |\n", what, text, met ? "met" : "**not met**");
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

struct ConeFigures {
  double ratio_48, ratio_matched, worst_96, median_48;
};

ConeFigures cone_table(int rounds) {
  constexpr int kAccuracyPairs = 2000, kTimedPairs = 100;
  const std::vector<Engagement> pairs = engagements(kAccuracyPairs),
                                fewer(pairs.begin(), pairs.begin() + 200);
  const Accuracy accuracy(pairs), slice_accuracy(fewer);
  const Spread discretisation = slice_accuracy.slice_discretisation(360);
  const int matched = accuracy.fewest(discretisation.median, &Spread::median);

  std::vector<Item> items;
  std::vector<Spread> errors;
  for (const int planes : {12, 36, 360}) {
    items.push_back(
        item("slice_cone, " + std::to_string(planes) + " planes", kTimedPairs, 1,
             [&, planes](int i) { return slice_cone(pairs[i].a, pairs[i].b, planes).slices[0].left; }));
    errors.push_back(slice_accuracy.slice(planes));
  }
  const std::set<int> counts = {accuracy.fewest(1e-3, &Spread::median),
                                accuracy.fewest(1e-6, &Spread::median),
                                accuracy.fewest(1e-3, &Spread::worst),
                                accuracy.fewest(1e-6, &Spread::worst),
                                matched,
                                48,
                                96};
  std::map<int, std::size_t> row;
  for (const int samples : counts) {
    row[samples] = items.size();
    items.push_back(
        item("true_cone, " + std::to_string(samples) + " samples", kTimedPairs, 10,
             [&, samples](int i) { return true_cone(pairs[i].a, pairs[i].b, samples).solid_angle; }));
    errors.push_back(accuracy.exact(samples));
  }
  items.push_back(item("true_cone, 48 samples, and cone_bounds", kTimedPairs, 2, [&](int i) {
    return cone_bounds(true_cone(pairs[i].a, pairs[i].b, 48), pairs[i].a, pairs[i].b).solid_angle_error;
  }));
  errors.push_back(accuracy.exact(48));
  measure(items, rounds);

  std::printf("| cone | time | slice_cone(360) / this | section area off by: median | worst |\n");
  std::printf("| --- | --- | --- | --- | --- |\n");
  const auto ratio = [&](std::size_t k) { return median_ratio(items[2], items[k]); };
  for (std::size_t k = 0; k < items.size(); ++k)
    std::printf("| %s | %s | %.3g | %.1e | %.1e |\n", items[k].name.c_str(),
                nanoseconds(median(items[k].times)).c_str(), ratio(k), errors[k].median, errors[k].worst);
  std::printf(
      "\nOver %d pairs (slices: %zu), relative. slice_cone(360) is off by %.1e (median) from its own "
      "limit of many planes, which %d exact samples undercut; the rest of its error is what slices "
      "cannot see.\n",
      kAccuracyPairs, fewer.size(), discretisation.median, matched);
  return {ratio(row[48]), ratio(row[matched]), accuracy.exact(96).worst, accuracy.exact(48).median};
}

/// Slice cones of combined quadrics beside those of ellipsoids, and the certified cones. Returns the largest
/// ratio of the former.
double combined_table(int rounds) {
  constexpr int kSlicePairs = 100, kCertifiedPairs = 10, kPlanes = 36;
  struct Row {
    const char* name;
    Family a, b;
    std::vector<CombinedEngagement> pairs = {};
  };
  std::vector<Row> rows = {{"biconcave", Family::ellipsoid, Family::biconcave},
                           {"biconvex", Family::ellipsoid, Family::biconvex},
                           {"star", Family::ellipsoid, Family::star},
                           {"star and star", Family::star, Family::star}};
  const std::vector<Engagement> plain = engagements(kSlicePairs);
  std::vector<Item> items = {item("slice_cone of ellipsoids, 36 planes", kSlicePairs, 1, [&](int i) {
    return slice_cone(plain[i].a, plain[i].b, kPlanes).slices[0].left;
  })};
  for (Row& row : rows) row.pairs = combined_engagements(kSlicePairs, row.a, row.b);
  for (const Row& row : rows)
    items.push_back(
        item(std::string("combined_slice_cone, ") + row.name + ", 36 planes", kSlicePairs, 1, [&row](int i) {
          return combined_slice_cone(row.pairs[i].a, row.pairs[i].b, kPlanes).slices[0].left;
        }));
  const std::size_t slices = items.size();
  items.push_back(item("the same, biconcave, tangents chosen as in 6.3.2", kSlicePairs, 1, [&](int i) {
    const CombinedEngagement& e = rows[0].pairs[i];
    return combined_slice_cone(e.a, e.b, kPlanes, SliceSector::source_by_sides).slices[0].left;
  }));
  for (const Row& row : rows)
    items.push_back(item(std::string("CombinedOracle made, ") + row.name, kSlicePairs, 1, [&row](int i) {
      return CombinedOracle(row.pairs[i].a, row.pairs[i].b).relation() == Relation::disjoint;
    }));
  std::vector<std::vector<CombinedOracle>> oracles(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const CombinedEngagement& e : rows[k].pairs) oracles[k].emplace_back(e.a, e.b);
    items.push_back(
        item(std::string("its membership, ") + rows[k].name, kSlicePairs, 1,
             [&all = oracles[k], &row = rows[k]](int i) { return all[i].membership(row.pairs[i].w); }));
  }
  measure(items, rounds);
  std::vector<Item> certified;
  for (const Row& row : rows)
    certified.push_back(item(
        std::string("combined_cone to 0.01, ") + row.name, kCertifiedPairs, 1,
        [&row](int i) { return combined_cone(row.pairs[i].a, row.pairs[i].b, 0.01).solid_angle_error; }));
  for (Item& it : certified) it.times.push_back(it.round());

  double worst = 0;
  std::printf("| call | time | this / slice_cone of ellipsoids |\n| --- | --- | --- |\n");
  for (std::size_t k = 0; k < items.size(); ++k) {
    const double ratio = median_ratio(items[k], items[0]);
    if (k < slices) worst = std::max(worst, ratio);
    std::printf("| %s | %s | %.3g |\n", items[k].name.c_str(), nanoseconds(median(items[k].times)).c_str(),
                ratio);
  }
  for (const Item& it : certified)
    std::printf("| %s | %s | |\n", it.name.c_str(), nanoseconds(median(it.times)).c_str());
  std::printf(
      "\nThe ellipsoids of the first table, delimited as benchmarks/combined_pairs.h says; certified cones "
      "of %d "
      "pairs.\n",
      kCertifiedPairs);
  return worst;
}

struct MembershipFigures {
  double plain, ladder, triage, over_plain, least_ratio, passed;
};

MembershipFigures membership_table(int rounds) {
  constexpr int kPairs = 1000, kFew = 20, kRepeats = 200;
  const Prepared all(engagements(kPairs)), grazing(engagements(kPairs, 1e-4)),
      tangent(tangent_engagements(kPairs));
  struct Row {
    bool same_question;
    int count;
    std::function<bool(const Prepared&, int)> answer;
  };
  std::vector<Item> items;
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, bool same_question, int count, int repeats, auto answer) {
    items.push_back(item(name, count, repeats, [&all, answer](int i) { return answer(all, i); }));
    rows.push_back({same_question, count, answer});
  };
  const auto touches = [](Membership m) { return m != Membership::out; };
  const auto w = [](const Prepared& p, int i) -> const Eigen::Vector3d& { return p.engagements[i].w; };
  add("membership, all rungs", true, kPairs, kRepeats,
      [=](const Prepared& p, int i) { return touches(p.oracles[i].membership(w(p, i))); });
  add("first rung, proved bound", true, kPairs, kRepeats, [=](const Prepared& p, int i) {
    const auto answer = p.oracles[i].triage_membership(w(p, i));
    return answer ? touches(*answer)
                  : touches(p.oracles[i].exact_membership(w(p, i), Eigen::Vector3d::Zero()));
  });
  add("plain double, no bound", true, kPairs, kRepeats,
      [=](const Prepared& p, int i) { return touches(p.oracles[i].naive_membership(w(p, i))); });
  add("second rung, intervals", true, kPairs, kRepeats, [=](const Prepared& p, int i) {
    const auto answer = p.oracles[i].interval_membership(w(p, i), Eigen::Vector3d::Zero());
    return answer ? touches(*answer)
                  : touches(p.oracles[i].exact_membership(w(p, i), Eigen::Vector3d::Zero()));
  });
  add("one shot, pair prepared anew", true, kPairs, 1, [=](const Prepared& p, int i) {
    const Engagement& e = p.engagements[i];
    return touches(ConeOracle(e.a, e.b).membership(e.w));
  });
  add("exact rung", true, kPairs, 1, [=](const Prepared& p, int i) {
    return touches(p.oracles[i].exact_membership(w(p, i), Eigen::Vector3d::Zero()));
  });
  for (const int steps : {10, 100, 10000})
    add("FCL continuousCollide, CCDC_NAIVE, " + std::to_string(steps) + " times", true,
        steps < 1000 ? kPairs : kFew, 1, [steps](const Prepared& p, int i) { return p.fcl[i].naive(steps); });
  for (const auto& [name, solver] : {std::pair("libccd", FclSolver::libccd), {"indep", FclSolver::indep}}) {
    const std::string text = std::string(", GJK ") + name;
    add("FCL conservative advancement" + text, true, kPairs, 1,
        [solver = solver](const Prepared& p, int i) { return p.fcl[i].advancement(solver); });
    add("FCL continuousCollide, CCDC_CONSERVATIVE_ADVANCEMENT on polytopes" + text, true, kPairs, 1,
        [solver = solver](const Prepared& p, int i) { return p.fcl[i].polytope_advancement(solver); });
    add("FCL distance now" + text, false, kPairs, 1,
        [solver = solver](const Prepared& p, int i) { return p.fcl[i].distance(solver) > 0; });
    add("FCL collide now" + text, false, kPairs, 1,
        [solver = solver](const Prepared& p, int i) { return p.fcl[i].collide(solver); });
  }
  measure(items, rounds);

  const auto wrong = [&](const Row& row, const Prepared& set) -> std::string {
    if (!row.same_question) return "other question";
    const Wrong found = wrong_answers(set, row.count, [&](int i) { return row.answer(set, i); });
    return std::to_string(found.hits) + " + " + std::to_string(found.misses) + " of " +
           std::to_string(row.count);
  };
  std::printf(
      "| call | time | this / membership | wrong: false hits + misses | wrong, half aimed within 1e-4 | "
      "wrong, "
      "tangent within 8 ulps |\n");
  std::printf("| --- | --- | --- | --- | --- | --- |\n");
  int passed = 0;
  for (int i = 0; i < kPairs; ++i) passed += all.oracles[i].triage_membership(w(all, i)).has_value();
  MembershipFigures figures{median(items[2].times),
                            median(items[0].times),
                            median(items[1].times),
                            median_ratio(items[0], items[2]),
                            1e300,
                            100. * passed / kPairs};
  for (std::size_t k = 0; k < items.size(); ++k) {
    const double ratio = median_ratio(items[k], items[0]);
    std::printf("| %s | %s | %.3g | %s | %s | %s |\n", items[k].name.c_str(),
                nanoseconds(median(items[k].times)).c_str(), ratio, wrong(rows[k], all).c_str(),
                wrong(rows[k], grazing).c_str(), wrong(rows[k], tangent).c_str());
    if (k > 5 && rows[k].same_question) figures.least_ratio = std::min(figures.least_ratio, ratio);
  }
  const auto hits = [](const Prepared& p) { return std::count(p.touches.begin(), p.touches.end(), true); };
  std::printf(
      "\n%ld of the %d velocities touch; of those half aimed within 1e-4 rad of the boundary, %ld; of "
      "the tangent ones, on the boundary or within 8 units in the last place of it, %ld.\n",
      hits(all), kPairs, hits(grazing), hits(tangent));
  return figures;
}

/// Many velocities against one pair: anywhere, and every second one near its cone.
std::vector<Eigen::Vector3d> velocities_of(const Engagement& pair, std::size_t count) {
  const TrueCone cone = true_cone(pair.a, pair.b, 64);
  Dice dice(3);
  std::vector<Eigen::Vector3d> w(count);
  for (std::size_t i = 0; i < count; ++i) {
    const BoundarySample& s = cone.boundary[i / 2 % 64];
    w[i] = i % 2 == 0 ? dice.direction() : Eigen::Vector3d(s.direction + dice.uniform(-0.2, 0.2) * s.normal);
  }
  return w;
}

/// 10^6 velocities against one pair in one call. Returns nanoseconds a velocity by width of the registers, as
/// far as the machine has them.
std::map<VectorWidth, double> batch_table(int rounds) {
  constexpr std::size_t kVelocities = 1'000'000, kToOneExact = 100;
  const Engagement pair = engagements(1).front();
  const ConeOracle oracle(pair.a, pair.b);
  const std::vector<Eigen::Vector3d> w = velocities_of(pair, kVelocities);
  std::vector<Membership> truth(kVelocities), out(kVelocities);
  for (std::size_t i = 0; i < kVelocities; ++i)
    truth[i] = i % kToOneExact == 0 ? oracle.exact_membership(w[i], Eigen::Vector3d::Zero())
                                    : oracle.membership(w[i]);

  std::vector<Item> items;
  const auto add = [&](const std::string& name, auto answer) {
    items.push_back(item(name, 1, 1, [&out, answer](int) {
      answer();
      return out[0];
    }));
  };
  add("membership, one after the other", [&] {
    for (std::size_t i = 0; i < kVelocities; ++i) out[i] = oracle.membership(w[i]);
  });
  add("plain double, one after the other", [&] {
    for (std::size_t i = 0; i < kVelocities; ++i) out[i] = oracle.naive_membership(w[i]);
  });
  std::map<VectorWidth, std::size_t> row;
  for (const auto& [width, name] : {std::pair(VectorWidth::two, "plain x86-64"),
                                    {VectorWidth::four, "AVX2"},
                                    {VectorWidth::eight, "AVX-512"}}) {
    if (width > widest_vectors()) continue;
    row[width] = items.size();
    add(std::string("memberships in one call, ") + name,
        [&, at_most = width] { oracle.memberships(w, out, at_most); });
  }
  measure(items, rounds);

  std::printf("| 10^6 velocities against one pair | time of each | membership / this | wrong |\n");
  std::printf("| --- | --- | --- | --- |\n");
  for (const Item& it : items) {
    std::fill(out.begin(), out.end(), Membership::on);
    it.round();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < kVelocities; ++i) wrong += out[i] != truth[i];
    std::printf("| %s | %s | %.3g | %zu |\n", it.name.c_str(),
                nanoseconds(median(it.times) / kVelocities).c_str(), median_ratio(items[0], it), wrong);
  }
  std::map<VectorWidth, double> times;
  for (const auto& [width, k] : row) times[width] = median(items[k].times) / kVelocities;
  return times;
}

}  // namespace
}  // namespace vericone::benchmarks

int main(int argc, char** argv) {
  using namespace vericone::benchmarks;
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  std::printf("%s; %s %s, %s; FCL %s; %d rounds, time of the thread.\n\n", cpu_model().c_str(),
              VERICONE_COMPILER, VERICONE_BUILD_TYPE, VERICONE_FLAGS, fcl_version(), rounds);
  const ConeFigures cone = cone_table(rounds);
  std::printf("\n");
  const double combined = combined_table(rounds);
  std::printf("\n");
  const MembershipFigures membership = membership_table(rounds);
  std::printf("\n");
  const auto batch = batch_table(rounds);
  std::printf("\nFCL's table of conservative advancement %s a pair of ellipsoids.\n",
              fcl_ellipsoids_in_table() ? "has an entry for" : "has no entry for");
  std::printf("\n| requirement | measured | |\n| --- | --- | --- |\n");
  requirement("slice_cone(360) / true_cone(48) at least 50", cone.ratio_48 >= 50, cone.ratio_48, "%.3g");
  requirement("the same at slice_cone(360)'s own discretisation error", cone.ratio_matched >= 50,
              cone.ratio_matched, "%.3g");
  requirement("worst area error at 96 samples below 1e-6", cone.worst_96 < 1e-6, cone.worst_96, "%.1e");
  requirement("median area error at 48 samples below 1e-12", cone.median_48 < 1e-12, cone.median_48, "%.1e");
  requirement("slices of combined quadrics / slices of ellipsoids at most 5", combined <= 5, combined,
              "%.3g");
  requirement("membership in plain double below 40 ns", membership.plain < 40, membership.plain, "%.1f ns");
  requirement("exact membership, all rungs, below 40 ns", membership.ladder < 40, membership.ladder,
              "%.1f ns");
  requirement("the same at most 1.15 times plain double", membership.over_plain <= 1.15,
              membership.over_plain, "%.2f");
  requirement("the first rung decides at least 99.9 % of them", membership.passed >= 99.9, membership.passed,
              "%.1f %%");
  for (const auto& [width, name, most] :
       {std::tuple(vericone::VectorWidth::four, "10^6 velocities in one call below 8 ns each with AVX2", 8.0),
        {vericone::VectorWidth::eight, "the same below 5.5 ns with AVX-512", 5.5}})
    if (batch.contains(width)) requirement(name, batch.at(width) < most, batch.at(width), "%.1f ns");
  requirement("fastest FCL call for the same question / membership at least 15", membership.least_ratio >= 15,
              membership.least_ratio, "%.3g");
}
