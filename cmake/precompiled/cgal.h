// The exact kernel of the cross-checks (GPL, verify/ alone).
#pragma once

#include "exact.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
