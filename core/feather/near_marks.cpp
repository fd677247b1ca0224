// P. Felzenszwalb and D. Huttenlocher, Distance Transforms of Sampled Functions (2012), take the
// distance in two passes: along columns, then the least sum of squares along rows. As distances are
// short here, the second pass looks at all columns that are near enough.
#include "core/feather/near_marks.h"

#include "core/base/check.h"

#include <algorithm>

namespace marsview {

std::vector<std::uint32_t> squaredDistances(GridView<const std::uint8_t> marks, std::size_t reach)
{
    MARSVIEW_CHECK(marks.columns() > 2 * reach && marks.rows() > 2 * reach);
    const std::size_t width = marks.columns();
    const std::size_t columns = width - 2 * reach;
    const std::size_t rows = marks.rows() - 2 * reach;
    const auto far = static_cast<std::uint32_t>(reach);
    // In the column of each sample, the distance to the nearest mark; all columns.
    std::vector<std::uint32_t> in_column(width * rows, far);
    std::vector<std::uint32_t> since(width, far);
    const auto pass = [&](std::size_t row) {
        for (std::size_t column = 0; column < width; ++column) {
            since[column] = marks(column, row) != 0 ? 0 : std::min(since[column] + 1, far);
        }
        if (row >= reach && row < reach + rows) {
            std::uint32_t* known = in_column.data() + (row - reach) * width;
            for (std::size_t column = 0; column < width; ++column) {
                known[column] = std::min(known[column], since[column]);
            }
        }
    };
    for (std::size_t row = 0; row < marks.rows(); ++row) {
        pass(row);
    }
    std::fill(since.begin(), since.end(), far);
    for (std::size_t row = marks.rows(); row > 0; --row) {
        pass(row - 1);
    }
    std::vector<std::uint32_t> squared(columns * rows, far * far);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::uint32_t* known = in_column.data() + row * width;
        if (std::all_of(known, known + width, [far](std::uint32_t d) { return d == far; })) {
            continue;
        }
        for (std::size_t column = 0; column < columns; ++column) {
            const std::uint32_t* here = known + column + reach;
            std::uint32_t least = far * far;
            for (std::uint32_t aside = 0; aside < far && aside * aside < least; ++aside) {
                const std::uint32_t nearer = std::min(*(here - aside), *(here + aside));
                least = std::min(least, aside * aside + nearer * nearer);
            }
            squared[row * columns + column] = least;
        }
    }
    return squared;
}

} // namespace marsview
