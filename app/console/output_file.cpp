#include "app/console/output_file.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <system_error>

namespace marsview {
namespace {

namespace fs = std::filesystem;

int writeTo(const fs::path& path, std::string_view text)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    return file ? 0 : (errno != 0 ? errno : EIO);
}

} // namespace

InterruptIgnored::InterruptIgnored()
    : before_(std::signal(SIGINT, SIG_IGN))
{}

InterruptIgnored::~InterruptIgnored()
{
    std::signal(SIGINT, before_);
}

Status writeOutputFile(const std::string& path, std::string_view text)
{
    const InterruptIgnored ignored;
    const auto refused = [&path](const std::string& reason) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot be written ({}); choose a file in an existing, "
                                 "writable folder",
                                 path, reason)};
    };
    std::error_code none;
    if (path == "-") {
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
                       std::fflush(stdout) == 0
                   ? Status(Done{})
                   : Error{ErrorCode::Unreadable, "stdout: writing the result failed"};
    }
    const fs::file_status status = fs::status(path, none);
    const bool is_new = status.type() == fs::file_type::not_found;
    if (!is_new && status.type() != fs::file_type::regular) {
        const int failure = writeTo(path, text);
        return failure == 0 ? Status(Done{}) : refused(std::generic_category().message(failure));
    }
    const fs::path target = is_new ? fs::path(path) : fs::canonical(path, none);
    fs::path unfinished = target;
    unfinished += ".part";
    if (const int failure = writeTo(unfinished, text); failure != 0) {
        fs::remove(unfinished, none);
        return refused(std::generic_category().message(failure));
    }
    if (!is_new) {
        fs::permissions(unfinished, status.permissions(), none);
    }
    std::error_code failure;
    fs::rename(unfinished, target, failure);
    if (failure) {
        fs::remove(unfinished, none);
        return refused(failure.message());
    }
    return Done{};
}

} // namespace marsview
