#include "core/files/shared_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

using FileStatus = struct stat;
using FileId = std::pair<dev_t, ino_t>; // not reused while the file is open

// The files that are open, and those that were until recently.
class OpenTable {
public:
    std::shared_ptr<const SharedFile> find(const FileId& id)
    {
        const std::lock_guard lock(mutex_);
        const auto found = files_.find(id);
        return found == files_.end() ? nullptr : found->second.lock();
    }

    // Another thread's, if it was faster.
    std::shared_ptr<const SharedFile> add(const FileId& id, std::shared_ptr<const SharedFile> file)
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(files_, [](const auto& entry) { return entry.second.expired(); });
        const auto [at, is_new] = files_.try_emplace(id, file);
        if (is_new) {
            return file;
        }
        std::shared_ptr<const SharedFile> first = at->second.lock();
        if (!first) {
            at->second = file;
            return file;
        }
        return first;
    }

private:
    std::mutex mutex_;
    std::map<FileId, std::weak_ptr<const SharedFile>> files_;
};

OpenTable& openTable()
{
    static auto& table = *new OpenTable; // NOLINT: GDAL closes files after the end of main()
    return table;
}

thread_local KeepOpen* keeping = nullptr; // the innermost

} // namespace

SharedFile::~SharedFile()
{
    ::close(descriptor_);
}

std::uint64_t SharedFile::bytes() const noexcept
{
    FileStatus status{};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::size_t SharedFile::read(void* to, std::size_t count, std::uint64_t offset) const noexcept
{
    std::size_t done = 0;
    while (done < count) {
        const ssize_t bytes = ::pread(descriptor_, static_cast<char*>(to) + done, count - done,
                                      static_cast<off_t>(offset + done));
        if (bytes > 0) {
            done += static_cast<std::size_t>(bytes);
        } else if (bytes == 0) {
            errno = 0; // which drivers of GDAL put into their messages
            break;
        } else if (errno != EINTR) {
            break;
        }
    }
    return done;
}

std::size_t
SharedFile::write(const void* from, std::size_t count, std::uint64_t offset) const noexcept
{
    std::size_t done = 0;
    while (done < count) {
        const ssize_t bytes = ::pwrite(descriptor_, static_cast<const char*>(from) + done,
                                       count - done, static_cast<off_t>(offset + done));
        if (bytes > 0) {
            done += static_cast<std::size_t>(bytes);
        } else if (bytes == 0 || errno != EINTR) {
            break;
        }
    }
    return done;
}

std::shared_ptr<const SharedFile> openShared(const std::string& path)
{
    FileStatus status{};
    if (::stat(path.c_str(), &status) != 0) {
        return nullptr;
    }
    if (!S_ISREG(status.st_mode)) { // opening others may block, or is not for reading samples
        errno = EINVAL;
        return nullptr;
    }
    std::shared_ptr<const SharedFile> file;
    if (::faccessat(AT_FDCWD, path.c_str(), R_OK, AT_EACCESS) == 0) {
        file = openTable().find({status.st_dev, status.st_ino});
    }
    if (!file) {
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (descriptor < 0) {
            return nullptr;
        }
        auto fresh = std::make_shared<const SharedFile>(descriptor);
        if (::fstat(descriptor, &status) != 0) { // it may have been replaced since
            return nullptr;
        }
        file = openTable().add({status.st_dev, status.st_ino}, std::move(fresh));
    }
    KeepOpen::note(file);
    return file;
}

std::shared_ptr<const SharedFile> openForUpdate(const std::string& path)
{
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    return descriptor < 0 ? nullptr : std::make_shared<const SharedFile>(descriptor);
}

KeepOpen::KeepOpen()
    : outer_(std::exchange(keeping, this))
{}

KeepOpen::~KeepOpen()
{
    keeping = outer_;
}

void KeepOpen::note(const std::shared_ptr<const SharedFile>& file)
{
    for (KeepOpen* at = keeping; at != nullptr; at = at->outer_) {
        OpenFiles& files = at->files_;
        if (files.size() < kFilesMax &&
            std::find(files.begin(), files.end(), file) == files.end()) {
            files.push_back(file);
        }
    }
}

} // namespace marsview
