// Suggests a CRS for grids in degrees without one, and finds CRSs that do not fit their grid.
#pragma once

#include "core/geo/body.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct RasterInfo;

/// Information on axes and body from sources other than a CRS.
struct AxisHints {
    std::string degree_axes;    // how the file declares degrees; empty if it does not
    const Body* body = nullptr; // named by the file's metadata or its name; null if unknown
    bool operator==(const AxisHints&) const = default;
};

/// A CRS that fits a grid without one.
struct CrsChoice {
    std::string body; // as in knownBodies
    std::string crs;  // text for Crs::fromText and RasterOverrides::crs: a code, or WKT
    bool operator==(const CrsChoice&) const = default;
};

/// A raster without CRS, or with a projected one that does not fit, whose numbers look like degrees
/// of longitude and latitude.
struct CrsSuggestion {
    /// Why: "its extent is 0° – 360°, 90° S – 90° N".
    std::string reason;
    /// A single choice if the file names a body, otherwise the likely ones, Earth first. Never
    /// empty.
    std::vector<CrsChoice> choices;
    /// False if only the numbers suggest degrees: they could be a few meters.
    bool is_certain = false;
    /// The name and the unit of the CRS of the file that does not fit; empty without a CRS.
    std::string unfit_crs;
    std::string unfit_unit;
    bool operator==(const CrsSuggestion&) const = default;
};

/// Empty for a raster with a CRS or without georeferencing, or whose extent cannot be in degrees.
std::optional<CrsSuggestion> suggestCrs(const RasterInfo& info);

/// For a raster with a projected CRS whose grid must be in degrees: a whole body. Otherwise empty.
std::optional<CrsSuggestion> suggestDegreesInstead(const RasterInfo& info);

/// The corresponding sentence in RasterInfo::notices.
std::string noticeOf(const CrsSuggestion& suggestion);
/// The same for the command line, which sets a CRS with --crs and a body with --body.
std::string optionNoticeOf(const CrsSuggestion& suggestion);

/// Whether all sample positions can be longitudes and latitudes in units of which `turn` make a
/// full turn of longitude: at most two turns from 0 and at most half a sample beyond the poles.
bool canBeAngles(const RasterInfo& info, double turn = 360.0);

/// Why the geographic CRS of `info` does not fit its grid. Empty if it fits.
std::string angularMisfit(const RasterInfo& info);

/// The sentence about a CRS in degrees that is not used since it does not fit the grid. Empty if it
/// fits.
std::string noticeOfUnusedCrs(const RasterInfo& info);

/// Why the projected CRS of `info` does not fit its grid: its numbers must be degrees, or they can
/// be, and as lengths lie outside the CRS's area of use. Empty if it fits.
std::string projectedMisfit(const RasterInfo& info);
/// The same for a CRS in place of that of `as_read`, the raster as its file describes it, which may
/// say that the grid is in degrees.
std::string projectedMisfit(const RasterInfo& info, const RasterInfo& as_read);

/// A sentence if the extent of a grid with a projected CRS could be in degrees. Empty otherwise.
std::string doubtAboutExtent(const RasterInfo& info);
/// A sentence if the pixels of a grid with a projected CRS are so small that their sizes could be
/// in degrees. Empty otherwise.
std::string doubtAboutPixels(const RasterInfo& info);

} // namespace marsview
