#include "ui/widgets/coordinate_field.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QStyleOptionFocusRect>
#include <QStylePainter>

#include <chrono>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kCopiedDuration{1200};

} // namespace

CoordinateField::CoordinateField(QWidget* parent)
    : ReservedLabel({}, parent)
{
    setTextInteractionFlags(Qt::NoTextInteraction);
    setFocusPolicy(Qt::TabFocus);
    copied_timer_.setSingleShot(true);
    connect(&copied_timer_, &QTimer::timeout, this, &CoordinateField::showNow);
}

void CoordinateField::showText(const QString& text, bool is_position)
{
    text_ = text;
    is_position_ = is_position;
    showNow();
}

void CoordinateField::showCopied()
{
    copied_timer_.start(kCopiedDuration);
    showNow();
}

void CoordinateField::showNow()
{
    const bool is_copied = copied_timer_.isActive();
    // Not disabled: the Tab key reaches it, and the crosshair with it.
    setForegroundRole(is_position_ || is_copied ? QPalette::WindowText : QPalette::PlaceholderText);
    setCursor(is_position_ ? Qt::PointingHandCursor : Qt::ArrowCursor);
    setHint(is_position_ ? tr("Click to copy the coordinates") : QString());
    //: In place of a position, for a moment after it was copied to the clipboard
    setWholeText(is_copied ? tr("Copied") : text_);
}

void CoordinateField::mousePressEvent(QMouseEvent* event)
{
    event->setAccepted(event->button() == Qt::LeftButton && is_position_);
}

void CoordinateField::mouseReleaseEvent(QMouseEvent* event)
{
    if (event->button() == Qt::LeftButton && rect().contains(event->position().toPoint())) {
        Q_EMIT copyRequested();
    }
}

void CoordinateField::keyPressEvent(QKeyEvent* event)
{
    const int key = event->key();
    if (event->matches(QKeySequence::Copy) || key == Qt::Key_Space || key == Qt::Key_Return ||
        key == Qt::Key_Enter) {
        Q_EMIT copyRequested();
        return;
    }
    ReservedLabel::keyPressEvent(event);
}

void CoordinateField::focusInEvent(QFocusEvent* event)
{
    ReservedLabel::focusInEvent(event);
    update();
    Q_EMIT focusChanged(true);
}

void CoordinateField::focusOutEvent(QFocusEvent* event)
{
    ReservedLabel::focusOutEvent(event);
    update();
    Q_EMIT focusChanged(false);
}

void CoordinateField::paintEvent(QPaintEvent* event)
{
    ReservedLabel::paintEvent(event);
    if (hasFocus()) {
        QStylePainter painter(this);
        QStyleOptionFocusRect option;
        option.initFrom(this);
        option.backgroundColor = palette().color(QPalette::Window);
        option.state |= QStyle::State_KeyboardFocusChange;
        painter.drawPrimitive(QStyle::PE_FrameFocusRect, option);
    }
}

} // namespace marsview
