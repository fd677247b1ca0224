#include "core/base/deflate.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>
#include <zlib.h>

namespace marsview {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytesOf(const char* text)
{
    Bytes bytes(std::strlen(text));
    std::memcpy(bytes.data(), text, bytes.size());
    return bytes;
}

Bytef* zlibs(Bytes& bytes)
{
    return reinterpret_cast<Bytef*>(bytes.data());
}

TEST(Deflate, ChecksumsAreThoseOfTheStandards)
{
    // The check value of CRC-32 (ISO-HDLC), and RFC 1950's Adler-32 of the same text.
    EXPECT_EQ(crc32Of(bytesOf("123456789")), 0xCBF43926U);
    EXPECT_EQ(adler32Of(bytesOf("123456789")), 0x091E01DEU);
    EXPECT_EQ(crc32Of({}), 0U);
    EXPECT_EQ(adler32Of({}), 1U);
}

TEST(Deflate, ChecksumsCanBeComputedInParts)
{
    EXPECT_EQ(crc32Of(bytesOf("6789"), crc32Of(bytesOf("12345"))), 0xCBF43926U);
    EXPECT_EQ(adler32Of(bytesOf("6789"), adler32Of(bytesOf("12345"))), 0x091E01DEU);
    EXPECT_EQ(crc32Of({}, 0xCBF43926U), 0xCBF43926U);
    EXPECT_EQ(adler32Of({}, 0x091E01DEU), 0x091E01DEU);
}

TEST(Deflate, ZlibReadsItsOutput)
{
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{70'000}}) {
        Bytes plain(count, std::byte{7});
        Bytes stream = deflated(plain, 1);
        EXPECT_LE(stream.size(), deflatedBytesMax(count));
        Bytes read(count + 1);
        uLongf size = read.size();
        ASSERT_EQ(uncompress(zlibs(read), &size, zlibs(stream), stream.size()), Z_OK);
        EXPECT_EQ(size, count);
        read.resize(count);
        EXPECT_EQ(read, plain);
    }
}

TEST(Deflate, ReadsOutputOfZlib)
{
    Bytes plain = bytesOf("the same again, the same again, the same again");
    Bytes stream(compressBound(plain.size()));
    uLongf size = stream.size();
    ASSERT_EQ(compress(zlibs(stream), &size, zlibs(plain), plain.size()), Z_OK);
    stream.resize(size);
    Bytes read(plain.size());
    EXPECT_TRUE(inflate(stream, read));
    EXPECT_EQ(read, plain);
}

TEST(Deflate, RefusesDamagedStreamsAndWrongSizes)
{
    const Bytes plain = bytesOf("the same again, the same again, the same again");
    const Bytes stream = deflated(plain, 6);
    Bytes shorter(plain.size() - 1);
    EXPECT_FALSE(inflate(stream, shorter));
    Bytes longer(plain.size() + 1);
    EXPECT_FALSE(inflate(stream, longer));
    Bytes read(plain.size());
    EXPECT_FALSE(inflate({}, read));
    for (std::size_t length = 1; length < stream.size(); ++length) {
        EXPECT_FALSE(inflate(std::span(stream).first(length), read)) << length;
    }
    Bytes more = stream;
    more.push_back(std::byte{0});
    EXPECT_FALSE(inflate(more, read));
    Bytes damaged = stream;
    damaged.back() ^= std::byte{1}; // of the checksum at the end
    EXPECT_FALSE(inflate(damaged, read));
}

} // namespace
} // namespace marsview
