// SPDX-License-Identifier: BSD-3-Clause
//
// The fields of what claims and figures are measured by (docs/reference/papers.md, Values). Their readers
// stand in read_values.cpp; which fields there are, and what each means, stands here.
#pragma once

#include "input/field_table.h"
#include "measures/measure.h"

namespace vericone::paper {

using PaperFields = input::Fields<Json>;

PaperFields& with_series(PaperFields& rows);  // adds those of a series
const PaperFields& series_fields();           // rows of a table
const PaperFields& value_fields();            // a number of such rows
const PaperFields& trial_fields();
const input::Fields<Ascent>& ascent_fields();
const PaperFields& range_fields();

// Of schemas.
Json text_schema();
Json number_schema();
Json mapping_schema();
Json formula();
Json either(const char* title, Json one, Json other);
Json list_of(Json items, int least = 0);
Json texts();
Json numbers();
Json reference(const char* name);

}  // namespace vericone::paper
