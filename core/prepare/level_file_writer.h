// Writes a level file in parts.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/levels/level_file_format.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace marsview {

/// Writes PATH.part and renames it to PATH when it is complete. Without finish() or keep() the file
/// is removed.
class LevelFileWriter {
public:
    static Result<std::unique_ptr<LevelFileWriter>> create(const std::string& path);
    /// The number of bytes written, and the CRC-32 of all bytes after the preamble.
    struct Written {
        std::uint64_t bytes = 0;
        std::uint32_t checksum = 0;
    };
    /// Continues after the bytes of an interrupted writer, which are read once. Invalid if they no
    /// longer exist.
    static Result<std::unique_ptr<LevelFileWriter>> resume(const std::string& path,
                                                           const Written& written);
    ~LevelFileWriter();
    LevelFileWriter(const LevelFileWriter&) = delete;
    LevelFileWriter& operator=(const LevelFileWriter&) = delete;

    /// Any thread.
    Result<FilePart> append(std::span<const std::byte> bytes);
    /// Flushes all appended data to the disk. Empty on failure. Do not call during append().
    std::optional<Written> flush();
    /// Keeps the written data for resuming.
    void keep() noexcept { is_kept_ = true; }

    /// An array to be written as a plane.
    struct Array {
        std::string name;
        std::span<const std::byte> values;
    };
    /// Writes the arrays, which are those of planesOf(header) in their order, and the header;
    /// flushes everything to the disk and, if `confirm` succeeds, renames the file.
    struct Finish {
        const JobMonitor& monitor;
        const std::function<Status()>& confirm; // may be empty
    };
    Status finish(LevelFileHeader header, std::span<const Array> arrays, const Finish& how);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    explicit LevelFileWriter(std::string path);

    bool hasWhatWasWritten() const;
    Status writeFront(std::span<const std::byte> bytes);
    Status publish();
    Error failed(const std::string& what) const;

    std::string path_;
    std::string part_path_;
    std::mutex mutex_; // guards the following
    std::unique_ptr<std::FILE, Close> file_;
    Written written_;
    bool is_published_ = false;
    bool is_kept_ = false;
};

} // namespace marsview
