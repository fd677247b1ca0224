// Four-by-four matrices of doubles, in column-major order as in OpenGL.
#pragma once

#include <array>
#include <cstddef>

namespace marsview {

/// element(row, column) is values[column * 4 + row].
struct Matrix4 {
    std::array<double, 16> values{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    constexpr double operator()(std::size_t row, std::size_t column) const noexcept
    {
        return values[column * 4 + row];
    }
    constexpr double& operator()(std::size_t row, std::size_t column) noexcept
    {
        return values[column * 4 + row];
    }
};

constexpr Matrix4 operator*(const Matrix4& a, const Matrix4& b) noexcept
{
    Matrix4 product;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            double sum = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                sum += a(row, k) * b(k, column);
            }
            product(row, column) = sum;
        }
    }
    return product;
}

} // namespace marsview
