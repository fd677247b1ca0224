// Undo of told georeferencing.
#pragma once

#include "core/raster/raster_info.h"

#include <QUndoCommand>

#include <functional>

namespace marsview {

/// A change from one set of overrides to another, already in effect when it is pushed.
class OverrideCommand final : public QUndoCommand {
public:
    /// `apply` is called with the overrides to put in effect on each undo and redo.
    OverrideCommand(RasterOverrides before,
                    RasterOverrides after,
                    std::function<void(const RasterOverrides&)> apply);

    void undo() override;
    void redo() override;

private:
    RasterOverrides before_;
    RasterOverrides after_;
    std::function<void(const RasterOverrides&)> apply_;
    bool is_in_effect_ = true;
};

} // namespace marsview
