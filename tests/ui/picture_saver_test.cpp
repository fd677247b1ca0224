// Saving pictures: sizes, formats, contents, folders.
#include "tests/ui/map_window.h"
#include "ui/canvas/picture_writer.h"
#include "ui/commands/picture_saver.h"
#include "ui/globe/globe_view.h"
#include "ui/pictures/flat_pictures.h"
#include "ui/pictures/picture_drawing.h"
#include "ui/window/load_status.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMessageBox>
#include <QPointer>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

class PictureSaverTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow({900, 600});
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
    // Closes the dialog with this file name and waits for the picture.
    void saveAs(SavePictureDialog* dialog, const QString& file)
    {
        Q_EMIT dialog->fileRequested();
        auto* files = window_->findChild<QFileDialog*>();
        ASSERT_NE(files, nullptr);
        Q_EMIT files->fileSelected(file);
        files->reject();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        const QList<PictureSaver*> savers = window_->findChildren<PictureSaver*>();
        ASSERT_TRUE(waitFor([&] {
            return std::none_of(savers.begin(), savers.end(),
                                [](const PictureSaver* saver) { return saver->isSaving(); });
        }));
    }
    static PictureChoice choiceOf(const QSize& size)
    {
        return {.size = size, .has_legend = true, .has_scale = true};
    }
};

TEST_F(PictureSaverTest, IsOfferedWhereAMapIsShown)
{
    const QAction& save = *window_->actionSet().save_picture;
    EXPECT_TRUE(save.isEnabled());
    window_->controller().remove(window_->session().active);
    ASSERT_TRUE(window_->session().layers.empty());
    EXPECT_FALSE(save.isEnabled());
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    EXPECT_TRUE(save.isEnabled());
}

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

TEST_F(PictureSaverTest, IsBackAtTheSizesIfNoFileIsChosen)
{
    SavePictureDialog* dialog = ask();
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QSpinBox*>(QStringLiteral("width"))->setValue(321);
    QTest::keyClick(dialog, Qt::Key_Return);
    auto* files = dialog->findChild<QFileDialog*>();
    ASSERT_NE(files, nullptr);
    EXPECT_EQ(QApplication::activeModalWidget(), files);
    QTest::keyClick(files, Qt::Key_Escape);
    ASSERT_TRUE(waitFor([&] { return dialog->findChild<QFileDialog*>() == nullptr; }));
    EXPECT_TRUE(dialog->isVisible());
    EXPECT_EQ(dialog->choice().size.width(), 321);
    const QString file = maps_.path(QStringLiteral("second.png"));
    saveAs(dialog, file);
    EXPECT_EQ(QImage(file).width(), 321);
    EXPECT_EQ(window_->findChild<SavePictureDialog*>(), nullptr);
}

TEST_F(PictureSaverTest, RefusesAnUnknownEndingBeforeItDraws)
{
    SavePictureDialog* dialog = ask();
    ASSERT_NE(dialog, nullptr);
    auto* saver = window_->findChild<PictureSaver*>();
    QSignalSpy drawing(saver, &PictureSaver::progressed);
    Q_EMIT dialog->fileRequested();
    QPointer<QFileDialog> files = window_->findChild<QFileDialog*>();
    ASSERT_NE(files, nullptr);
    Q_EMIT files->fileSelected(maps_.path(QStringLiteral("p1.xyz")));
    files->reject();
    ASSERT_TRUE(waitFor([&] { return files.isNull(); }));
    EXPECT_EQ(drawing.count(), 0);
    EXPECT_FALSE(saver->isSaving());
    auto* refusal = window_->findChild<QMessageBox*>(QStringLiteral("pictureRefused"));
    ASSERT_NE(refusal, nullptr);
    EXPECT_TRUE(refusal->text().contains(QStringLiteral(".png, .jpg or .tif")));
    refusal->accept();
    // The name is asked for again, with an ending that is known.
    files = window_->findChild<QFileDialog*>();
    ASSERT_NE(files, nullptr);
    ASSERT_FALSE(files->selectedFiles().isEmpty());
    EXPECT_EQ(QFileInfo(files->selectedFiles().constFirst()).fileName(), QStringLiteral("p1.png"));
    const QString file = maps_.path(QStringLiteral("p1.png"));
    Q_EMIT files->fileSelected(file);
    files->reject();
    ASSERT_TRUE(waitFor([&] { return drawing.count() > 0 && !saver->isSaving(); }));
    EXPECT_TRUE(QFileInfo::exists(file));
}

TEST_F(PictureSaverTest, ASuccessClosesTheNoticeOfTheFailureBefore)
{
    WindowOptions options = testWindowOptions();
    options.failures = WindowOptions::Failures::AsNotices;
    makeWindow({900, 600}, options);
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    auto* saver = window_->findChild<PictureSaver*>();
    const auto* notice = window_->findChild<QLabel*>(QStringLiteral("noticeText"));
    const auto has_failure = [notice] {
        return notice->isVisible() &&
               notice->text().contains(QStringLiteral("Cannot Save Picture"));
    };
    saver->save(QStringLiteral("/no/such/folder/x.png"), view().camera(), choiceOf({64, 48}));
    ASSERT_TRUE(waitFor([&] { return !saver->isSaving(); }));
    EXPECT_TRUE(has_failure());
    saver->save(maps_.path(QStringLiteral("x.png")), view().camera(), choiceOf({64, 48}));
    ASSERT_TRUE(waitFor([&] { return !saver->isSaving(); }));
    EXPECT_FALSE(has_failure());
}

