// All sample types, for typed tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

namespace marsview::test {

using AllSampleTypes = testing::Types<std::uint8_t,
                                      std::int8_t,
                                      std::uint16_t,
                                      std::int16_t,
                                      std::uint32_t,
                                      std::int32_t,
                                      std::uint64_t,
                                      std::int64_t,
                                      float,
                                      double>;

} // namespace marsview::test
