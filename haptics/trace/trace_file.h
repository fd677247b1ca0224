// An output file for a recording.
#pragma once

#include "core/base/result.h"

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace marsview {

/// After the first failure all output is discarded; status() returns that first error. One thread
/// at a time.
class TraceFile {
public:
    /// Creates or truncates the file, writes the first line, and prevents other recordings into it
    /// while it is open. On failure returns Unreadable with the cause: a missing folder, a full
    /// disk, or a file that is already being recorded to.
    static Result<TraceFile> begin(const std::string& path, std::string_view first_line);

    void write(std::string_view text);
    /// Passes the buffered output to the system, which detects a full disk.
    void flush();
    /// Also closes the file; later output is discarded silently.
    Status close();
    Status status() const;

private:
    struct Closer {
        void operator()(std::FILE* file) const noexcept;
    };
    using File = std::unique_ptr<std::FILE, Closer>;

    TraceFile(std::string path, File file);
    void note(bool is_fine);

    std::string path_;
    File file_;
    int error_ = 0; // errno of the first error
};

} // namespace marsview
