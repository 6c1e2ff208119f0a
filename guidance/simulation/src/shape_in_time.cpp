// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/shape_in_time.h>
