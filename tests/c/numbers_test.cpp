// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies as numbers: the same body again, or a line that says why not.
#include "c_bodies.h"

namespace vericone::c_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CInterface, BodiesOfNumbersAreTheSameBodies) {
  RandomBodies random(3706);
  for (const auto kind : kKinds)
    for (int i = 0; i < 20; ++i) {
      const Both body = kind(random);
      const std::vector<double> numbers = numbers_of(body.c.get());
      const BodyHandle again(vericone_body_of_numbers(numbers.data(), numbers.size()));
      ASSERT_TRUE(again) << vericone_error();
      EXPECT_EQ(vericone_body_kind(again.get()), vericone_body_kind(body.c.get()));
      EXPECT_EQ(numbers_of(again.get()), numbers);
      // The pieces of an assembly stand in the same order, in the same tree.
      const vericone::Body made = body_of_numbers(numbers);
      if (const Assembly* pieces = body.cpp.assembly())
        for (std::size_t k = 0; k < pieces->size(); ++k)
          EXPECT_EQ(made.assembly()->piece(k).points(), pieces->piece(k).points());
      for (int k = 0; k < 5; ++k) {
        const Vector3d n = random.direction();
        expect_same(body.cpp.support(n), made.support(n));
      }
    }
}

TEST(CInterface, NumbersOfNoBodyAreRefused) {
  RandomBodies random(3707);
  for (const auto kind : kKinds) {
    const std::vector<double> good = numbers_of(kind(random).c.get());
    for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 40) {
      EXPECT_FALSE(vericone_body_of_numbers(good.data(), length)) << length;
      EXPECT_THAT(vericone_error(), HasSubstr(", must be "));
    }
    for (const double bad : {kNan, 1e300, -1.0, 0.5})
      for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 40) {
        auto numbers = good;
        numbers[i] = bad;
        const BodyHandle made(vericone_body_of_numbers(numbers.data(), numbers.size()));
        // Some are another body; a NaN is none.
        if (std::isnan(bad)) EXPECT_FALSE(made) << i;
        if (made) EXPECT_GE(vericone_body_numbers(made.get(), nullptr, 0), 0);
      }
    auto longer = good;
    longer.push_back(0);
    EXPECT_FALSE(vericone_body_of_numbers(longer.data(), longer.size()));
  }
  const BodyHandle ball = ellipsoid(random).c;
  for (const double part : {2.0, 1 - 9e-10, 1 + 1e-11}) {
    auto lies = numbers_of(ball.get());
    lies[4] *= part;  // its shape is not that of its factor
    EXPECT_FALSE(vericone_body_of_numbers(lies.data(), lies.size())) << part;
    EXPECT_THAT(vericone_error(), StartsWith("numbers[1]: got "));
  }
}

TEST(CInterface, TinyAndFlatBodiesOfNumbersAreTheSameBodies) {
  for (const Vector3d& axes : {Vector3d(1e-110, 2e-110, 3e-110), Vector3d(1e-155, 1e-155, 1e-155),
                               Vector3d(1e150, 1, 1e-150), Vector3d(1e150, 1e150, 1e150)}) {
    const Vector3d zero = Vector3d::Zero();
    const Rows turned = rotation_3d({0.5, -0.5, 0.5, 0.5});
    const BodyHandle body(vericone_body_ellipsoid(zero.data(), axes.data(), turned.data()));
    ASSERT_TRUE(body) << vericone_error();
    const auto numbers = numbers_of(body.get());
    const BodyHandle again(vericone_body_of_numbers(numbers.data(), numbers.size()));
    ASSERT_TRUE(again) << vericone_error();
    EXPECT_EQ(numbers_of(again.get()), numbers);
  }
}

}  // namespace
}  // namespace vericone::c_test
