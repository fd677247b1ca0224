// How many digits of a measured number mean something.
//
// One rule everywhere: an uncertainty has two digits, and a number ends where its uncertainty does:
// 21.346 km ± 12 m. Where no uncertainty is known, the distance of the samples stands for it.
#pragma once

#include "core/geo/georeference.h"
#include "core/raster/raster_info.h"

namespace marsview {

struct Crater;

/// The power of ten that the last digit of `value` counts. At least two and at most six digits
/// remain; four if `uncertainty` is not a positive number.
int lastPlace(double value, double uncertainty);

/// A number as it is written: rounded, in units of 10^unit_power.
struct WrittenNumber {
    double value = 0.0;
    int decimals = 0;
};
WrittenNumber writtenNumber(double value, int last_place, int unit_power = 0);

/// What the samples of a raster resolve, in meters; 0: unknown.
struct MeasuredResolution {
    double ground_m = 0.0;
    double height_m = 0.0;
};

/// The distance of samples, and of elevations near `elevation_m`. Elevations between samples are
/// known no better than to a tenth of their distance, or to a meter.
MeasuredResolution
resolutionOf(const Georeference& georeference, const RasterInfo& info, double elevation_m);

/// The last places of what is measured on a raster.
class MeasuredDigits {
public:
    explicit MeasuredDigits(const MeasuredResolution& resolution)
        : resolution_(resolution)
    {}

    int length(double length_m) const { return lastPlace(length_m, resolution_.ground_m); }
    int elevation(double elevation_m) const;
    /// Its border is known to a sample.
    int area(double area_m2, double perimeter_m) const;
    int volume(double volume_m3, double area_m2) const;
    /// Of a circle with an RMS distance of its points from it; 0 without residuals.
    int diameter(double diameter_m, double rms_m) const;
    /// Of the depth of a crater, and of the elevations of its rim and floor. Gridding cuts crests
    /// and fills floors (Mouginis-Mark et al. 2018, doi:10.1111/maps.12895): a wall that rises by
    /// the depth over the radius differs by that share of it from sample to sample, or over the
    /// RMS distance of the rim if that is larger.
    int depth(const Crater& crater) const;
    /// At least two decimals, and more than three only for the second digit.
    int depthToDiameter(const Crater& crater) const;
    /// In degrees, as the following ones: the direction of a line so long.
    int direction(double length_m) const;

private:
    double depthError(const Crater& crater) const;

    MeasuredResolution resolution_;
};

/// Of an angle in degrees: at most two decimals.
int anglePlace(double uncertainty_deg);
/// Of slopes, whose uncertainty is not known: a decimal.
inline constexpr int kSlopePlace = -1;

} // namespace marsview
