// Projects in the window: saving, opening, questions, recovery.

#include "core/base/file_lock.h"
#include "core/session/project.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/map_window.h"
#include "tests/ui/project_files.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/recent_files.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/measure_list.h"
#include "ui/panels/measure_panel.h"
#include "ui/project/project_autosave.h"
#include "ui/project/project_controller.h"
#include "ui/project/project_menu.h"
#include "ui/text/coordinate_text.h"
#include "ui/widgets/notice_bar.h"
#include "ui/widgets/notice_center.h"
#include "ui/window/window_actions.h"

#include <QAbstractButton>
#include <QAction>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

namespace marsview {
namespace {

namespace fs = std::filesystem;

class ProjectWindowTest : public MapWindowTest {
protected:
    WindowOptions asking() const
    {
        WindowOptions options = testWindowOptions();
        options.questions = WindowOptions::Questions::Ask;
        options.autosave_folder = folder_.path() / "autosave";
        return options;
    }
    QString path(const char* name) const { return QString::fromStdString(folder_.file(name)); }
    QMessageBox* box(const char* name)
    {
        QMessageBox* found = nullptr;
        EXPECT_TRUE(waitFor([&] {
            found = window_->findChild<QMessageBox*>(QString::fromLatin1(name));
            return found != nullptr && found->isVisible();
        })) << name;
        return found;
    }
    // Waits until the box is gone.
    void answer(const char* name, QMessageBox::StandardButton button)
    {
        QMessageBox* asked = box(name);
        ASSERT_NE(asked, nullptr);
        asked->button(button)->click();
        ASSERT_TRUE(waitFor([&] {
            return window_->findChild<QMessageBox*>(QString::fromLatin1(name)) == nullptr;
        }));
    }
    bool openProject(const QString& file)
    {
        window_->open(file);
        return waitFor([this] {
            return !window_->commands().project.isReading() && !window_->controller().isBusy() &&
                   (shownLayers(window_->session()).empty() || view().isPictureComplete());
        });
    }
    // A window with two layers and many settings other than the standard ones.
    void makeChangedWindow()
    {
        makeWindow(kSmall, asking());
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
        SessionController& controller = window_->controller();
        const LayerId top = window_->session().layers[0].id;
        const LayerId below = window_->session().layers[1].id;
        controller.rename(top, QStringLiteral("Upper “layer”"));
        controller.setRamp(below, QStringLiteral("gray"));
        controller.setStretch(top, fixedStretch(-1234.5, 4321.25));
        controller.setSlopeRange(
            below, SlopeRange{.minimum = Angle::degrees(1.5), .maximum = Angle::degrees(33.0)});
        controller.setExaggeration(3.5);
        controller.setContours(true);
        controller.setLight(Angle::degrees(123.4), Angle::degrees(56.7));
        controller.setSubsolarPoint(
            {.longitude = Angle::degrees(-133.8), .latitude = Angle::degrees(18.65)});
        controller.activate(below);
    }
    Project saved() const { return window_->commands().project.project(); }

