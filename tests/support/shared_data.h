// Where the real data lies.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace marsview::test {

/// The folder of real elevation data, which is not part of the source tree. May not exist.
std::filesystem::path sharedData();
bool hasSharedData();

/// resources/samples, which is part of the source tree.
std::filesystem::path bundledSamples();
/// Of those: Mars as a whole, geographic; a mountain on the Earth, projected.
std::string bundledMars();
std::string bundledMountain();

/// The root of the source tree.
std::filesystem::path sourceRoot();

/// One line of the folder's CATALOGUE.tsv.
struct CatalogueEntry {
    std::string path;   // relative to sharedData()
    std::string driver; // "DOES NOT OPEN" for labels' data, headers and broken files
};

/// Empty where the data is absent.
std::vector<CatalogueEntry> catalogue();

} // namespace marsview::test

/// Leaves the test, with a sentence, where the real data is absent.
#define MARSVIEW_NEEDS_SHARED_DATA()                                                               \
    if (!::marsview::test::hasSharedData())                                                        \
    GTEST_SKIP() << "the real elevation data is not at " << ::marsview::test::sharedData()         \
                 << "; set MARSVIEW_SHARED_DATA"
