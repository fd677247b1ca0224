// A folder for a test's files.
#pragma once

#include <filesystem>
#include <string>

namespace marsview::test {

/// An empty folder that is removed, with its content, with the object.
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

/// The bytes of a file; throws if it cannot be read.
std::string readFile(const std::filesystem::path& path);

} // namespace marsview::test