    test::TempFolder folder_;
};

} // namespace

TEST_F(ProjectWindowTest, IsOfferedNextToTheMapButNotAmongBundledOnes)
{
    const QString map = maps_.mars();
    const QString folder = QFileInfo(map).absolutePath();
    const auto offered = [&](const fs::path& bundled) {
        WindowOptions options = testWindowOptions();
        options.bundled_maps = bundled;
        makeWindow(kSmall, options);
        EXPECT_TRUE(openAndWait(*window_, map));
        window_->commands().project_menu.saveProjectAs()->trigger();
        auto* dialog = window_->findChild<QFileDialog*>(QStringLiteral("saveProjectDialog"));
        EXPECT_NE(dialog, nullptr);
        const QString of_dialog =
            dialog != nullptr ? dialog->directory().absolutePath() : QString();
        dialog->reject();
        return of_dialog;
    };
    EXPECT_EQ(offered({}), folder);
    EXPECT_EQ(offered(folder.toStdString()), QDir::homePath());
}

TEST_F(ProjectWindowTest, OpensWhatWasSavedWithCameraAndLooks)
{
    makeChangedWindow();
    OrbitCamera camera = view().camera();
    camera.azimuth = Angle::degrees(40.0);
    camera.tilt = Angle::degrees(50.0);
    camera.distance_m *= 0.5;
    view().setCamera(camera);
    EXPECT_TRUE(window_->isWindowModified());
    ASSERT_TRUE(saveProject(window_->commands().project, path("a"))); // the extension is added
    EXPECT_FALSE(window_->isWindowModified());
    EXPECT_TRUE(window_->windowTitle().startsWith(QStringLiteral("\u2068a\u2069[*]")) ||
                window_->windowTitle().startsWith(QStringLiteral("a[*]")))
        << window_->windowTitle().toStdString();
    const Project before = saved();
    const OrbitCamera camera_before = view().camera();
    window_.reset();

    makeWindow(kSmall, asking());
    ASSERT_TRUE(openProject(path("a.mvproj")));
    ASSERT_TRUE(window_->session().missing.empty());
    const Project after = saved();
    EXPECT_EQ(after.layers, before.layers);
    EXPECT_EQ(after.active, before.active);
    EXPECT_EQ(after.look, before.look);
    const OrbitCamera camera_after = view().camera();
    EXPECT_NEAR(camera_after.target.x, camera_before.target.x, 1e-3);
    EXPECT_NEAR(camera_after.target.y, camera_before.target.y, 1e-3);
    EXPECT_NEAR(camera_after.distance_m, camera_before.distance_m, 1e-3);
    EXPECT_NEAR(camera_after.azimuth.degrees(), 40.0, 1e-9);
    EXPECT_NEAR(camera_after.tilt.degrees(), 50.0, 1e-9);
    EXPECT_FALSE(window_->isWindowModified());
    EXPECT_EQ(window_->undoStack().count(), 0);
    EXPECT_EQ(window_->commands().project_menu.recentProjects()->isEnabled(), true);
}

TEST_F(ProjectWindowTest, UndoingToTheSavedStateIsNoChange)
{
    makeChangedWindow();
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    window_->controller().setExaggeration(7.0);
    EXPECT_TRUE(window_->isWindowModified());
    window_->undoStack().undo();
    EXPECT_FALSE(window_->isWindowModified());
}

TEST_F(ProjectWindowTest, EveryChangeOfTheDocumentIsANamedStepOfUndo)
{
    makeChangedWindow();
    QUndoStack& stack = window_->undoStack();
    const Session changed = window_->session();
    for (int i = 0; i < stack.count(); ++i) {
        EXPECT_FALSE(stack.text(i).isEmpty()) << i;
    }
    while (stack.count() > 0 && stack.canUndo()) {
        stack.undo();
    }
    EXPECT_TRUE(window_->session().layers.empty());
    while (stack.canRedo()) {
        stack.redo();
    }
    EXPECT_EQ(window_->session().layers, changed.layers);
    EXPECT_EQ(window_->session().look, changed.look);
}

TEST_F(ProjectWindowTest, ClosingWithChangesAsks)
{
    makeChangedWindow();
    window_->close();
    EXPECT_TRUE(window_->isVisible());
    answer("unsavedChanges", QMessageBox::Cancel);
    EXPECT_TRUE(window_->isVisible());
    window_->close();
    answer("unsavedChanges", QMessageBox::Discard);
    EXPECT_FALSE(window_->isVisible());
}

TEST_F(ProjectWindowTest, ClosingSavesOnRequest)
{
    makeChangedWindow();
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    window_->controller().setExaggeration(9.0);
    window_->close();
    answer("unsavedChanges", QMessageBox::Save);
    EXPECT_TRUE(waitFor([this] { return !window_->isVisible(); }));
    const auto project = readProject(folder_.file("a.mvproj"), {});
    ASSERT_TRUE(project) << project.error().message;
    EXPECT_EQ(project->layers.front().exaggeration, 9.0);
}

TEST_F(ProjectWindowTest, ClosingAnUnsavedSessionAsksForAFile)
{
    makeChangedWindow();
    window_->close();
    answer("unsavedChanges", QMessageBox::Save);
    auto* dialog = window_->findChild<QFileDialog*>(QStringLiteral("saveProjectDialog"));
    ASSERT_NE(dialog, nullptr);
    dialog->selectFile(path("b.mvproj"));
    Q_EMIT dialog->fileSelected(path("b.mvproj"));
    EXPECT_TRUE(waitFor([this] { return !window_->isVisible(); }));
    EXPECT_TRUE(QFile::exists(path("b.mvproj")));
}

TEST_F(ProjectWindowTest, ClosingWhileSavingWaitsForTheFile)
{
    makeChangedWindow();
    window_->commands().project.saveAs(path("a.mvproj"));
    window_->close();
    EXPECT_TRUE(window_->isVisible());
    EXPECT_TRUE(waitFor([this] { return !window_->isVisible(); })) << "no question";
    EXPECT_TRUE(readProject(folder_.file("a.mvproj"), {}));
}

TEST_F(ProjectWindowTest, ChangesMadeWhileSavingAreUnsaved)
{
    makeChangedWindow();
    ProjectController& project = window_->commands().project;
    project.saveAs(path("a.mvproj"));
    window_->controller().setExaggeration(9.0);
    ASSERT_TRUE(waitFor([&] { return !project.isSaving(); }));
    EXPECT_TRUE(window_->isWindowModified());
    const auto written = readProject(folder_.file("a.mvproj"), {});
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(written->layers.front().exaggeration, 3.5);
    window_->undoStack().undo();
    EXPECT_FALSE(window_->isWindowModified());
}

TEST_F(ProjectWindowTest, FailedSavingStaysUnsaved)
{
    makeChangedWindow();
    ProjectController& project = window_->commands().project;
    QSignalSpy failures(&project, &ProjectController::failed);
    EXPECT_FALSE(saveProject(project, path("no such folder/a.mvproj")));
    EXPECT_EQ(failures.count(), 1);
    EXPECT_TRUE(window_->isWindowModified());
    EXPECT_TRUE(project.file().isEmpty());
}

TEST_F(ProjectWindowTest, ClosingWithoutChangesDoesNotAsk)
{
    makeChangedWindow();
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    window_->close();
    EXPECT_FALSE(window_->isVisible());
}

TEST_F(ProjectWindowTest, NewProjectIsEmpty)
{
    makeChangedWindow();
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    window_->commands().project_menu.newProject()->trigger();
    EXPECT_TRUE(window_->session().layers.empty());
    EXPECT_TRUE(window_->commands().project.file().isEmpty());
    EXPECT_FALSE(window_->isWindowModified());
    EXPECT_EQ(window_->undoStack().count(), 0);
}

// A missing layer must not look as if it had been removed, its measurements with it.
TEST_F(ProjectWindowTest, MeasurementsNameTheLayerThatIsMissing)
{
    makeWindow(kSmall, asking());
    fs::create_directory(folder_.path() / "data");
    ASSERT_TRUE(QFile::copy(maps_.hill(), path("data/one.asc")));
    ASSERT_TRUE(openAndWait(*window_, path("data/one.asc")));
    window_->measuring()->begin(MeasurementKind::Slope);
    window_->measuring()->addPointAt({3.0, 3.0});
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    window_.reset();
    ASSERT_TRUE(QFile::rename(path("data/one.asc"), path("elsewhere.asc")));

    makeWindow(kWithPanels, asking());
    ASSERT_TRUE(openProject(path("a.mvproj")));
    ASSERT_EQ(window_->session().missing.size(), 1U);
    const auto layer_of_first = [this] {
        const auto* list = window_->measurePanel()->list();
        return list->model()->index(0, MeasureList::LayerColumn).data().toString();
    };
    EXPECT_EQ(withPlainDirections(layer_of_first()), QStringLiteral("one.asc (missing)"));
    const auto* panel = window_->datasetPanel();
    const auto labels = panel->findChildren<QLabel*>();
    EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
        return label->isVisible() &&
               withPlainDirections(label->text())
                   .startsWith(
                       QStringLiteral("Missing: one.asc.\nLocate or remove what is missing "));
    }));
    window_->controller().locate(window_->session().missing.front().id, path("elsewhere.asc"));
    ASSERT_TRUE(waitFor([this] { return window_->session().missing.empty(); }));
    EXPECT_EQ(layer_of_first(), QStringLiteral("one.asc"));
}

