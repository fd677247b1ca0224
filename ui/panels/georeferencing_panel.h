// The panel that tells where a map lies, and lets the user know better.
#pragma once

#include "core/raster/raster_info.h"
#include "ui/number_text.h"

#include <QWidget>

#include <array>
#include <memory>
#include <optional>

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QStackedWidget;

namespace marsview {

class Dataset;

/// Two pages: the facts, and the fields to override them. Asks for changes; never makes any.
class GeoreferencingPanel final : public QWidget {
    Q_OBJECT

public:
    explicit GeoreferencingPanel(QWidget* parent = nullptr);

    /// The map in effect; null for none. Fills both pages; what is being typed stays as long as
    /// the map does.
    void setDataset(const std::shared_ptr<const Dataset>& dataset);
    void setHeightUnit(HeightUnit unit);

    /// Switches to the fields.
    void edit();

Q_SIGNALS:
    void overridesRequested(const RasterOverrides& overrides);

private:
    QWidget* makeFactsPage();
    QWidget* makeFieldsPage();
    void fillFacts();
    void addFact(const QString& name, const QString& value);
    void addPlaceFacts(const Dataset& dataset);
    void addSampleFacts(const Dataset& dataset);
    void fillFields();
    Ellipsoid ellipsoidFrom(std::optional<double> equatorial_m,
                            std::optional<double> polar_m) const;
    void apply();
    void showProblem(const QString& problem);

    std::shared_ptr<const Dataset> dataset_;
    HeightUnit unit_of_heights_ = HeightUnit::Metres;
    QStackedWidget* pages_ = nullptr;
    QWidget* facts_page_ = nullptr;
    QWidget* fields_page_ = nullptr;
    QFormLayout* facts_ = nullptr;
    QLabel* notices_ = nullptr;
    QPushButton* override_button_ = nullptr;

    QLineEdit* crs_ = nullptr;
    QComboBox* body_ = nullptr;
    QLineEdit* equatorial_ = nullptr;
    QLineEdit* polar_ = nullptr;
    std::array<QLineEdit*, 6> terms_{};
    QComboBox* unit_ = nullptr;
    QLineEdit* nodata_ = nullptr;
    QLabel* problem_ = nullptr;
};

} // namespace marsview
