// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/clearance_law.h>
