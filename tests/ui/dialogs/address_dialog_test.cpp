#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/controllers/recent_files.h"
#include "ui/dialogs/address_dialog.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace marsview {
namespace {

QPushButton* openButton(AddressDialog& dialog)
{
    for (QPushButton* button : dialog.findChildren<QPushButton*>()) {
        if (button->isDefault()) {
            return button;
        }
    }
    return nullptr;
}

TEST(AddressDialog, AcceptsAddressesOfFilesOnly)
{
    for (const char* good :
         {"https://example.org/mars.tif", "http://127.0.0.1:8080/a/b.tif", "s3://bucket/key.tif",
          "gs://bucket/key.tif", "https://example.org/mars.tif?token=1", "file:///data/a%20b.tif",
          "file://localhost/data/mars.tif", "/vsizip//data/maps.zip/dem.tif",
          "/vsizip/maps.zip/dem.tif", "NETCDF:maps.nc:z", "HDF5:\"/data/a b.h5\"://dem"}) {
        EXPECT_EQ(problemOfAddress(QString::fromLatin1(good)), QString()) << good;
    }
    for (const char* bad :
         {"mars.tif", "/data/mars.tif", "/vsizip/", "C:/data/mars.tif",
          "ftp://example.org/mars.tif", "https://", "https:///mars.tif", "https://example.org",
          "https://example.org/", "https://example.org/maps/", "https://exa mple.org/mars.tif",
          "/vsicurl/https://a.b/c.tif", "file://server/mars.tif", "file:///a%zz.tif"}) {
        EXPECT_NE(problemOfAddress(QString::fromLatin1(bad)), QString()) << bad;
    }
}

TEST(AddressDialog, OpensTypedAddressesAndOffersRecentOnes)
{
    AddressDialog dialog({QStringLiteral("https://example.org/old.tif")});
    dialog.show();
    auto* field = dialog.findChild<QComboBox*>(QStringLiteral("address"));
    const QSignalSpy chosen(&dialog, &AddressDialog::addressChosen);
    EXPECT_EQ(field->currentText(), QString());
    EXPECT_EQ(field->count(), 1);
    EXPECT_FALSE(openButton(dialog)->isEnabled());
    field->setEditText(QStringLiteral("https://example.org"));
    EXPECT_FALSE(openButton(dialog)->isEnabled());
    EXPECT_FALSE(dialog.findChild<QLabel*>(QStringLiteral("answer"))->text().isEmpty());
    field->setEditText(QStringLiteral("  https://example.org/new.tif "));
    EXPECT_TRUE(dialog.findChild<QLabel*>(QStringLiteral("answer"))->text().isEmpty());
    ASSERT_TRUE(openButton(dialog)->isEnabled());
    QTest::keyClick(field, Qt::Key_Return);
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toString(), QStringLiteral("https://example.org/new.tif"));
    EXPECT_FALSE(dialog.isVisible());
}

TEST(AddressDialog, OpensFileAddressesAsPaths)
{
    AddressDialog dialog({});
    dialog.show();
    auto* field = dialog.findChild<QComboBox*>(QStringLiteral("address"));
    const QSignalSpy chosen(&dialog, &AddressDialog::addressChosen);
    field->setEditText(QStringLiteral("file://localhost/data/a%20b.tif"));
    QTest::keyClick(field, Qt::Key_Return);
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toString(), QStringLiteral("/data/a b.tif"));
}

TEST(AddressDialog, IsOpenedFromTheMenuAndReportsWhyOpeningFailed)
{
    MainWindow window(testWindowOptions());
    window.show();
    ASSERT_TRUE(waitUntilSettled(window));
    EXPECT_EQ(window.actionSet().open_address->shortcut(), QKeySequence(Qt::CTRL | Qt::Key_U));
    window.actionSet().open_address->trigger();
    auto* dialog = window.findChild<AddressDialog*>();
    ASSERT_NE(dialog, nullptr);
    const QSignalSpy failures(&window, &MainWindow::openFailed);
    // Port 1 has no listener.
    dialog->findChild<QComboBox*>(QStringLiteral("address"))
        ->setEditText(QStringLiteral("http://127.0.0.1:1/mars.tif"));
    openButton(*dialog)->click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return failures.count() > 0; }, kTimeout));
    EXPECT_TRUE(failures[0][0].toString().contains(QStringLiteral("http://127.0.0.1:1/mars.tif")));
}

TEST(RecentFiles, KeepAddressesAsTheyAre)
{
    QMenu menu;
    RecentFiles recent(menu, RecentFiles::Memory::WindowOnly);
    const QString address = QStringLiteral("https://example.org/a/../b/mars.tif?key=1");
    recent.add(address);
    EXPECT_EQ(recent.files(), QStringList{address});
    Q_EMIT menu.aboutToShow();
    const QAction* entry = menu.actions().constFirst();
    EXPECT_TRUE(entry->isEnabled());
    EXPECT_EQ(entry->toolTip(), address);
    EXPECT_FALSE(entry->text().contains(QStringLiteral("missing")));
}

} // namespace
} // namespace marsview