TEST_F(ProjectWindowTest, MissingLayersKeepTheirSettingsAndCanBeLocated)
{
    makeWindow(kSmall, asking());
    fs::create_directory(folder_.path() / "data");
    ASSERT_TRUE(QFile::copy(maps_.hill(), path("data/one.asc")));
    ASSERT_TRUE(QFile::copy(maps_.hill(), path("data/two.asc")));
    ASSERT_TRUE(openAndWait(*window_, path("data/one.asc")));
    ASSERT_TRUE(openAndWait(*window_, path("data/two.asc")));
    window_->controller().setStretch(window_->session().layers[0].id, fixedStretch(1.0, 2.0));
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    const Project before = saved();
    window_.reset();
    ASSERT_TRUE(QFile::rename(path("data/two.asc"), path("elsewhere.asc")));

    makeWindow(kSmall, asking());
    ASSERT_TRUE(openProject(path("a.mvproj")));
    ASSERT_EQ(window_->session().missing.size(), 1U);
    EXPECT_EQ(window_->session().layers.size(), 1U);
    EXPECT_FALSE(window_->isWindowModified());
    EXPECT_EQ(saved().layers, before.layers);
    ASSERT_TRUE(saveProject(window_->commands().project, window_->commands().project.file()));
    const auto again = readProject(folder_.file("a.mvproj"), {});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->layers, before.layers);

    const LayerId id = window_->session().missing.front().id;
    window_->controller().locate(id, path("elsewhere.asc"));
    ASSERT_TRUE(waitFor([this] { return window_->session().missing.empty(); }));
    EXPECT_TRUE(window_->isWindowModified());
    const Layer& located = window_->session().layers.front();
    EXPECT_EQ(located.id, id);
    EXPECT_EQ(located.name, "two.asc");
    EXPECT_EQ(located.stretch, fixedStretch(1.0, 2.0));
    EXPECT_EQ(located.map->spec().path, folder_.file("elsewhere.asc"));
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().missing.size(), 1U);

    window_->controller().removeMissing(id);
    EXPECT_TRUE(window_->session().missing.empty());
    EXPECT_EQ(saved().layers.size(), 1U);
}

