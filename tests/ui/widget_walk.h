// Everything that people meet in a window.
#pragma once

#include <QList>
#include <QStringList>

class QObject;
class QWidget;

namespace marsview {

/// A text of the window, and where it is.
struct FoundText {
    QString place; // "QToolButton \"cancelLoading\" toolTip"
    QString text;
};

/// The texts of `root`, its descendants and their actions and items: what is read, shown as a tip
/// or told to screen readers. Texts of hidden widgets too.
QList<FoundText> textsOf(const QWidget& root);

/// Descendants that people act upon: buttons, fields, lists, sliders, and whatever takes the focus.
/// Without the insides of Qt's own widgets and the title buttons of docks, which the menus stand in
/// for.
QList<QWidget*> controlsOf(const QWidget& root);

/// "QToolButton \"cancelLoading\"".
QString describe(const QObject& object);

} // namespace marsview
