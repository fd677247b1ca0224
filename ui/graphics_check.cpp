#include "ui/graphics_check.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>

namespace marsview {

QSurfaceFormat mapSurfaceFormat()
{
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    return format;
}

QString graphicsProblem()
{
    const auto tr = [](const char* text) {
        return QCoreApplication::translate("GraphicsCheck", text);
    };
    const QString platform = QGuiApplication::platformName();
    if (platform == QStringLiteral("offscreen") || platform == QStringLiteral("minimal")) {
        // A context may be had there, but a window cannot show what is drawn with it.
        return tr("the Qt platform \"%1\" cannot show OpenGL windows; start with a display, for "
                  "example under xvfb-run")
            .arg(platform);
    }
    QOpenGLContext context;
    context.setFormat(mapSurfaceFormat());
    QOffscreenSurface surface;
    surface.setFormat(mapSurfaceFormat());
    surface.create();
    if (!context.create() || !context.makeCurrent(&surface)) {
        return tr(
            "no OpenGL context can be created; install the graphics driver, or Mesa's "
            "software one (libgl1-mesa-dri)");
    }
    const auto version = context.format().version();
    context.doneCurrent();
    if (version < qMakePair(3, 3)) {
        return tr("OpenGL 3.3 is needed, the graphics driver offers %1.%2; install a newer driver "
                  "or Mesa's software one")
            .arg(version.first)
            .arg(version.second);
    }
    return {};
}

} // namespace marsview