TEST_F(ProjectWindowTest, DamagedProjectChangesNothing)
{
    makeWindow(kSmall, testWindowOptions());
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    const Session before = window_->session();
    QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    folder_.write("bad.mvproj", R"({"format": "MarsView project", "version": 1, "layers": [)");
    window_->open(path("bad.mvproj"));
    ASSERT_TRUE(waitFor([&] { return failures.count() == 1; }));
    EXPECT_TRUE(failures[0][0].toString().contains(QStringLiteral("damaged project")));
    EXPECT_EQ(window_->session(), before);
    folder_.write("new.mvproj", R"({"format": "MarsView project", "version": 99})");
    window_->open(path("new.mvproj"));
    ASSERT_TRUE(waitFor([&] { return failures.count() == 2; }));
    EXPECT_TRUE(failures[1][0].toString().contains(QStringLiteral("newer version of MarsView")));
}

TEST_F(ProjectWindowTest, SavingWhileLayersLoadLosesNone)
{
    makeChangedWindow();
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    const Project before = saved();
    window_->open(path("a.mvproj"));
    ASSERT_TRUE(waitFor([this] { return window_->controller().isBusy(); }));
    EXPECT_EQ(saved().layers, before.layers);
    EXPECT_EQ(saved().camera, before.camera);
    window_->controller().cancel();
    EXPECT_EQ(saved().layers, before.layers);
    EXPECT_EQ(window_->session().missing.size(), 2U);
}

TEST_F(ProjectWindowTest, CrashIsFollowedByTheOfferToRestore)
{
    makeChangedWindow();
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    window_->controller().setExaggeration(8.0);
    window_->commands().project.autosaveNow();
    const Project before = saved();
    // A crash leaves the copy and releases the lock, as a window does that is not closed.
    fs::path copy;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "autosave")) {
        if (isProjectPath(entry.path().string())) {
            copy = entry.path();
        }
    }
    ASSERT_FALSE(copy.empty());
    EXPECT_FALSE(window_->commands().project.leftover()) << "this program still runs";
    const fs::path kept = folder_.path() / "autosave/crashed.mvproj";
    window_.reset();
    fs::rename(copy, kept);

    makeWindow(kSmall, asking());
    window_->commands().project_menu.offerRecovery();
    QMessageBox* asked = box("recovery");
    ASSERT_NE(asked, nullptr);
    EXPECT_TRUE(asked->text().contains(QStringLiteral("changes to")));
    for (QAbstractButton* button : asked->buttons()) {
        if (button->objectName() == QStringLiteral("restore")) {
            button->click();
            break;
        }
    }
    ASSERT_TRUE(waitFor([this] { return window_->session().layers.size() == 2; }));
    EXPECT_EQ(saved().layers, before.layers);
    EXPECT_EQ(window_->commands().project.file(), path("a.mvproj"));
    EXPECT_TRUE(window_->isWindowModified());
    EXPECT_TRUE(waitFor([&] { return !fs::exists(kept); })) << "there is another one";
    ASSERT_TRUE(saveProject(window_->commands().project, window_->commands().project.file()));
    EXPECT_FALSE(window_->isWindowModified());
    const auto leftover = window_->commands().project.leftover();
    EXPECT_FALSE(leftover) << leftover->copy;
}

