// Reads from a product's label how its samples become elevations.
//
// GDAL 3.6 ignores some of this: everything for PDS3 products in JPEG2000 or TIFF, PDS3 units,
// numbers in quotes, lists or other bases, void constants under other names, and labels next to a
// data file that is opened without them.
#pragma once

#include "core/raster/raster_info.h"
#include "core/raster/sample_type.h"

#include <optional>
#include <string>
#include <vector>

class GDALDataset;

namespace marsview {

/// A value of a label that should be a number.
struct UnreadNumber {
    OverrideField field; // Scale, Offset or Nodata
    std::string name;    // "SCALING_FACTOR"
    std::string text;    // as it is written
};

/// The label's description of the samples; empty fields if it has none.
struct LabelElevation {
    std::string path;            // of the label
    std::optional<double> scale; // value = raw × scale + offset, in `unit`
    std::optional<double> offset;
    std::vector<double> nodata; // raw: all special constants
    std::string unit;           // as it is written
    std::optional<bool> is_signed;
    std::optional<double> columns; // of the samples
    std::optional<double> rows;
    std::vector<UnreadNumber> unread;
    bool is_understood = true; // false for a label without a description of samples

    /// Whether it has a scale, be it a number or not.
    bool hasScale() const;
};

/// From a PDS3, ISIS 2, ISIS 3 or PDS4 label in `text`, for samples of that type.
std::optional<LabelElevation> labelElevationIn(const std::string& text, int band, SampleType type);

/// Of the label that `dataset` was opened through, or, for a TIFF or JPEG2000, of the label at
/// `label_path`, which may be empty. Nothing for other formats. `info` has driver, path, band and
/// type.
std::optional<LabelElevation>
labelElevationOf(GDALDataset& dataset, const RasterInfo& info, const std::string& label_path);

/// Replaces GDAL's values in `info` by those of the label and adds one notice that names the
/// differences.
void applyLabel(RasterInfo& info, const LabelElevation& label);

/// A sentence if the TIFF with the samples of an ISIS 3 label has its own scale or offset that
/// differs and is not applied. `info` is after applyLabel.
std::optional<std::string> noticeOfUnusedScale(GDALDataset& dataset, const RasterInfo& info);

bool isJpeg2000Name(const std::string& path);

/// The PDS3, PDS4 or ISIS 3 label that describes a data file in the same folder or archive: one
/// that names it, or else, for a JPEG2000, one of the same name. At a server only names in the
/// letter case of the data file's own are tried, with one request each. Empty if there is none.
std::string labelNextTo(const std::string& data_path);

/// The TIFF or JPEG2000 with the samples of a PDS3 label; the case of its name is ignored. GDAL 3.6
/// finds a compressed file only with the exact case, and reads one that the label declares as a
/// plain image as if its bytes were samples. Empty for other products, and if the file is missing.
std::string encodedImageOf(const std::string& label_path);

} // namespace marsview
