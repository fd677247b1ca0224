// The small, quiet words that say what a value in a panel is.
#pragma once

#include <QFont>
#include <QString>

class QHBoxLayout;
class QLabel;
class QWidget;

namespace marsview {

/// The font of captions for text in `font`.
QFont captionFont(QFont font);

QLabel* makeCaption(const QString& text, QWidget* parent);

/// A caption with a value at the other end of its line. The layout is the caller's.
QHBoxLayout* makeCaptionLine(QLabel* caption, QLabel* value);

} // namespace marsview
