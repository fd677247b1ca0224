// Vector files in the window: opening, the menu and the list of those that are open.
#pragma once

#include "core/session/session.h"
#include "ui/widgets/notice.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <string>
#include <vector>

class QAction;
class QMainWindow;
class QMenu;

namespace marsview {

class FileWork;
class NoticeCenter;
class SessionController;
class TerrainView;
class VectorFileList;
class VectorOverlays;

/// GUI thread; must not outlive its parts.
class VectorTools final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        SessionController& session;
        TerrainView& view;
        NoticeCenter& notices;
        FileWork& work;
        QAction& open;
        QMenu& files;         // of open files; it is filled here
        VectorFileList& list; // the same
    };

    explicit VectorTools(const Parts& parts, QObject* parent = nullptr);

    /// Opens vector files, after the maps that are being loaded.
    void open(const QStringList& files);
    VectorOverlays& overlays() noexcept { return *overlays_; }
    void setSession(const Session& session);

Q_SIGNALS:
    /// A text for the status bar.
    void opened(const QString& message);
    /// "FILE: WHY"
    void failed(const QString& problem);

private:
    void askFile();
    void openWaiting();
    void offerBody(const QString& file, const QString& body, const QString& crs);
    void withdrawOffer(const QString& file);
    void add(const QString& file, const QString& crs, const QStringList& notices);
    void connectList();
    void fillMenu();
    void fillList();
    void setVisible(const std::string& path, bool is_visible);
    void askColor(const std::string& path);
    const VectorOverlay* overlayOf(const std::string& path) const;

    Parts parts_;
    VectorOverlays* overlays_ = nullptr;
    std::vector<VectorOverlay> shown_; // in the menu
    QList<Notice> offers_;             // to read files on the map's body, by path
    QStringList waiting_;              // for the maps that are being loaded
    QString folder_;
};

} // namespace marsview
