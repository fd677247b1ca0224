// The description of a raster file, and the user's overrides.
#pragma once

#include "core/base/result.h"
#include "core/files/archive_rasters.h"
#include "core/geo/crs.h"
#include "core/geo/geotransform.h"
#include "core/geo/vertical.h"
#include "core/raster/crs_suggestion.h"
#include "core/raster/sample_grid.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// Raw sample to height: height in meters = raw × gain + offset_m.
struct ElevationScale {
    double gain = 1.0;
    double offset_m = 0.0;

    constexpr double height(double raw) const noexcept { return raw * gain + offset_m; }
    bool operator==(const ElevationScale&) const = default;
};

/// What the user can override; see RasterOverrides.
enum class OverrideField {
    Crs,
    Body,
    Radii,
    Transform,
    VerticalUnit,
    Scale,
    Offset,
    VerticalDatum,
    Nodata,
};

/// A notice that is untrue or done once the user overrides any of `settled_by`.
struct FieldNotice {
    std::string text;
    std::vector<OverrideField> settled_by;
    bool operator==(const FieldNotice&) const = default;
};

/// A value of a product's label, or of a file's metadata, that GDAL reads otherwise.
struct LabelCorrection {
    OverrideField field;
    std::string label; // "scale 0.5"
    std::string gdal;  // "scale 1"
    bool operator==(const LabelCorrection&) const = default;
};

/// A unit that fits elevations better than meters, where the file declares none.
struct UnitSuggestion {
    VerticalUnit unit;
    /// An elevation in meters that no place on the body has, which the samples reach if they are
    /// read as meters. Empty if only the unit of the CRS suggests the unit.
    std::optional<double> implausible_m;
    bool operator==(const UnitSuggestion&) const = default;
};

/// Elevations that no place on the body has, although more than one value is so: they are not a
/// mark of nodata. A scale or a unit is missing, or the map shows another body.
struct ElevationMisfit {
    double elevation_m = 0.0;
    double limit_m = 0.0; // the elevation of the highest or the lowest place of the body
    std::string body;     // as in knownBodies
    bool operator==(const ElevationMisfit&) const = default;
};

/// The description of one band of a raster file.
struct RasterInfo {
    std::string path; // the opened file; may differ from the requested one (a label for its data)
    /// All rasters of the archive that was opened, if there are several; see archiveNotice().
    std::vector<ArchiveRaster> in_archive;
    /// The file that was requested if another one was opened: the data of a label, for example.
    std::string requested;
    /// For a raster on a server: identifies its version. Empty for files.
    std::string remote_version;
    /// The server identifies versions by ETag or time, so that cached data can be matched to this
    /// version later. Otherwise at most the size shows a change.
    bool has_named_version = false;
    std::string driver; // GDAL's short name, "GTiff"
    std::size_t columns = 0;
    std::size_t rows = 0;
    int band = 1; // counted from 1
    int band_count = 1;
    SampleType type = SampleType::Int16;
    std::optional<double> nodata; // raw
    /// Further raw values that mark nodata: special constants of the product's label.
    std::vector<double> other_nodata;
    bool has_mask_band = false; // a mask band marks further voids

    double scale = 1.0; // value = raw × scale + offset, in `unit`
    double offset = 0.0;
    VerticalUnit unit;
    bool is_unit_declared = false;     // otherwise meters are assumed
    std::optional<double> typical_raw; // a valid sample, if one was searched for
    /// For values that are distances from the body's center: the radius in meters that is
    /// subtracted to get heights.
    std::optional<double> reference_radius_m;
    std::string vertical_datum; // empty if unknown

