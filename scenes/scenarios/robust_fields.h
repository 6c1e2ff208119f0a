// SPDX-License-Identifier: BSD-3-Clause
//
// The fields of the robust law, of its cases and of scenarios. Its users link guidance.
#pragma once

#include <vericone/guidance/robust_law.h>

#include "input/fields.h"

namespace vericone::input {

/// A number that has to be there; `requirement` is said where it is not.
inline double required_number(const Json& value, const std::string& path, const char* field,
                              const char* requirement) {
  return read_number(require_field(value, path, field, requirement), join(path, field), "");
}

/// `nu` as printed, or the two ends of a.
inline void read_a(const Json& value, const std::string& path, guidance::RobustModel& model) {
  const std::string a = join(path, "a");
  if (value.contains("nu") == value.contains("a"))
    throw InputError(a, value.contains("a") ? "beside nu" : "nothing",
                     "given as nu (a between -nu and nu), or as a: [low, high]");
  if (value.contains("a")) {
    const Eigen::Vector2d ends = read_vector<2>(value["a"], a, ", the lower one first");
    model.a_low = ends(0);
    model.a_high = ends(1);
    return;
  }
  const double nu = required_number(value, path, "nu", "");
  if (!(nu > 0)) throw InputError(join(path, "nu"), quoted(value["nu"]), "a positive number");
  model.a_low = -nu;
  model.a_high = nu;
}

inline void read_b(const Json& value, const std::string& path, guidance::RobustModel& model) {
  model.b_high = required_number(value, path, "lambda", "the most of |b|, 1/m");
  model.b_low = value.contains("b_min") ? required_number(value, path, "b_min", "") : 0;
}

/// One of two words; nothing where the field is not there.
template <typename Choice>
Choice read_either(const Json& value, const std::string& path, const char* field, Choice otherwise,
                   const char* first, Choice one, const char* second, Choice two) {
  if (!value.contains(field)) return otherwise;
  if (value[field] == first) return one;
  if (value[field] == second) return two;
  throw InputError(join(path, field), quoted(value[field]),
                   std::string("\"") + first + "\" or \"" + second + "\"");
}

/// mu, Q, R, polytope (`otherwise` where it is not given) and bound.
inline guidance::RobustOptions read_robust_options(const Json& value, const std::string& path,
                                                   guidance::Polytope otherwise) {
  using guidance::Attenuation, guidance::Polytope;
  guidance::RobustOptions options;
  options.mu = required_number(value, path, "mu", "the bound of the influence of noise, s");
  options.state_weight = required_number(value, path, "Q", "the weight of z^2");
  options.input_weight = required_number(value, path, "R", "the weight of the correction squared");
  options.polytope = read_either(value, path, "polytope", otherwise, "printed", Polytope::printed,
                                 "containing", Polytope::containing);
  options.attenuation = read_either(value, path, "bound", Attenuation::printed, "sqrt(mu)",
                                    Attenuation::printed, "mu", Attenuation::stated);
  return options;
}

}  // namespace vericone::input
