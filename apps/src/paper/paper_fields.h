// SPDX-License-Identifier: BSD-3-Clause
//
// The fields of claims.yaml and figures.yaml (docs/reference/papers.md). Their readers stand where what they
// read is used; which fields there are, and what each means, stands here.
#pragma once

#include "measures/series_fields.h"
#include "paper/claim.h"

namespace vericone::paper {

const PaperFields& line_fields();  // a curve of a panel
const PaperFields& look_fields();  // of a panel beside its curves
const PaperFields& figure_fields();
const PaperFields& figures_file_fields();
const PaperFields& claim_fields();
const PaperFields& body_claim_fields();  // of a body, whose printed numbers are claims
const PaperFields& tolerance_fields();
const PaperFields& fit_fields();
const PaperFields& claims_file_fields();

/// Values that are one of some words.
input::Value<std::string> drawings();
input::Value<Verdict> otherwise_verdict();

Json claims_schema();
Json figures_schema();

}  // namespace vericone::paper
