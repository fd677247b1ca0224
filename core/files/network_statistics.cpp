#include "core/files/network_statistics.h"

#include "core/files/gdal_runtime.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <memory>
#include <nlohmann/json.hpp>

namespace marsview {
namespace {

struct CplFree {
    void operator()(char* text) const { CPLFree(text); }
};

} // namespace

void countNetworkUse()
{
    ensureGdal();
    CPLSetConfigOption("CPL_VSIL_NETWORK_STATS_ENABLED", "YES");
}

NetworkStatistics networkStatistics()
{
    const std::unique_ptr<char, CplFree> text(VSINetworkStatsGetAsSerializedJSON(nullptr));
    NetworkStatistics statistics;
    const auto json = nlohmann::json::parse(text ? text.get() : "", nullptr, false);
    // {"methods": {"GET": {"count": 3, "downloaded_bytes": 49152}, "HEAD": {"count": 1}}, …}
    if (json.is_object() && json.contains("methods")) {
        for (const auto& [name, method] : json["methods"].items()) {
            statistics.request_count += method.value("count", std::uint64_t{0});
            statistics.downloaded_bytes += method.value("downloaded_bytes", std::uint64_t{0});
        }
    }
    return statistics;
}

} // namespace marsview
