#include "core/base/environment.h"

#include <cstdlib>
#include <pwd.h>
#include <unistd.h>

namespace marsview {

std::string environmentVariable(const char* name)
{
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe): no thread sets
                                           // variables
    return value != nullptr ? value : "";
}

std::filesystem::path userFolder(const char* variable, const char* below_home)
{
    std::filesystem::path folder = environmentVariable(variable);
    if (folder.is_absolute()) {
        return folder;
    }
    std::string home = environmentVariable("HOME");
    if (home.empty()) {
        const passwd* user = getpwuid(getuid()); // NOLINT(concurrency-mt-unsafe)
        home = user != nullptr ? user->pw_dir : "/";
    }
    return std::filesystem::path(home) / below_home;
}

} // namespace marsview
