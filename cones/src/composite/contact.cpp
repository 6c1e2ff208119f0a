// SPDX-License-Identifier: BSD-3-Clause
#include "composite/state.h"
