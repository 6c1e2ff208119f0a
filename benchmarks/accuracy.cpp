// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/accuracy.h>
#include <vericone/cones/slices/slice_cone.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vericone::benchmarks {
namespace {

double slice_area(const Engagement& e, int planes) {
  return slice_cone(e.a, e.b, planes).polyhedral().cross_section_area;
}

}  // namespace

Spread::Spread(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  median = errors[errors.size() / 2];
  worst = errors.back();
}

Accuracy::Accuracy(const std::vector<Engagement>& pairs) : pairs_(pairs) {
  constexpr int kReference = 512;
  for (const Engagement& e : pairs) areas_.push_back(true_cone(e.a, e.b, kReference).cross_section_area);
}

const Spread& Accuracy::exact(int samples) const {
  if (const auto known = exact_.find(samples); known != exact_.end()) return known->second;
  std::vector<double> errors;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    errors.push_back(
        std::abs(true_cone(pairs_[i].a, pairs_[i].b, samples).cross_section_area / areas_[i] - 1));
  return exact_.emplace(samples, Spread(std::move(errors))).first->second;
}

Spread Accuracy::slice(int planes) const {
  std::vector<double> errors;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    errors.push_back(std::abs(slice_area(pairs_[i], planes) / areas_[i] - 1));
  return Spread(std::move(errors));
}

Spread Accuracy::slice_discretisation(int planes) const {
  std::vector<double> errors;
  for (const Engagement& e : pairs_) {
    const double coarse = slice_area(e, planes), fine = slice_area(e, 2 * planes);
    const double limit = fine + (fine - coarse) / 3;
    errors.push_back(std::abs(coarse / limit - 1));
  }
  return Spread(std::move(errors));
}

int Accuracy::fewest(double target, double Spread::*measure) const {
  int samples = 200;
  while (samples > 4 && exact(samples - 2).*measure < target) samples -= 2;
  return samples;
}

std::string label(const char* what, int count, const Spread& error) {
  char text[96];
  std::snprintf(text, sizeof text, "%s = %d, error %.1e (worst %.1e)", what, count, error.median,
                error.worst);
  return text;
}

}  // namespace vericone::benchmarks
