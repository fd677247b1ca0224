// A file of GDAL's file systems (/vsicurl/…, /vsizip/…) that closes itself.
#pragma once

#include <cpl_vsi.h>

#include <memory>
#include <string>

namespace marsview {

struct GdalFileCloser {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using GdalFile = std::unique_ptr<VSILFILE, GdalFileCloser>;

/// Opens for reading. Null if it cannot be opened; GDAL's error is reported to its handler.
inline GdalFile openGdalFile(const std::string& path)
{
    return GdalFile(VSIFOpenL(path.c_str(), "rb"));
}

} // namespace marsview
