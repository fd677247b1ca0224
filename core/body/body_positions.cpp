#include "core/body/body_positions.h"

#include "core/base/check.h"
#include "core/geo/body_layout.h"

#include <GeographicLib/Geocentric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kTermCount = 10;
// Chebyshev nodes per side of a block, and shares of a block between them where the fit is judged.
constexpr std::size_t kNodes = 5;
constexpr std::size_t kJudged = 6;
constexpr unsigned kBlockShiftMax = 4;
constexpr double kErrorMaxM = 1e-4;
constexpr double kErrorMaxCells = 2.5e-7;

// T_i(u) · T_j(v) for i + j <= 3.
std::array<double, kTermCount> termsAt(double u, double v) noexcept
{
    const std::array<double, 4> a{1.0, u, 2.0 * u * u - 1.0, u * (4.0 * u * u - 3.0)};
    const std::array<double, 4> b{1.0, v, 2.0 * v * v - 1.0, v * (4.0 * v * v - 3.0)};
    return {a[0], a[1], b[1], a[2], a[1] * b[1], b[2], a[3], a[2] * b[1], a[1] * b[2], b[3]};
}

// The ellipsoid's radius of curvature in the prime vertical, from the sine of the planetographic
// latitude.
double primeVerticalM(const Ellipsoid& ellipsoid, double sine) noexcept
{
    const double ratio = ellipsoid.polar_m / ellipsoid.equatorial_m;
    return ellipsoid.equatorial_m / std::sqrt(1.0 + (ratio * ratio - 1.0) * sine * sine);
}

double node(std::size_t i) noexcept
{
    return std::cos((2.0 * static_cast<double>(i) + 1.0) * std::numbers::pi /
                    (2.0 * static_cast<double>(kNodes)));
}

} // namespace

BodyPositions::Foot footOf(const Ellipsoid& ellipsoid, const GeographicPoint& place) noexcept
{
    const Angle latitude = ellipsoid.planetographic(place.latitude);
    const double sine = std::sin(latitude.radians());
    const double cosine = std::cos(latitude.radians());
    const double ratio = ellipsoid.polar_m / ellipsoid.equatorial_m;
    const double across_m = primeVerticalM(ellipsoid, sine);
    const double east = std::sin(place.longitude.radians());
    const double to_meridian = std::cos(place.longitude.radians());
    return {{across_m * cosine * to_meridian, across_m * cosine * east,
             across_m * ratio * ratio * sine},
            {cosine * to_meridian, cosine * east, sine}};
}

BodyVertical verticalAt(const Ellipsoid& ellipsoid, const Vec3& point) noexcept
{
    const GeographicLib::Geocentric frame(ellipsoid.equatorial_m, ellipsoid.flattening());
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double height_m = 0.0;
    frame.Reverse(point.x, point.y, point.z, latitude_deg, longitude_deg, height_m);
    const double latitude = Angle::degrees(latitude_deg).radians();
    const double longitude = Angle::degrees(longitude_deg).radians();
    return {{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
             std::sin(latitude)},
            height_m};
}

class BodyPositions::Maker {
public:
    Maker(const Georeference& georeference,
          JobMonitor& monitor,
          const std::optional<Ellipsoid>& scene)
        : georeference_(georeference)
        , monitor_(monitor)
        , scene_(scene)
    {}

    Result<BodyPositions> make()
    {
        if (!georeference_.crs() || !georeference_.crs()->ellipsoid()) {
            return Error{ErrorCode::Invalid,
                         "has no CRS on a body, so that it cannot lie on one; state the CRS"};
        }
        made_.ellipsoid_ = scene_.value_or(*georeference_.crs()->ellipsoid());
        const double axes = made_.ellipsoid_.equatorial_m / made_.ellipsoid_.polar_m;
        made_.axes_squared_ = axes * axes;
        made_.columns_ = georeference_.columns();
        made_.rows_ = georeference_.rows();
        if (made_.columns_ < 2 || made_.rows_ < 2) {
            return Error{ErrorCode::Invalid, "has fewer than 2 columns or rows"};
        }
        Status filled = hasMeridiansAsColumns(georeference_) ? fillTables() : fillBlocks();
        if (!filled) {
            return std::move(filled).error();
        }
        if (made_.columns_ < 2 || made_.rows_ < 2) {
            return Error{ErrorCode::Invalid, "has fewer than 2 columns or rows off the poles"};
        }
        orient();
        return std::move(made_);
    }

private:
    std::optional<GeographicPoint> placeOf(double column, double row) const
    {
        return georeference_.toGeographic(GridPoint{column, row});
    }

