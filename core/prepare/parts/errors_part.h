// The share of a part in the second pass over a map.
#pragma once

#include "core/base/result.h"
#include "core/files/file_bytes.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_errors.h"
#include "core/prepare/parts/part_rows.h"
#include "core/tiles/tile.h"

namespace marsview {

/// Writes what the pass found in `rows`, which it has processed.
void saveErrors(CheckpointWriter& to,
                LevelErrorPass& pass,
                const TileLayout& layout,
                const PartRows& rows);

/// Adds what saveErrors() wrote, as mergeSurvey() does. The fills stored by the part are read from
/// `fills` and stored again.
Status mergeErrors(CheckpointReader& from,
                   LevelErrorPass& pass,
                   const TileLayout& layout,
                   const PartRows& rows,
                   const FileBytes& fills);

} // namespace marsview
