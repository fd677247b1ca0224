// Scrolling for panels that may be lower than their content.
#pragma once

class QScrollArea;
class QWidget;

namespace marsview {

/// Without a frame; scrolls up and down only: wide content wraps. Whatever gets the focus, except
/// by a click, is scrolled into sight. A frame shows that the area itself has the focus.
QScrollArea* makeScrollArea(QWidget* parent);

} // namespace marsview
