// Remembering why a device did not work, for who looks for devices later.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace marsview {

/// What went wrong when one device was used last: a small file, from one program to the next. Not
/// for the servo thread's tick: it works on files. What cannot be written is forgotten.
class LastTrouble {
public:
    /// No folder has more of these files than that; the oldest go.
    static constexpr std::size_t kFilesMax = 32;
    /// Longer sentences are cut off.
    static constexpr std::size_t kBytesMax = 500;

    /// `device` is a name that the device always has.
    LastTrouble(std::filesystem::path folder, std::string_view device);

    /// One line, as it was set; empty where there was no trouble.
    std::string get() const;
    /// Empty where the device was used without trouble.
    void set(std::string_view trouble) const;

private:
    std::filesystem::path folder_;
    std::filesystem::path file_;
};

} // namespace marsview
