// A folder for the files that a test makes.
#pragma once

#include <filesystem>
#include <string>

namespace marsview::test {

/// An empty folder that is gone, with all it holds, when the object is.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The path of a file in it, which may not exist yet.
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& content) const;

private:
    std::filesystem::path path_;
};

/// The bytes of a file; throws where it cannot be read.
std::string readFile(const std::filesystem::path& path);

} // namespace marsview::test