    /// Empty if the file has none, or one that cannot be inverted.
    std::optional<GeoTransform> transform;
    std::optional<Crs> crs;
    const Body* body = nullptr; // of the CRS, or set by the user; null if unknown
    AxisHints axis_hints;       // axes and body from metadata other than a CRS
    /// For a grid without a fitting CRS that appears to be in degrees.
    std::optional<CrsSuggestion> crs_suggestion;
    /// A raw value at an end of the samples' range that usually marks nodata, where the file
    /// declares none. Set by noteSuspiciousSamples().
    std::optional<double> nodata_suggestion;
    /// Set by noteSuspiciousSamples().
    std::optional<UnitSuggestion> unit_suggestion;
    /// Set by noteSuspiciousSamples().
    std::optional<ElevationMisfit> elevation_misfit;
    /// The sentence about a CRS of the file that cannot be that of its grid, and is not used; it is
    /// among the notices. Empty without one.
    std::string unused_crs_notice;

    /// Observations, assumptions and corrections, as sentences for the user.
    std::vector<std::string> notices;
    std::vector<FieldNotice> field_notices; // those of the notices that depend on a field
    std::string label_name; // of the label that has the corrections; empty: the file's metadata
    std::vector<LabelCorrection> label_corrections;

    /// Adds a notice that no longer applies if the user overrides any of these fields.
    void addNotice(std::string text, std::vector<OverrideField> settled_by);
    /// The sentence about the requested file that is among the notices; empty without any.
    std::string replacementNotice() const;
    /// The sentence about the corrections that is among the notices; empty without any.
    std::string labelNotice() const;

    ElevationScale elevationScale() const noexcept;
    /// Whether the nodata value does not mark all voids.
    bool needsVoidMask() const noexcept { return has_mask_band || !other_nodata.empty(); }
    /// The settings that decide which samples are void, for the keys of derived files; empty if
    /// none are declared.
    std::string voidSettings() const;
    /// Number of triangles of the surface, two per cell.
    std::uint64_t triangleCount() const noexcept;
};

/// Values set by the user in place of the file's. The file itself is never changed.
struct RasterOverrides {
    std::optional<std::string> crs{};     // text as for Crs::fromText
    std::optional<std::string> body{};    // name as for bodyNamed
    std::optional<Ellipsoid> ellipsoid{}; // radii in meters
    std::optional<GeoTransform::Terms> transform{};
    std::optional<std::string> vertical_unit{}; // spelling as for verticalUnitFrom
    std::optional<double> scale{};  // value = raw × scale + offset, in the vertical unit
    std::optional<double> offset{}; // finite, like the scale, which also must not be 0
    std::optional<std::string> vertical_datum{}; // a name for display
    std::optional<double> nodata{};              // raw

    bool operator==(const RasterOverrides&) const = default;
    bool isEmpty() const { return *this == RasterOverrides{}; }
};

/// Adds a notice if the CRS is missing or does not fit the placement. Sets the CRS suggestion.
void notePlacement(RasterInfo& info);

/// The field that an error of withOverrides() concerns, for showing it next to that field. Empty
/// for other errors. A path before the sentence is skipped.
std::optional<OverrideField> refusedField(const Error& error);

/// `info` as the file describes it, with the overrides applied. A CRS of the file in degrees is not
/// used for a grid that cannot be in degrees. Errors begin with the name of the
/// option ("scale: …"; see refusedField) and say why it cannot be used. A CRS in degrees is refused
/// for a grid that cannot be in degrees, and a map projection for a grid that must be.
Result<RasterInfo> withOverrides(RasterInfo info, const RasterOverrides& overrides);

/// Adds a notice if the file seems to have undeclared voids or an undeclared unit, has only voids,
/// or has values that cannot be elevations. Sets the suggestions of nodata and unit, and the
/// misfit.
void noteSuspiciousSamples(RasterInfo& info, const SampleStatistics& statistics);

/// The sentence in RasterInfo::notices that corresponds to a nodata suggestion.
std::string noticeOfNodata(double raw);

/// Decides whether values are heights or radii (see RasterInfo::reference_radius_m) and names the
/// datum accordingly. Call whenever scale, unit, CRS or body changed.
void deduceHeightReference(RasterInfo& info);

/// An error with `path` in its message if the raster has fewer than 2 × 2 samples.
Status checkIsSurface(const std::string& path, const RasterInfo& info);

} // namespace marsview
