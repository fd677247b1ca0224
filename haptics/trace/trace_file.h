// A file that a recording is written into.
#pragma once

#include "core/base/result.h"

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace marsview {

/// What is written after the first failure is lost; status() tells of that one. For one thread at a
/// time.
class TraceFile {
public:
    /// Makes or empties the file, writes the first line, and keeps other recordings away from it as
    /// long as it is open. Unreadable, with the cause, where that fails: as a folder that is not
    /// there, a full disk, or a file that is being recorded into already.
    static Result<TraceFile> begin(const std::string& path, std::string_view first_line);

    void write(std::string_view text);
    /// Hands what was written over to the system, so that a full disk shows.
    void flush();
    /// Also closes; anything that is written later is lost without a word.
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
    int error_ = 0; // the first, as the system numbers them
};

} // namespace marsview
