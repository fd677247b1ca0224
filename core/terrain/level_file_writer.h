// Writing a level file piece by piece.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/level_file_format.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
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
    /// Goes on behind the first `bytes` that another one has written. Invalid where there are
    /// fewer.
    static Result<std::unique_ptr<LevelFileWriter>> resume(const std::string& path,
                                                           std::uint64_t bytes);
    ~LevelFileWriter();
    LevelFileWriter(const LevelFileWriter&) = delete;
    LevelFileWriter& operator=(const LevelFileWriter&) = delete;

    /// Any thread.
    Result<FilePart> append(std::span<const std::byte> bytes);
    /// What was appended is in the file from now on, whatever becomes of the program: how many
    /// bytes that are. Nothing where it cannot be written. While nobody appends.
    std::optional<std::uint64_t> flush();
    /// What was written stays, to be resumed.
    void keep() noexcept { is_kept_ = true; }

    /// An array to be written as a plane.
    struct Array {
        std::string name;
        std::span<const std::byte> values;
    };
    /// Writes the arrays, which are those of planesOf(header) in their order, and the header; sees
    /// to it that all is on the disk, and gives the file its name.
    Status finish(LevelFileHeader header, std::span<const Array> arrays, const JobMonitor& monitor);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    explicit LevelFileWriter(std::string path);

    Status writeFront(std::span<const std::byte> bytes);
    Status publish();
    Error failed(const std::string& what) const;

    std::string path_;
    std::string part_path_;
    std::mutex mutex_; // of what follows
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t bytes_ = 0;
    bool is_published_ = false;
    bool is_kept_ = false;
};

} // namespace marsview
