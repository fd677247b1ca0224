#include "tests/support/shared_data.h"

#include <fstream>
#include <sstream>

namespace marsview::test {

std::filesystem::path sharedData()
{
    return std::filesystem::path(MARSVIEW_SHARED_DATA).lexically_normal();
}

bool hasSharedData()
{
    return std::filesystem::exists(sharedData() / "CATALOGUE.tsv");
}

std::filesystem::path bundledSamples()
{
    return MARSVIEW_SAMPLES;
}

std::string bundledMars()
{
    return (bundledSamples() / "mars_mola_4ppd.tif").string();
}

std::string bundledMountain()
{
    return (bundledSamples() / "mount_st_helens_30m.tif").string();
}

std::filesystem::path sourceRoot()
{
    return MARSVIEW_SOURCES;
}

std::vector<CatalogueEntry> catalogue()
{
    std::vector<CatalogueEntry> entries;
    std::ifstream file(sharedData() / "CATALOGUE.tsv");
    std::string line;
    std::getline(file, line); // the header
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        CatalogueEntry entry;
        std::getline(fields, entry.path, '\t');
        std::getline(fields, entry.driver, '\t');
        entries.push_back(entry);
    }
    return entries;
}

} // namespace marsview::test
