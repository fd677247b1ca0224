// Prepares one part of a map, on any machine that sees the source and the folder of parts.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/level_builder.h"
#include "core/prepare/parts/part_rows.h"
#include "core/prepare/row_memory.h"
#include "core/raster/open_raster.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace marsview {

struct PartJob {
    std::string folder;   // of the parts; created if missing
    std::size_t part = 1; // 1 … parts
    std::size_t parts = 1;
    std::size_t mean_blocks_max = LevelBuild{}.mean_blocks_max; // the same for all parts
    RowMemory memory{}; // the folder of its scratch files is that of the parts
};

struct PartReport {
    PartRows rows;                    // of level-0 tiles
    std::uint64_t samples = 0;        // in these rows
    bool is_copied = false;           // by this call, together with the first pass
    bool is_measured = false;         // the second pass is complete
    std::vector<std::size_t> awaited; // parts that the second pass waits for
    std::vector<std::string> notes;   // sentences for the user
    double copy_seconds = 0.0;
    double level_seconds = 0.0;
};

/// Copies the part's rows of tiles and makes the first pass over them, then, once all parts have
/// got so far, the second pass. Work that is complete is kept: call it again for the second pass,
/// which joinParts() otherwise makes. A part may be killed, repeated, and made in any order. Its
/// own files are compared with their checksums and made again if they are damaged; without damage
/// the source is read once. On all cores; not for the GUI thread. Errors name the file.
Result<PartReport> preparePart(const OpenRaster& raster, const PartJob& job, JobMonitor& monitor);

} // namespace marsview
