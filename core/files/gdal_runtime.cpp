#include "core/files/gdal_runtime.h"

#include "core/files/block_cache.h"
#include "core/files/gdal_drivers.h"
#include "core/files/gdal_shared_files.h"

#include <cpl_conv.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <mutex>

namespace marsview {
namespace {

// Enough for a row of 256² int16 tiles across 100 000 columns; GDAL's default, 5 % of the memory,
// would keep a second copy of whole maps. Scattered reads need more (allowLargeBlockCache()).
constexpr GIntBig kBlockCacheBytes = GIntBig{32} << 20;

// Retries and timeouts for reading from servers; most concern only HTTP. The user's settings take
// precedence. GDAL's chunks of 16 KiB are kept: with 32 or 64 KiB, opening a map of 16384² samples
// and reading its first tile took as many requests and 1.5 or 2 times the bytes.
void setDefaults()
{
    struct Option {
        const char* name;
        const char* value;
    };
    constexpr std::array<Option, 9> options{{
        {"GDAL_PAM_ENABLED", "YES"},
        {"CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO"}, // no files next to those that are read
        {"GDAL_NUM_THREADS", "ALL_CPUS"},         // compressed tiles decode in parallel
        {"GDAL_HTTP_CONNECTTIMEOUT", "10"},       // seconds
        // Fewer bytes per second than this, for this many seconds, count as a timeout.
        {"GDAL_HTTP_LOW_SPEED_LIMIT", "100"},
        {"GDAL_HTTP_LOW_SPEED_TIME", "10"},
        {"GDAL_HTTP_MAX_RETRY", "3"}, // after 0.25, some 0.5 and 1.2 seconds
        {"GDAL_HTTP_RETRY_DELAY", "0.25"},
        {"GDAL_HTTP_TCP_KEEPALIVE", "YES"},
    }};
    for (const Option& option : options) {
        if (!hasUserOption(option.name)) {
            CPLSetConfigOption(option.name, option.value);
        }
    }
}

// GDAL's messages end in a full stop and may span several lines.
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

bool hasUserOption(const char* name)
{
    return CPLGetConfigOption(name, nullptr) != nullptr;
}

void ensureGdal()
{
    static std::once_flag once;
    std::call_once(once, [] {
        CPLSetErrorHandler(CPLQuietErrorHandler);
        shareFilesOfGdal();
        GDALAllRegister(); // also reads the user's configuration file
        leaveOutDrivers();
        setDefaults();
        if (!hasUserOption("GDAL_CACHEMAX")) {
            GDALSetCacheMax64(kBlockCacheBytes);
        }
    });
}

std::size_t blockCacheBytes()
{
    ensureGdal();
    return static_cast<std::size_t>(GDALGetCacheMax64());
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

void GdalMessages::collect(CPLErr level, CPLErrorNum number, const char* text)
{
    auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (level == CE_Failure || level == CE_Fatal) {
        self->failures_.push_back(asOneLine(text));
    } else if (level == CE_Warning) {
        self->warnings_.push_back(asOneLine(text));
    } else if (level == CE_Debug) {
        CPLDefaultErrorHandler(level, number, text); // the user set CPL_DEBUG
    }
}

} // namespace marsview
