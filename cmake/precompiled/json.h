// The programs: results as JSON, files, streams.
#pragma once

#include "core.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
