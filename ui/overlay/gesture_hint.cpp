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
constexpr int kColumnSpacing = 10;
constexpr int kRowSpacing = 3;

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

    title_ = new QLabel(tr("Move over the map"), this);
    QFont bold = title_->font();
    bold.setBold(true);
    title_->setFont(bold);
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
    grid->setHorizontalSpacing(kColumnSpacing);
    grid->setVerticalSpacing(kRowSpacing);
    grid->addWidget(title_, 0, 0, 1, 3);
    // Over two rows: without the title the button is next to the first line.
    grid->addWidget(close, 0, 4, 2, 1, Qt::AlignRight | Qt::AlignTop);
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
    const auto make_mark = [this, grid](int row) {
        auto* mark = new QLabel(this);
        mark->setFixedSize(kHintIconSide, kHintIconSide);
        grid->addWidget(mark, row, 3, Qt::AlignRight | Qt::AlignVCenter);
        return mark;
    };
    QString all = title_->text();
    int row = 1;
    for (std::size_t i = 0; i < texts.size(); ++i, ++row) {
        Line& line = lines_[i];
        line.action = texts[i].action;
        line.gesture = new QLabel(texts[i].gesture, this);
        line.keys = new QLabel(texts[i].keys, this);
        line.effect = new QLabel(texts[i].effect, this);
        grid->addWidget(line.gesture, row, 0);
        grid->addWidget(line.keys, row, 1);
        grid->addWidget(line.effect, row, 2);
        line.mark = make_mark(row);
        const QString ways = texts[i].keys.isEmpty()
                                 ? texts[i].gesture
                                 //: %1 is a gesture of the mouse, %2 keys with the same effect
                                 : tr("%1 or %2").arg(texts[i].gesture, texts[i].keys);
        //: A list for screen readers: %1 is the list so far, %2 a gesture, %3 its effect
        all = tr("%1. %2: %3").arg(all, ways, texts[i].effect);
    }
    invitation_ = new QLabel(tr("Choose Touch (T) and drag to feel the terrain"), this);
    invitation_->setFont(bold);
    grid->addWidget(invitation_, row, 0, 1, 3);
    Line& touch = lines_.back();
    touch.action = MapAction::Touch;
    //: In the hint over the map: choose the tool by its key, then drag
    touch.gesture = new QLabel(tr("T, then drag"), this);
    //: In the hint over the map: what a drag with the tool Touch does
    touch.effect = new QLabel(tr("feel the terrain"), this);
    touch.gesture->hide();
    touch.effect->hide();
    grid->addWidget(touch.gesture, row, 0);
    grid->addWidget(touch.effect, row, 2);
    touch.mark = make_mark(row);
    //: A list that is read aloud: %1 is what comes before, %2 a sentence
    setAccessibleDescription(tr("%1. %2").arg(all, invitation_->text()));
}

void GestureHint::setForm(Form form)
{
    if (form == form_) {
        return;
    }
    form_ = form;
    title_->setVisible(form < Form::WithoutTitle);
    const bool is_full = form == Form::Full;
    for (const Line& line : lines_) {
        const bool is_shown = (line.action != MapAction::FlyThere || form < Form::WithoutFlights) &&
                              (line.action != MapAction::Orbit || form < Form::MoveZoomTouch);
        const bool is_sentence = is_full && line.action == MapAction::Touch;
        line.gesture->setVisible(is_shown && !is_sentence);
        line.effect->setVisible(is_shown && !is_sentence);
        line.mark->setVisible(is_shown);
        if (line.keys != nullptr) {
            line.keys->setVisible(is_full);
        }
    }
    invitation_->setVisible(is_full);
    auto* grid = static_cast<QGridLayout*>(layout());
    grid->setHorizontalSpacing(is_full ? kColumnSpacing : kColumnSpacing / 2);
    grid->setVerticalSpacing(is_full ? kRowSpacing : 1);
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
