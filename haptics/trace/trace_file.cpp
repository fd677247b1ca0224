#include "haptics/trace/trace_file.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

Error refusal(const std::string& path, int system_error)
{
    const char* what_to_do = system_error == ENOSPC || system_error == EDQUOT
                                 ? "free disk space, or choose another file"
                                 : "choose another file in an existing, writable folder";
    return {ErrorCode::Unreadable,
            fmt::format("{}: cannot be written ({}); {}", path,
                        std::generic_category().message(system_error), what_to_do)};
}

// Devices and pipes are not locked.
bool isPlainFile(int descriptor)
{
    struct stat about {};
    return fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
}

} // namespace

void TraceFile::Closer::operator()(std::FILE* file) const noexcept
{
    std::fclose(file); // NOLINT(cppcoreguidelines-owning-memory)
}

TraceFile::TraceFile(std::string path, File file)
    : path_(std::move(path))
    , file_(std::move(file))
{}

Result<TraceFile> TraceFile::begin(const std::string& path, std::string_view first_line)
{
    // Truncated only after it is locked. O_NONBLOCK: do not wait for a reader of a pipe.
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (descriptor < 0) {
        return errno == ENXIO
                   ? Error{ErrorCode::Unreadable,
                           fmt::format("{}: is a pipe without a reader; start the reader first, or "
                                       "choose another file",
                                       path)}
                   : refusal(path, errno);
    }
    fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    if (isPlainFile(descriptor)) {
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(descriptor);
            return Error{
                ErrorCode::Unreadable,
                fmt::format("{}: is already being recorded to; choose another file", path)};
        }
        if (ftruncate(descriptor, 0) != 0) {
            const int system_error = errno;
            ::close(descriptor);
            return refusal(path, system_error);
        }
    }
    File file(fdopen(descriptor, "wb"));
    if (!file) {
        const int system_error = errno;
        ::close(descriptor);
        return refusal(path, system_error);
    }
    TraceFile begun(path, std::move(file));
    begun.write(fmt::format("{}\n", first_line));
    begun.flush();
    if (Status status = begun.status(); !status) {
        return std::move(status).error();
    }
    return begun;
}

void TraceFile::note(bool is_fine)
{
    if (!is_fine && error_ == 0) {
        error_ = errno != 0 ? errno : EIO;
    }
}

void TraceFile::write(std::string_view text)
{
    if (file_ && error_ == 0) {
        note(std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size());
    }
}

void TraceFile::flush()
{
    if (file_ && error_ == 0) {
        note(std::fflush(file_.get()) == 0);
    }
}

Status TraceFile::close()
{
    if (file_) {
        note(std::fclose(file_.release()) == 0); // NOLINT(cppcoreguidelines-owning-memory)
    }
    return status();
}

Status TraceFile::status() const
{
    return error_ == 0 ? Status(Done{}) : Status(refusal(path_, error_));
}

} // namespace marsview
