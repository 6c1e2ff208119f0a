// The tests.
#pragma once

#include "exact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <sstream>
