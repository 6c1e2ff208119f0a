// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/body_state.h>
