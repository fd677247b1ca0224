// Search in the coordinate reference systems of PROJ's database.
#pragma once

#include "core/geo/body.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// A system as the database lists it.
struct CrsEntry {
    std::string code;           // "EPSG:32610", text for Crs::fromText
    std::string name;           // "WGS 84 / UTM zone 10N"
    const Body* body = nullptr; // null: a body that is not among knownBodies()
    std::string area{};         // where it is used, "Between 126°W and 120°W, …"; may be empty
};

/// An immutable list of systems. Its functions may be called from any thread.
class CrsCatalog {
public:
    /// The geographic, projected and compound systems of PROJ's database that are not deprecated:
    /// some 10,000. Takes tens of milliseconds; empty if PROJ finds no database.
    static CrsCatalog fromDatabase();

    explicit CrsCatalog(const std::vector<CrsEntry>& entries);

    std::size_t size() const noexcept { return records_.size(); }

    /// The systems that match every word of `query`, best first, at most `count_max`. A word
    /// matches a code, or the beginning of a word of the name, the body or the area; "10N" also
    /// matches "zone 10N", and case is ignored. Systems of `body` come first if it is not null.
    /// Entries live as long as the catalog. Takes a few milliseconds.
    std::vector<const CrsEntry*>
    search(std::string_view query, std::size_t count_max, const Body* body = nullptr) const;

private:
    struct Record {
        CrsEntry entry;
        std::vector<std::string> name_words; // lower case, with those of the code
        std::vector<std::string> area_words;
        std::string number; // of the code
        std::string name;   // lower case
    };

    std::vector<Record> records_;
};

} // namespace marsview
