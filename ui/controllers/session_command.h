// Undo of whatever changes the session.
#pragma once

#include "core/session/session.h"

#include <QUndoCommand>

#include <functional>

namespace marsview {

/// Changes that follow each other and may be taken back as one, such as the steps of a slider. Two
/// changes merge where kind and serial are equal.
struct SessionRun {
    enum class Kind { None, Light, Exaggeration, Stretch } kind = Kind::None;
    int serial = 0; // of the drag
};

/// Both sessions, before and after: undo and redo are immediate and cannot fail.
class SessionCommand final : public QUndoCommand {
public:
    using Apply = std::function<void(const Session&)>;

    /// `text` continues "Undo …". `apply` outlives the command.
    SessionCommand(
        const QString& text, Session before, Session after, Apply apply, SessionRun run = {});

    void undo() override { apply_(before_); }
    void redo() override { apply_(after_); }
    int id() const override;
    /// The text is that of the last change. Becomes obsolete if the changes cancel out.
    bool mergeWith(const QUndoCommand* other) override;

private:
    Session before_;
    Session after_;
    Apply apply_;
    SessionRun run_;
};

} // namespace marsview
