// The affine map from the sample grid to map coordinates.
#pragma once

#include "core/base/result.h"
#include "core/geo/frames.h"

#include <array>

namespace marsview {

/// GDAL's six geotransform terms as GDAL defines them: the terms place the outer corner of pixel
/// (0, 0), and x = t0 + t1·pixel + t2·line, y = t3 + t4·pixel + t5·line. All six are used.
class GeoTransform {
public:
    using Terms = std::array<double, 6>;

    /// One map unit per pixel, north up, the outer corner of the first pixel at the origin.
    GeoTransform() = default;

    /// Refuses terms that are not finite or whose columns are (nearly) parallel: such a transform
    /// cannot be inverted.
    static Result<GeoTransform> fromTerms(const Terms& terms);

    const Terms& terms() const noexcept { return terms_; }

    /// Exact up to rounding: at most 3 ulp of the largest term.
    MapPoint toMap(GridPoint grid) const noexcept;
    /// Inverse of toMap; round trips within 1e-9 sample for coordinates up to 1e7 samples.
    GridPoint toGrid(MapPoint map) const noexcept;

    /// Length of one step along a row and along a column, in CRS units.
    double pixelWidth() const noexcept;
    double pixelHeight() const noexcept;

    bool operator==(const GeoTransform&) const = default;

private:
    Terms terms_{0.0, 1.0, 0.0, 0.0, 0.0, -1.0};
};

} // namespace marsview