// The system frees the memory of a killed program before its locks: the next one may start before.
TEST_F(ProjectWindowTest, ACopyOfAProgramThatIsStillEndingIsOfferedOnceItHasEnded)
{
    makeChangedWindow();
    window_->commands().project.autosaveNow();
    const Project before = saved();
    fs::path copy;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "autosave")) {
        if (isProjectPath(entry.path().string())) {
            copy = entry.path();
        }
    }
    ASSERT_FALSE(copy.empty());
    const fs::path kept = folder_.path() / "autosave/ending.mvproj";
    const fs::path closed = folder_.path() / "autosave/closed.mvproj";
    window_.reset();
    fs::rename(copy, kept);
    fs::copy_file(kept, closed);
    const auto lock = [](const fs::path& of) { // a shared lock leaves its file, as a kill does
        auto held = FileLock::tryLock(of.string() + ".lock", FileLock::Kind::Shared);
        EXPECT_TRUE(held && *held);
        return std::make_unique<FileLock>(std::move(**held));
    };
    auto ending = lock(kept);
    auto closing = lock(closed);

    makeWindow(kSmall, asking());
    window_->commands().project_menu.offerRecovery();
    const auto asked = [this] {
        return window_->findChild<QMessageBox*>(QStringLiteral("recovery")) != nullptr;
    };
    EXPECT_FALSE(asked()) << "both still run";
    fs::remove(closed); // as a program does that ends properly
    closing.reset();
    ending.reset();
    QMessageBox* question = box("recovery");
    ASSERT_NE(question, nullptr);
    for (QAbstractButton* button : question->buttons()) {
        if (button->objectName() == QStringLiteral("restore")) {
            button->click();
            break;
        }
    }
    ASSERT_TRUE(waitFor([this] { return window_->session().layers.size() == 2; }));
    EXPECT_EQ(saved().layers, before.layers);
    EXPECT_TRUE(waitFor([&] { return !fs::exists(kept); })) << "there is another one";
    EXPECT_FALSE(asked());
}

// A copy that is already being written when a project is restored lacks the restored state.
TEST_F(ProjectWindowTest, ACopyGoesOnceItsOwnStateIsOnTheDiskAgain)
{
    ProjectAutosave autosave(folder_.path() / "autosave");
    ProjectState state;
    state.project.others["state"] = "2";
    std::vector<std::string> written; // what the copy had when it was reported
    const auto report = [&] {
        for (const auto& entry : fs::directory_iterator(folder_.path() / "autosave")) {
            if (isProjectPath(entry.path().string())) {
                const auto project = readProject(entry.path(), {});
                written.push_back(project ? project->others.at("state") : "");
            }
        }
    };
    autosave.write(state); // runs
    state.project.others["state"] = "3";
    autosave.write(state, report);
    autosave.wait();
    EXPECT_EQ(written, std::vector<std::string>{"3"});
}

TEST_F(ProjectWindowTest, AutosaveFollowsAChangeAndGoesWithItsUndo)
{
    makeChangedWindow();
    const auto copy_count = [this] {
        int count = 0;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder_.path() / "autosave", none)) {
            count += isProjectPath(entry.path().string()) ? 1 : 0;
        }
        return count;
    };
    ASSERT_TRUE(waitFor([&] { return copy_count() == 1; }));
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    EXPECT_TRUE(waitFor([&] { return copy_count() == 0; }));
    window_->controller().setExaggeration(5.0);
    window_->commands().project.autosaveNow();
    EXPECT_EQ(copy_count(), 1);
    window_->undoStack().undo();
    EXPECT_EQ(copy_count(), 0);
}

