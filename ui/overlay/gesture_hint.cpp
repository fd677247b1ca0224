#include "ui/overlay/gesture_hint.h"

#include "ui/widgets/icons.h"
#include "ui/widgets/plate.h"

#include <QGridLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QToolButton>
#include <QWheelEvent>

#include <algorithm>

namespace marsview {
namespace {

constexpr int kHintIconSide = 14; // points

// Both zooms are one line.
MapAction lineOf(MapAction action)
{
    return action == MapAction::ZoomFinely ? MapAction::Zoom : action;
}

} // namespace

GestureHint::GestureHint(QWidget* parent)
    : QWidget(parent)
{
    setObjectName(QStringLiteral("gestureHint"));
    setAccessibleName(tr("First Steps"));
    setCursor(Qt::ArrowCursor);
    // Over the map, whatever the theme.
    QPalette colors = palette();
    for (const auto role : {QPalette::WindowText, QPalette::ButtonText, QPalette::Text}) {
        colors.setColor(role, overlayTextColor());
    }
    setPalette(colors);

    auto* title = new QLabel(tr("Move over the map"), this);
    QFont bold = title->font();
    bold.setBold(true);
    title->setFont(bold);
    auto* close = new QToolButton(this);
    close->setObjectName(QStringLiteral("closeHint"));
    close->setIcon(lineIcon(QStringLiteral("close"), overlayTextColor()));
    close->setIconSize({kHintIconSide, kHintIconSide});
    close->setAutoRaise(true);
    close->setFocusPolicy(Qt::TabFocus);
    close->setAccessibleName(tr("Close the Hint"));
    close->setToolTip(tr("Close the hint (Esc); Help › Keys and Mouse lists everything"));
    connect(close, &QToolButton::clicked, this, &GestureHint::dismissed);

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(kPlatePadding + 3, kPlatePadding, kPlatePadding, kPlatePadding + 1);
    grid->setHorizontalSpacing(10);
    grid->setVerticalSpacing(3);
    grid->addWidget(title, 0, 0, 1, 3);
    grid->addWidget(close, 0, 3, Qt::AlignRight);
    struct Text {
        MapAction action;
        QString gesture;
        QString keys;
        QString effect;
    };
    const std::array<Text, 4> texts{
        Text{MapAction::Pan, tr("Drag"), tr("arrow keys"), tr("move")},
        Text{MapAction::Orbit, tr("Right-drag"), tr("Q, E, R, F"), tr("turn and tilt")},
        Text{MapAction::Zoom, tr("Wheel"), tr("Page Up/Down"), tr("zoom")},
        Text{MapAction::FlyThere, tr("Double-click"), {}, tr("fly there")},
    };
    const auto add_mark = [this, grid](std::size_t i, MapAction action, int row) {
        auto* mark = new QLabel(this);
        mark->setFixedSize(kHintIconSide, kHintIconSide);
        grid->addWidget(mark, row, 3, Qt::AlignRight | Qt::AlignVCenter);
        lines_[i] = {.action = action, .mark = mark};
    };
    QString all = title->text();
    int row = 1;
    for (std::size_t i = 0; i < texts.size(); ++i, ++row) {
        grid->addWidget(new QLabel(texts[i].gesture, this), row, 0);
        grid->addWidget(new QLabel(texts[i].keys, this), row, 1);
        grid->addWidget(new QLabel(texts[i].effect, this), row, 2);
        add_mark(i, texts[i].action, row);
        const QString ways = texts[i].keys.isEmpty()
                                 ? texts[i].gesture
                                 //: %1 is a gesture of the mouse, %2 keys with the same effect
                                 : tr("%1 or %2").arg(texts[i].gesture, texts[i].keys);
        //: A list for screen readers: %1 is the list so far, %2 a gesture, %3 its effect
        all = tr("%1. %2: %3").arg(all, ways, texts[i].effect);
    }
    auto* touch = new QLabel(tr("Choose Touch (T) and drag to feel the terrain"), this);
    touch->setFont(bold);
    grid->setRowMinimumHeight(row, 2);
    ++row;
    grid->addWidget(touch, row, 0, 1, 3);
    add_mark(texts.size(), MapAction::Touch, row);
    //: A list that is read aloud: %1 is what comes before, %2 a sentence
    setAccessibleDescription(tr("%1. %2").arg(all, touch->text()));
}

void GestureHint::markDone(MapAction action)
{
    const auto line = std::find_if(lines_.begin(), lines_.end(), [&](const Line& known) {
        return known.action == lineOf(action);
    });
    if (line == lines_.end() || line->is_done) {
        return;
    }
    line->is_done = true;
    line->mark->setPixmap(lineIcon(QStringLiteral("check"), overlayTextColor())
                              .pixmap({kHintIconSide, kHintIconSide}, devicePixelRatioF()));
    if (std::all_of(lines_.begin(), lines_.end(), [](const Line& l) { return l.is_done; })) {
        Q_EMIT dismissed();
    }
}

bool GestureHint::isDone(MapAction action) const
{
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
        return line.action == lineOf(action) && line.is_done;
    });
}

void GestureHint::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    drawPlate(painter, rect());
}

// Nothing of the map is meant that lies below.
void GestureHint::mousePressEvent(QMouseEvent* event)
{
    event->accept();
}

void GestureHint::wheelEvent(QWheelEvent* event)
{
    event->accept();
}

} // namespace marsview
