#include "core/base/file_lock.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

Error refusal(const std::string& path, int system_error)
{
    return {system_error == ENOENT ? ErrorCode::NotFound : ErrorCode::Unreadable,
            path + ": cannot be created or opened (" +
                std::strerror(system_error) + // NOLINT(concurrency-mt-unsafe)
                "); choose another folder"};
}

// Whether the path still names the opened file: the last holder may have removed it.
bool isStillAt(const std::string& path, int descriptor)
{
    struct stat opened {};
    struct stat named {};
    return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

} // namespace

FileLock::FileLock(int descriptor, std::string path, Kind kind)
    : descriptor_(descriptor)
    , path_(std::move(path))
    , kind_(kind)
{}

FileLock::FileLock(FileLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1))
    , path_(std::move(other.path_))
    , kind_(other.kind_)
{}

FileLock& FileLock::operator=(FileLock&& other) noexcept
{
    if (this != &other) {
        release();
        descriptor_ = std::exchange(other.descriptor_, -1);
        path_ = std::move(other.path_);
        kind_ = other.kind_;
    }
    return *this;
}

FileLock::~FileLock()
{
    release();
}

void FileLock::release() noexcept
{
    if (descriptor_ < 0) {
        return;
    }
    if (kind_ == Kind::Exclusive) {
        unlink(path_.c_str()); // while locked: waiting processes check whether the file still
                               // exists
    }
    close(descriptor_);
    descriptor_ = -1;
}

Result<std::optional<FileLock>> FileLock::tryLock(const std::string& path, Kind kind)
{
    while (true) {
        int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            const int system_error = errno;
            descriptor = kind == Kind::Shared ? open(path.c_str(), O_RDONLY | O_CLOEXEC) : -1;
            if (descriptor < 0) {
                return refusal(path, system_error);
            }
        }
        const int operation = (kind == Kind::Exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB;
        int outcome = flock(descriptor, operation);
        while (outcome != 0 && errno == EINTR) {
            outcome = flock(descriptor, operation);
        }
        if (outcome != 0) {
            const int system_error = errno;
            close(descriptor);
            if (system_error == EWOULDBLOCK) {
                return std::optional<FileLock>();
            }
            return refusal(path, system_error);
        }
        FileLock lock(descriptor, path, kind);
        if (!isStillAt(path, descriptor)) {
            lock.kind_ = Kind::Shared; // another process owns the path now: leave the file alone
            continue;
        }
        if (kind == Kind::Exclusive) {
            const std::string holder = std::to_string(getpid()) + "\n";
            if (ftruncate(descriptor, 0) != 0 ||
                pwrite(descriptor, holder.data(), holder.size(), 0) < 0) {
                // The file does not name its holder, as on a full disk. The lock is held all the
                // same.
            }
        }
        return std::optional<FileLock>(std::move(lock));
    }
}

bool FileLock::isHeld(const std::string& path)
{
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    const bool is_held = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(descriptor);
    return is_held;
}

long FileLock::holder(const std::string& path)
{
    long process = 0;
    std::ifstream(path) >> process;
    return process;
}

} // namespace marsview
