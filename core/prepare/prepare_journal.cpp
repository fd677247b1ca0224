#include "core/prepare/prepare_journal.h"

#include "core/base/deflate.h"
#include "core/prepare/tiff_tiles.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <unistd.h>

namespace marsview {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kChecksumBytes = 4;

std::uint32_t checksumOf(const std::vector<std::uint8_t>& bytes, std::size_t count)
{
    return crc32Of(std::as_bytes(std::span(bytes).first(count)));
}

int writeWhole(const std::string& path, const std::vector<std::uint8_t>& bytes)
{
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        return errno;
    }
    int failure = 0;
    for (std::size_t at = 0; at < bytes.size() && failure == 0;) {
        const ssize_t count = write(file, bytes.data() + at, bytes.size() - at);
        if (count < 0 && errno != EINTR) {
            failure = errno;
        }
        at += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    if (failure == 0 && fdatasync(file) != 0) {
        failure = errno;
    }
    if (close(file) != 0 && failure == 0) {
        failure = errno;
    }
    return failure;
}

} // namespace

Status writeJournal(const std::string& path, const PrepareJournal& journal)
{
    Json json;
    json["key"] = journal.key;
    json["source_stamp"] = journal.source_stamp;
    json["tile_rows"] = journal.tile_rows;
    json["tile_rows_all"] = journal.tile_rows_all;
    json["file_bytes"] = journal.file_bytes;
    json["overviews"] = Json::binary(journal.overviews);
    std::vector<std::uint8_t> bytes = Json::to_cbor(json);
    std::uint32_t checksum = checksumOf(bytes, bytes.size());
    for (std::size_t i = 0; i < kChecksumBytes; ++i) {
        bytes.push_back(static_cast<std::uint8_t>(checksum & 0xFFU));
        checksum >>= 8U;
    }
    const std::string unfinished = path + ".new";
    int failure = writeWhole(unfinished, bytes);
    if (failure == 0 && std::rename(unfinished.c_str(), path.c_str()) != 0) {
        failure = errno;
    }
    if (failure != 0) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        return writeError(path, failure, "cannot be written");
    }
    return Done{};
}

std::optional<PrepareJournal> readJournal(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.size() <= kChecksumBytes) {
        return std::nullopt;
    }
    const std::size_t content = bytes.size() - kChecksumBytes;
    std::uint32_t checksum = checksumOf(bytes, content);
    for (std::size_t i = 0; i < kChecksumBytes; ++i) {
        if (bytes[content + i] != static_cast<std::uint8_t>(checksum & 0xFFU)) {
            return std::nullopt;
        }
        checksum >>= 8U;
    }
    bytes.resize(content);
    Json json = Json::from_cbor(bytes, true, false);
    if (json.is_discarded() || !json.is_object()) {
        return std::nullopt;
    }
    try {
        PrepareJournal journal;
        journal.key = json.at("key").get<std::string>();
        journal.source_stamp = json.value("source_stamp", std::string());
        journal.tile_rows = json.at("tile_rows").get<std::uint64_t>();
        journal.tile_rows_all = json.at("tile_rows_all").get<std::uint64_t>();
        journal.file_bytes = json.at("file_bytes").get<std::uint64_t>();
        journal.overviews = std::move(json.at("overviews").get_binary());
        return journal;
    } catch (const Json::exception&) {
        return std::nullopt; // of another version
    }
}

} // namespace marsview
