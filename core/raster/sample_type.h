// The types in which rasters store their samples.
#pragma once

#include "core/base/check.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace marsview {

enum class SampleType {
    UInt8,
    Int8,
    UInt16,
    Int16,
    UInt32,
    Int32,
    UInt64,
    Int64,
    Float32,
    Float64,
};

/// Calls `function(T{})` with a value of the C++ type that stores such samples.
template <typename F>
constexpr decltype(auto) dispatchSampleType(SampleType type, F&& function)
{
    switch (type) {
    case SampleType::UInt8:
        return std::forward<F>(function)(std::uint8_t{});
    case SampleType::Int8:
        return std::forward<F>(function)(std::int8_t{});
    case SampleType::UInt16:
        return std::forward<F>(function)(std::uint16_t{});
    case SampleType::Int16:
        return std::forward<F>(function)(std::int16_t{});
    case SampleType::UInt32:
        return std::forward<F>(function)(std::uint32_t{});
    case SampleType::Int32:
        return std::forward<F>(function)(std::int32_t{});
    case SampleType::UInt64:
        return std::forward<F>(function)(std::uint64_t{});
    case SampleType::Int64:
        return std::forward<F>(function)(std::int64_t{});
    case SampleType::Float32:
        return std::forward<F>(function)(float{});
    case SampleType::Float64:
        return std::forward<F>(function)(double{});
    }
    MARSVIEW_CHECK(false);
}

/// Calls `function(T{})` with the unsigned type of that many bytes: 1, 2, 4 or 8.
template <typename F>
constexpr decltype(auto) dispatchUnsigned(std::size_t bytes, F&& function)
{
    switch (bytes) {
    case 1:
        return std::forward<F>(function)(std::uint8_t{});
    case 2:
        return std::forward<F>(function)(std::uint16_t{});
    case 4:
        return std::forward<F>(function)(std::uint32_t{});
    case 8:
        return std::forward<F>(function)(std::uint64_t{});
    default:
        MARSVIEW_CHECK(false);
    }
}

/// Bytes of one sample.
constexpr std::size_t sampleBytes(SampleType type)
{
    return dispatchSampleType(type, [](auto zero) { return sizeof(zero); });
}

/// The name used by GDAL's tools: "Byte", "Int16", "Float32", …
std::string_view sampleTypeName(SampleType type);

} // namespace marsview
