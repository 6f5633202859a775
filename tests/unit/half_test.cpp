// IEEE 754-2008, 3.6: binary16.
#include "glare/device/half.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using namespace seaglare::glare;

TEST(Half, NumbersOfTheStandardHaveTheirBits) {
    EXPECT_EQ(half_from_float(1.0F), 0x3C00);
    EXPECT_EQ(half_from_float(-2.0F), 0xC000);
    EXPECT_EQ(half_from_float(65504.0F), 0x7BFF);
    EXPECT_EQ(half_from_float(0x1p-14F), 0x0400);
    EXPECT_EQ(half_from_float(0x1p-24F), 0x0001);
    EXPECT_EQ(half_from_float(0.333333333F), 0x3555);
    EXPECT_EQ(half_from_float(0.0F), 0x0000);
    EXPECT_EQ(half_from_float(-0.0F), 0x8000);
}

TEST(Half, EveryFiniteNumberComesBack) {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        if ((bits & 0x7C00U) == 0x7C00U) continue;
        const auto half = static_cast<Half>(bits);
        ASSERT_EQ(half_from_float(float_from_half(half)), half) << bits;
    }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
    for (std::uint32_t bits = 0; bits < 0x7BFF; ++bits) {
        const float low = float_from_half(static_cast<Half>(bits));
        const float high = float_from_half(static_cast<Half>(bits + 1));
        const float middle = low + (high - low) / 2;  // exact
        const std::uint32_t even = (bits & 1U) == 0 ? bits : bits + 1;
        ASSERT_EQ(half_from_float(middle), even) << middle;
        ASSERT_EQ(half_from_float(std::nextafter(middle, low)), bits) << middle;
        ASSERT_EQ(half_from_float(std::nextafter(middle, high)), bits + 1) << middle;
    }
}

TEST(Half, WhatIsTooLargeIsTheLargest) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (float value : {65505.0F, 70000.0F, 1e30F, infinity})
        EXPECT_EQ(float_from_half(half_from_float(value)), largest_half) << value;
    EXPECT_EQ(float_from_half(half_from_float(-infinity)), -largest_half);
    EXPECT_TRUE(std::isfinite(float_from_half(half_from_float(std::nanf("")))));
}

TEST(Half, TheRelativeErrorIsAtMostTwoToTheMinusEleven) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-13.99F, 15.9F);
    for (int i = 0; i < 100000; ++i) {
        const float value = std::exp2(exponent(random));
        ASSERT_LE(std::abs(float_from_half(half_from_float(value)) - value), value * 0x1p-11F) << value;
    }
}

TEST(Half, EachChannelHasItsFactor) {
    const std::vector<float> from = {1, 2, 3, 4, -1, -2, -3, -4};
    const std::array<float, 4> factor = {1, 2, 4, 0.5F};
    std::vector<Half> to(from.size());
    halves_from_floats(from, factor, to);
    const std::vector<float> expected = {1, 4, 12, 2, -1, -4, -12, -2};
    for (std::size_t i = 0; i < to.size(); ++i)
        EXPECT_EQ(float_from_half(to[i]), expected[i]);
}

}  // namespace
