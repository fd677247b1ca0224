// The progress of a map's preparation, for resuming after an interruption.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The guaranteed content of the unfinished file.
struct PrepareJournal {
    std::string key; // source, settings and format: identifies the job
    /// SourceStamp::text of the source; empty if an earlier version wrote the journal.
    std::string source_stamp;
    std::uint64_t tile_rows = 0; // of the raster, complete
    std::uint64_t tile_rows_all = 0;
    std::uint64_t file_bytes = 0;
    std::vector<std::uint8_t> overviews; // OverviewBuilder::save
    bool operator==(const PrepareJournal&) const = default;
};

/// Replaces the journal atomically; it is on the disk when the function returns.
Status writeJournal(const std::string& path, const PrepareJournal& journal);

/// Empty if there is none or it is damaged.
std::optional<PrepareJournal> readJournal(const std::string& path);

} // namespace marsview
