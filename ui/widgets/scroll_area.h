// Scrolling for panels that may be lower than their content.
#pragma once

class QScrollArea;
class QWidget;

namespace marsview {

/// Without a frame; scrolls up and down only: wide content wraps.
QScrollArea* makeScrollArea(QWidget* parent);

} // namespace marsview
