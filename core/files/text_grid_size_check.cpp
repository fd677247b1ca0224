#include "core/files/text_grid_size_check.h"

#include "core/files/file_stamp.h"
#include "core/files/gdal_file.h"
#include "core/files/opening_job.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

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
vsi_l_offset endOfHeader(VSILFILE& file)
{
    std::string beginning(65536, '\0');
    beginning.resize(VSIFReadL(beginning.data(), 1, beginning.size(), &file));
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = beginning.find_first_of("\r\n", begin);
        if (end == std::string::npos ||
            !isHeaderLine(std::string_view(beginning).substr(begin, end - begin))) {
            return begin;
        }
        begin = end + 1;
    }
}

// Up to `count`; empty if the job was canceled.
std::optional<std::uint64_t> wordsIn(const std::string& path, std::uint64_t count)
{
    const GdalFile file = openGdalFile(path);
    if (!file) {
        return 0;
    }
    const vsi_l_offset begin = endOfHeader(*file);
    VSIFSeekL(file.get(), begin, SEEK_SET);
    std::string buffer(std::size_t{1} << 20, '\0');
    std::uint64_t words = 0;
    bool is_in_word = false;
    while (words < count) {
        if (OpeningJob::current() != nullptr && OpeningJob::current()->isCanceled()) {
            return std::nullopt;
        }
        const std::size_t bytes = VSIFReadL(buffer.data(), 1, buffer.size(), file.get());
        if (bytes == 0) {
            break;
        }
        for (const char c : std::string_view(buffer).substr(0, bytes)) {
            if (c == '\0') {
                return std::min(words, count);
            }
            const bool is_word = !isSpace(c);
            words += is_word && !is_in_word ? 1 : 0;
            is_in_word = is_word;
        }
    }
    return std::min(words, count);
}

std::mutex answer_mutex;
// Stamps of files known to be complete.
std::map<std::string, std::string>& complete()
{
    static std::map<std::string, std::string> stamps;
    return stamps;
}

} // namespace

bool isTextGrid(std::string_view driver)
{
    return driver == "AAIGrid" || driver == "GRASSASCIIGrid";
}

Status checkTextGrid(const std::string& path, std::uint64_t count)
{
    const std::string stamp = fmt::format("{} {}", count, stampTextOf({path}));
    {
        const std::lock_guard lock(answer_mutex);
        if (const auto known = complete().find(path);
            known != complete().end() && known->second == stamp) {
            return Done{};
        }
    }
    VSIStatBufL status{};
    const bool is_there = VSIStatL(path.c_str(), &status) == 0;
    const std::uint64_t bytes = is_there ? static_cast<std::uint64_t>(status.st_size) : 0;
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
    const std::lock_guard lock(answer_mutex);
    if (complete().size() >= kRememberedMax) {
        complete().clear();
    }
    complete().insert_or_assign(path, stamp);
    return Done{};
}

} // namespace marsview
