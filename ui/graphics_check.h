// Whether this machine can draw at all.
#pragma once

#include <QString>
#include <QSurfaceFormat>

namespace marsview {

/// The kind of context that the map is drawn with: OpenGL 3.3 core with a depth buffer.
QSurfaceFormat mapSurfaceFormat();

struct GraphicsCheck {
    /// One sentence for the user where no such context can be had; empty where all is well.
    QString problem;
    /// mapSurfaceFormat() with as much smoothing of edges as the driver does without effort.
    QSurfaceFormat format;
};

/// Tries a context. Needs a QGuiApplication.
GraphicsCheck checkGraphics();

} // namespace marsview
