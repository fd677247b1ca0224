#include "core/files/text_grid_size_check.h"

#include "core/files/file_stamp.h"
#include "core/files/opening_job.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>

namespace marsview {
namespace {

constexpr std::size_t kRememberedMax = 256;
constexpr std::size_t kHeaderLineMax = 1024;

bool isSpace(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool isHeaderLine(std::string_view line)
{
    constexpr std::array<std::string_view, 15> kKeys{
        "ncols", "nrows", "xll",  "yll",  "cellsize", "dx",   "dy",        "nodata",
        "north", "south", "east", "west", "rows",     "cols", "multiplier"};
    std::string word;
    for (const char c : line.substr(0, kHeaderLineMax)) {
        if (!isSpace(c)) {
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else if (!word.empty()) {
            break;
        }
    }
    return word.empty() || word.starts_with("null:") || word.starts_with("type:") ||
           std::any_of(kKeys.begin(), kKeys.end(),
                       [&word](std::string_view key) { return word.starts_with(key); });
}

// Where the numbers begin.
std::streamoff endOfHeader(std::ifstream& stream)
{
    std::string beginning(65536, '\0');
    stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    beginning.resize(static_cast<std::size_t>(stream.gcount()));
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = beginning.find_first_of("\r\n", begin);
        if (end == std::string::npos ||
            !isHeaderLine(std::string_view(beginning).substr(begin, end - begin))) {
            return static_cast<std::streamoff>(begin);
        }
        begin = end + 1;
    }
}

// Up to `count`; empty if the job was canceled.
std::optional<std::uint64_t> wordsIn(const std::string& path, std::uint64_t count)
{
    std::ifstream stream(path, std::ios::binary);
    const std::streamoff begin = endOfHeader(stream);
    stream.clear();
    stream.seekg(begin);
    std::string buffer(std::size_t{1} << 20, '\0');
    std::uint64_t words = 0;
    bool is_in_word = false;
    while (stream && words < count) {
        if (OpeningJob::current() != nullptr && OpeningJob::current()->isCanceled()) {
            return std::nullopt;
        }
        stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        const auto end = buffer.begin() + static_cast<std::ptrdiff_t>(stream.gcount());
        for (auto at = buffer.begin(); at != end; ++at) {
            if (*at == '\0') {
                return words;
            }
            const bool is_word = !isSpace(*at);
            words += is_word && !is_in_word ? 1 : 0;
            is_in_word = is_word;
        }
    }
    return std::min(words, count);
}

std::mutex mutex;
// Stamps of files known to be complete.
std::map<std::string, std::string>& complete()
{
    static std::map<std::string, std::string> stamps;
    return stamps;
}

} // namespace

Status checkTextGrid(const std::string& path, std::uint64_t count)
{
    const std::string stamp = fmt::format("{} {}", count, stampTextOf({path}));
    {
        const std::lock_guard lock(mutex);
        if (const auto known = complete().find(path);
            known != complete().end() && known->second == stamp) {
            return Done{};
        }
    }
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
    // Each number takes at least a digit and a space: beyond this size counting is unnecessary.
    const std::optional<std::uint64_t> words =
        bytes / 2 + 1 < count ? bytes / 2 + 1 : wordsIn(path, count);
    if (!words) {
        return Error{ErrorCode::Canceled, "opening was canceled"};
    }
    if (*words < count) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("is cut short or damaged: its header promises {} samples, the "
                                 "file has {}{}; fetch it again",
                                 count, bytes / 2 + 1 < count ? "at most " : "", *words)};
    }
    const std::lock_guard lock(mutex);
    if (complete().size() >= kRememberedMax) {
        complete().clear();
    }
    complete().insert_or_assign(path, stamp);
    return Done{};
}

} // namespace marsview
