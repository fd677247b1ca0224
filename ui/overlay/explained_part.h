// Help for overlays that are transparent to the mouse.
#pragma once

#include <QString>

class QEvent;
class QWidget;

namespace marsview {

/// Answers an event of the widget below `part` that asks for the tooltip or the What's This text of
/// a place on the part: with `tooltip`, where it is not empty, and the part's own What's This text.
/// Returns whether the event was answered.
bool explainAt(const QEvent& event, const QWidget& part, const QString& tooltip);

} // namespace marsview
