// A position that is shown and can be copied.
#pragma once

#include "ui/widgets/reserved_label.h"

#include <QTimer>

namespace marsview {

/// A label whose text is copied by a click, or by Ctrl+C, Space or Enter while it has the focus. It
/// takes the focus by the Tab key only: a click does not change it.
class CoordinateField final : public ReservedLabel {
    Q_OBJECT

public:
    explicit CoordinateField(QWidget* parent = nullptr);

    /// The text to show, except just after a copy. `is_position` is false for a text that replaces
    /// a position; it cannot be copied.
    void showText(const QString& text, bool is_position);
    /// Says for a moment that the position was copied.
    void showCopied();

Q_SIGNALS:
    void copyRequested();
    void focusChanged(bool has_focus);

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void showNow();

    QString text_;
    bool is_position_ = false;
    QTimer copied_timer_; // runs while it says so
};

} // namespace marsview
