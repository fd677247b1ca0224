#include "ui/dialogs/keys_dialog.h"

#include "ui/tools/gestures.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>

#include <array>

namespace marsview {

KeysDialog::KeysDialog(const QList<QAction*>& actions, QWidget* parent)
    : QDialog(parent)
{
    setWindowTitle(tr("Keys and Mouse"));
    // Two columns, so that it fits on a small screen.
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(20);
    grid->setVerticalSpacing(3);
    grid->setColumnMinimumWidth(2, 24);
    QList<std::array<QString, 2>> lines;
    for (const GestureLine& line : gestureLines()) {
        lines.append({line.gesture, line.action});
    }
    lines.append({tr("Space held"), tr("Grab: pan in contact, zoom in the air")});
    lines.append({tr("Drop files"), tr("Open them")});
    lines.append({tr("SpaceMouse cap"), tr("Pan, zoom, turn and tilt")});
    lines.append({tr("SpaceMouse button 1"), tr("Show the whole map")});
    for (const QAction* action : actions) {
        if (!action->shortcut().isEmpty()) {
            lines.append({QKeySequence::listToString(action->shortcuts().mid(0, 1),
                                                     QKeySequence::NativeText),
                          action->text().remove(QLatin1Char('&')).remove(QChar(0x2026))});
        }
    }
    const int half = (static_cast<int>(lines.size()) + 1) / 2;
    for (int i = 0; i < lines.size(); ++i) {
        auto* key = new QLabel(lines[i][0], this);
        QFont font = key->font();
        font.setBold(true);
        key->setFont(font);
        const int column = i < half ? 0 : 3;
        grid->addWidget(key, i % half, column);
        grid->addWidget(new QLabel(lines[i][1], this), i % half, column + 1);
    }
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(grid);
    layout->addSpacing(8);
    layout->addWidget(buttons);
}

} // namespace marsview
