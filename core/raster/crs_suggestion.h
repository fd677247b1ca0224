// Grids in degrees whose file has no CRS, and CRSs that cannot be meant for a grid.
#pragma once

#include "core/geo/body.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct RasterInfo;

/// What a file says about its axes and its body other than by a CRS.
struct AxisHints {
    std::string degree_axes;    // how the file declares degrees; empty where it does not
    const Body* body = nullptr; // named by the file's metadata or its name; null where unknown
    bool operator==(const AxisHints&) const = default;
};

/// A CRS that fits a grid without one.
struct CrsChoice {
    std::string body; // as in knownBodies
    std::string crs;  // text for Crs::fromText and RasterOverrides::crs: a code, or WKT
    bool operator==(const CrsChoice&) const = default;
};

/// A raster without CRS whose numbers look like degrees of longitude and latitude.
struct CrsSuggestion {
    /// Why: "its extent is 0° – 360°, 90° S – 90° N".
    std::string reason;
    /// One where the file names a body, otherwise the likely ones, Earth first. Never empty.
    std::vector<CrsChoice> choices;
    /// False where only the look of the numbers speaks for degrees: they could be a few metres.
    bool is_certain = false;
    bool operator==(const CrsSuggestion&) const = default;
};

/// Nothing for a raster with a CRS, without georeferencing, or whose extent is not one in degrees.
std::optional<CrsSuggestion> suggestCrs(const RasterInfo& info);

/// The sentence for it in RasterInfo::notices.
std::string noticeOf(const CrsSuggestion& suggestion);
/// The same for the command line, which sets a CRS with --crs and a body with --body.
std::string optionNoticeOf(const CrsSuggestion& suggestion);

/// Whether all sample positions can be longitudes and latitudes in units of which `turn` make a
/// full turn of longitude: at most two turns from 0 and at most half a sample beyond the poles.
bool canBeAngles(const RasterInfo& info, double turn = 360.0);

/// Why the CRS of `info`, which counts in angles, cannot be meant for its grid. Empty where it can.
std::string angularMisfit(const RasterInfo& info);

/// Why the CRS of `info`, a map projection, cannot be meant for its grid, which `as_read`, the same
/// raster as its file describes it, has in degrees. Empty where it can.
std::string projectedMisfit(const RasterInfo& info, const RasterInfo& as_read);

} // namespace marsview
