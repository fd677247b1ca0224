#include "ui/window/keys_dialog.h"

#include "ui/canvas/gestures.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include <algorithm>
#include <array>

namespace marsview {
namespace {

constexpr int kColumnsMax = 3;
constexpr int kTitleLines = 2; // a group's title and frame are as high as so many of its lines

QString plainTitle(QString text)
{
    return text.remove(QLatin1Char('&')).remove(QChar(0x2026));
}

QString withMinusSign(const QString& key)
{
    return key == QStringLiteral("-") ? QString(QChar(0x2212)) : key;
}

QString textOf(const QAction& action)
{
    const QString text = action.property(kKeyTextProperty).toString();
    return text.isEmpty() ? plainTitle(action.text()) : text;
}

QString keysOf(const QAction& action)
{
    const QList<QKeySequence> keys = action.shortcuts();
    if (keys.isEmpty()) {
        return {};
    }
    const QString first = withMinusSign(keys[0].toString(QKeySequence::NativeText));
    return keys.size() == 1
               ? first
               //: Two keys for the same
               : KeysDialog::tr("%1 or %2").arg(first, keys[1].toString(QKeySequence::NativeText));
}

} // namespace

KeysDialog::KeysDialog(const QMenuBar& menus, QWidget* parent)
    : QDialog(parent)
{
    setWindowTitle(tr("Keys and Mouse"));
    QList<Group> groups{mouseGroup(), drawingGroup()};
    for (const QAction* action : menus.actions()) {
        if (action->menu() != nullptr) {
            addMenu(groups, *action->menu());
        }
    }
    const QSize room = screen()->availableSize() * 9 / 10;
    QWidget* page = nullptr;
    for (int columns = kColumnsMax; columns > 0; --columns) {
        delete page;
        page = makePage(groups, columns);
        if (page->sizeHint().width() < room.width()) {
            break;
        }
    }
    auto* area = new QScrollArea(this);
    area->setWidget(page);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setAccessibleName(tr("Keys and gestures"));
    const QSize page_size = page->sizeHint();
    area->setMinimumSize(
        std::min(page_size.width() + area->verticalScrollBar()->sizeHint().width(), room.width()),
        std::min(page_size.height() + 4, room.height() - 80));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(area, 1);
    layout->addWidget(buttons);
}

// Columns of about the same height, in reading order.
QWidget* KeysDialog::makePage(const QList<Group>& groups, int columns)
{
    const auto heightOf = [](const Group& group) {
        return static_cast<int>(group.lines.size()) + kTitleLines;
    };
    int left = 0; // lines
    for (const Group& group : groups) {
        left += heightOf(group);
    }
    auto* page = new QWidget(this);
    auto* row = new QHBoxLayout(page);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(12);
    auto next = groups.begin();
    for (int column = 0; column < columns; ++column) {
        auto* stack = new QVBoxLayout;
        row->addLayout(stack);
        const int share = left / (columns - column);
        int height = 0;
        while (next != groups.end() &&
               (height == 0 || column + 1 == columns || height + heightOf(*next) / 2 <= share)) {
            height += heightOf(*next);
            stack->addWidget(makeGroup(*next++));
        }
        left -= height;
        stack->addStretch(1);
    }
    return page;
}

KeysDialog::Group KeysDialog::mouseGroup()
{
    Group group{.title = tr("Mouse"), .lines = {}};
    for (const GestureLine& line : gestureLines()) {
        group.lines.append({line.gesture, line.action});
    }
    group.lines.append({tr("Space held"), tr("Grab: pan in contact, zoom in the air")});
    group.lines.append({tr("Drop files"), tr("Open them")});
    group.lines.append({tr("SpaceMouse cap"), tr("Pan, zoom, turn and tilt")});
    group.lines.append({tr("SpaceMouse button 1"), tr("Show the whole map")});
    return group;
}

// The keys that the map handles while a measurement or an annotation is drawn.
KeysDialog::Group KeysDialog::drawingGroup()
{
    const auto name = [](Qt::Key key) {
        return QKeySequence(key).toString(QKeySequence::NativeText);
    };
    //: A group of keys: those of the tools Measure and Annotate
    Group group{.title = tr("Measure and Annotate"), .lines = {}};
    group.lines.append({name(Qt::Key_Enter), tr("Place a point at the pointer or crosshair")});
    //: %1 is a key
    group.lines.append({tr("%1 again").arg(name(Qt::Key_Enter)), tr("In the same place: finish")});
    group.lines.append(
        {name(Qt::Key_Backspace), tr("Remove the last point, or the one under the pointer")});
    group.lines.append(
        {name(Qt::Key_Delete), tr("Remove the selected item, or the point under the pointer")});
    group.lines.append({name(Qt::Key_Escape), tr("Discard an unfinished item, or deselect")});
    group.lines.append({tr("Drag a point"), tr("Move it")});
    group.lines.append({tr("Drag a line"), tr("Insert a point")});
    return group;
}

// A submenu is a separate group.
void KeysDialog::addMenu(QList<Group>& groups, const QMenu& menu)
{
    Group group{.title = plainTitle(menu.title()), .lines = {}};
    QList<Group> inner;
    for (const QAction* action : menu.actions()) {
        if (action->menu() != nullptr) {
            addMenu(inner, *action->menu());
        } else if (!action->shortcut().isEmpty()) {
            group.lines.append({keysOf(*action), textOf(*action)});
        }
    }
    if (!group.lines.isEmpty()) {
        groups.append(group);
    }
    groups += inner;
}

QWidget* KeysDialog::makeGroup(const Group& group)
{
    auto* box = new QGroupBox(group.title, this);
    auto* grid = new QGridLayout(box);
    grid->setHorizontalSpacing(16);
    grid->setVerticalSpacing(2);
    grid->setColumnStretch(1, 1);
    int row = 0;
    for (const Line& line : group.lines) {
        auto* key = new QLabel(line.key, box);
        QFont font = key->font();
        font.setBold(true);
        key->setFont(font);
        grid->addWidget(key, row, 0);
        grid->addWidget(new QLabel(line.effect, box), row, 1);
        ++row;
    }
    return box;
}

} // namespace marsview
