#include "core/files/remote_raster.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

struct Scheme {
    std::string_view address;
    std::string_view name;
    bool is_kept; // the address follows unchanged
};

constexpr std::array<Scheme, 4> kSchemes{{{"https://", "/vsicurl/", true},
                                          {"http://", "/vsicurl/", true},
                                          {"s3://", "/vsis3/", false},
                                          {"gs://", "/vsigs/", false}}};

// GDAL's options of the same kind are given in parentheses or after a question mark.
constexpr std::array<std::string_view, 4> kNames{"/vsicurl/", "/vsicurl?", "/vsis3/", "/vsigs/"};

bool startsWithIgnoringCase(std::string_view text, std::string_view prefix)
{
    return text.size() >= prefix.size() && EQUALN(text.data(), prefix.data(), prefix.size());
}

// The last version of each file that this process asked for: GDAL's cached chunks belong to it.
std::mutex known_mutex;

std::map<std::string, RemoteVersion>& knownVersions()
{
    static std::map<std::string, RemoteVersion> versions;
    return versions;
}

void dropKept(const std::string& remote_name)
{
    VSICurlPartialClearCache(remote_name.c_str());
}

// The number after `words` in `text`; 0 if there is none.
int numberAfter(std::string_view text, std::string_view words)
{
    const std::size_t at = text.find(words);
    int number = 0;
    if (at != std::string_view::npos) {
        const std::string_view rest = text.substr(at + words.size());
        std::from_chars(rest.data(), rest.data() + rest.size(), number);
    }
    return number;
}

Error statusFailure(const std::string& remote_name, int status)
{
    const std::string address = addressOf(remote_name);
    switch (status) {
    case 404:
    case 410:
        return {ErrorCode::NotFound,
                fmt::format("{}: nothing was found at this address ({}); check its spelling",
                            address, status)};
    case 401:
    case 403:
        return {ErrorCode::Unreadable,
                fmt::format("{}: the server denies access ({}); it may require a login, or "
                            "the address may have expired",
                            address, status)};
    case 408:
    case 429:
    case 500:
    case 502:
    case 503:
    case 504:
        return {
            ErrorCode::Unreadable,
            fmt::format("{}: the server reports an error ({}); try again later", address, status)};
    default:
        return {
            ErrorCode::Unreadable,
            fmt::format("{}: the server responds with {} instead of the file", address, status)};
    }
}

// After a request for the headers failed: opening the file makes GDAL report the reason.
Error reasonOfSilence(const std::string& remote_name)
{
    dropKept(remote_name);
    const GdalMessages messages;
    VSIErrorReset();
    if (VSILFILE* file = VSIFOpenExL(remote_name.c_str(), "rb", 1)) {
        VSIFCloseL(file); // it has recovered just now
        return {ErrorCode::Unreadable,
                fmt::format("{}: the server did not respond in time; try again",
                            addressOf(remote_name))};
    }
    std::string text = VSIGetLastErrorMsg();
    for (const char* words : {"HTTP response code: ", "Invalid AWS response: "}) {
        if (const int status = numberAfter(text, words); status > 0) {
            return statusFailure(remote_name, status);
        }
    }
    if (text.find("AWS_NO_SIGN_REQUEST") != std::string::npos) {
        return {
            ErrorCode::Unreadable,
            fmt::format("{}: the bucket requires a login and none is set up; for a public one set "
                        "AWS_NO_SIGN_REQUEST=YES in the environment",
                        addressOf(remote_name))};
    }
    constexpr std::string_view curl = "CURL error: ";
    if (text.starts_with(curl)) {
        text.erase(0, curl.size());
    }
    if (text.empty()) {
        text = messages.firstFailure("no reason was given");
    }
    return {ErrorCode::Unreadable,
            fmt::format("{}: the server does not respond; check the address and the network ({})",
                        addressOf(remote_name), text)};
}

// A strong ETag shows every change. A weak one never satisfies the condition (RFC 9110, 13.1.1);
// then the time is used.
std::string conditionOf(const RemoteVersion& version)
{
    if (!version.etag.empty() && !version.etag.starts_with("W/")) {
        return "If-Match: " + version.etag;
    }
    if (!version.modified.empty()) {
        return "If-Unmodified-Since: " + version.modified;
    }
    return "";
}

// GDAL_HTTP_HEADERS is a comma-separated list of texts that may be quoted.
std::string quoted(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result + '"';
}

bool says(const GdalMessages& messages, std::string_view words)
{
    const auto has = [words](const std::string& text) {
        return text.find(words) != std::string::npos;
    };
    return std::any_of(messages.failures().begin(), messages.failures().end(), has) ||
           std::any_of(messages.warnings().begin(), messages.warnings().end(), has);
}

