#include "ui/drawing/name_field.h"

#include "ui/drawing/drawing_base.h"

#include <QEvent>
#include <QFocusEvent>
#include <QKeyEvent>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr int kAway = 12;    // points from the place to the nearest corner of the field
constexpr int kLetters = 20; // that the field has room for

bool isMapKey(const QKeyEvent& event)
{
    switch (event.key()) {
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
        return true;
    default:
        return event.matches(QKeySequence::Undo) || event.matches(QKeySequence::Redo);
    }
}

bool isModifier(int key)
{
    return key == Qt::Key_Control || key == Qt::Key_Shift || key == Qt::Key_Alt ||
           key == Qt::Key_AltGr || key == Qt::Key_Meta;
}

} // namespace

NameField::NameField(DrawingBase& drawing, QWidget& view)
    : QLineEdit(&view)
    , drawing_(&drawing)
    , view_(view)
{
    setObjectName(QStringLiteral("nameField"));
    setAccessibleName(tr("Name of the new annotation"));
    setToolTip(tr("Enter keeps the name, Esc the usual one"));
    hide();
    view.installEventFilter(this);
    connect(&drawing, &DrawingBase::placed, this, &NameField::openFor);
    connect(&drawing, &DrawingBase::moved, this, &NameField::follow);
    connect(&drawing, &DrawingBase::changed, this, [this] {
        if (item_ != 0 && drawing_->itemOf(item_) == nullptr) {
            close(); // undone or removed
        }
    });
}

void NameField::openFor(std::uint32_t item)
{
    keep();
    const DrawnItem* named = drawing_->itemOf(item);
    if (named == nullptr || view_.isHidden() || !drawing_->namePlace(item)) {
        return; // nobody sees what would be named
    }
    item_ = item;
    setText(named->name);
    setModified(false);
    selectAll();
    resize(fontMetrics().averageCharWidth() * kLetters, sizeHint().height());
    follow();
    show();
    raise();
    setFocus(Qt::OtherFocusReason);
}

void NameField::follow()
{
    if (item_ == 0) {
        return;
    }
    const auto place = drawing_->namePlace(item_);
    if (!place) {
        keep(); // it has left the picture
        return;
    }
    const QPoint corner = place->toPoint() + QPoint(kAway, kAway);
    move(std::clamp(corner.x(), 0, std::max(0, view_.width() - width())),
         std::clamp(corner.y(), 0, std::max(0, view_.height() - height())));
}

void NameField::keep()
{
    const std::uint32_t item = item_;
    const bool is_typed = isModified();
    close();
    if (item != 0 && is_typed && drawing_) {
        drawing_->rename(item, text());
    }
}

void NameField::close()
{
    if (std::exchange(item_, 0) == 0) {
        return;
    }
    const bool had_focus = hasFocus();
    hide();
    if (had_focus) {
        view_.setFocus(Qt::OtherFocusReason);
    }
}

// Other keys than those of text are passed to the map or the menus, and the name is kept: the next
// point can be placed, the placing undone or the project saved at once.
bool NameField::event(QEvent* event)
{
    if (event->type() != QEvent::ShortcutOverride || item_ == 0) {
        return QLineEdit::event(event);
    }
    auto& key = *static_cast<QKeyEvent*>(event);
    if (key.key() == Qt::Key_Escape) {
        key.accept();
        return true;
    }
    if (!isModified() && isMapKey(key)) {
        keep();
        key.ignore();
        return true;
    }
    const bool is_handled = QLineEdit::event(event);
    const bool is_command = key.modifiers().testFlag(Qt::ControlModifier) ||
                            key.modifiers().testFlag(Qt::AltModifier) ||
                            (key.key() >= Qt::Key_F1 && key.key() <= Qt::Key_F35);
    if (!key.isAccepted() && is_command && !isModifier(key.key())) {
        keep();
    }
    return is_handled;
}

void NameField::keyPressEvent(QKeyEvent* event)
{
    switch (event->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
        keep();
        break;
    case Qt::Key_Escape:
        close();
        break;
    default:
        QLineEdit::keyPressEvent(event);
    }
    event->accept(); // the map has no part in it
}

void NameField::focusOutEvent(QFocusEvent* event)
{
    QLineEdit::focusOutEvent(event);
    // Its own menu, or another program.
    if (event->reason() != Qt::PopupFocusReason && event->reason() != Qt::ActiveWindowFocusReason) {
        keep();
    }
}

bool NameField::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == &view_ && event->type() == QEvent::MouseButtonPress) {
        keep();
    }
    return QLineEdit::eventFilter(watched, event);
}

} // namespace marsview
