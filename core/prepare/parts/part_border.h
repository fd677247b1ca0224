// What the second pass over a part needs of the other parts.
//
// A part of a map with N parts thereby reads little more than its own files: of another part, one
// row of samples if it is the next one, one sample in 512 × 512, and, on maps with voids, the means
// of blocks that are kept in memory.
#pragma once

#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_survey.h"
#include "core/prepare/parts/part_rows.h"
#include "core/tiles/tile.h"

#include <string>

namespace marsview {

/// Writes what other parts need of `rows`, which the pass has processed, and flushes the finest
/// means to the disk. False on failure.
bool saveBorder(CheckpointWriter& to,
                LevelSurveyPass& pass,
                const TileLayout& layout,
                const PartRows& rows);

/// Adds what saveBorder() wrote for `other` to a pass that has the survey of `rows`. The other's
/// finest means are read from their file `means_path`. Invalid if `from` is not of such a part.
Status mergeBorder(CheckpointReader& from,
                   LevelSurveyPass& pass,
                   const TileLayout& layout,
                   const PartRows& other,
                   const PartRows& rows,
                   const std::string& means_path);

} // namespace marsview
