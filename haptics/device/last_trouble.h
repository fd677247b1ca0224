// Remembers why a device did not work, for later device lists.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace marsview {

/// What went wrong when a device was last used: a small file that later runs of the program read.
/// Not for the tick: it does file I/O. Write errors are ignored.
class LastTrouble {
public:
    /// Most files in one folder; the oldest are deleted.
    static constexpr std::size_t kFilesMax = 32;
    /// Longer sentences are truncated.
    static constexpr std::size_t kBytesMax = 500;

    /// `device` is a stable name of the device.
    LastTrouble(std::filesystem::path folder, std::string_view device);

    /// One line, as passed to set(); empty if the device worked.
    std::string get() const;
    /// Pass an empty string after a use without trouble.
    void set(std::string_view trouble) const;

private:
    std::filesystem::path folder_;
    std::filesystem::path file_;
};

} // namespace marsview
