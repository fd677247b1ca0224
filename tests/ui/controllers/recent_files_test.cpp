#include "ui/controllers/recent_files.h"

#include <gtest/gtest.h>

namespace marsview {
namespace {

TEST(RecentFileNames, ShowFoldersIfNamesAreEqual)
{
    EXPECT_EQ(namesFor({QStringLiteral("/data/mars/dem.tif"), QStringLiteral("/data/moon/dem.tif"),
                        QStringLiteral("/data/earth.tif")}),
              (QStringList{QStringLiteral("dem.tif — mars/"), QStringLiteral("dem.tif — moon/"),
                           QStringLiteral("earth.tif")}));
}

TEST(RecentFileNames, ShowAsManyFoldersAsDistinguishThem)
{
    EXPECT_EQ(
        namesFor({QStringLiteral("/a/one/tiles/x.hgt"), QStringLiteral("/a/two/tiles/x.hgt")}),
        (QStringList{QStringLiteral("x.hgt — one/tiles/"), QStringLiteral("x.hgt — two/tiles/")}));
    EXPECT_EQ(namesFor({QStringLiteral("/tiles/x.hgt"), QStringLiteral("/a/tiles/x.hgt")}),
              (QStringList{QStringLiteral("x.hgt — tiles/"), QStringLiteral("x.hgt — a/tiles/")}));
}

TEST(RecentFileNames, AreThoseOfAddressesToo)
{
    EXPECT_EQ(
        namesFor(
            {QStringLiteral("https://one.org/dem.tif"), QStringLiteral("https://two.org/dem.tif")}),
        (QStringList{QStringLiteral("dem.tif — one.org/"), QStringLiteral("dem.tif — two.org/")}));
}

TEST(RecentFileNames, StayAloneWhereTheyAre)
{
    EXPECT_EQ(namesFor({}), QStringList());
    EXPECT_EQ(namesFor({QStringLiteral("dem.tif")}), QStringList{QStringLiteral("dem.tif")});
}

} // namespace
} // namespace marsview
