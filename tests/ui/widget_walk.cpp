#include "tests/ui/widget_walk.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QProgressBar>
#include <QScrollArea>
#include <QSlider>
#include <QSpinBox>
#include <QStackedWidget>
#include <QTabBar>

namespace marsview {
namespace {

bool isInside(const QWidget& widget)
{
    if (widget.objectName().startsWith(QStringLiteral("qt_"))) {
        return true;
    }
    const QWidget* parent = widget.parentWidget();
    const bool is_title_button = qobject_cast<const QDockWidget*>(parent) != nullptr &&
                                 qobject_cast<const QAbstractButton*>(&widget) != nullptr;
    bool is_part = qobject_cast<const QHeaderView*>(&widget) != nullptr; // of its list
    for (const QWidget* ancestor = parent; ancestor != nullptr && !is_part;
         ancestor = ancestor->parentWidget()) {
        is_part = qobject_cast<const QAbstractSpinBox*>(ancestor) != nullptr ||
                  qobject_cast<const QComboBox*>(ancestor) != nullptr ||
                  qobject_cast<const QLineEdit*>(ancestor) != nullptr;
    }
    return is_title_button || is_part;
}

void addActions(const QList<QAction*>& actions, QList<FoundText>& texts)
{
    for (const QAction* action : actions) {
        const QString place = QStringLiteral("QAction ");
        texts.append({place + QStringLiteral("text"), action->text()});
        texts.append({place + QStringLiteral("toolTip"), action->toolTip()});
        texts.append({place + QStringLiteral("iconText"), action->iconText()});
        texts.append({place + QStringLiteral("statusTip"), action->statusTip()});
    }
}

void addItems(const QAbstractItemModel& model, const QString& place, QList<FoundText>& texts)
{
    for (int row = 0; row < model.rowCount(); ++row) {
        const QModelIndex index = model.index(row, 0);
        for (const int role : {static_cast<int>(Qt::DisplayRole), static_cast<int>(Qt::ToolTipRole),
                               static_cast<int>(Qt::AccessibleTextRole)}) {
            texts.append({place + QStringLiteral(" item"), index.data(role).toString()});
        }
        for (int role = Qt::UserRole; role < Qt::UserRole + 8; ++role) {
            if (index.data(role).typeId() == QMetaType::QString &&
                qobject_cast<const QComboBox*>(model.QObject::parent()) == nullptr) {
                texts.append({place + QStringLiteral(" item"), index.data(role).toString()});
            }
        }
    }
}

void addTextsOf(const QWidget& widget, QList<FoundText>& texts)
{
    const QString place = describe(widget) + QLatin1Char(' ');
    const auto add = [&](const char* what, const QString& text) {
        texts.append({place + QLatin1String(what), text});
    };
    add("windowTitle", widget.windowTitle());
    add("toolTip", widget.toolTip());
    add("statusTip", widget.statusTip());
    add("whatsThis", widget.whatsThis());
    add("accessibleName", widget.accessibleName());
    add("accessibleDescription", widget.accessibleDescription());
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) {
        add("text", label->text());
    }
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) {
        add("text", button->text());
    }
    if (const auto* field = qobject_cast<const QLineEdit*>(&widget)) {
        add("placeholder", field->placeholderText());
    }
    if (const auto* box = qobject_cast<const QSpinBox*>(&widget)) {
        add("suffix", box->prefix() + box->suffix());
    }
    if (const auto* menu = qobject_cast<const QMenu*>(&widget)) {
        add("title", menu->title());
    }
    if (const auto* box = qobject_cast<const QComboBox*>(&widget)) {
        for (int i = 0; i < box->count(); ++i) {
            add("item", box->itemText(i));
        }
    }
    if (const auto* view = qobject_cast<const QAbstractItemView*>(&widget);
        view != nullptr && view->model() != nullptr && !isInside(widget)) {
        addItems(*view->model(), describe(widget), texts);
    }
    addActions(widget.actions(), texts);
}

} // namespace

QString describe(const QObject& object)
{
    QString text = QString::fromLatin1(object.metaObject()->className());
    const auto* widget = qobject_cast<const QWidget*>(&object);
    const QString name = !object.objectName().isEmpty() ? object.objectName()
                         : widget != nullptr            ? widget->accessibleName()
                                                        : QString();
    return name.isEmpty() ? text : text + QStringLiteral(" \"%1\"").arg(name);
}

QList<FoundText> textsOf(const QWidget& root)
{
    QList<FoundText> texts;
    addTextsOf(root, texts);
    for (const QWidget* widget : root.findChildren<QWidget*>()) {
        addTextsOf(*widget, texts);
    }
    texts.removeIf([](const FoundText& found) { return found.text.isEmpty(); });
    return texts;
}

QList<QWidget*> controlsOf(const QWidget& root)
{
    QList<QWidget*> controls;
    for (QWidget* widget : root.findChildren<QWidget*>()) {
        const bool is_control = qobject_cast<QAbstractButton*>(widget) != nullptr ||
                                qobject_cast<QComboBox*>(widget) != nullptr ||
                                qobject_cast<QLineEdit*>(widget) != nullptr ||
                                qobject_cast<QAbstractSpinBox*>(widget) != nullptr ||
                                qobject_cast<QSlider*>(widget) != nullptr ||
                                qobject_cast<QAbstractItemView*>(widget) != nullptr ||
                                (widget->focusPolicy() & Qt::TabFocus) != 0;
        const bool is_frame_only = qobject_cast<QScrollArea*>(widget) != nullptr ||
                                   qobject_cast<QMenu*>(widget) != nullptr ||
                                   qobject_cast<QLabel*>(widget) != nullptr;
        const auto* tabs = qobject_cast<QTabBar*>(widget);
        const bool is_without_tabs = tabs != nullptr && tabs->count() == 0;
        if (is_control && !is_frame_only && !is_without_tabs && !isInside(*widget)) {
            controls.append(widget);
        }
    }
    return controls;
}

QStringList sharedLetters(const QMenuBar& bar)
{
    QStringList pairs;
    const auto collect = [&pairs](const QList<QAction*>& actions) {
        QMap<QChar, QString> owners;
        for (const QAction* action : actions) {
            const QString text = action->text();
            const auto mark = text.indexOf(QLatin1Char('&'));
            if (action->isSeparator() || mark < 0 || mark + 1 >= text.size()) {
                continue;
            }
            const QChar letter = text[mark + 1].toLower();
            if (owners.contains(letter)) {
                pairs.append(text + QStringLiteral(" and ") + owners[letter]);
            }
            owners[letter] = text;
        }
    };
    collect(bar.actions());
    for (const QMenu* menu : bar.findChildren<QMenu*>()) {
        collect(menu->actions());
    }
    return pairs;
}

} // namespace marsview
