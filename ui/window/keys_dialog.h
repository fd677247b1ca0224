// The list of keys and what the mouse does.
#pragma once

#include <QDialog>
#include <QList>
#include <QString>

class QMenu;
class QMenuBar;

namespace marsview {

class KeysDialog final : public QDialog {
    Q_OBJECT

public:
    /// Lists the gestures of the mouse and, by menu, every entry that has a key.
    explicit KeysDialog(const QMenuBar& menus, QWidget* parent = nullptr);

private:
    struct Line {
        QString key;
        QString effect;
    };
    struct Group {
        QString title;
        QList<Line> lines;
    };

    static Group mouseGroup();
    static Group drawingGroup();
    static void addMenu(QList<Group>& groups, const QMenu& menu);
    QWidget* makePage(const QList<Group>& groups, int columns);
    QWidget* makeGroup(const Group& group);
};

} // namespace marsview
