// The location of the real data.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace marsview::test {

/// The folder of real elevation data, which is not part of the source tree. It may be missing.
std::filesystem::path sharedData();
bool hasSharedData();

/// resources/samples, which is part of the source tree.
std::filesystem::path bundledSamples();
/// In that folder: all of Mars, geographic; a mountain on the Earth, projected.
std::string bundledMars();
std::string bundledMountain();

/// The root of the source tree.
std::filesystem::path sourceRoot();

/// One line of the folder's CATALOGUE.tsv.
struct CatalogueEntry {
    std::string path;   // relative to sharedData()
    std::string driver; // "DOES NOT OPEN" for data files of labels, headers and broken files
};

/// Empty if the data is missing.
std::vector<CatalogueEntry> catalogue();

} // namespace marsview::test

/// Skips the test with a message if the real data is missing.
#define MARSVIEW_NEEDS_SHARED_DATA()                                                               \
    if (!::marsview::test::hasSharedData())                                                        \
    GTEST_SKIP() << "the real elevation data is not at " << ::marsview::test::sharedData()         \
                 << "; set MARSVIEW_SHARED_DATA"
