// Runs the tests of the window in a real one. Needs a display, for example from xvfb-run.

#include "ui/graphics_check.h"

#include <QApplication>
#include <QLocale>
#include <QSettings>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QTemporaryDir>

#include <gtest/gtest.h>

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    QStandardPaths::setTestModeEnabled(true);
    // Settings of this process alone: others may run tests at the same time.
    const QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    QLocale::setDefault(QLocale::c());
    QSurfaceFormat::setDefaultFormat(marsview::mapSurfaceFormat());
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName(QStringLiteral("MarsViewTest"));
    QCoreApplication::setApplicationName(QStringLiteral("MarsViewTest"));
    return RUN_ALL_TESTS();
}
