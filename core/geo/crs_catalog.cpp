#include "core/geo/crs_catalog.h"

#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>
#include <utility>

namespace marsview {
namespace {

// Words that people type, and the matching words of the database's names.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kSynonyms{{
    {"lunar", "moon"},
    {"martian", "mars"},
    {"wgs84", "wgs 84"},
    {"simple cylindrical", "equirectangular"},
    {"equidistant cylindrical", "equirectangular"},
    {"plate carree", "equirectangular"},
    {"plate carrée", "equirectangular"},
}};

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

// Runs of letters, digits and non-ASCII characters, in lower case.
std::vector<std::string> wordsOf(std::string_view text)
{
    std::vector<std::string> words;
    std::string word;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || byte >= 0x80) {
            word += static_cast<char>(std::tolower(byte));
        } else if (!word.empty()) {
            words.push_back(std::exchange(word, {}));
        }
    }
    if (!word.empty()) {
        words.push_back(word);
    }
    return words;
}

bool isInList(const std::vector<std::string>& words, std::string_view word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool isStartInList(const std::vector<std::string>& words, std::string_view start)
{
    return std::any_of(words.begin(), words.end(),
                       [start](const std::string& word) { return word.starts_with(start); });
}

const Body* bodyOfEntry(std::string_view authority, std::string_view name)
{
    // Names of places on the Earth contain names of bodies.
    const bool is_planetary = authority.starts_with("IAU") || authority == "ESRI";
    const Body* mentioned = is_planetary ? bodyMentioned(name) : nullptr;
    return mentioned != nullptr || authority.starts_with("IAU") ? mentioned : bodyNamed("Earth");
}

bool isForMaps(const OSRCRSInfo& info)
{
    switch (info.eType) {
    case OSR_CRS_TYPE_GEOGRAPHIC_2D:
    case OSR_CRS_TYPE_PROJECTED:
    case OSR_CRS_TYPE_COMPOUND:
        return true;
    case OSR_CRS_TYPE_OTHER: // planetocentric systems on ellipsoids
        return std::string_view(info.pszAuthName).starts_with("IAU");
    default:
        return false;
    }
}

std::string textOf(const char* text)
{
    return text != nullptr ? text : "";
}

} // namespace

CrsCatalog CrsCatalog::fromDatabase()
{
    int count = 0;
    OSRCRSInfo** list = OSRGetCRSInfoListFromDatabase(nullptr, nullptr, &count);
    std::vector<CrsEntry> entries;
    for (int i = 0; i < count; ++i) {
        const OSRCRSInfo& info = *list[i];
        if (info.bDeprecated == 0 && isForMaps(info)) {
            const std::string authority = textOf(info.pszAuthName);
            const std::string name = textOf(info.pszName);
            entries.push_back({.code = authority + ":" + textOf(info.pszCode),
                               .name = name,
                               .body = bodyOfEntry(authority, name),
                               .area = textOf(info.pszAreaName)});
        }
    }
    OSRDestroyCRSInfoList(list);
    return CrsCatalog(entries);
}

CrsCatalog::CrsCatalog(const std::vector<CrsEntry>& entries)
{
    records_.reserve(entries.size());
    for (const CrsEntry& entry : entries) {
        Record record{.entry = entry,
                      .name_words = wordsOf(entry.name),
                      .area_words = wordsOf(entry.area),
                      .number = lowerCase(entry.code.substr(entry.code.find(':') + 1)),
                      .name = lowerCase(entry.name)};
        for (std::string& word : wordsOf(entry.code)) {
            record.name_words.push_back(std::move(word));
        }
        if (entry.body != nullptr) {
            record.name_words.push_back(lowerCase(entry.body->name));
        }
        records_.push_back(std::move(record));
    }
}

std::vector<const CrsEntry*>
CrsCatalog::search(std::string_view query, std::size_t count_max, const Body* body) const
{
    std::string plain = lowerCase(query);
    for (const auto& [common, in_database] : kSynonyms) {
        if (const std::size_t at = plain.find(common); at != std::string::npos) {
            plain.replace(at, common.size(), in_database);
        }
    }
    const std::vector<std::string> words = wordsOf(plain);
    if (words.empty()) {
        return {};
    }
    struct Hit {
        int penalty = 0;
        const Record* record = nullptr;
    };
    std::vector<Hit> hits;
    for (const Record& record : records_) {
        // The sum over the words: 0 for a word of the name, more for a prefix or a word of the
        // area.
        int penalty = 0;
        bool is_match = true;
        for (const std::string& word : words) {
            if (word == record.number || isInList(record.name_words, word)) {
                continue;
            }
            if (isStartInList(record.name_words, word)) {
                penalty += 2;
            } else if (isStartInList(record.area_words, word)) {
                penalty += 5;
            } else {
                is_match = false;
                break;
            }
        }
        if (!is_match) {
            continue;
        }
        const bool is_exact = record.name == plain || lowerCase(record.entry.code) == plain ||
                              isInList(words, record.number);
        penalty += is_exact ? -100 : 0;
        penalty += body != nullptr && record.entry.body != body ? 20 : 0;
        // Systems in general use come before those of a single mapping agency.
        const std::string_view code = record.entry.code;
        penalty += code.starts_with("EPSG") || code.starts_with("IAU") ? 0 : 4;
        penalty += record.entry.body == bodyNamed("Earth") && !record.name.starts_with("wgs 84") &&
                           !is_exact
                       ? 1
                       : 0;
        penalty +=
            code.starts_with("IAU") && record.name.find("sphere") == std::string::npos && !is_exact
                ? 1
                : 0;
        hits.push_back({.penalty = penalty, .record = &record});
    }
    const auto key = [](const Hit& hit) {
        const CrsEntry& entry = hit.record->entry;
        return std::tuple(hit.penalty, entry.name.size(), entry.code.size(),
                          std::string_view(entry.code));
    };
    const auto middle =
        hits.begin() + static_cast<std::ptrdiff_t>(std::min(count_max, hits.size()));
    std::partial_sort(hits.begin(), middle, hits.end(),
                      [&key](const Hit& a, const Hit& b) { return key(a) < key(b); });
    std::vector<const CrsEntry*> entries;
    for (auto hit = hits.begin(); hit != middle; ++hit) {
        entries.push_back(&hit->record->entry);
    }
    return entries;
}

} // namespace marsview
