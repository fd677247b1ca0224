#include "core/annotations/annotation_log.h"

#include "core/annotations/drawn_json.h"
#include "core/base/durable_file.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <map>
#include <utility>

namespace marsview {
namespace {

constexpr const char* kFirstLine = "MarsView annotations 1\n";

std::optional<std::uint32_t> numberIn(const Json& line, const char* key)
{
    if (!line.contains(key) || !line[key].is_number_unsigned()) {
        return std::nullopt;
    }
    const auto number = line[key].get<std::uint64_t>();
    return number <= std::numeric_limits<std::uint32_t>::max()
               ? std::optional(static_cast<std::uint32_t>(number))
               : std::nullopt;
}

} // namespace

Result<AnnotationLog> AnnotationLog::create(const std::filesystem::path& path)
{
    AnnotationLog log;
    log.path_ = path;
    log.file_.reset(std::fopen(path.c_str(), "wb"));
    if (!log.file_) {
        return log.cannotWrite();
    }
    if (Status status = log.append(kFirstLine); !status) {
        return status.error();
    }
    log.lines_ = 0;
    return log;
}

Status AnnotationLog::put(const LoggedAnnotation& logged)
{
    Json json = Json::object();
    json["id"] = logged.id;
    if (logged.layer) {
        json["layer"] = *logged.layer;
    }
    json.update(annotationJson(logged.annotation));
    // What is not UTF-8 is replaced: a copy with a changed letter is better than none.
    return append(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Status AnnotationLog::remove(std::uint32_t id)
{
    return append(fmt::format("{{\"id\":{}}}\n", id));
}

Status AnnotationLog::append(const std::string& line)
{
    if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size()) {
        return cannotWrite();
    }
    bytes_ += line.size();
    ++lines_;
    return Done{};
}

Result<std::uint64_t> AnnotationLog::commit()
{
    if (!flushToDisk(file_.get())) {
        return cannotWrite();
    }
    flushFolderToDisk(path_.parent_path());
    return bytes_;
}

Error AnnotationLog::cannotWrite() const
{
    return {ErrorCode::Unreadable,
            fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno))};
}

Result<std::vector<LoggedAnnotation>>
readAnnotationLog(const std::filesystem::path& path, std::uint64_t bytes, JobMonitor& monitor)
{
    const auto damaged = [&path](const std::string& why) {
        return Error{ErrorCode::Damaged, fmt::format("{}: {}", path.string(), why)};
    };
    std::ifstream file(path, std::ios::binary);
    std::map<std::uint32_t, LoggedAnnotation> known;
    std::uint64_t at = 0;
    for (std::string line; at < bytes; at += line.size() + 1) {
        if (!std::getline(file, line) || file.eof()) {
            return damaged("shorter than it was");
        }
        monitor.report(static_cast<double>(at) / static_cast<double>(bytes));
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, path.string() + ": reading was canceled"};
        }
        if (at == 0) {
            if (line + "\n" != kFirstLine) {
                return damaged("not a log of annotations");
            }
            continue;
        }
        const Json json = Json::parse(line, nullptr, false);
        const auto id = json.is_object() ? numberIn(json, "id") : std::nullopt;
        if (!id) {
            return damaged(fmt::format("damaged at byte {}", at));
        }
        if (!json.contains("shape")) {
            known.erase(*id);
            continue;
        }
        std::string fault;
        Members members(json, fmt::format("byte {}", at), fault);
        LoggedAnnotation logged{
            .id = *id, .layer = numberIn(json, "layer"), .annotation = annotationFrom(members)};
        if (!fault.empty()) {
            return damaged(fault);
        }
        // Most are new and the last.
        known.insert_or_assign(known.end(), *id, std::move(logged));
    }
    if (at != bytes) {
        return damaged("a line ends elsewhere than it did");
    }
    std::vector<LoggedAnnotation> all;
    all.reserve(known.size());
    for (auto& [id, logged] : known) {
        all.push_back(std::move(logged));
    }
    return all;
}

} // namespace marsview
