// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/run.h>
