// Writing a level file piece by piece.
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

/// Writes PATH.part, and moves it to PATH when it is whole. Without finish() or keep() nothing
/// stays.
class LevelFileWriter {
public:
    static Result<std::unique_ptr<LevelFileWriter>> create(const std::string& path);
    /// How far one has written, and what by: the CRC-32 of all but the preamble.
    struct Written {
        std::uint64_t bytes = 0;
        std::uint32_t checksum = 0;
    };
    /// Goes on behind what another one has written, which is read once. Invalid where it is not
    /// there any more.
    static Result<std::unique_ptr<LevelFileWriter>> resume(const std::string& path,
                                                           const Written& written);
    ~LevelFileWriter();
    LevelFileWriter(const LevelFileWriter&) = delete;
    LevelFileWriter& operator=(const LevelFileWriter&) = delete;

    /// Any thread.
    Result<FilePart> append(std::span<const std::byte> bytes);
    /// What was appended is on the disk from now on, whatever becomes of the machine. Nothing where
    /// it cannot be written. While nobody appends.
    std::optional<Written> flush();
    /// What was written stays, to be resumed.
    void keep() noexcept { is_kept_ = true; }

    /// An array to be written as a plane.
    struct Array {
        std::string name;
        std::span<const std::byte> values;
    };
    /// Writes the arrays, which are those of planesOf(header) in their order, and the header; sees
    /// to it that all is on the disk, and, where `confirm` agrees, gives the file its name.
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
    std::mutex mutex_; // of what follows
    std::unique_ptr<std::FILE, Close> file_;
    Written written_;
    bool is_published_ = false;
    bool is_kept_ = false;
};

} // namespace marsview
