// The key that grabs, while it is held.
#pragma once

#include <QObject>
#include <QTimer>

namespace marsview {

/// Follows the space bar from its press to its release, wherever the keyboard focus is in the
/// meantime. A release in another program is not reported to this one: after a return the key
/// counts as released unless it repeats within a second.
class GrabKey final : public QObject {
    Q_OBJECT

public:
    explicit GrabKey(QObject* parent = nullptr);

    /// The key was pressed.
    void hold();
    bool isHeld() const noexcept { return is_held_; }

Q_SIGNALS:
    void released();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void release();

    QTimer return_timer_;
    bool is_held_ = false;
};

} // namespace marsview
