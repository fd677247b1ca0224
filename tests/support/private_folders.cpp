// Part of every test program: what it and the programs that it runs write for the user goes to
// folders that are removed at the end. Programs that run at the same time don't meet in them, and
// the user's own folders stay as they are.

#include "tests/support/temp_folder.h"

#include <cstdlib>
#include <filesystem>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;

class PrivateFolders {
public:
    PrivateFolders()
    {
        set("MARSVIEW_CACHE_DIR", folder_.path()); // prepared maps
        give("XDG_CONFIG_HOME", "config");
        give("XDG_DATA_HOME", "data");
        give("XDG_STATE_HOME", "state");    // marks of devices that are being connected
        give("XDG_RUNTIME_DIR", "runtime"); // locks of devices
    }

private:
    static void set(const char* name, const fs::path& folder)
    {
        setenv(name, folder.c_str(), 1); // NOLINT(concurrency-mt-unsafe)
    }
    void give(const char* name, const char* folder)
    {
        const fs::path path = folder_.path() / folder;
        fs::create_directory(path);
        fs::permissions(path, fs::perms::owner_all); // a runtime folder is its user's alone
        set(name, path);
    }

    TempFolder folder_;
};

const PrivateFolders kPrivateFolders;

} // namespace
} // namespace marsview::test
