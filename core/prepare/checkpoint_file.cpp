#include "core/prepare/checkpoint_file.h"

#include "core/base/deflate.h"
#include "core/base/durable_file.h"
#include "core/levels/level_file_format.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;

std::size_t rowsAtOnce(const SampleGrid& samples)
{
    return std::max<std::size_t>(1, 4 * kPieceBytes /
                                        (samples.columns() * sampleBytes(samples.type())));
}

SampleGrid copyOfRows(const SampleGrid& samples, std::size_t first, std::size_t end)
{
    SampleGrid rows = SampleGrid::create(samples.type(), samples.columns(), end - first).value();
    samples.visit([&](auto values) {
        std::memcpy(rows.rowData(0), values.row(first).data(),
                    rows.rows() * rows.columns() * sampleBytes(rows.type()));
    });
    for (std::size_t row = first; samples.hasVoids() && row < end; ++row) {
        for (std::size_t column = 0; column < samples.columns(); ++column) {
            if (samples.isVoid(column, row)) {
                rows.markVoid(column, row - first);
            }
        }
    }
    return rows;
}

} // namespace

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

void CheckpointWriter::putRows(const SampleGrid& samples, std::size_t first, std::size_t end)
{
    const std::size_t step = rowsAtOnce(samples);
    for (std::size_t row = first; row < end; row += step) {
        putGrid(copyOfRows(samples, row, std::min(row + step, end)));
        samples.releasePages();
    }
}

void CheckpointWriter::putScratch(const ScratchBytes& values, std::size_t bytes)
{
    for (std::size_t at = 0; at < bytes; at += kPieceBytes) {
        putBytes({values.data() + at, std::min(kPieceBytes, bytes - at)});
        values.release();
    }
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
    auto file = FileBytes::open(path);
    std::uint32_t checksum = 0;
    if (!file || file->size() < sizeof(checksum)) {
        return std::nullopt;
    }
    CheckpointReader reader(std::move(file).value());
    reader.end_ = reader.file_.size();
    std::uint32_t found = 0;
    for (std::uint64_t left = reader.end_ - sizeof(checksum); left > 0;) {
        RawArray<std::byte> bytes(std::min<std::uint64_t>(left, kPieceBytes));
        if (!reader.getBytes({bytes.data(), bytes.size()})) {
            return std::nullopt;
        }
        found = crc32Of({bytes.data(), bytes.size()}, found);
        left -= bytes.size();
    }
    if (!reader.get(checksum) || checksum != found) {
        return std::nullopt;
    }
    reader.end_ -= sizeof(checksum);
    reader.at_ = 0;
    return reader;
}

bool CheckpointReader::getBytes(std::span<std::byte> bytes)
{
    if (has_failed_ || bytes.size() > left()) {
        return fail();
    }
    while (!bytes.empty()) {
        if (at_ < piece_at_ || at_ >= piece_at_ + piece_.size()) {
            auto piece = file_.read(at_, std::min<std::uint64_t>(kPieceBytes, file_.size() - at_));
            if (!piece || piece->size() == 0) {
                return fail();
            }
            piece_ = std::move(piece).value();
            piece_at_ = at_;
        }
        const std::size_t from = at_ - piece_at_;
        const std::size_t count = std::min(bytes.size(), piece_.size() - from);
        std::copy_n(piece_.data() + from, count, bytes.data());
        bytes = bytes.subspan(count);
        at_ += count;
    }
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

bool CheckpointReader::getRows(SampleGrid& samples, std::size_t first, std::size_t end)
{
    const std::size_t step = rowsAtOnce(samples);
    for (std::size_t row = first; row < end; row += step) {
        const auto rows =
            getGrid(samples.type(), samples.columns(), std::min(row + step, end) - row);
        if (!rows) {
            return false;
        }
        samples.put(*rows, 0, row);
        samples.releasePages();
    }
    return true;
}

bool CheckpointReader::getScratch(ScratchBytes& values, std::size_t first, std::size_t bytes)
{
    if (first > values.size() || bytes > values.size() - first) {
        return fail();
    }
    for (std::size_t at = 0; at < bytes; at += kPieceBytes) {
        if (!getBytes({values.data() + first + at, std::min(kPieceBytes, bytes - at)})) {
            return false;
        }
        values.release();
    }
    return true;
}

} // namespace marsview
