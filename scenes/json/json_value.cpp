// SPDX-License-Identifier: BSD-3-Clause
#include "json/json_value.h"

#include <cmath>

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace vericone {

Json numbers_json(std::span<const double> numbers) {
  Json list = Json::array();
  for (const double x : numbers) list.push_back(x);
  return list;
}

std::string json_text(const Json& value) { return value.dump(1, ' ', false, Json::error_handler_t::replace); }

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json number_or_null(const std::optional<double>& x) { return x ? number_or_null(*x) : Json(nullptr); }

}  // namespace vericone
