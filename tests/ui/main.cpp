// Runs the tests of the window in a real one. Needs a display, for example from xvfb-run.

#include "core/files/open_probe.h"
#include "ui/graphics_check.h"

#include <QApplication>
#include <QLocale>
#include <QSettings>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace {

// A button that a test leaves pressed changes what the tests after it see.
class ReleasedButtons final : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& /*test*/) override
    {
        EXPECT_EQ(QGuiApplication::mouseButtons(), Qt::NoButton) << "pressed and not released";
    }
};

} // namespace

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    marsview::prestartProbes(); // as the program does
    QStandardPaths::setTestModeEnabled(true);
    // Settings of this process alone: others may run tests at the same time.
    const QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    QLocale::setDefault(QLocale::c());
    QSurfaceFormat::setDefaultFormat(marsview::mapSurfaceFormat());
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName(QStringLiteral("MarsViewTest"));
    QCoreApplication::setApplicationName(QStringLiteral("MarsViewTest"));
    testing::UnitTest::GetInstance()->listeners().Append(new ReleasedButtons);
    return RUN_ALL_TESTS();
}
