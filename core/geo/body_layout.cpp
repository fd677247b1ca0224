#include "core/geo/body_layout.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace marsview {
namespace {

constexpr double kTurnDeg = 360.0;

class LayoutMaker {
public:
    explicit LayoutMaker(const Georeference& georeference)
        : georeference_(georeference)
    {
        layout_.columns = georeference.columns();
        layout_.rows = georeference.rows();
    }

    Result<BodyLayout> make()
    {
        if (Status turned = takeTurn(); !turned) {
            return turned.error();
        }
        takePoles();
        return layout_;
    }

private:
    // NaN outside the projection.
    double longitudeDeg(std::size_t column) const
    {
        const double middle_row = 0.5 * static_cast<double>(georeference_.rows() - 1);
        const auto place =
            georeference_.toGeographic(GridPoint{static_cast<double>(column), middle_row});
        return place ? place->longitude.degrees() : std::numeric_limits<double>::quiet_NaN();
    }
    double latitudeDeg(std::size_t row) const
    {
        const auto place = georeference_.toGeographic(GridPoint{0.0, static_cast<double>(row)});
        return place ? place->latitude.degrees() : std::numeric_limits<double>::quiet_NaN();
    }

    // A raster with a sample at the same meridian in the first and the last column needs one of
    // them.
    Status takeTurn()
    {
        const double first_deg = longitudeDeg(0);
        const double step_deg = std::abs(longitudeDeg(1) - first_deg);
        double span_deg = std::abs(longitudeDeg(layout_.columns - 1) - first_deg);
        constexpr double kEqualSteps = 1e-6;
        if (span_deg > kTurnDeg + kEqualSteps * step_deg) {
            return Error{
                ErrorCode::Invalid,
                fmt::format("extends over {:.6g}° of longitude; a body has 360°", span_deg)};
        }
        if (span_deg > kTurnDeg - kEqualSteps * step_deg) {
            --layout_.columns;
            span_deg = std::abs(longitudeDeg(layout_.columns - 1) - first_deg);
        }
        layout_.wraps =
            layout_.columns >= 3 && std::abs(kTurnDeg - span_deg - step_deg) < 0.5 * step_deg;
        return Done{};
    }

    // The distance of a row from the pole, in steps to another row.
    double offPoleRows(std::size_t row, std::size_t inner) const
    {
        constexpr double kPoleDeg = 90.0;
        const double latitude = latitudeDeg(row);
        const double step = std::abs(latitude - latitudeDeg(inner));
        return (kPoleDeg - std::abs(latitude)) / std::max(step, 1e-300);
    }

    void takePoles()
    {
        constexpr double kAtPoleRows = 1e-6;
        std::size_t last = layout_.rows - 1;
        if (offPoleRows(0, 1) < kAtPoleRows) {
            layout_.first_row = 1;
        }
        if (last > layout_.first_row && offPoleRows(last, last - 1) < kAtPoleRows) {
            layout_.has_row_after = true;
            --last;
        }
        layout_.rows = last - layout_.first_row + 1;
        if (layout_.rows < 2) {
            return;
        }
        constexpr double kNextToPoleRows = 1.0 + kAtPoleRows;
        const std::size_t first = layout_.first_row;
        layout_.closes_first = layout_.wraps && offPoleRows(first, first + 1) <= kNextToPoleRows;
        layout_.closes_last = layout_.wraps && offPoleRows(last, last - 1) <= kNextToPoleRows;
    }

    const Georeference& georeference_;
    BodyLayout layout_;
};

} // namespace

bool hasMeridiansAsColumns(const Georeference& georeference)
{
    const GeoTransform::Terms& t = georeference.transform().terms();
    if (t[2] != 0.0 || t[4] != 0.0 || !georeference.crs() || !georeference.crs()->turn()) {
        return false;
    }
    constexpr double kEqualDeg = 1e-11;
    const double last_column = static_cast<double>(georeference.columns() - 1);
    const double last_row = static_cast<double>(georeference.rows() - 1);
    const auto place_of = [&](double column, double row) {
        return georeference.toGeographic(GridPoint{column, row});
    };
    for (const double share : {0.0, 0.31, 0.77, 1.0}) {
        const auto above = place_of(share * last_column, 0.25 * last_row);
        const auto below = place_of(share * last_column, 0.75 * last_row);
        const auto left = place_of(0.0, share * last_row);
        const auto right = place_of(last_column, share * last_row);
        if (!above || !below || !left || !right ||
            std::abs(above->longitude.degrees() - below->longitude.degrees()) > kEqualDeg ||
            std::abs(left->latitude.degrees() - right->latitude.degrees()) > kEqualDeg) {
            return false;
        }
    }
    return true;
}

Result<BodyLayout> bodyLayout(const Georeference& georeference)
{
    return LayoutMaker(georeference).make();
}

} // namespace marsview
