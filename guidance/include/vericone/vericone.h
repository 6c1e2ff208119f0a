// SPDX-License-Identifier: BSD-3-Clause
//
// All that most users need: bodies, pairs, cones, and a pilot among many obstacles. The families behind a
// pair, fitting, files and simulation have headers of their own (docs/explanation/architecture.md).
#pragma once

#include <vericone/cones/cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/guide.h>
#include <vericone/guidance/navigator.h>
