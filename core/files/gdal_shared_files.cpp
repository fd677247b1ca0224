#include "core/files/gdal_shared_files.h"

#include "core/files/shared_file.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <gdal_version.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

namespace marsview {

// Later versions have other virtual functions; there, files are opened as often as GDAL does.
#if GDAL_VERSION_NUM < GDAL_COMPUTE_VERSION(3, 10, 0)
namespace {

// A position in a shared open file. For one thread at a time.
class SharedHandle final : public VSIVirtualHandle {
public:
    explicit SharedHandle(std::shared_ptr<const SharedFile> file)
        : file_(std::move(file))
    {}

    int Seek(vsi_l_offset offset, int whence) override
    {
        is_at_end_ = false;
        at_ = whence == SEEK_CUR   ? at_ + offset
              : whence == SEEK_END ? file_->bytes() + offset
                                   : offset;
        return 0;
    }

    vsi_l_offset Tell() override { return at_; }

    std::size_t Read(void* to, std::size_t size, std::size_t count) override
    {
        const std::size_t wanted = size * count;
        if (wanted == 0) {
            return 0;
        }
        const std::size_t done = readAt(static_cast<char*>(to), wanted);
        is_at_end_ = is_at_end_ || done < wanted;
        at_ += done;
        return done / size;
    }

    std::size_t Write(const void*, std::size_t, std::size_t) override
    {
        errno = EBADF;
        return 0;
    }

    int Eof() override { return is_at_end_ ? 1 : 0; }

    int Close() override
    {
        file_.reset();
        return 0;
    }

    int Truncate(vsi_l_offset) override
    {
        errno = EBADF;
        return -1;
    }

    void* GetNativeFileDescriptor() override
    {
        return reinterpret_cast<void*>(static_cast<std::uintptr_t>(file_->descriptor()));
    }

    bool HasPRead() const override { return true; }

    std::size_t PRead(void* to, std::size_t size, vsi_l_offset offset) const override
    {
        return file_->read(to, size, offset);
    }

private:
    // Small reads go through a buffer, as with a FILE: headers and lines are read by single words.
    std::size_t readAt(char* to, std::size_t wanted)
    {
        std::size_t done = 0;
        if (at_ >= buffer_begin_ && at_ - buffer_begin_ < buffered_) {
            const auto begin = static_cast<std::size_t>(at_ - buffer_begin_);
            done = std::min(wanted, buffered_ - begin);
            std::memcpy(to, buffer_.data() + begin, done);
        }
        const std::size_t left = wanted - done;
        if (left >= buffer_.size()) {
            return done + file_->read(to + done, left, at_ + done);
        }
        if (left == 0) {
            return done;
        }
        buffer_begin_ = at_ + done;
        buffered_ = file_->read(buffer_.data(), buffer_.size(), buffer_begin_);
        const std::size_t more = std::min(left, buffered_);
        std::memcpy(to + done, buffer_.data(), more);
        return done + more;
    }

    std::shared_ptr<const SharedFile> file_;
    vsi_l_offset at_ = 0;
    bool is_at_end_ = false;
    std::array<char, 4096> buffer_;
    vsi_l_offset buffer_begin_ = 0;
    std::size_t buffered_ = 0;
};

class SharingFileSystem final : public VSIFilesystemHandler {
public:
    explicit SharingFileSystem(VSIFilesystemHandler* plain)
        : plain_(plain)
    {}

    VSIVirtualHandle*
    Open(const char* path, const char* access, bool sets_error, CSLConstList options) override
    {
        const std::string_view mode(access);
        if (mode == "r" || mode == "rb") {
            if (auto file = openShared(path)) {
                auto handle = std::make_unique<SharedHandle>(std::move(file));
                return CPLTestBool(CPLGetConfigOption("VSI_CACHE", "FALSE"))
                           ? VSICreateCachedFile(handle.release())
                           : handle.release();
            }
        }
        return plain_->Open(path, access, sets_error, options);
    }

    int Stat(const char* path, VSIStatBufL* status, int flags) override
    {
        return plain_->Stat(path, status, flags);
    }
    int Unlink(const char* path) override { return plain_->Unlink(path); }
    int Mkdir(const char* path, long mode) override { return plain_->Mkdir(path, mode); }
    int Rmdir(const char* path) override { return plain_->Rmdir(path); }
    int RmdirRecursive(const char* path) override { return plain_->RmdirRecursive(path); }
    char** ReadDirEx(const char* path, int count_max) override
    {
        return plain_->ReadDirEx(path, count_max);
    }
    char** SiblingFiles(const char* path) override { return plain_->SiblingFiles(path); }
    int Rename(const char* from, const char* to) override { return plain_->Rename(from, to); }
    int IsCaseSensitive(const char* path) override { return plain_->IsCaseSensitive(path); }
    GIntBig GetDiskFreeSpace(const char* path) override { return plain_->GetDiskFreeSpace(path); }
    int SupportsSparseFiles(const char* path) override { return plain_->SupportsSparseFiles(path); }
    VSIDIR* OpenDir(const char* path, int depth, const char* const* options) override
    {
        return plain_->OpenDir(path, depth, options);
    }
    bool IsLocal(const char* path) override { return plain_->IsLocal(path); }
    bool SupportsSequentialWrite(const char* path, bool allows_temporary) override
    {
        return plain_->SupportsSequentialWrite(path, allows_temporary);
    }
    bool SupportsRandomWrite(const char* path, bool allows_temporary) override
    {
        return plain_->SupportsRandomWrite(path, allows_temporary);
    }

private:
    std::unique_ptr<VSIFilesystemHandler> plain_; // GDAL does not delete what was replaced
};

} // namespace

void shareFilesOfGdal()
{
    // GDAL deletes it at the end of the program.
    VSIFileManager::InstallHandler("", new SharingFileSystem(VSIFileManager::GetHandler("")));
}
#else
void shareFilesOfGdal() {}
#endif

} // namespace marsview
