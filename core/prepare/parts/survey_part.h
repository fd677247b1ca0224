// The share of a part in the first pass over a map.
#pragma once

#include "core/base/result.h"
#include "core/files/file_bytes.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_survey.h"
#include "core/prepare/parts/part_rows.h"
#include "core/tiles/tile.h"

#include <string>

namespace marsview {

/// Writes what the pass found in `rows`, which it has processed together with the rows of means in
/// them: in proportion to the rows, not to the map. Without LevelSurveyPass::State::nested.
void saveSurvey(CheckpointWriter& to,
                LevelSurveyPass& pass,
                const TileLayout& layout,
                const PartRows& rows);

/// Adds what saveSurvey() wrote. Parts are merged in the order of their rows; the result is that
/// of one pass over all of them. The tiles stored by the part are read from `tiles` and stored
/// again, and its incomplete bands of levels from `bands`, unless these are null. The part's finest
/// means stay in their file `means_path`. Invalid if
/// `from` is not of such a part.
Status mergeSurvey(CheckpointReader& from,
                   LevelSurveyPass& pass,
                   const TileLayout& layout,
                   const PartRows& rows,
                   const FileBytes* tiles,
                   CheckpointReader* bands,
                   const std::string& means_path);

} // namespace marsview
