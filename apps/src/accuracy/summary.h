// SPDX-License-Identifier: BSD-3-Clause
//
// What the figures and the text of `vericone accuracy` show, from the rows of one table.
#pragma once

#include <iosfwd>
#include <vector>

#include "accuracy/measure.h"
#include "accuracy/statistics.h"
#include "json/json_forward.h"

namespace vericone::accuracy {

struct Summary {
  struct Samples {
    int samples = 0;
    Spread error, bound;  // of the exact cone's area, parts of it
    std::ptrdiff_t violated = 0;
  };
  std::size_t engagements = 0;
  int finest_planes = 0;
  SliceErrors slices;
  std::vector<Spread> missing;  // part of the true area that the slices of each count miss
  Spread slice_bias;            // what the finest count misses
  std::vector<double> slice_bias_values;
  std::vector<Samples> exact;
  double bound_order = 0;
};

/// `planes`: in rising order.
Summary summarise(const std::vector<Measurement>& rows, const std::vector<int>& planes);
Json to_json(const Summary& summary);
void print_summary(const Summary& summary, std::ostream& out);

}  // namespace vericone::accuracy
