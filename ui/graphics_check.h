// Whether this machine can draw at all.
#pragma once

#include <QString>
#include <QSurfaceFormat>

namespace marsview {

/// The kind of context that the map is drawn with: OpenGL 3.3 core with a depth buffer.
QSurfaceFormat mapSurfaceFormat();

/// One sentence for the user where no such context can be had; empty where all is well. Needs a
/// QGuiApplication.
QString graphicsProblem();

} // namespace marsview
