// Runs the tests of the window in a real one. Needs a display, for example from xvfb-run.

#include "ui/graphics_check.h"

#include <QApplication>
#include <QLocale>
#include <QStandardPaths>
#include <QSurfaceFormat>

#include <gtest/gtest.h>

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    QStandardPaths::setTestModeEnabled(true);
    QLocale::setDefault(QLocale::c());
    QSurfaceFormat::setDefaultFormat(marsview::mapSurfaceFormat());
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName(QStringLiteral("MarsViewTest"));
    QCoreApplication::setApplicationName(QStringLiteral("MarsViewTest"));
    return RUN_ALL_TESTS();
}
