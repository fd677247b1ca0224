#include "tests/architecture/folder_graph.h"

#include <gtest/gtest.h>

namespace marsview::test {
namespace {

using Folders = std::vector<std::string>;

TEST(FolderGraph, OrderedFoldersHaveNoCycle)
{
    const std::vector<Include> includes{
        {"a/x.cpp", "a/x.h"}, {"a/x.cpp", "b/y.h"}, {"a/x.cpp", "c/z.h"}, {"b/y.cpp", "c/z.h"}};
    EXPECT_TRUE(folderCycles(includes).empty());
}

TEST(FolderGraph, ReportsACycleWithItsIncludes)
{
    // No file includes another in a circle; the folders do.
    const std::vector<Include> includes{
        {"a/x.cpp", "b/y.h"}, {"a/w.cpp", "b/y.h"}, {"b/v.cpp", "a/u.h"}, {"b/v.cpp", "c/z.h"}};
    const std::vector<FolderCycle> cycles = folderCycles(includes);
    ASSERT_EQ(cycles.size(), 1U);
    EXPECT_EQ(cycles[0].folders, (Folders{"a", "b"}));
    EXPECT_EQ(cycles[0].includes, (std::vector<Include>{includes[0], includes[1], includes[2]}));
}

TEST(FolderGraph, FindsALongCycleWithoutFoldersThatOnlyLeadToIt)
{
    const std::vector<Include> includes{
        {"a/x.h", "b/x.h"}, {"b/x.h", "c/x.h"}, {"c/y.h", "d/x.h"}, {"d/x.h", "b/y.h"}};
    const std::vector<FolderCycle> cycles = folderCycles(includes);
    ASSERT_EQ(cycles.size(), 1U);
    EXPECT_EQ(cycles[0].folders, (Folders{"b", "c", "d"}));
}

TEST(FolderGraph, FindsACycleBetweenAFolderAndItsSubfolder)
{
    const std::vector<Include> includes{{"a/x.h", "a/b/x.h"}, {"a/b/y.h", "a/y.h"}};
    const std::vector<FolderCycle> cycles = folderCycles(includes);
    ASSERT_EQ(cycles.size(), 1U);
    EXPECT_EQ(cycles[0].folders, (Folders{"a", "a/b"}));
}

TEST(FolderGraph, ReportsSeparateCyclesOnceEach)
{
    const std::vector<Include> includes{{"a/x.h", "b/x.h"}, {"b/y.h", "a/y.h"}, {"b/y.h", "c/x.h"},
                                        {"c/x.h", "d/x.h"}, {"d/y.h", "c/y.h"}, {"c/z.h", "e/x.h"},
                                        {"e/x.h", "c/u.h"}};
    const std::vector<FolderCycle> cycles = folderCycles(includes);
    ASSERT_EQ(cycles.size(), 2U);
    EXPECT_EQ(cycles[0].folders, (Folders{"a", "b"}));
    EXPECT_EQ(cycles[1].folders, (Folders{"c", "d"}));
}

TEST(FolderGraph, FilesBelongToTheirOwnFolderOnly)
{
    const Folders paths{"a/1.h", "a/2.h", "a/3.h", "a/b/1.h", "a/b/2.h"};
    using Counts = std::map<std::string, std::size_t>;
    EXPECT_EQ(crowdedFolders(paths, 2), (Counts{{"a", 3}}));
    EXPECT_EQ(crowdedFolders(paths, 3), Counts{});
}

} // namespace
} // namespace marsview::test
