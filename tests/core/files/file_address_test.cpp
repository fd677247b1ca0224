#include "core/files/file_address.h"

#include <gtest/gtest.h>

#include <utility>

namespace marsview::test {

TEST(FileAddress, IsConvertedToAPath)
{
    for (const auto& [address, path] :
         {std::pair{"file:///a/b.tif", "/a/b.tif"},
          std::pair{"file://localhost/a/b.tif", "/a/b.tif"},
          std::pair{"file://LOCALHOST/a/b.tif", "/a/b.tif"}, std::pair{"FILE:/a/b.tif", "/a/b.tif"},
          std::pair{"file:///a%20b/100%25%2fc.tif", "/a b/100%/c.tif"},
          std::pair{"file:///M%C3%A4rz.tif", "/M\xc3\xa4rz.tif"}}) {
        const Result<std::string> local = localPathOf(address);
        ASSERT_TRUE(local) << address;
        EXPECT_EQ(*local, path);
    }
}

TEST(FileAddress, LeavesOtherTextUnchanged)
{
    for (const char* name : {"a%20b.tif", "/a/b.tif", "https://host/a%20b.tif", "file.tif",
                             "NETCDF:file:variable", "file:b.tif", ""}) {
        const Result<std::string> local = localPathOf(name);
        ASSERT_TRUE(local) << name;
        EXPECT_EQ(*local, name);
    }
}

TEST(FileAddress, IsRefusedWithTheReason)
{
    for (const auto& [address, reason] :
         {std::pair{"file://server/a.tif", "names the computer \"server\""},
          std::pair{"file://localhost", "no path"}, std::pair{"file:///a%2", "percent sign"},
          std::pair{"file:///a%zz", "percent sign"}, std::pair{"file:///a%00b", "percent sign"}}) {
        const Result<std::string> local = localPathOf(address);
        ASSERT_FALSE(local) << address;
        EXPECT_NE(local.error().message.find(reason), std::string::npos) << local.error().message;
        EXPECT_TRUE(local.error().message.starts_with(address));
    }
}

} // namespace marsview::test
