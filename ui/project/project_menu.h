// The project in the window: menu entries, questions, title, notices of missing layers.
#pragma once

#include "ui/controllers/recent_files.h"
#include "ui/project/project_controller.h"
#include "ui/widgets/notice_center.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QTimer>

#include <filesystem>
#include <functional>
#include <set>

class QAction;
class QMainWindow;
class QMenu;
class QMessageBox;

namespace marsview {

/// Adds New, Open, Save, Save As and Recent Projects to the top of the File menu, and asks before
/// unsaved changes are lost. GUI thread; must not outlive its parts.
class ProjectMenu final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        QMenu& file_menu;
        SessionController& session;
        ProjectController& project;
        NoticeCenter& notices;
        RecentFiles::Memory memory = RecentFiles::Memory::WindowOnly;
        /// Whether questions are asked; otherwise unsaved changes are dropped.
        bool has_questions = false;
        /// Of the maps that come with the program; empty for none.
        QString bundled_maps{};
    };

    explicit ProjectMenu(const Parts& parts, QObject* parent = nullptr);

    /// Runs `next` once nothing would be lost: at once if there are no changes, or after the user
    /// has saved or dropped them. Never if the user cancels, or saving fails.
    void saveThen(const std::function<void()>& next);
    /// Whether saveThen() would ask.
    bool hasQuestion() const;
    /// Reads a project, opens it once nothing would be lost, and then opens maps on top of it. If
    /// the project cannot be read, the maps are opened alone.
    void open(const QString& project, const QStringList& maps = {});
    /// Asks whether to restore what a crash left behind, if anything. A program that was killed a
    /// moment ago may take seconds to end: until then its copy is watched.
    void offerRecovery();
    /// "PROJECT[*]"; empty if the project was never saved.
    QString title() const;

    QAction* newProject() const noexcept { return new_; }
    QAction* openProject() const noexcept { return open_; }
    QAction* saveProject() const noexcept { return save_; }
    QAction* saveProjectAs() const noexcept { return save_as_; }
    QMenu* recentProjects() const noexcept { return recent_menu_; }

Q_SIGNALS:
    /// A project is about to be started or opened.
    void requested();

private:
    void chooseProject();
    void saveAs(const std::function<void()>& next);
    void locate(LayerId id);
    void showMissing();
    void offerLeftover(const std::set<std::filesystem::path>* of = nullptr);
    void ask(const LeftoverProject& leftover);
    void lookAtCopiesInUse();
    QString folder() const;

    Parts parts_;
    QAction* new_ = nullptr;
    QAction* open_ = nullptr;
    QAction* save_ = nullptr;
    QAction* save_as_ = nullptr;
    QMenu* recent_menu_ = nullptr;
    RecentFiles* recent_ = nullptr;
    std::set<std::filesystem::path> asked_;  // copies that the user has been asked about
    std::set<std::filesystem::path> in_use_; // copies of others, until they are free or gone
    QPointer<QMessageBox> question_;
    QTimer look_again_;
    QElapsedTimer looking_; // since the offer was made
    QStringList maps_;      // to be opened on top of the project
};

} // namespace marsview
