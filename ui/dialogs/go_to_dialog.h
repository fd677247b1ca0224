// Going to a place by its name or its coordinate.
#pragma once

#include "core/base/result.h"
#include "core/session/map.h"
#include "ui/controllers/preferences.h"
#include "ui/text/coordinate_text.h"
#include "ui/widgets/name_completer.h"

#include <QDialog>
#include <QTimer>

#include <memory>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace marsview {

/// How a pair of numbers without letters is read.
enum class ReadAs { Map, Planetocentric, Planetographic };

/// What a map offers, the format's own first.
std::vector<ReadAs> readingsOn(const RasterInfo& info, const CoordinateFormat& format);

/// The last entry, to start with the next time.
struct GoToEntry {
    /// Nothing for the format's own: a planetocentric reading on Mars must not become a geocentric
    /// one on the Earth.
    std::optional<ReadAs> read_as;
    QString text;
};

struct FoundPlace {
    std::shared_ptr<const Map> map;
    GridPoint grid; // of it; up to half a pixel beyond the outermost samples
    ReadAs read_as; // differs from the requested one if the text is unambiguous
};

/// The place on the map's grid that a text names. Letters N, S, E or W and degree signs make it a
/// latitude and a longitude, numbers beyond 360 map coordinates, whatever `read_as` is. A longitude
/// without a letter is west-positive where the format is. Errors name the invalid part of the text,
/// or the map's limits if the place is outside.
Result<FoundPlace> placeOnMap(const std::shared_ptr<const Map>& map,
                              const CoordinateFormat& format,
                              ReadAs read_as,
                              const QString& text);

/// The same on the first of several maps that has the place. Map coordinates are those of the first
/// one's CRS.
Result<FoundPlace> placeOnMaps(const std::vector<std::shared_ptr<const Map>>& maps,
                               const CoordinateFormat& format,
                               ReadAs read_as,
                               const QString& text);

/// Shows the position that the text names, or the error in it, while the user types.
class GoToDialog final : public QDialog {
    Q_OBJECT

public:
    /// The maps of the scene, the uppermost first; at least one. Of the preferences, the format of
    /// coordinates and the unit of elevations are used.
    GoToDialog(std::vector<std::shared_ptr<const Map>> maps,
               const Preferences& preferences,
               const GoToEntry& last,
               NamesOnMap names,
               QWidget* parent = nullptr);

    /// For another use than going there.
    void setTexts(const QString& title, const QString& button);
    GoToEntry entry() const;

Q_SIGNALS:
    void placeChosen(const FoundPlace& place);
    void nameChosen(const PlaceName& place);

private:
    ReadAs readAs() const;
    QString answerFor(const FoundPlace& place);
    std::optional<PlaceName> namedPlace() const;
    QString answerFor(const PlaceName& place) const;
    void check();
    void go();

    std::vector<std::shared_ptr<const Map>> maps_;
    std::shared_ptr<const Map> map_; // the uppermost
    Preferences preferences_;
    NamesOnMap names_;
    QTimer arrival_timer_;       // runs while the elevation of the place is loading
    QLineEdit* field_ = nullptr; // first: the first child created gets the focus
    QComboBox* kind_ = nullptr;
    QLabel* answer_ = nullptr;
    QPushButton* go_button_ = nullptr;
};

} // namespace marsview
