#include "core/prepare/checkpoint_file.h"

#include "core/base/deflate.h"
#include "core/base/durable_file.h"
#include "core/files/file_bytes.h"
#include "core/levels/level_file_format.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace marsview {

std::string CheckpointWriter::unfinishedPath(const std::string& path)
{
    return path + ".new";
}

CheckpointWriter::CheckpointWriter(const std::string& path)
    : path_(path)
    , file_(std::fopen(unfinishedPath(path).c_str(), "wb"))
    , has_failed_(!file_)
{}

CheckpointWriter::~CheckpointWriter()
{
    if (file_) {
        file_.reset();
        std::remove(unfinishedPath(path_).c_str());
    }
}

void CheckpointWriter::putBytes(std::span<const std::byte> bytes)
{
    if (bytes.empty()) {
        return; // it may have no address
    }
    checksum_ = crc32Of(bytes, checksum_);
    has_failed_ =
        has_failed_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size();
}

void CheckpointWriter::putGrid(const SampleGrid& samples)
{
    putArray(packedSamples(samples));
}

bool CheckpointWriter::finish()
{
    const std::uint32_t checksum = checksum_;
    put(checksum);
    if (has_failed_ || !flushToDisk(file_.get())) {
        return false;
    }
    file_.reset();
    std::error_code problem;
    std::filesystem::rename(unfinishedPath(path_), path_, problem);
    flushFolderToDisk(std::filesystem::path(path_).parent_path());
    return !problem;
}

std::optional<CheckpointReader> CheckpointReader::open(const std::string& path)
{
    const auto file = FileBytes::open(path);
    if (!file) {
        return std::nullopt;
    }
    auto bytes = file->read(0, file->size());
    std::uint32_t checksum = 0;
    if (!bytes || bytes->size() < sizeof(checksum)) {
        return std::nullopt;
    }
    CheckpointReader reader;
    reader.bytes_ = std::move(bytes).value();
    reader.end_ = reader.bytes_.size() - sizeof(checksum);
    std::memcpy(&checksum, reader.bytes_.data() + reader.end_, sizeof(checksum));
    if (crc32Of(std::span(reader.bytes_.data(), reader.end_)) != checksum) {
        return std::nullopt;
    }
    return reader;
}

bool CheckpointReader::getBytes(std::span<std::byte> bytes)
{
    if (has_failed_ || bytes.size() > left()) {
        return fail();
    }
    std::copy_n(bytes_.data() + at_, bytes.size(), bytes.data());
    at_ += bytes.size();
    return true;
}

std::optional<SampleGrid>
CheckpointReader::getGrid(SampleType type, std::size_t columns, std::size_t rows)
{
    std::vector<std::byte> bytes;
    std::optional<SampleGrid> samples;
    if (getAny(bytes)) {
        samples = unpackSamples(bytes, type, columns, rows);
    }
    if (!samples) {
        fail();
    }
    return samples;
}

} // namespace marsview
