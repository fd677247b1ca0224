#include "core/raster/gdal_runtime.h"

#include <cpl_conv.h>
#include <gdal_priv.h>

#include <algorithm>
#include <mutex>

namespace marsview {
namespace {

// Enough for a row of 256² int16 tiles across 100 000 columns; GDAL's default, 5 % of the memory,
// would hold whole maps twice.
constexpr GIntBig kBlockCacheBytes = GIntBig{32} << 20;

// GDAL's texts end in full stops and may run over several lines.
std::string asOneLine(const char* text)
{
    std::string line(text);
    std::replace(line.begin(), line.end(), '\n', ' ');
    while (!line.empty() && (line.back() == '.' || line.back() == ' ')) {
        line.pop_back();
    }
    return line;
}

} // namespace

void ensureGdal()
{
    static std::once_flag once;
    std::call_once(once, [] {
        CPLSetErrorHandler(CPLQuietErrorHandler);
        CPLSetConfigOption("GDAL_PAM_ENABLED", "YES");
        CPLSetConfigOption("GDAL_NUM_THREADS", "ALL_CPUS"); // compressed tiles decode in parallel
        GDALSetCacheMax64(kBlockCacheBytes);
        GDALAllRegister();
    });
}

GdalMessages::GdalMessages()
{
    CPLPushErrorHandlerEx(collect, this);
}

GdalMessages::~GdalMessages()
{
    CPLPopErrorHandler();
    CPLErrorReset();
}

std::string GdalMessages::firstFailure(const std::string& otherwise) const
{
    return failures_.empty() ? otherwise : failures_.front();
}

void GdalMessages::collect(CPLErr level, CPLErrorNum, const char* text)
{
    auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (level == CE_Failure || level == CE_Fatal) {
        self->failures_.push_back(asOneLine(text));
    } else if (level == CE_Warning) {
        self->warnings_.push_back(asOneLine(text));
    }
}

} // namespace marsview
