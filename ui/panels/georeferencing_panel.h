// The panel with the body, place and elevations of a map, and the form that sets them.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/raster/raster_info.h"
#include "ui/text/number_text.h"

#include <QWidget>

#include <memory>

class QLabel;
class QPushButton;
class QScrollArea;
class QStackedWidget;
class QVBoxLayout;

namespace marsview {

class Map;
class OverrideForm;

/// Two pages: the facts, and the form to override them. Asks for changes; never makes any.
class GeoreferencingPanel final : public QWidget {
    Q_OBJECT

public:
    explicit GeoreferencingPanel(QWidget* parent = nullptr);

    /// The map in effect; null for none. `is_nodata_assumed`: its nodata value is neither the
    /// file's nor the user's. Fills both pages; the form stays open for as long as it is the same
    /// file with the same overrides.
    void setMap(const std::shared_ptr<const Map>& map, bool is_nodata_assumed = false);
    void setHeightUnit(HeightUnit unit);
    void setCoordinateFormat(const CoordinateFormat& format);

    /// Switches to the form.
    void edit();
    enum class NoticeFocus { Take, Leave };
    /// Reveals one of the notices among the facts. It takes the keyboard focus where the user
    /// works with the keyboard.
    void showNotice(const QString& notice, NoticeFocus focus);
    /// Why overrides were refused; shows the form.
    void showFailure(const QString& problem);

Q_SIGNALS:
    void overridesRequested(const RasterOverrides& overrides);

private:
    void makeFactsPage();
    void makeForm();
    void fillFacts();
    void addCaption(const QString& name);
    QLabel* addFact(const QString& name, const QString& value);
    void addLongFact(const QString& name, const QString& value);
    void addNotice(const QString& text);
    void flash(QLabel& label);
    void addPlaceFacts(const Map& map);
    void addSampleFacts(const Map& map);

    std::shared_ptr<const Map> map_;
    bool is_nodata_assumed_ = false;
    HeightUnit unit_of_heights_ = HeightUnit::Meters;
    CoordinateFormat coordinates_;
    QStackedWidget* pages_ = nullptr;
    QScrollArea* facts_page_ = nullptr;
    OverrideForm* form_ = nullptr;
    QVBoxLayout* facts_ = nullptr;
    QVBoxLayout* notices_ = nullptr; // one label for each
    QPushButton* override_button_ = nullptr;
};

} // namespace marsview
