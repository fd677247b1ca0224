// A view of a two-dimensional array in row-major order.
#pragma once

#include "core/base/check.h"

#include <cstddef>
#include <span>
#include <type_traits>

namespace marsview {

/// Columns × rows elements with a row stride, which the view does not own. A view never outlives
/// the call it is passed to.
template <typename T>
class GridView {
public:
    GridView() = default;
    /// `data` points at element (0, 0); `row_stride` counts elements and is at least `columns`.
    GridView(T* data, std::size_t columns, std::size_t rows, std::size_t row_stride)
        : data_(data)
        , columns_(columns)
        , rows_(rows)
        , row_stride_(row_stride)
    {
        MARSVIEW_CHECK(row_stride >= columns);
    }
    GridView(T* data, std::size_t columns, std::size_t rows)
        : GridView(data, columns, rows, columns)
    {}
    /// A view of mutable elements is also a view of constant ones.
    template <typename U>
    requires std::is_same_v<T, const U>
    GridView(const GridView<U>& other) // NOLINT(google-explicit-constructor)
        : GridView(other.data(), other.columns(), other.rows(), other.rowStride())
    {}

    T* data() const noexcept { return data_; }
    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    std::size_t rowStride() const noexcept { return row_stride_; }

    /// Unchecked: column < columns(), row < rows().
    T& operator()(std::size_t column, std::size_t row) const noexcept
    {
        return data_[row * row_stride_ + column];
    }
    std::span<T> row(std::size_t row) const noexcept
    {
        return {data_ + row * row_stride_, columns_};
    }

private:
    T* data_ = nullptr;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::size_t row_stride_ = 0;
};

} // namespace marsview
