// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/vision/image.h>
#include <algorithm>

namespace vericone::vision {

double overlap(const Box& a, const Box& b) {
  const double w = std::min(a.x + a.w, b.x + b.w) - std::max(a.x, b.x),
               h = std::min(a.y + a.h, b.y + b.h) - std::max(a.y, b.y);
  if (!(w > 0 && h > 0)) return 0;
  return w * h / (a.w * a.h + b.w * b.h - w * h);
}

}  // namespace vericone::vision
