#include "ui/override_command.h"

#include <QCoreApplication>

#include <utility>

namespace marsview {

OverrideCommand::OverrideCommand(RasterOverrides before,
                                 RasterOverrides after,
                                 std::function<void(const RasterOverrides&)> apply)
    : QUndoCommand(QCoreApplication::translate("OverrideCommand", "Change of Georeferencing"))
    , before_(std::move(before))
    , after_(std::move(after))
    , apply_(std::move(apply))
{}

void OverrideCommand::undo()
{
    apply_(before_);
}

void OverrideCommand::redo()
{
    if (std::exchange(is_in_effect_, false)) {
        return; // QUndoStack::push calls this too
    }
    apply_(after_);
}

} // namespace marsview
