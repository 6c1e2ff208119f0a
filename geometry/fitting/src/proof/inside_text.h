// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/hull.h>
#include <cstddef>
#include <functional>
#include <string>

namespace vericone::fitting {

/// The certificate that everything in the sample is inside, of pieces as `write_pieces` adds them to the
/// text; `homes`: the piece that contains each point and triangle, -1 where there is none.
InsideCertificate inside_text(const Sample& sample, const Assignment& homes, std::size_t pieces,
                              const std::function<void(std::string&)>& write_pieces);

}  // namespace vericone::fitting
