// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/times/order.h>

#include "times/contact_time_exact.h"
#include "times/contact_time_search.h"

namespace vericone {
namespace {

// Spreads of the bounds of a time: where the first rung decides it is by far more.
constexpr double kTriageSpread = 1e-6, kTriageWidest = 1e-5, kLeastSpread = 0x1p-50, kWidest = 0.1;

ContactTimeSearch search_for(const Encounter& encounter) {
  return {encounter.a, encounter.b, {encounter.w(0), encounter.w(1), encounter.w(2)}};
}

std::optional<Sign> order_of(const std::optional<ContactTimeBounds>& p,
                             const std::optional<ContactTimeBounds>& q) {
  if (!p || !q) return std::nullopt;
  if (p->when != q->when) return p->when < q->when ? Sign::negative : Sign::positive;
  if (p->when != ContactTimeBounds::When::later) return Sign::zero;
  if (p->hi < q->lo) return Sign::negative;
  if (q->hi < p->lo) return Sign::positive;
  return std::nullopt;
}

std::optional<Sign> triage(const ContactTimeSearch& p, const ContactTimeSearch& q) {
  return order_of(p.bounds(kTriageSpread, kTriageWidest), q.bounds(kTriageSpread, kTriageWidest));
}

std::optional<Sign> interval(const ContactTimeSearch& p, const ContactTimeSearch& q) {
  return order_of(p.bounds(kLeastSpread, kWidest), q.bounds(kLeastSpread, kWidest));
}

void require_finite(const Encounter& encounter, const char* field) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(encounter.w(i)))
      throw InputError(std::string(field) + ".w[" + std::to_string(i) + "]", to_text(encounter.w(i)),
                       "a finite number (m/s)");
}

}  // namespace

std::optional<Sign> triage_earlier(const Encounter& p, const Encounter& q) noexcept {
  return triage(search_for(p), search_for(q));
}

std::optional<Sign> interval_earlier(const Encounter& p, const Encounter& q) noexcept {
  return interval(search_for(p), search_for(q));
}

Sign exact_earlier(const Encounter& p, const Encounter& q) {
  require_finite(p, "p");
  require_finite(q, "q");
  const auto time = [](const Encounter& encounter) {
    return exact::ContactTime(ConeOracle(encounter.a, encounter.b), encounter.w, Eigen::Vector3d::Zero());
  };
  exact::ContactTime of_p = time(p), of_q = time(q);
  return static_cast<Sign>(compare(of_p, of_q));
}

Sign earlier(const Encounter& p, const Encounter& q, Rung* rung) {
  const ContactTimeSearch search_p = search_for(p), search_q = search_for(q);
  return climb<EarlierContact>(
      rung, [&] { return triage(search_p, search_q); }, [&] { return interval(search_p, search_q); },
      [&] { return exact_earlier(p, q); });
}

}  // namespace vericone
