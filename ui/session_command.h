// Undo of whatever changes the session.
#pragma once

#include "core/session/session.h"

#include <QUndoCommand>

#include <functional>

namespace marsview {

/// Both sessions, before and after: undo and redo are immediate and cannot fail.
class SessionCommand final : public QUndoCommand {
public:
    using Apply = std::function<void(const Session&)>;

    /// Changes that follow each other and may be taken back as one, such as the steps of a slider.
    enum class Run { None = -1, Light = 1 };

    /// `text` continues "Undo …". `apply` outlives the command.
    SessionCommand(
        const QString& text, Session before, Session after, Apply apply, Run run = Run::None);

    void undo() override { apply_(before_); }
    void redo() override { apply_(after_); }
    int id() const override { return static_cast<int>(run_); }
    bool mergeWith(const QUndoCommand* other) override;

private:
    Session before_;
    Session after_;
    Apply apply_;
    Run run_;
};

} // namespace marsview
