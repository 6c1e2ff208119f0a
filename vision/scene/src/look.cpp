// SPDX-License-Identifier: BSD-3-Clause
#include "look.h"

#include <vericone/internal/geometry/mixed.h>
#include <array>

namespace vericone::vision {

std::uint64_t mixed(std::uint64_t seed, std::uint64_t k) {
  return detail::mixed(seed * 0x9e3779b97f4a7c15u + (k + 1) * 0xbf58476d1ce4e5b9u - 0x9e3779b97f4a7c15u);
}

Look::Look(std::uint32_t seed) : texels_(kAlong * kAcross) {
  const std::array<Colour, 8> paints{Colour(235, 235, 235), Colour(30, 28, 28),   Colour(40, 40, 190),
                                     Colour(150, 70, 30),   Colour(60, 200, 235), Colour(185, 180, 175),
                                     Colour(60, 120, 40),   Colour(40, 110, 230)};
  std::uint64_t k = 0;
  const auto part = [&] { return double(mixed(seed, ++k) >> 11) * 0x1p-53; };
  paint_ = paints[mixed(seed, 0) % paints.size()];
  const Colour glass(38, 32, 28);
  for (std::size_t i = 0; i < kAlong; ++i)
    for (std::size_t j = 0; j < kAcross; ++j) {
      const double along = (double(i) + 0.5) / kAlong, across = (double(j) + 0.5) / kAcross;
      Colour& c = texels_[i * kAcross + j];
      const bool middle = across > 0.1 && across < 0.9;
      c = paint_;
      if (!middle) c = 0.7f * paint_;
      if (along > 0.25 && along < 0.58) c = 0.9f * c;
      if (middle && ((along > 0.58 && along < 0.72) || (along > 0.14 && along < 0.25))) c = glass;
      const bool corner = across < 0.22 || across > 0.78;
      if (corner && along > 0.955) c = Colour(240, 250, 250);
      if (corner && along < 0.035) c = Colour(30, 30, 200);
    }
  // A sunroof, a rack, a sign, a bonnet of another colour: what there is, and where.
  const auto patch = [&](double low, double high) {
    const double length = (high - low) * (0.3 + 0.5 * part()), width = 0.2 + 0.4 * part();
    const double x = low + (high - low - length) * part(), y = 0.12 + (0.76 - width) * part();
    const bool bright = grey(paint_) < 128;
    const Colour c =
        (bright ? Colour(200, 205, 210) : Colour(45, 45, 50)) + Colour::Constant(float(40 * part() - 20));
    for (std::size_t i = 0; i < kAlong; ++i)
      for (std::size_t j = 0; j < kAcross; ++j) {
        const double along = (double(i) + 0.5) / kAlong, across = (double(j) + 0.5) / kAcross;
        if (along > x && along < x + length && across > y && across < y + width) texels_[i * kAcross + j] = c;
      }
  };
  patch(0.26, 0.57);
  patch(0.26, 0.57);
  patch(0.74, 0.94);
}

}  // namespace vericone::vision
