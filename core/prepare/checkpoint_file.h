// A file with the state of a long job, for resuming after the program was killed.
#pragma once

#include "core/base/raw_array.h"
#include "core/base/scratch_bytes.h"
#include "core/files/file_bytes.h"
#include "core/raster/sample_grid.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace marsview {

/// Writes PATH.new and renames it to PATH when it is complete and on the disk, so that a kill
/// leaves the previous checkpoint. Errors are stored and reported once, by finish(). For one
/// thread.
class CheckpointWriter {
public:
    explicit CheckpointWriter(const std::string& path);
    ~CheckpointWriter();
    CheckpointWriter(const CheckpointWriter&) = delete;
    CheckpointWriter& operator=(const CheckpointWriter&) = delete;

    template <typename T>
    void put(const T& value)
    {
        static_assert(std::is_arithmetic_v<T>);
        putBytes(std::as_bytes(std::span(&value, 1)));
    }
    /// Arrays begin with their length. `values` is any contiguous range of numbers.
    template <typename Range>
    void putArray(const Range& values)
    {
        const std::span numbers(values);
        put(static_cast<std::uint64_t>(numbers.size()));
        putBytes(std::as_bytes(numbers));
    }
    void putGrid(const SampleGrid& samples);
    /// Rows [first, end), a few at a time, whose pages are released.
    void putRows(const SampleGrid& samples, std::size_t first, std::size_t end);
    /// The first `bytes` of them, which are released.
    void putScratch(const ScratchBytes& values, std::size_t bytes);

    /// False if the file could not be written; PATH is then unchanged.
    bool finish();

    /// PATH.new; a kill may leave it.
    static std::string unfinishedPath(const std::string& path);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    void putBytes(std::span<const std::byte> bytes);

    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::uint32_t checksum_ = 0;
    bool has_failed_ = false;
};

/// Reads the values back in the order of writing. A mismatch fails, and so do all later reads.
class CheckpointReader {
public:
    /// Empty if the file does not exist or is damaged: reads it once to compare it with its
    /// checksum, in pieces.
    static std::optional<CheckpointReader> open(const std::string& path);

    template <typename T>
    bool get(T& value)
    {
        static_assert(std::is_arithmetic_v<T>);
        return getBytes(std::as_writable_bytes(std::span(&value, 1)));
    }
    /// An array of the length of `values`.
    template <typename Range>
    bool getArray(Range&& values)
    {
        const std::span numbers(values);
        std::uint64_t count = 0;
        return get(count) && count == numbers.size() && getBytes(std::as_writable_bytes(numbers));
    }
    /// An array of any length, as a vector or string.
    template <typename Container>
    bool getAny(Container& values)
    {
        std::uint64_t count = 0;
        if (!get(count) || count > left() / sizeof(typename Container::value_type)) {
            return fail();
        }
        values.resize(count);
        return getBytes(std::as_writable_bytes(std::span(values)));
    }
    std::optional<SampleGrid> getGrid(SampleType type, std::size_t columns, std::size_t rows);
    /// Puts the rows of putRows() into `samples`, from row `first` on, and releases them.
    bool getRows(SampleGrid& samples, std::size_t first, std::size_t end);
    /// The bytes of putScratch(), from byte `first` of `values` on.
    bool getScratch(ScratchBytes& values, std::size_t first, std::size_t bytes);

private:
    explicit CheckpointReader(FileBytes file)
        : file_(std::move(file))
    {}

    std::uint64_t left() const noexcept { return end_ - at_; }
    bool getBytes(std::span<std::byte> bytes);
    bool fail() noexcept
    {
        has_failed_ = true;
        return false;
    }

    FileBytes file_;
    RawArray<std::byte> piece_; // of the file, from piece_at_ on
    std::uint64_t piece_at_ = 0;
    std::uint64_t at_ = 0;
    std::uint64_t end_ = 0;
    bool has_failed_ = false;
};

} // namespace marsview
