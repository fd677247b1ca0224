#include "core/files/gdal_file.h"
#include "core/files/gdal_runtime.h"
#include "core/files/shared_file.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace marsview {
namespace {

using test::TempFolder;

std::string bytesOf(std::size_t count)
{
    std::string bytes(count, '\0');
    std::uint32_t state = 1;
    std::generate(bytes.begin(), bytes.end(), [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<char>(state >> 24U);
    });
    return bytes;
}

TEST(SharedFile, IsOpenedAgainOnlyAfterItsLastOwner)
{
    const TempFolder folder;
    const std::string path = folder.write("map.tif", "first");
    std::filesystem::create_symlink(path, folder.file("link.tif"));
    auto first = openShared(path);
    ASSERT_TRUE(first);
    EXPECT_EQ(openShared(path), first);
    EXPECT_EQ(openShared(folder.file("link.tif")), first);
    const std::weak_ptr<const SharedFile> watched = first;
    first.reset();
    EXPECT_TRUE(watched.expired());
    EXPECT_TRUE(openShared(path));
}

TEST(SharedFile, IsTheFileThatThePathLeadsToNow)
{
    const TempFolder folder;
    const std::string path = folder.write("map.tif", "first");
    const auto before = openShared(path);
    std::filesystem::rename(folder.write("new.tif", "second"), path);
    const auto after = openShared(path);
    ASSERT_TRUE(before && after);
    std::string text(6, ' ');
    EXPECT_EQ(after->read(text.data(), text.size(), 0), 6U);
    EXPECT_EQ(text, "second");
    EXPECT_EQ(before->read(text.data(), text.size(), 0), 5U);
    EXPECT_EQ(text.substr(0, 5), "first");
    std::filesystem::remove(path);
    EXPECT_FALSE(openShared(path));
    EXPECT_FALSE(openShared(folder.path().string()));
}

TEST(SharedFile, StaysOpenWhereItIsKept)
{
    const TempFolder folder;
    ensureGdal();
    const std::string path = folder.write("map.tif", "bytes");
    std::weak_ptr<const SharedFile> watched;
    OpenFiles files;
    {
        const KeepOpen outer;
        {
            const KeepOpen inner;
            EXPECT_TRUE(openGdalFile(path));
            files = inner.files();
        }
        ASSERT_EQ(files.size(), 1U);
        watched = files.front();
        EXPECT_EQ(outer.files(), files);
        files.clear();
        EXPECT_FALSE(watched.expired());
        EXPECT_EQ(openShared(path), watched.lock());
    }
    EXPECT_TRUE(watched.expired());
}

// Against reads of the whole content, at random positions and sizes around those of the buffer.
TEST(SharedFile, GivesGdalTheBytesOfTheFile)
{
    const TempFolder folder;
    ensureGdal();
    const std::string content = bytesOf(20'000);
    const GdalFile file = openGdalFile(folder.write("map.bin", content));
    ASSERT_TRUE(file);
    test::Random random;
    std::size_t at = 0;
    for (int i = 0; i < 5000; ++i) {
        if (random.below(3) != 0) {
            at = random.below(content.size() + 10);
            ASSERT_EQ(VSIFSeekL(file.get(), at, SEEK_SET), 0);
            EXPECT_EQ(VSIFEofL(file.get()), 0);
        }
        ASSERT_EQ(VSIFTellL(file.get()), at);
        const std::size_t count = 1 + random.below(random.below(2) == 0 ? 20 : 9000);
        const std::size_t left = at < content.size() ? content.size() - at : 0;
        std::string read(count, '\0');
        ASSERT_EQ(VSIFReadL(read.data(), 1, count, file.get()), std::min(count, left));
        EXPECT_EQ(VSIFEofL(file.get()) != 0, count > left);
        ASSERT_EQ(read.substr(0, std::min(count, left)),
                  content.substr(std::min(at, content.size()), count));
        at += std::min(count, left);
    }
    ASSERT_EQ(VSIFSeekL(file.get(), 0, SEEK_END), 0);
    EXPECT_EQ(VSIFTellL(file.get()), content.size());
    errno = ENOENT;
    char beyond = 0;
    EXPECT_EQ(VSIFReadL(&beyond, 1, 1, file.get()), 0U);
    EXPECT_EQ(errno, 0); // no failure
    EXPECT_EQ(VSIFWriteL("x", 1, 1, file.get()), 0U);
}

} // namespace
} // namespace marsview
