#include "ui/controllers/session_command.h"

#include <utility>

namespace marsview {
namespace {

constexpr int kKindBits = 2;

} // namespace

SessionCommand::SessionCommand(
    const QString& text, Session before, Session after, Apply apply, SessionRun run)
    : QUndoCommand(text)
    , before_(std::move(before))
    , after_(std::move(after))
    , apply_(std::move(apply))
    , run_(run)
{}

int SessionCommand::id() const
{
    return run_.kind == SessionRun::Kind::None
               ? -1 // merges with nothing
               : (run_.serial << kKindBits) + static_cast<int>(run_.kind);
}

bool SessionCommand::mergeWith(const QUndoCommand* other)
{
    // Commands of one id are of one class.
    const auto* next = static_cast<const SessionCommand*>(other);
    after_ = next->after_;
    setText(next->text());
    setObsolete(after_ == before_);
    return true;
}

} // namespace marsview
