// SPDX-License-Identifier: BSD-3-Clause
//
// JSON values of the commands. What does not depend on the types put in is compiled once, in json_value.cpp.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "json/json_forward.h"

extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace vericone {

Json numbers_json(std::span<const double> numbers);

/// A list of its coordinates.
template <typename Vector>
Json vector_json(const Eigen::MatrixBase<Vector>& v) {
  const typename Vector::PlainObject x = v;
  return numbers_json({x.data(), static_cast<std::size_t>(x.size())});
}

/// A list of its rows.
template <typename Matrix>
Json matrix_json(const Eigen::MatrixBase<Matrix>& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) rows.push_back(vector_json(m.row(i)));
  return rows;
}

/// Indented by one, and good JSON whatever bytes the names of files have.
std::string json_text(const Json& value);

/// JSON has no infinities and no NaN: null stands for them.
Json number_or_null(double x);
Json number_or_null(const std::optional<double>& x);

}  // namespace vericone
