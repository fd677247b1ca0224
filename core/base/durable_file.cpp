#include "core/base/durable_file.h"

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#ifdef __unix__
#include <fcntl.h>
#include <unistd.h>
#endif

namespace marsview {
namespace {

long processId()
{
#ifdef __unix__
    return static_cast<long>(getpid());
#else
    return 0;
#endif
}

Error cannotWrite(const std::filesystem::path& path, const std::string& why)
{
    return Error{ErrorCode::Unreadable, path.string() + ": cannot be written: " + why};
}

} // namespace

bool flushToDisk(std::FILE* file)
{
#ifdef __unix__
    return std::fflush(file) == 0 && fsync(fileno(file)) == 0;
#else
    return std::fflush(file) == 0;
#endif
}

void flushFolderToDisk([[maybe_unused]] const std::filesystem::path& folder)
{
#ifdef __unix__
    const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
#endif
}

Status replaceFile(const std::filesystem::path& path, std::string_view content)
{
    namespace fs = std::filesystem;
    std::error_code problem;
    const fs::path resolved = fs::weakly_canonical(path, problem);
    const fs::path target = problem ? path : resolved;
    const fs::path draft = target.parent_path() / ("." + target.filename().string() + "." +
                                                   std::to_string(processId()) + ".new");
    const auto fail = [&](const std::string& why) {
        std::error_code ignored;
        fs::remove(draft, ignored);
        return cannotWrite(path, why);
    };
    {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(draft.c_str(), "wb"),
                                                                   &std::fclose);
        if (!file) {
            return fail(std::strerror(errno));
        }
        if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
            !flushToDisk(file.get())) {
            return fail(std::strerror(errno));
        }
    }
    if (const fs::file_status status = fs::status(target, problem);
        !problem && fs::exists(status)) {
        fs::permissions(draft, status.permissions(), problem);
    }
    fs::rename(draft, target, problem);
    if (problem) {
        return fail(problem.message());
    }
    flushFolderToDisk(target.parent_path());
    return Done{};
}

} // namespace marsview
