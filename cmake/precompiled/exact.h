// The exact rungs of the predicates: integers and rationals.
#pragma once

#include "core.h"

#include <boost/multiprecision/cpp_int.hpp>
