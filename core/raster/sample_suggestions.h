// What the samples suggest that a file does not declare: its nodata value and its unit.
#pragma once

#include "core/raster/raster_info.h"

#include <optional>
#include <string>

namespace marsview {

/// A nodata suggestion that no elevation on any body has: a window may read it as nodata until its
/// user decides. Empty if there is no suggestion, or if it may be an elevation.
std::optional<double> certainNodata(const RasterInfo& info);

/// Feet for a map of the Earth without a declared unit, if in meters it would be higher or lower
/// than any place on the Earth but not in feet, or if the unit of its CRS is the foot. Samples of
/// the nodata suggestion are ignored.
std::optional<UnitSuggestion> suggestUnit(const RasterInfo& info,
                                          const SampleStatistics& statistics);

/// Sets the suggestion of `info` from the samples that are known, which may be a part of all, and
/// adds its notice.
void noteUnit(RasterInfo& info, const SampleStatistics& statistics);

/// Elevations that the body does not have (known_elevations.h), if they are not a single value far
/// from the rest, as nodata is. The suggestions of `info` must be set.
std::optional<ElevationMisfit> findMisfit(const RasterInfo& info,
                                          const SampleStatistics& statistics);

/// As noteUnit(), and notes elevations that the body does not have. Few samples suffice.
void noteElevations(RasterInfo& info, const SampleStatistics& statistics);

enum class SampleEnd { Lowest, Highest };
/// Whether the lowest or the highest value is farther from the next one than this share of the
/// range of the values between both ends. True if the next one is not known.
bool isIsolated(const SampleStatistics& statistics, SampleEnd end, double share_of_rest);

/// The corresponding sentence in RasterInfo::notices, and for the command line with its options.
std::string noticeOf(const ElevationMisfit& misfit);
std::string optionNoticeOf(const ElevationMisfit& misfit);

/// The corresponding sentence in RasterInfo::notices.
std::string noticeOf(const UnitSuggestion& suggestion);
/// The same for the command line, which sets a unit with --unit.
std::string optionNoticeOf(const UnitSuggestion& suggestion);

} // namespace marsview
