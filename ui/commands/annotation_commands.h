// The Annotate menu, the tool that is chosen in it, and files of annotations.
#pragma once

#include "core/annotations/annotation_files.h"
#include "ui/controllers/detached_jobs.h"

#include <QDir>
#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <string>

class QMainWindow;

namespace marsview {

class AnnotationController;
class AnnotationPanel;
class FileWork;
class TerrainView;
class WindowDocks;
struct WindowActions;

/// Files are read and written on a thread of their own. GUI thread; must not outlive its parts.
class AnnotationCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        WindowActions& actions;
        AnnotationController& annotating;
        AnnotationPanel& panel;
        TerrainView& view;
        WindowDocks& docks;
        FileWork& work;
    };

    explicit AnnotationCommands(const Parts& parts);
    /// Cancels reading and writing.
    ~AnnotationCommands() override;

    /// Adds the features of a file on the body of the map that is shown; imported() or failed()
    /// follows. `crs` replaces that of the file.
    void importFile(const QString& file, const std::optional<Crs>& crs = std::nullopt);
    /// Writes the selected annotations if there are several, otherwise all of them; exported() or
    /// failed() follows.
    void exportFile(const QString& file);

Q_SIGNALS:
    /// A text for the status bar.
    void imported(const QString& message);
    void exported(const QString& file);
    /// "FILE: WHY"
    void failed(const QString& problem);

private:
    struct Outcome;

    void showPanel();
    void showState();
    void askImport();
    void askExport();
    void take(const QString& file, const Outcome& outcome);
    void askBody(const QString& file, const Outcome& outcome);

    Parts parts_;
    QString folder_ = QDir::homePath(); // of the file that was saved or read last
    DetachedJobs jobs_;
};

} // namespace marsview
