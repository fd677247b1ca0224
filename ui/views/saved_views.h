// Saved views in the window: menu entries, panel, flights to them.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/session/saved_view.h"
#include "ui/views/camera_flight.h"
#include "ui/views/saved_views_panel.h"
#include "ui/views/view_thumbnails.h"
#include "ui/widgets/name_completer.h"

#include <QList>
#include <QObject>

#include <functional>
#include <optional>

class QAction;
class QMenu;

namespace marsview {

class SessionController;
class TerrainView;

/// Adds the menu "Saved Views" and connects the panel, the session and the view. GUI thread; must
/// not outlive what it is made of.
class SavedViews final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        SessionController& session;
        TerrainView& view;
        PictureScenes scenes;
        SavedViewsPanel& panel;
        QMenu& menu;                            // the new one is inserted there,
        QAction* before = nullptr;              // before this
        std::function<NamesOnMap()> names = {}; // on the topmost layer; empty: none
        std::function<CoordinateFormat()> format = {};
        /// The globe, which may be shown in place of the view.
        struct Globe {
            std::function<std::optional<ViewCamera>()> camera; // empty while it is not shown
            std::function<void(const ViewCamera&)> fly;        // shows it
            std::function<void()> leave;                       // shows the view
        };
        Globe globe = {};
        std::function<void()> reveal_panel = {};
    };

    explicit SavedViews(const Parts& parts, QObject* parent = nullptr);

    const SavedViewActions& actions() const noexcept { return actions_; }
    QMenu* menu() const noexcept { return menu_; }
    QAction* showPanel() const noexcept { return show_panel_; }
    ViewThumbnails& thumbnails() noexcept { return thumbnails_; }
    CameraFlight& flight() noexcept { return flight_; }

    /// Saves the current view under a name that suits it, and lets the user type another one.
    void save();
    /// Flies there. Reports a view whose layers are not open.
    void goTo(ViewId id);
    /// Gives a view the current camera and exaggeration.
    void update(ViewId id);

Q_SIGNALS:
    /// In a few words, for the status bar.
    void reported(const QString& message);

private:
    void makeActions();
    void fillMenu();
    void showSession();
    void showEnabled();
    std::optional<ViewCamera> currentCamera() const;
    std::optional<SavedView> currentView() const;
    std::optional<ViewCamera> globeCamera() const;
    QString descriptionOf(const SavedView& view) const;

    Parts parts_;
    SavedViewActions actions_;
    QAction* show_panel_ = nullptr;
    QMenu* menu_ = nullptr;
    QList<QAction*> numbered_; // go to the first ones
    ViewThumbnails thumbnails_;
    CameraFlight flight_;
};

} // namespace marsview