// A changed note costs a line, not a project; what a crash leaves between two steps is whole.
TEST_F(ProjectWindowTest, AutosaveAppendsWhatChangedToALog)
{
    makeWindow(kSmall, asking());
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    AnnotationController& annotating = *window_->annotating();
    std::vector<Annotation> points(2000);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].name = "p" + std::to_string(i);
        points[i].body = drawnBody(view().map()->georeference(), view().map()->info().body);
        points[i].vertices = {
            GeographicPoint{Angle::degrees(0.01 * static_cast<double>(i)), Angle::degrees(5.0)}};
    }
    annotating.add(points, QStringLiteral("Import"));
    ProjectController& project = window_->commands().project;
    project.autosaveNow();
    const auto file_with = [this](const char* ending) {
        fs::path found;
        for (const auto& entry : fs::directory_iterator(folder_.path() / "autosave")) {
            if (entry.path().extension() == ending) {
                EXPECT_TRUE(found.empty());
                found = entry.path();
            }
        }
        return found;
    };
    const fs::path copy = file_with(".mvproj");
    const fs::path log = file_with(".annotations");
    const auto whole = fs::file_size(log);
    EXPECT_LT(fs::file_size(copy), 10'000U);
    const Project before = saved();
    const fs::path older = folder_.path() / "older.mvproj";
    fs::copy_file(copy, older);

    const std::uint32_t first = annotating.state().items.front().id;
    annotating.setNote(first, QStringLiteral("looked at"));
    annotating.remove(first + 1);
    project.autosaveNow();
    EXPECT_EQ(file_with(".annotations"), log);
    EXPECT_GT(fs::file_size(log), whole);
    EXPECT_LT(fs::file_size(log), whole + 500);
    const Project after = saved();
    ASSERT_EQ(after.annotations.size(), 1999U);

    window_.reset(); // as a crash does, it leaves the copy
    makeWindow(kSmall, asking());
    const auto found = [this]() -> std::optional<Project> {
        const auto leftover = window_->commands().project.leftover();
        JobMonitor monitor;
        const auto read = leftover ? ProjectAutosave::wholeProject(*leftover, monitor)
                                   : Result<Project>(Error{ErrorCode::NotFound, ""});
        return read ? std::optional(*read) : std::nullopt;
    };
    EXPECT_EQ(found(), after);
    // Killed after the log was written and before the project file was.
    fs::copy_file(older, copy, fs::copy_options::overwrite_existing);
    EXPECT_EQ(found(), before);
    window_->commands().project.recover(*window_->commands().project.leftover());
    ASSERT_TRUE(waitFor([&] { return !fs::exists(copy); })) << "there is another one";
    EXPECT_EQ(saved().annotations, before.annotations);
    EXPECT_FALSE(fs::exists(log));
}

// A visitor who plays with the sample has nothing to lose.
TEST_F(ProjectWindowTest, ChangesOfTheSampleAloneAreNoneToKeep)
{
    makeWindow(kSmall, asking());
    window_->openSample(maps_.moon("sample"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    window_->controller().setExaggeration(7.0);
    EXPECT_FALSE(window_->isWindowModified());
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    EXPECT_TRUE(window_->isWindowModified()) << "undo brings the exaggeration back";
    window_->undoStack().undo();
    EXPECT_FALSE(window_->isWindowModified());
    window_->close();
    EXPECT_FALSE(window_->isVisible()) << "without a question";
}

// Opening is repeated as easily as it is done: there is nothing to ask.
TEST_F(ProjectWindowTest, OpeningMapsAloneIsNotAChange)
{
    makeWindow(kSmall, asking());
    window_->openSample(maps_.moon("sample"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    EXPECT_FALSE(window_->isWindowModified());
    window_->undoStack().undo();
    EXPECT_FALSE(window_->isWindowModified());
    window_->undoStack().redo();
    ASSERT_TRUE(openAndWait(*window_, maps_.mars("other")));
    EXPECT_FALSE(window_->isWindowModified());
    window_->controller().setExaggeration(7.0);
    EXPECT_TRUE(window_->isWindowModified());
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    EXPECT_TRUE(window_->isWindowModified()) << "the exaggeration would still be lost";
    ASSERT_TRUE(saveProject(window_->commands().project, path("a.mvproj")));
    ASSERT_TRUE(openAndWait(*window_, maps_.moon("more")));
    EXPECT_TRUE(window_->isWindowModified()) << "the file does not have the new layer";
}

} // namespace marsview
