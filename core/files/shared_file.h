// Files on a disk, opened once for all their readers.
//
// Opening a map takes many steps: the check of its header, GDAL's recognition of the format, the
// driver, the label, the identity, one dataset for each thread (GDAL's datasets are for one thread
// at a time). All of them read through one open file of the kernel. Reads name their offset, so
// readers do not disturb each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// An open file, closed with its last owner. Any thread.
class SharedFile {
public:
    enum class Access : std::uint8_t { Read, Update };

    /// Of a descriptor, which the object closes.
    explicit SharedFile(int descriptor) noexcept
        : descriptor_(descriptor)
    {}
    ~SharedFile();
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    int descriptor() const noexcept { return descriptor_; }
    /// The present size; 0 if it cannot be determined.
    std::uint64_t bytes() const noexcept;
    /// The number of bytes read: fewer than `count` at the end of the file or on a failure.
    std::size_t read(void* to, std::size_t count, std::uint64_t offset) const noexcept;
    /// The number of bytes written: fewer than `count` on a failure, with errno.
    std::size_t write(const void* from, std::size_t count, std::uint64_t offset) const noexcept;

private:
    int descriptor_;
};

/// The regular file at `path`, opened for reading. It is opened only if this process does not have
/// that file open through this function already: the path must lead to the same device and inode,
/// so a file that has been replaced is opened. Null with errno if it cannot be opened. Any thread.
std::shared_ptr<const SharedFile> openShared(const std::string& path);

/// The file at `path` for reading and writing, open for its owners only. Null with errno if it
/// cannot be opened.
std::shared_ptr<const SharedFile> openForUpdate(const std::string& path);

/// Open files: until the last copy is gone, opening them again takes no system call `open`.
using OpenFiles = std::vector<std::shared_ptr<const SharedFile>>;

/// During its lifetime, the files that this thread opens with openShared(), or that GDAL opens on
/// it, stay open: the first kFilesMax of them.
///
///     KeepOpen opening;
///     use(GDALDataset::Open(name)); // recognizes the format, then opens the driver: one open file
///     map.files = opening.files();  // open for the threads that read the map later
class KeepOpen {
public:
    static constexpr std::size_t kFilesMax = 32; // a mosaic may have thousands

    KeepOpen();
    ~KeepOpen();
    KeepOpen(const KeepOpen&) = delete;
    KeepOpen& operator=(const KeepOpen&) = delete;

    const OpenFiles& files() const noexcept { return files_; }

private:
    friend std::shared_ptr<const SharedFile> openShared(const std::string& path);
    static void note(const std::shared_ptr<const SharedFile>& file);

    OpenFiles files_;
    KeepOpen* outer_; // which keeps the files open, too
};

} // namespace marsview
