// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/predicates/campaign.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "predicates/subjects.h"

namespace vericone::verify {
namespace {

std::vector<Subject> all_subjects() {
  std::vector<Subject> all;
  for (const auto subjects : {pair_subjects(), hull_subjects(), horizon_subjects(), orifice_subjects(),
                              order_subjects(), side_subjects()})
    all.insert(all.end(), subjects.begin(), subjects.end());
  return all;
}

Subject subject_named(const std::string& name) {
  for (const Subject& s : all_subjects())
    if (name == s.name) return s;
  throw std::invalid_argument("no predicate \"" + name + "\"");
}

/// Neighbouring blocks that one thread takes at a time.
constexpr std::uint64_t kChunk = 32;

/// Spread over the kinds of cases, which follow one another: not every n-th block but every n-th of each run
/// of kinds.
bool one_in(std::uint64_t every, std::uint64_t block) {
  // A fixed scramble of the number, the finaliser of MurmurHash3.
  if (every == 0) return false;
  std::uint64_t x = block + 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
  return (x ^ (x >> 33)) % every == 0;
}

struct Tally {
  PredicateReport r;
  double nanoseconds = 0, random_nanoseconds = 0;

  void add(const Subject& subject, const PredicateOptions& options, std::uint64_t number, Depth depth,
           Block& block) {
    nanoseconds += block.nanoseconds;
    random_nanoseconds += block.random_nanoseconds;
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& c = block.cases[i];
      if (options.distort) {
        c.ladder = options.distort(c.rung, c.ladder);
        if (c.triage >= 0) c.triage = options.distort(Rung::triage, c.triage);
        if (c.interval >= 0) c.interval = options.distort(Rung::interval, c.interval);
        if (c.exact >= 0) c.exact = options.distort(Rung::exact, c.exact);
      }
      ++r.cases;
      r.degenerate += subject.degenerate(c.truth >= 0 ? c.truth : c.ladder);
      r.compared_with_exact += depth.exact;
      r.checked_against_cgal += c.truth >= 0;
      (c.rung == Rung::triage ? r.triage : c.rung == Rung::interval ? r.interval : r.exact) += 1;
      if (c.random) {
        ++r.random_cases;
        r.random_triage += c.rung == Rung::triage;
        r.random_interval += c.rung == Rung::interval;
      }
      // All that answered must agree; the oracle decides where it was asked.
      const int right = c.truth >= 0 ? c.truth : c.exact >= 0 ? c.exact : c.ladder;
      bool wrong = c.ladder != right;
      for (const int answer : {c.triage, c.interval, c.exact}) wrong |= answer >= 0 && answer != right;
      if (wrong) {
        ++r.wrong;
        const std::uint64_t index = number * kCasesPerBlock + static_cast<std::uint64_t>(i);
        if (!r.first_wrong || index < *r.first_wrong) r.first_wrong = index;
      }
      if (c.naive >= 0) {
        ++r.naive_asked;
        r.naive_wrong += c.naive != right;
      }
    }
  }

  void add(const Tally& other) {
    const PredicateReport& o = other.r;
    if (o.first_wrong && (!r.first_wrong || *o.first_wrong < *r.first_wrong)) r.first_wrong = o.first_wrong;
    r.cases += o.cases, r.degenerate += o.degenerate, r.compared_with_exact += o.compared_with_exact;
    r.checked_against_cgal += o.checked_against_cgal, r.wrong += o.wrong;
    r.naive_asked += o.naive_asked, r.naive_wrong += o.naive_wrong;
    r.triage += o.triage, r.interval += o.interval, r.exact += o.exact;
    r.random_cases += o.random_cases, r.random_triage += o.random_triage;
    r.random_interval += o.random_interval;
    nanoseconds += other.nanoseconds, random_nanoseconds += other.random_nanoseconds;
  }
};

PredicateReport run(const Subject& subject, const PredicateOptions& options) {
  const std::uint64_t blocks = (options.cases + kCasesPerBlock - 1) / kCasesPerBlock;
  const unsigned threads =
      options.threads ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  std::atomic<std::uint64_t> next = 0;
  std::atomic<bool> stopped = false;
  std::mutex mutex;
  Tally total;
  std::uint64_t done = 0;
  std::exception_ptr failure;

  const auto work = [&] {
    try {
      Tally mine;
      while (!stopped) {
        const std::uint64_t first = next.fetch_add(kChunk);
        if (first >= blocks) break;
        const std::uint64_t last = std::min(first + kChunk, blocks);
        std::uint64_t number = first;
        for (; number < last && !(options.stop && options.stop()); ++number) {
          Block block;
          const Depth depth{one_in(options.exact_every, number), one_in(options.truth_every, number)};
          subject.run(options.seed, number, depth, block);
          mine.add(subject, options, number, depth, block);
        }
        if (number < last) stopped = true;
        if (options.progress) {
          const std::lock_guard lock(mutex);
          done += (number - first) * kCasesPerBlock;
          options.progress(subject.name, done, blocks * kCasesPerBlock);
        }
      }
      const std::lock_guard lock(mutex);
      total.add(mine);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      stopped = true;
    }
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& t : others) t.join();
  if (failure) std::rethrow_exception(failure);

  PredicateReport r = total.r;
  r.predicate = subject.name;
  r.seed = options.seed;
  if (r.cases) r.nanoseconds = total.nanoseconds / static_cast<double>(r.cases);
  if (r.random_cases) r.random_nanoseconds = total.random_nanoseconds / static_cast<double>(r.random_cases);
  return r;
}

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}
using Count = unsigned long long;

}  // namespace

