// Where on the screen the window may be.
#pragma once

#include <QObject>
#include <QRect>

class QWidget;

namespace marsview {

/// `frame` moved, and shrunk where needed, to lie within `available`: both with the window's frame.
QRect fittedTo(const QRect& frame, const QRect& available);

/// Keeps a window, its frame included, within the part of its screen that panels of the desktop
/// leave free: before it is shown, when it is shown, and when it comes to another screen or the
/// screen changes. A child of the window.
class WindowPlace final : public QObject {
    Q_OBJECT

public:
    explicit WindowPlace(QWidget& window);

    void fit();

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void followScreen();

    QWidget& window_;
    bool is_following_ = false;
};

} // namespace marsview
