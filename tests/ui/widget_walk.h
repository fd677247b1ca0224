// All texts and controls of a window.
#pragma once

#include <QList>
#include <QStringList>

class QObject;
class QMenuBar;
class QWidget;

namespace marsview {

/// A text of the window and its location.
struct FoundText {
    QString place; // "QToolButton \"cancelLoading\" toolTip"
    QString text;
};

/// The texts of `root`, its descendants and their actions and items: labels, tooltips, and texts
/// for screen readers. Includes hidden widgets.
QList<FoundText> textsOf(const QWidget& root);

/// The interactive descendants: buttons, fields, lists, sliders, and everything that takes the
/// focus. Without the internal parts of Qt's own widgets, and without the title buttons of docks,
/// which have menu equivalents.
QList<QWidget*> controlsOf(const QWidget& root);

/// Pairs of entries of one menu that have the same letter: "&Open… and &Other". `bar` counts as a
/// menu, too.
QStringList sharedLetters(const QMenuBar& bar);

/// "QToolButton \"cancelLoading\"".
QString describe(const QObject& object);

} // namespace marsview
