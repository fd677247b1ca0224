// Vector files in the window: opening, the menu of those that are open.
#pragma once

#include "core/session/session.h"

#include <QObject>
#include <QString>

class QAction;
class QMainWindow;
class QMenu;

namespace marsview {

class SessionController;
class TerrainView;
class VectorOverlays;

/// GUI thread; must not outlive what it is made of.
class VectorTools final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        SessionController& session;
        TerrainView& view;
        QAction& open;
        QMenu& files; // of open files; it is filled here
    };

    explicit VectorTools(const Parts& parts, QObject* parent = nullptr);

    VectorOverlays& overlays() noexcept { return *overlays_; }
    void setSession(const Session& session);

Q_SIGNALS:
    /// A text for the status bar.
    void opened(const QString& message);
    /// "FILE: WHY"
    void failed(const QString& problem);

private:
    void askFile();
    void add(const QString& file, const QStringList& notices);
    void fillMenu();
    void askColor(const std::string& path);
    void goTo(const std::string& path);
    const VectorOverlay* overlayOf(const std::string& path) const;

    Parts parts_;
    VectorOverlays* overlays_ = nullptr;
    std::vector<VectorOverlay> shown_; // in the menu
    QString folder_;
};

} // namespace marsview
