// How far a map's preparation has come, for the next attempt after this one was stopped.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// What the file that is being written holds for certain.
struct PrepareJournal {
    std::string key; // source, settings and form: whether it is the same work
    /// SourceStamp::text of what was read; empty where an earlier version wrote the journal.
    std::string source_stamp;
    std::uint64_t tile_rows = 0; // of the raster, complete
    std::uint64_t tile_rows_all = 0;
    std::uint64_t file_bytes = 0;
    std::vector<std::uint8_t> overviews; // OverviewBuilder::save
    bool operator==(const PrepareJournal&) const = default;
};

/// Takes the place of what was there in one step; on the disk when it returns.
Status writeJournal(const std::string& path, const PrepareJournal& journal);

/// Nothing where there is none, or where it is damaged.
std::optional<PrepareJournal> readJournal(const std::string& path);

} // namespace marsview