// The status of the response on which GDAL gave up, or 0.
int lastStatus(const GdalMessages& messages)
{
    for (const std::vector<std::string>& texts : {messages.failures(), messages.warnings()}) {
        for (auto text = texts.rbegin(); text != texts.rend(); ++text) {
            for (const char* words :
                 {"HTTP error code: ", "HTTP error code : ", "HTTP response code: "}) {
                if (const int status = numberAfter(*text, words); status >= 400) {
                    return status;
                }
            }
        }
    }
    return 0;
}

} // namespace

std::optional<std::string> remoteNameFor(const std::string& path)
{
    for (const std::string_view name : kNames) {
        if (path.starts_with(name)) {
            return path;
        }
    }
    for (const Scheme& scheme : kSchemes) {
        if (startsWithIgnoringCase(path, scheme.address)) {
            return std::string(scheme.name) +
                   (scheme.is_kept ? path : path.substr(scheme.address.size()));
        }
    }
    return std::nullopt;
}

std::string addressOf(const std::string& remote_name)
{
    for (const Scheme& scheme : kSchemes) {
        if (!remote_name.starts_with(scheme.name)) {
            continue;
        }
        const std::string rest = remote_name.substr(scheme.name.size());
        if (!scheme.is_kept) {
            return std::string(scheme.address) + rest;
        }
        if (startsWithIgnoringCase(rest, scheme.address)) {
            return rest;
        }
    }
    return remote_name;
}

std::string RemoteVersion::text() const
{
    return fmt::format("{} {} {}", bytes, etag, modified);
}

Result<RemoteVersion> askRemote(const std::string& remote_name)
{
    ensureGdal();
    CPLStringList headers;
    {
        const GdalMessages messages;
        headers.Assign(VSIGetFileMetadata(remote_name.c_str(), "HEADERS", nullptr), TRUE);
    }
    if (headers.Count() == 0) {
        return reasonOfSilence(remote_name);
    }
    RemoteVersion version;
    version.etag = headers.FetchNameValueDef("ETag", "");
    version.modified = headers.FetchNameValueDef("Last-Modified", "");
    const std::string_view bytes = headers.FetchNameValueDef("Content-Length", "0");
    std::from_chars(bytes.data(), bytes.data() + bytes.size(), version.bytes);
    const std::lock_guard lock(known_mutex);
    const auto [known, is_new] = knownVersions().try_emplace(remote_name, version);
    if (!is_new && known->second != version) {
        dropKept(remote_name);
        known->second = version;
    }
    return version;
}

struct RemoteScope::Settings {
    CPLConfigOptionSetter siblings;
    std::optional<CPLConfigOptionSetter> headers;
};

RemoteScope::RemoteScope(const std::string&, const RemoteVersion& version)
    : settings_(new Settings{
          .siblings = CPLConfigOptionSetter("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR", false),
          .headers = {}})
{
    const std::string condition = conditionOf(version);
    if (!condition.empty()) {
        const std::string before = CPLGetConfigOption("GDAL_HTTP_HEADERS", "");
        const std::string all = before + (before.empty() ? "" : ",") + quoted(condition);
        settings_->headers.emplace("GDAL_HTTP_HEADERS", all.c_str(), false);
    }
}

RemoteScope::~RemoteScope() = default;

struct ExactRanges::Settings {
    CPLConfigOptionSetter has_ranges{"GTIFF_HAS_OPTIMIZED_READ_MULTI_RANGE", "YES", false};
};

ExactRanges::ExactRanges()
    : settings_(new Settings)
{}

ExactRanges::~ExactRanges() = default;

Error remoteFailure(const std::string& remote_name,
                    const RemoteVersion& version,
                    const GdalMessages& messages,
                    const std::string& otherwise)
{
    const std::string address = addressOf(remote_name);
    dropKept(remote_name);
    if (says(messages, "Range downloading not supported")) {
        return {ErrorCode::Unsupported,
                fmt::format("{}: the server sends whole files only (it ignores range "
                            "requests); download the file and open it from disk",
                            address)};
    }
    const Result<RemoteVersion> now = askRemote(remote_name);
    if (!now) {
        return now.error();
    }
    if (*now != version) {
        return {ErrorCode::Invalid,
                fmt::format("{}: has changed at the server since it was opened; open it again",
                            address)};
    }
    if (const int status = lastStatus(messages); status != 0) {
        return statusFailure(remote_name, status);
    }
    return {ErrorCode::Unreadable, fmt::format("{}: {}", address, otherwise)};
}

Error notCloudOptimised(const std::string& remote_name, const std::string& why)
{
    return {ErrorCode::Unsupported,
            fmt::format("{}: is not a cloud-optimized GeoTIFF: {}; download it, or convert it "
                        "on the server (gdal_translate -of COG)",
                        addressOf(remote_name), why)};
}

} // namespace marsview
