#include "core/base/scratch_bytes.h"

#include "core/base/raw_array.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace marsview {

Result<ScratchBytes>
ScratchBytes::create(std::size_t bytes, Content content, const ScratchPlace* place)
{
    ScratchBytes made;
    if (bytes == 0) {
        return made;
    }
    if (place != nullptr && bytes >= place->bytes_min) {
        if (Status mapped = made.map(bytes, place->folder); !mapped) {
            return std::move(mapped).error();
        }
        return made;
    }
    made.data_ = static_cast<std::byte*>(content == Content::Zeros ? std::calloc(bytes, 1)
                                                                   : std::malloc(bytes));
    if (made.data_ == nullptr) {
        return Error{ErrorCode::TooLarge, fmt::format("{} bytes do not fit in memory", bytes)};
    }
    made.size_ = bytes;
    useLargePages(made.data_, bytes);
    return made;
}

Status ScratchBytes::map(std::size_t bytes, const std::string& folder)
{
    std::string path = folder + "/scratch.XXXXXX";
    const auto refusal = [&](int reason) {
        return Error{
            ErrorCode::TooLarge,
            fmt::format("{}: no room for {:.1f} MB of temporary data ({}); free some space "
                        "or choose another folder",
                        folder, static_cast<double>(bytes) / 1e6,
                        std::generic_category().message(reason))};
    };
    const int file = mkostemp(path.data(), O_CLOEXEC);
    if (file < 0) {
        return refusal(errno);
    }
    unlink(path.c_str());
    // Without reserved blocks, a full disk would end the program when a page is touched.
    const int reserved = posix_fallocate(file, 0, static_cast<off_t>(bytes));
    void* data = reserved == 0 ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0)
                               : MAP_FAILED;
    const int reason = reserved != 0 ? reserved : errno;
    close(file);
    if (data == MAP_FAILED) {
        return refusal(reason);
    }
    data_ = static_cast<std::byte*>(data);
    size_ = bytes;
    is_file_ = true;
    return Done{};
}

ScratchBytes::~ScratchBytes()
{
    if (is_file_) {
        munmap(data_, size_);
    } else {
        std::free(data_);
    }
}

void ScratchBytes::release() const noexcept
{
    if (is_file_) {
        madvise(data_, size_, MADV_DONTNEED);
    }
}

} // namespace marsview
