#include "core/files/tiff_handle.h"

#include <cstdio>
#include <utility>

namespace marsview {
namespace {

// libtiff reads and writes at a position.
struct Position {
    std::shared_ptr<const SharedFile> file;
    std::uint64_t at = 0;
};

Position& positionOf(thandle_t handle)
{
    return *static_cast<Position*>(handle);
}

tmsize_t readFrom(thandle_t handle, void* to, tmsize_t count)
{
    Position& position = positionOf(handle);
    const std::size_t done = position.file->read(to, static_cast<std::size_t>(count), position.at);
    position.at += done;
    return static_cast<tmsize_t>(done);
}

tmsize_t writeTo(thandle_t handle, void* from, tmsize_t count)
{
    Position& position = positionOf(handle);
    const std::size_t done =
        position.file->write(from, static_cast<std::size_t>(count), position.at);
    position.at += done;
    return static_cast<tmsize_t>(done);
}

toff_t moveTo(thandle_t handle, toff_t offset, int whence)
{
    Position& position = positionOf(handle);
    position.at = whence == SEEK_CUR   ? position.at + offset
                  : whence == SEEK_END ? position.file->bytes() + offset
                                       : offset;
    return position.at;
}

toff_t sizeOf(thandle_t handle)
{
    return positionOf(handle).file->bytes();
}

int release(thandle_t handle)
{
    delete &positionOf(handle); // NOLINT(cppcoreguidelines-owning-memory): libtiff is the owner
    return 0;
}

} // namespace

TiffHandle openTiff(std::shared_ptr<const SharedFile> file,
                    const std::string& path,
                    SharedFile::Access access,
                    TIFFOpenOptions* options)
{
    auto position = std::make_unique<Position>(Position{.file = std::move(file)});
    // Not mapped: truncating the file during reading would crash the program.
    const char* const mode = access == SharedFile::Access::Update ? "r+m" : "rm";
    TiffHandle handle(TIFFClientOpenExt(path.c_str(), mode, position.get(), readFrom, writeTo,
                                        moveTo, release, sizeOf, nullptr, nullptr, options));
    if (handle) {
        static_cast<void>(position.release()); // the handle deletes it
    }
    return handle;
}

} // namespace marsview
