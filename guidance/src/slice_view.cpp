// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/plane_view.h>
