#include "core/prepare/copy_checkpoint.h"

#include "core/prepare/checkpoint_file.h"

namespace marsview {
namespace {

// To be increased with every change of the fields.
constexpr std::uint32_t kVersion = 1;

} // namespace

bool saveCheckpoint(const std::string& path, const CopyCheckpoint& checkpoint)
{
    CheckpointWriter to(path);
    to.put(kVersion);
    to.putArray(checkpoint.key);
    to.putArray(checkpoint.source_stamp);
    to.put(checkpoint.tile_rows);
    to.put(checkpoint.tile_rows_all);
    to.put(checkpoint.file_bytes);
    to.putArray(checkpoint.overviews);
    return to.finish();
}

std::optional<CopyCheckpoint> readCopyCheckpoint(const std::string& path)
{
    std::optional<CheckpointReader> from = CheckpointReader::open(path);
    std::uint32_t version = 0;
    CopyCheckpoint checkpoint;
    if (!from || !from->get(version) || version != kVersion || !from->getAny(checkpoint.key) ||
        !from->getAny(checkpoint.source_stamp) || !from->get(checkpoint.tile_rows) ||
        !from->get(checkpoint.tile_rows_all) || !from->get(checkpoint.file_bytes) ||
        !from->getAny(checkpoint.overviews)) {
        return std::nullopt;
    }
    return checkpoint;
}

} // namespace marsview