    Status fillTables()
    {
        const Result<BodyLayout> layout = bodyLayout(georeference_);
        if (!layout) {
            return layout.error();
        }
        made_.first_row_ = layout->first_row;
        made_.has_row_after_ = layout->has_row_after;
        made_.wraps_ = layout->wraps;
        made_.closes_first_ = layout->closes_first;
        made_.closes_last_ = layout->closes_last;
        const double middle_row = 0.5 * static_cast<double>(made_.rows_ - 1);
        made_.columns_ = layout->columns;
        made_.rows_ = layout->rows;
        for (std::size_t column = 0; column < made_.columns_; ++column) {
            const auto place = placeOf(static_cast<double>(column), middle_row);
            if (!place) {
                return noPlace();
            }
            const double radians = Angle::degrees(place->longitude.degrees()).radians();
            made_.column_table_.push_back({std::cos(radians), std::sin(radians)});
        }
        for (std::size_t row = 0; row < made_.rows_; ++row) {
            const auto place = placeOf(0.0, static_cast<double>(row + made_.first_row_));
            if (!place) {
                return noPlace();
            }
            const Foot foot = footOf(
                made_.ellipsoid_, {.longitude = Angle::degrees(0.0), .latitude = place->latitude});
            made_.row_table_.push_back(
                {foot.surface_m.x, foot.surface_m.z, foot.normal.x, foot.normal.z});
        }
        return Done{};
    }

    Status fillBlocks()
    {
        for (unsigned shift = kBlockShiftMax;; --shift) {
            layOut(shift);
            if (shift == 0 || isExact()) {
                break;
            }
        }
        const std::size_t block_rows = made_.block_rows_.size();
        made_.blocks_.reserve(block_rows * made_.blocks_per_row_);
        for (std::size_t row = 0; row < block_rows; ++row) {
            monitor_.report(static_cast<double>(row) / static_cast<double>(block_rows));
            if (monitor_.isCanceled()) {
                return Error{ErrorCode::Canceled, "placing the samples was canceled"};
            }
            for (std::size_t column = 0; column < made_.blocks_per_row_; ++column) {
                const auto block = fitted(column, row);
                if (!block) {
                    return noPlace();
                }
                made_.blocks_.push_back(*block);
            }
        }
        return Done{};
    }

    void layOut(unsigned shift)
    {
        const auto ranges = [shift](std::size_t count) {
            std::vector<Range> made;
            const std::size_t size = std::size_t{1} << shift;
            for (std::size_t begin = 0; begin < count; begin += size) {
                const std::size_t last = std::min(begin + size, count) - 1;
                const double half = 0.5 * static_cast<double>(last - begin);
                made.push_back({static_cast<double>(begin) + half, half > 0.0 ? 1.0 / half : 0.0});
            }
            return made;
        };
        made_.block_shift_ = shift;
        made_.block_columns_ = ranges(made_.columns_);
        made_.block_rows_ = ranges(made_.rows_);
        made_.blocks_per_row_ = made_.block_columns_.size();
    }

    std::optional<Foot>
    footAt(std::size_t block_column, std::size_t block_row, double u, double v) const
    {
        const Range& columns = made_.block_columns_[block_column];
        const Range& rows = made_.block_rows_[block_row];
        const auto at = [](const Range& range, double share) {
            return range.per_half > 0.0 ? range.middle + share / range.per_half : range.middle;
        };
        const auto place = placeOf(at(columns, u), at(rows, v));
        return place ? std::optional(footOf(made_.ellipsoid_, *place)) : std::nullopt;
    }

    Components componentsOf(const Foot& foot) const
    {
        return {foot.surface_m.x, foot.surface_m.y, foot.surface_m.z,
                1.0 / primeVerticalM(made_.ellipsoid_, foot.normal.z)};
    }

    // Sums over Chebyshev nodes, at which the polynomials are orthogonal. A block of one column or
    // row does not vary along it.
    std::optional<Block> fitted(std::size_t block_column, std::size_t block_row) const
    {
        Block block{};
        std::array<double, kTermCount> squares{};
        const bool is_single = made_.block_shift_ == 0;
        const std::size_t nodes = is_single ? 1 : kNodes;
        for (std::size_t i = 0; i < nodes; ++i) {
            for (std::size_t j = 0; j < nodes; ++j) {
                const double u = is_single ? 0.0 : node(i);
                const double v = is_single ? 0.0 : node(j);
                const auto foot = footAt(block_column, block_row, u, v);
                if (!foot) {
                    return std::nullopt;
                }
                const std::array<double, kTermCount> terms = termsAt(u, v);
                const Components values = componentsOf(*foot);
                const std::size_t used = is_single ? 1 : kTermCount;
                for (std::size_t k = 0; k < used; ++k) {
                    squares[k] += terms[k] * terms[k];
                    for (std::size_t c = 0; c < values.size(); ++c) {
                        block[k][c] += terms[k] * values[c];
                    }
                }
            }
        }
        for (std::size_t k = 0; k < kTermCount; ++k) {
            for (double& component : block[k]) {
                component = squares[k] > 0.0 ? component / squares[k] : 0.0;
            }
        }
        return block;
    }

