// Annotations by number in a file to which changes are appended.
#pragma once

#include "core/annotations/annotation.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

struct LoggedAnnotation {
    std::uint32_t id = 0;
    std::optional<std::uint32_t> layer{}; // a number that the caller gives layers
    Annotation annotation{};

    bool operator==(const LoggedAnnotation&) const = default;
};

/// Writes a log: a line of JSON for every annotation that is put or removed. What has been written
/// is never changed, so that a log up to a length that commit() returned stays what it was,
/// whatever happens later. One thread at a time.
class AnnotationLog {
public:
    /// Creates or replaces the file.
    static Result<AnnotationLog> create(const std::filesystem::path& path);

    const std::filesystem::path& path() const noexcept { return path_; }
    /// How many lines it has.
    std::size_t lines() const noexcept { return lines_; }

    /// A new annotation, or another state of one that was put. Blocks on the disk now and then.
    Status put(const LoggedAnnotation& logged);
    Status remove(std::uint32_t id);
    /// Waits until all of it is on the disk. Returns the length of the file in bytes.
    Result<std::uint64_t> commit();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    AnnotationLog() = default;
    Status append(const std::string& line);
    Error cannotWrite() const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t bytes_ = 0;
    std::size_t lines_ = 0;
};

/// What the first `bytes` of a log leave, by ascending id: seconds for a million. Damaged where it
/// is shorter, or not a log up to there; Canceled if the monitor says so.
Result<std::vector<LoggedAnnotation>>
readAnnotationLog(const std::filesystem::path& path, std::uint64_t bytes, JobMonitor& monitor);

} // namespace marsview
