// Scrolling for panels that may be lower than what is in them.
#pragma once

class QScrollArea;
class QWidget;

namespace marsview {

/// Without a frame; scrolls up and down only: what is too wide wraps.
QScrollArea* makeScrollArea(QWidget* parent);

} // namespace marsview
