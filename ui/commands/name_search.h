// Finding places by their names, in the window.
#pragma once

#include "core/names/gazetteer.h"
#include "ui/controllers/names_controller.h"
#include "ui/widgets/name_completer.h"

#include <QObject>
#include <QString>

class QAction;
class QLineEdit;
class QMainWindow;

namespace marsview {

class GlobeView;
class MapOverlays;
class TerrainView;

/// Connects the search field, the view and the lists of names; opens files of names. GUI thread;
/// must not outlive its parts.
class NameSearch final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        TerrainView& view;
        GlobeView& globe;
        MapOverlays& overlays;
        QLineEdit& field;
        QAction& open_names;
        bool is_remembered = false; // opened files are opened again by the next window
    };

    explicit NameSearch(const Parts& parts, QObject* parent = nullptr);

    NamesController& lists() noexcept { return lists_; }
    /// The names on the maps of the scene.
    NamesOnMap namesOnMap();
    /// The uppermost of them that a place lies on; null if there is none.
    std::shared_ptr<const Map> mapAt(const PlaceName& place) const;
    /// Flies there so that the feature fills the view, and marks it.
    void goTo(const PlaceName& place);
    /// Reads a file of names.
    void open(const QString& file);

Q_SIGNALS:
    /// The names on the topmost layer changed.
    void changed();
    /// In a few words, for the status bar.
    void opened(const QString& message);
    /// "FILE: WHY"
    void failed(const QString& problem);

private:
    void chooseFile();
    static void remember(const QString& file, const Gazetteer& names);
    void reopen();
    void showMap();
    void goToText();
    const Body* body() const;

    Parts parts_;
    NamesController lists_;
    NameCompleter* completer_ = nullptr;
    QString folder_; // of the file that was opened last
};

} // namespace marsview
