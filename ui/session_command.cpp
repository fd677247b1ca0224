#include "ui/session_command.h"

#include <utility>

namespace marsview {

SessionCommand::SessionCommand(
    const QString& text, Session before, Session after, Apply apply, Run run)
    : QUndoCommand(text)
    , before_(std::move(before))
    , after_(std::move(after))
    , apply_(std::move(apply))
    , run_(run)
{}

bool SessionCommand::mergeWith(const QUndoCommand* other)
{
    // Commands of one id are of one class.
    after_ = static_cast<const SessionCommand*>(other)->after_;
    return true;
}

} // namespace marsview
