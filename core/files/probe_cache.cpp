#include "core/files/probe_cache.h"

#include "core/base/environment.h"
#include "core/files/file_stamp.h"
#include "core/files/gdal_drivers.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Changes whenever drivers, limits or the parts read of a file change.
constexpr int kFormat = 3;

// Limit for the folder: a few hundred bytes each.
constexpr std::size_t kFilesMax = 4096;
constexpr std::size_t kHeldMax = 1024;
constexpr std::uintmax_t kFileBytesMax = std::uintmax_t{16} << 20;

fs::path folder()
{
    if (const std::string chosen = environmentVariable("MARSVIEW_CACHE_DIR"); !chosen.empty()) {
        return fs::path(chosen) / "opened";
    }
    return userFolder("XDG_CACHE_HOME", ".cache") / "marsview" / "opened";
}

// A busy machine may have caused a timeout.
constexpr std::chrono::hours kTimeoutKept{1};

constexpr std::array kKinds{std::pair{ProbeAnswer::Kind::Opened, "opened"},
                            std::pair{ProbeAnswer::Kind::Crashed, "crashed"},
                            std::pair{ProbeAnswer::Kind::TimedOut, "timed out"}};

// Relative names depend on the working folder.
std::string keyOf(const std::vector<std::string>& names)
{
    std::error_code none;
    std::string key =
        fmt::format("{}\n{}\n{}\n", kFormat, gdalVersion(), fs::current_path(none).string());
    for (const std::string& name : names) {
        key += name + "\n";
    }
    return key;
}

fs::path fileFor(const std::string& key)
{
    std::uint64_t hash = 0xcbf29ce484222325U; // FNV-1a; the file holds the key itself
    for (const char c : key) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    return folder() / fmt::format("{:016x}.json", hash);
}

struct Remembered {
    ProbeAnswer answer;
    std::string stamp;             // of answer.files
    std::chrono::sys_seconds at{}; // when the child ended
};

std::mutex cache_mutex;
std::map<std::string, Remembered>& held()
{
    static std::map<std::string, Remembered> answers;
    return answers;
}

std::optional<Remembered> load(const std::string& key)
{
    const fs::path path = fileFor(key);
    std::error_code failure;
    if (fs::file_size(path, failure) > kFileBytesMax || failure) {
        return std::nullopt;
    }
    std::ifstream stream(path);
    const Json json = Json::parse(stream, nullptr, false);
    if (!json.is_object()) {
        return std::nullopt;
    }
    try {
        if (json.at("key") != key) {
            return std::nullopt;
        }
        Remembered found;
        found.stamp = json.at("stamp").get<std::string>();
        const auto kind = std::find_if(kKinds.begin(), kKinds.end(), [&json](const auto& named) {
            return json.at("kind") == named.second;
        });
        if (kind == kKinds.end()) {
            return std::nullopt;
        }
        found.answer.kind = kind->first;
        found.answer.limit_s = json.at("limit_s").get<double>();
        found.at =
            std::chrono::sys_seconds(std::chrono::seconds(json.at("at").get<std::int64_t>()));
        found.answer.name = json.at("name").get<std::size_t>();
        found.answer.driver = json.at("driver").get<std::string>();
        found.answer.files = json.at("files").get<std::vector<std::string>>();
        found.answer.prints = json.at("prints").get<bool>();
        return found;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

void makeRoom(const fs::path& in)
{
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(in, none)) {
        files.emplace_back(entry.last_write_time(none), entry.path());
    }
    if (files.size() < kFilesMax) {
        return;
    }
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i < kFilesMax / 4; ++i) {
        fs::remove(files[i].second, none);
    }
}

// A failure only costs a child process at the next opening.
void save(const std::string& key, const Remembered& remembered)
{
    const fs::path path = fileFor(key);
    std::error_code failure;
    fs::create_directories(path.parent_path(), failure);
    makeRoom(path.parent_path());
    const ProbeAnswer& answer = remembered.answer;
    const auto kind = std::find_if(kKinds.begin(), kKinds.end(), [&answer](const auto& named) {
        return named.first == answer.kind;
    });
    const Json json{{"key", key},
                    {"stamp", remembered.stamp},
                    {"kind", kind->second},
                    {"limit_s", answer.limit_s},
                    {"at", remembered.at.time_since_epoch().count()},
                    {"name", answer.name},
                    {"driver", answer.driver},
                    {"files", answer.files},
                    {"prints", answer.prints}};
    const fs::path part = path.string() + fmt::format(".{}.part", getpid());
    std::ofstream stream(part);
    stream << json.dump(-1, ' ', false, Json::error_handler_t::replace);
    stream.close();
    if (stream) {
        fs::rename(part, path, failure);
    } else {
        fs::remove(part, failure);
    }
}

std::chrono::sys_seconds now()
{
    return std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
}

bool isValid(const Remembered& found, double limit_s)
{
    return stampTextOf(found.answer.files) == found.stamp &&
           (found.answer.kind != ProbeAnswer::Kind::TimedOut ||
            (found.answer.limit_s >= limit_s && now() - found.at < kTimeoutKept));
}

} // namespace

std::optional<ProbeAnswer> cachedProbe(const std::vector<std::string>& names, double limit_s)
{
    const std::string key = keyOf(names);
    std::optional<Remembered> found;
    {
        const std::lock_guard lock(cache_mutex);
        if (const auto at = held().find(key); at != held().end()) {
            found = at->second;
        }
    }
    if (!found || !isValid(*found, limit_s)) {
        found = load(key);
        if (!found || found->answer.name >= names.size() || !isValid(*found, limit_s)) {
            return std::nullopt;
        }
        const std::lock_guard lock(cache_mutex);
        held().insert_or_assign(key, *found);
    }
    return found->answer;
}

void cacheProbe(const std::vector<std::string>& names, const ProbeAnswer& answer)
{
    const bool is_failure =
        answer.kind == ProbeAnswer::Kind::Crashed || answer.kind == ProbeAnswer::Kind::TimedOut;
    if (answer.kind != ProbeAnswer::Kind::Opened &&
        (!is_failure || answer.driver == "VRT" || answer.driver.empty())) {
        return;
    }
    Remembered remembered{answer, {}, now()};
    std::vector<std::string>& files = remembered.answer.files;
    files.insert(files.end(), names.begin(),
                 names.begin() + static_cast<std::ptrdiff_t>(answer.name) + 1);
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    remembered.stamp = stampTextOf(files);
    if (remembered.stamp.empty()) {
        return;
    }
    const std::string key = keyOf(names);
    save(key, remembered);
    const std::lock_guard lock(cache_mutex);
    if (held().size() >= kHeldMax) {
        held().clear();
    }
    held().insert_or_assign(key, std::move(remembered));
}

} // namespace marsview
