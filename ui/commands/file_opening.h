// Opening files: by menu, by drop, from the list of recent ones.
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

class QMainWindow;
class QMimeData;

namespace marsview {

class ProjectMenu;
class RecentFiles;
class SessionController;
class VectorTools;
struct WindowActions;

/// The files and addresses in `data` that can be opened.
QStringList filesIn(const QMimeData& data);

/// Passes maps, projects and vector files to what opens each kind, and remembers the folder. GUI
/// thread; must not outlive its parts.
class FileOpening final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        const WindowActions& actions;
        SessionController& session;
        ProjectMenu& projects;
        VectorTools& vector_files;
        bool is_remembered = false; // recent files and the last folder
        QString bundled_maps{};     // their folder; empty: none
    };

    explicit FileOpening(const Parts& parts);

    /// Maps lie on top of each other and of the first project; vector files are drawn over them.
    void open(const QStringList& files);
    /// The same for the files that the program is started with. Opening these maps is not undone.
    void openAtStart(const QStringList& files);
    /// Asks for files, then opens them.
    void chooseFile();
    void chooseFolder();
    /// Asks for an address, then opens it.
    void chooseAddress();

    RecentFiles* recentFiles() const noexcept { return recent_; }

Q_SIGNALS:
    /// Files are about to be opened.
    void requested();

private:
    static QStringList rasterFilters();
    using OpenMaps = void (SessionController::*)(const QStringList&);
    void openFiles(const QStringList& files, OpenMaps open_maps);
    void openMaps(QStringList maps, OpenMaps open_maps);
    void fillBundledMaps();
    void openBundledMap(const QString& file);
    bool isBundled(const QString& file) const;
    void remember(const QString& file);

    Parts parts_;
    RecentFiles* recent_ = nullptr;
    QString last_folder_;
};

} // namespace marsview
