// Saving pictures: sizes, formats, contents, folders.
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/picture_writer.h"
#include "ui/canvas/terrain_view.h"
#include "ui/overlay/map_overlays.h"
#include "ui/picture_saver.h"
#include "ui/window_actions.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QPushButton>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

class PictureSaverTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(900, 600);
        window_->show();
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    }

    QSize viewSize()
    {
        return {window_->view()->viewport().width, window_->view()->viewport().height};
    }
    SavePictureDialog* ask()
    {
        window_->actionSet().save_picture->trigger();
        return window_->findChild<SavePictureDialog*>();
    }
    // Closes the dialog with this file name.
    void saveAs(SavePictureDialog* dialog, const QString& file)
    {
        dialog->accept();
        auto* files = window_->findChild<QFileDialog*>();
        ASSERT_NE(files, nullptr);
        Q_EMIT files->fileSelected(file);
        files->reject();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(PictureSaverTest, WritesEachFormatByItsEnding)
{
    const struct {
        const char* name;
        QByteArray begin;
    } formats[] = {{"a.png", QByteArray("\x89PNG")},
                   {"b.jpg", QByteArray("\xff\xd8\xff")},
                   {"c.jpeg", QByteArray("\xff\xd8\xff")},
                   {"d.tif", QByteArray("II*\0", 4)}};
    for (const auto& format : formats) {
        SavePictureDialog* dialog = ask();
        ASSERT_NE(dialog, nullptr);
        const QString path = maps_.path(QLatin1String(format.name));
        saveAs(dialog, path);
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::ReadOnly)) << format.name;
        EXPECT_EQ(file.read(format.begin.size()), format.begin) << format.name;
    }
}

TEST_F(PictureSaverTest, DrawsTheSizesThatAreOffered)
{
    SavePictureDialog* dialog = ask();
    ASSERT_NE(dialog, nullptr);
    auto* sizes = dialog->findChild<QComboBox*>();
    EXPECT_EQ(dialog->choice().size, viewSize());
    sizes->setCurrentIndex(1);
    EXPECT_EQ(dialog->choice().size, viewSize() * 2);
    const QString file = maps_.path(QStringLiteral("twice.png"));
    saveAs(dialog, file);
    const QImage twice(file);
    ASSERT_EQ(twice.size(), viewSize() * 2);
    // The same view: the brightness of blocks agrees with the window's picture.
    ASSERT_TRUE(QTest::qWaitFor([this] { return window_->view()->isPictureComplete(); }, kTimeout));
    const QImage once = window_->view()->terrainPicture();
    const QImage small = twice.scaled(once.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    int far_off = 0;
    for (int y = 40; y < once.height() - 40; y += 7) {
        for (int x = once.width() / 3; x < once.width() * 2 / 3; x += 7) {
            far_off += std::abs(once.pixelColor(x, y).green() - small.pixelColor(x, y).green()) > 24
                           ? 1
                           : 0;
        }
    }
    EXPECT_LT(far_off, 60);
}

TEST_F(PictureSaverTest, DrawsATypedSizeWithAnotherAspect)
{
    SavePictureDialog* dialog = ask();
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QSpinBox*>(QStringLiteral("width"))->setValue(1234);
    dialog->findChild<QSpinBox*>(QStringLiteral("height"))->setValue(321);
    EXPECT_EQ(dialog->findChild<QComboBox*>()->currentText(), QStringLiteral("Custom"));
    const QString file = maps_.path(QStringLiteral("typed.png"));
    saveAs(dialog, file);
    EXPECT_EQ(QImage(file).size(), QSize(1234, 321));
}

TEST_F(PictureSaverTest, LeavesOutOverlaysThatAreNotWanted)
{
    PictureSaver saver(*window_->view(), *window_->overlays(), PictureSaver::Memory::WindowOnly,
                       window_.get());
    const OrbitCamera camera = window_->view()->camera();
    const auto picture = [&](bool has_legend, bool has_scale) {
        return saver.picture(
            camera, {.size = viewSize(), .has_legend = has_legend, .has_scale = has_scale});
    };
    const QImage none = picture(false, false);
    const QImage legend = picture(true, false);
    const QImage scale = picture(false, true);
    const auto differs = [&none](const QImage& image, bool at_right) {
        for (int y = 0; y < none.height(); ++y) {
            for (int x = 0; x < none.width() / 2; ++x) {
                const int column = at_right ? none.width() - 1 - x : x;
                if (none.pixel(column, y) != image.pixel(column, y)) {
                    return true;
                }
            }
        }
        return false;
    };
    EXPECT_TRUE(differs(legend, false));
    EXPECT_FALSE(differs(legend, true));
    EXPECT_FALSE(differs(scale, false));
    EXPECT_TRUE(differs(scale, true));
}

TEST_F(PictureSaverTest, RefusesMoreThanTheDriverDraws)
{
    SavePictureDialog dialog({3000, 2000}, {.side_max = 8192, .pixel_count_max = 20'000'000},
                             nullptr);
    auto* save = dialog.findChild<QDialogButtonBox*>()->buttons().constLast();
    for (QAbstractButton* button : dialog.findChild<QDialogButtonBox*>()->buttons()) {
        if (dialog.findChild<QDialogButtonBox*>()->buttonRole(button) ==
            QDialogButtonBox::AcceptRole) {
            save = button;
        }
    }
    EXPECT_TRUE(save->isEnabled());
    dialog.findChild<QComboBox*>()->setCurrentIndex(2); // 12000 × 8000
    EXPECT_FALSE(save->isEnabled());
    dialog.findChild<QComboBox*>()->setCurrentIndex(1); // 6000 × 4000: 24 million
    EXPECT_FALSE(save->isEnabled());
    dialog.findChild<QComboBox*>()->setCurrentIndex(0);
    EXPECT_TRUE(save->isEnabled());
}

TEST_F(PictureSaverTest, RemembersAFolderOfItsOwn)
{
    PictureSaver saver(*window_->view(), *window_->overlays(), PictureSaver::Memory::WindowOnly,
                       window_.get());
    const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
    EXPECT_EQ(saver.folder(), QFileInfo(pictures).isDir() ? pictures : QDir::homePath())
        << "not the folder of the data";
    saver.start(QStringLiteral("hill"));
    const QList<SavePictureDialog*> dialogs = window_->findChildren<SavePictureDialog*>();
    ASSERT_EQ(dialogs.size(), 1);
    ASSERT_TRUE(QDir().mkpath(maps_.path(QStringLiteral("out"))));
    saveAs(dialogs.front(), maps_.path(QStringLiteral("out/hill.png")));
    EXPECT_EQ(QFileInfo(saver.folder()), QFileInfo(maps_.path(QStringLiteral("out"))));
}

TEST_F(PictureSaverTest, SaysWhyAFileCannotBeWritten)
{
    const QImage picture(4, 4, QImage::Format_RGB888);
    const Status unknown = writePictureFile(picture, maps_.path(QStringLiteral("x.bmp")));
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find(".png, .jpg or .tif"), std::string::npos);
    for (const char* name : {"/no/such/folder/x.png", "/no/such/folder/x.tif"}) {
        const Status missing = writePictureFile(picture, QLatin1String(name));
        ASSERT_FALSE(missing) << name;
        EXPECT_EQ(missing.error().message.find(name), 0U) << missing.error().message;
    }
}

} // namespace
} // namespace marsview
