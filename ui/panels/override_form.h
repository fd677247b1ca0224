// The form that replaces what a file states about its place and its elevations.
#pragma once

#include "core/raster/raster_info.h"

#include <QTimer>
#include <QWidget>

#include <array>
#include <map>
#include <memory>
#include <optional>

class QComboBox;
class QGridLayout;
class QLineEdit;
class QVBoxLayout;

namespace marsview {

class CrsField;
class Map;
class FormField;

/// Empty fields keep the file's value. Requests changes, makes none. The reason why a value cannot
/// be used is shown below its field, which gets the focus; entered values stay. The fields scroll;
/// the buttons below them do not.
class OverrideForm final : public QWidget {
    Q_OBJECT

public:
    explicit OverrideForm(QWidget* parent = nullptr);

    /// Null for none. Fills the fields, unless it is the same file with the same overrides as
    /// before: then unapplied input stays.
    void setMap(const std::shared_ptr<const Map>& map);
    void focusFirstField();
    /// Why overrides could not be applied, "OPTION: WHY", which may follow a path.
    void showFailure(const QString& problem);

Q_SIGNALS:
    /// Overrides that fit the file; empty ones to go by the file alone.
    void overridesRequested(const RasterOverrides& overrides);
    /// Nothing is to be changed.
    void closed();

private:
    QLineEdit* addEdit(QVBoxLayout& layout,
                       const QString& name,
                       const char* object_name,
                       std::optional<OverrideField> field = {});
    QComboBox* addChoice(QVBoxLayout& layout,
                         const QString& name,
                         const char* object_name,
                         OverrideField field);
    void addTransform(QVBoxLayout& layout);
    void addButtons(QVBoxLayout& layout);
    void fill();
    void clearProblems();
    void checkNumbers();
    void checkCrs();
    Ellipsoid ellipsoidFrom(std::optional<double> equatorial_m,
                            std::optional<double> polar_m) const;
    std::optional<RasterOverrides> entered();
    void apply();
    FormField* fieldOf(const QWidget* editor) const;

    std::shared_ptr<const Map> map_;
    QTimer typing_timer_; // runs out when the user stops typing
    std::map<OverrideField, FormField*> fields_;
    QList<FormField*> all_fields_;
    CrsField* crs_ = nullptr;
    QComboBox* body_ = nullptr;
    QLineEdit* equatorial_ = nullptr;
    QLineEdit* polar_ = nullptr;
    std::array<QLineEdit*, 6> terms_{};
    QComboBox* unit_ = nullptr;
    QLineEdit* scale_ = nullptr;
    QLineEdit* offset_ = nullptr;
    QLineEdit* datum_ = nullptr;
    QLineEdit* nodata_ = nullptr;
    QList<QLineEdit*> numbers_;
};

} // namespace marsview
