// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/track.h>