    // Whether blocks in all parts of the raster keep the bounds on the error.
    bool isExact() const
    {
        const double cell_m =
            std::min(georeference_.pixelWidthMeters(), georeference_.pixelHeightMeters());
        const double most_m = std::min(kErrorMaxM, kErrorMaxCells * cell_m);
        constexpr std::size_t kAcross = 6;
        for (std::size_t i = 0; i < kAcross; ++i) {
            for (std::size_t j = 0; j < kAcross; ++j) {
                const std::size_t column = i * (made_.block_columns_.size() - 1) / (kAcross - 1);
                const std::size_t row = j * (made_.block_rows_.size() - 1) / (kAcross - 1);
                const auto block = fitted(column, row);
                if (block && !isExact(*block, column, row, most_m)) {
                    return false;
                }
            }
        }
        return true;
    }

    bool isExact(const Block& block, std::size_t column, std::size_t row, double most_m) const
    {
        // A normal counts with the largest relief of any body.
        constexpr double kReliefM = 3e4;
        for (std::size_t i = 0; i <= kJudged; ++i) {
            for (std::size_t j = 0; j <= kJudged; ++j) {
                const double u = 2.0 * static_cast<double>(i) / static_cast<double>(kJudged) - 1.0;
                const double v = 2.0 * static_cast<double>(j) / static_cast<double>(kJudged) - 1.0;
                const auto foot = footAt(column, row, u, v);
                if (!foot) {
                    continue; // found when the block is made
                }
                const Foot made = made_.footFrom(block, u, v);
                if (length(made.surface_m - foot->surface_m) +
                        kReliefM * length(made.normal - foot->normal) >
                    most_m) {
                    return false;
                }
            }
        }
        return true;
    }

    void orient()
    {
        const std::size_t column = (made_.columns_ - 1) / 2;
        const std::size_t row = (made_.rows_ - 1) / 2;
        const Vec3 here = made_.at(column, row, 0.0);
        const Vec3 across = made_.at(column + 1, row, 0.0) - here;
        const Vec3 down = made_.at(column, row + 1, 0.0) - here;
        made_.is_mirrored_ = dot(cross(across, down), made_.at(column, row, 1.0) - here) > 0.0;
    }

    Status noPlace() const
    {
        return Error{ErrorCode::Invalid,
                     "has samples beyond a pole or outside its projection; crop it"};
    }

    const Georeference& georeference_;
    JobMonitor& monitor_;
    const std::optional<Ellipsoid>& scene_;
    BodyPositions made_;
};

Result<BodyPositions> BodyPositions::make(const Georeference& georeference,
                                          JobMonitor& monitor,
                                          const std::optional<Ellipsoid>& scene)
{
    return Maker(georeference, monitor, scene).make();
}

BodyPositions::Foot BodyPositions::footFrom(const Block& block, double u, double v) const noexcept
{
    const std::array<double, kTerms> terms = termsAt(u, v);
    Components sums{};
    for (std::size_t k = kTerms; k-- > 0;) { // the small ones first
        for (std::size_t c = 0; c < sums.size(); ++c) {
            sums[c] += block[k][c] * terms[k];
        }
    }
    return {{sums[0], sums[1], sums[2]},
            {sums[0] * sums[3], sums[1] * sums[3], sums[2] * sums[3] * axes_squared_}};
}

BodyPositions::Foot BodyPositions::footFromBlocks(std::size_t column,
                                                  std::size_t row) const noexcept
{
    const std::size_t block_column = column >> block_shift_;
    const std::size_t block_row = row >> block_shift_;
    const Range& columns = block_columns_[block_column];
    const Range& rows = block_rows_[block_row];
    return footFrom(blocks_[block_row * blocks_per_row_ + block_column],
                    (static_cast<double>(column) - columns.middle) * columns.per_half,
                    (static_cast<double>(row) - rows.middle) * rows.per_half);
}

} // namespace marsview