TEST_F(PictureSaverTest, DrawsTheOfferedSizes)
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

TEST_F(PictureSaverTest, OmitsDisabledOverlays)
{
    FlatPictures scene(view(), *window_->overlays());
    PictureSaver saver({.flat = scene, .globe = scene, .globe_view = *window_->globe()},
                       PictureSaver::Memory::WindowOnly, window_.get());
    const auto picture = [&](bool has_legend, bool has_scale) {
        const QString file = maps_.path(QStringLiteral("overlays.png"));
        saver.save(file, view().camera(),
                   {.size = viewSize(), .has_legend = has_legend, .has_scale = has_scale});
        EXPECT_TRUE(waitFor([&] { return !saver.isSaving(); }));
        return QImage(file);
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

// Blocks meet without a seam, and show what one frame buffer for all of it would.
TEST_F(PictureSaverTest, DrawsBlockByBlockWhatTheWindowShows)
{
    window_->resize(1290, 800); // blocks of 512 do not fit
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    ASSERT_GT(viewSize().width(), 700);
    FlatPictures pictures(view(), *window_->overlays());
    PictureDrawing drawing(pictures, view().camera(), viewSize());
    QImage drawn;
    QObject::connect(&drawing, &PictureDrawing::finished,
                     [&drawn](const QImage& picture) { drawn = picture; });
    ASSERT_TRUE(waitFor([&] { return !drawn.isNull(); }));
    const QImage shown = view().terrainPicture();
    ASSERT_EQ(drawn.size(), shown.size());
    int differing = 0;
    for (int y = 0; y < shown.height(); ++y) {
        for (int x = 0; x < shown.width(); ++x) {
            const QColor a = drawn.pixelColor(x, y);
            const QColor b = shown.pixelColor(x, y);
            differing += std::abs(a.red() - b.red()) > 3 || std::abs(a.green() - b.green()) > 3 ||
                                 std::abs(a.blue() - b.blue()) > 3
                             ? 1
                             : 0;
        }
    }
    EXPECT_LT(differing, shown.width() * shown.height() / 1000);
}

TEST_F(PictureSaverTest, TheWindowStaysUsableAndALargePictureCanBeCanceled)
{
    auto* saver = window_->findChild<PictureSaver*>();
    auto* status = window_->findChild<LoadStatus*>();
    auto* button = status->findChild<QToolButton*>(QStringLiteral("cancelLoading"));
    auto* bar = status->findChild<QProgressBar*>();
    const QString file = maps_.path(QStringLiteral("large.png"));
    { // what is there stays there
        QFile before(file);
        ASSERT_TRUE(before.open(QIODevice::WriteOnly));
        before.write("before");
    }
    QSignalSpy canceled(saver, &PictureSaver::canceled);
    QSignalSpy saved(saver, &PictureSaver::saved);
    for (const bool is_by_key : {false, true}) {
        saver->save(file, view().camera(), choiceOf({8192, 4096}));
        EXPECT_TRUE(status->isVisible());
        EXPECT_FALSE(window_->actionSet().save_picture->isEnabled());
        // Events come in between: the camera moves while blocks are drawn.
        const OrbitCamera before = view().camera();
        ASSERT_TRUE(waitFor([&] { return bar->value() > 1; }));
        view().step(NavigationStep::TurnLeft);
        ASSERT_TRUE(waitFor([&] { return !view().isMoving(); }));
        EXPECT_NE(view().camera(), before);
        ASSERT_TRUE(saver->isSaving()) << "too small to try this";
        if (is_by_key) {
            view().setFocus();
            QTest::keyClick(&view(), Qt::Key_Escape);
        } else {
            QTest::mouseClick(button, Qt::LeftButton);
        }
        EXPECT_FALSE(saver->isSaving());
        EXPECT_TRUE(status->isHidden());
        EXPECT_TRUE(window_->actionSet().save_picture->isEnabled());
    }
    EXPECT_EQ(canceled.count(), 2);
    EXPECT_EQ(saved.count(), 0);
    QFile after(file);
    ASSERT_TRUE(after.open(QIODevice::ReadOnly));
    EXPECT_EQ(after.readAll(), QByteArray("before"));
}

TEST_F(PictureSaverTest, WritesNothingOnceItIsCanceled)
{
    JobMonitor monitor;
    monitor.cancel();
    const QImage picture(4, 4, QImage::Format_RGB888);
    for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
        const QString file = maps_.path(QLatin1String(name));
        const Status written = writePictureFile(picture, file, &monitor);
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().code, ErrorCode::Canceled);
        EXPECT_FALSE(QFileInfo::exists(file)) << name;
    }
}

TEST_F(PictureSaverTest, RefusesSizesBeyondTheDriversLimit)
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
    FlatPictures scene(view(), *window_->overlays());
    PictureSaver saver({.flat = scene, .globe = scene, .globe_view = *window_->globe()},
                       PictureSaver::Memory::WindowOnly, window_.get());
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

TEST_F(PictureSaverTest, ReportsWhyAFileCannotBeWritten)
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