std::vector<std::string> predicate_names() {
  std::vector<std::string> names;
  for (const Subject& s : all_subjects()) names.emplace_back(s.name);
  return names;
}

PredicateReport run_predicate(const std::string& predicate, const PredicateOptions& options) {
  return run(subject_named(predicate), options);
}

std::vector<PredicateReport> run_predicate_campaign(const PredicateOptions& options) {
  std::vector<PredicateReport> reports;
  for (const Subject& s : all_subjects()) {
    if (options.stop && options.stop()) break;
    reports.push_back(run(s, options));
  }
  return reports;
}

PredicateCase replay_predicate(const std::string& predicate, std::uint64_t seed, std::uint64_t index) {
  Block block;
  subject_named(predicate).run(seed, index / kCasesPerBlock, {true, true}, block);
  return block.cases[index % kCasesPerBlock];
}

std::string to_markdown(std::span<const PredicateReport> reports) {
  std::string text =
      "| predicate | cases | degenerate | all rungs asked | against CGAL | wrong | naive wrong | triage | "
      "interval | exact | ns | random: triage | ns "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const PredicateReport& r : reports) {
    text +=
        format("| %s | %llu | %llu | %llu | %llu | %llu", r.predicate.c_str(), static_cast<Count>(r.cases),
               static_cast<Count>(r.degenerate), static_cast<Count>(r.compared_with_exact),
               static_cast<Count>(r.checked_against_cgal), static_cast<Count>(r.wrong));
    if (r.first_wrong) text += format(" (#%llu)", static_cast<Count>(*r.first_wrong));
    text += r.naive_asked ? format(" | %.3g %%", 100 * share(r.naive_wrong, r.naive_asked)) : " | -";
    text += format(" | %.2f %% | %.2f %% | %.2f %% | %.0f", 100 * share(r.triage, r.cases),
                   100 * share(r.interval, r.cases), 100 * share(r.exact, r.cases), r.nanoseconds);
    text += r.random_cases ? format(" | %.3f %% | %.0f |\n", 100 * share(r.random_triage, r.random_cases),
                                    r.random_nanoseconds)
                           : std::string(" | - | - |\n");
  }
  return text;
}

std::string to_json(std::span<const PredicateReport> reports) {
  std::string text = "[";
  for (const PredicateReport& r : reports) {
    text += text.size() > 1 ? ",\n " : "\n ";
    text += format(
        "{\"predicate\": \"%s\", \"seed\": %llu, \"cases\": %llu, \"degenerate\": %llu, "
        "\"compared_with_exact\": %llu, \"checked_against_cgal\": %llu, \"wrong\": %llu, ",
        r.predicate.c_str(), static_cast<Count>(r.seed), static_cast<Count>(r.cases),
        static_cast<Count>(r.degenerate), static_cast<Count>(r.compared_with_exact),
        static_cast<Count>(r.checked_against_cgal), static_cast<Count>(r.wrong));
    if (r.first_wrong) text += format("\"first_wrong\": %llu, ", static_cast<Count>(*r.first_wrong));
    text += r.naive_asked ? format("\"naive_wrong\": %llu, ", static_cast<Count>(r.naive_wrong))
                          : "\"naive_wrong\": null, ";
    text += format("\"triage\": %.9g, \"interval\": %.9g, \"exact\": %.9g, ", share(r.triage, r.cases),
                   share(r.interval, r.cases), share(r.exact, r.cases));
    text += r.random_cases ? format("\"random_triage\": %.9g, ", share(r.random_triage, r.random_cases))
                           : "\"random_triage\": null, ";
    text += format("\"nanoseconds\": %.4g, ", r.nanoseconds);
    text += r.random_cases ? format("\"random_nanoseconds\": %.4g}", r.random_nanoseconds)
                           : "\"random_nanoseconds\": null}";
  }
  return text + (reports.empty() ? "]" : "\n]");
}

}  // namespace vericone::verify
