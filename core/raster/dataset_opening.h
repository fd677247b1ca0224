// From a path or address to the open GDAL dataset.
#pragma once

#include "core/base/result.h"
#include "core/files/remote_raster.h"
#include "core/raster/mosaic.h"

#include <gdal_priv.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

struct OpenedDataset {
    GDALDatasetUniquePtr dataset;
    std::string name;                       // that GDAL opened
    std::optional<RemoteVersion> remote{};  // for a raster on a server
    std::shared_ptr<const Mosaic> mosaic{}; // of a folder of rasters
    std::string label{};                    // of a product whose samples are in a TIFF or JPEG2000
    bool prints = false;                    // a library prints lines to stderr
};

/// Opens what the user named: a file, label, header, archive, folder, address or connection string
/// of GDAL. `band` counts from 1 and is that of the rasters in a folder. Errors begin with the
/// path.
Result<OpenedDataset> openDataset(const std::string& path, int band);

// One kind each, to open it again. Errors without the path, except for a server's.

/// The first possible of GDAL's names; errors as for openFirst().
Result<OpenedDataset> openLocalDataset(const std::vector<std::string>& names);
/// The virtual raster of a mosaic, whose parts were opened before.
Result<GDALDatasetUniquePtr> openMosaicDataset(const Mosaic& mosaic);
/// On the condition that its version is `version`.
Result<GDALDatasetUniquePtr> openRemoteDataset(const std::string& name,
                                               const RemoteVersion& version);

} // namespace marsview
