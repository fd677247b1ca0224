// The panel of the measurements: what there is, the results of the current one, and its profile.
#pragma once

#include "ui/text/measure_text.h"

#include <QDir>
#include <QWidget>

#include <vector>

class QComboBox;
class QLabel;
class QPushButton;
class QToolButton;

namespace marsview {

class AttitudesView;
class HypsometryPlot;
class MeasureController;
class MeasureList;
struct MeasureItem;
class ProfilePlot;

/// Requests changes from the controller, and shows its state.
class MeasurePanel final : public QWidget {
    Q_OBJECT

public:
    explicit MeasurePanel(MeasureController& controller, QWidget* parent = nullptr);

    void setHeightUnit(HeightUnit unit);
    void setCoordinateFormat(const CoordinateFormat& format);
    MeasureList* list() const noexcept { return list_; }
    ProfilePlot* plot() const noexcept { return plot_; }
    AttitudesView* attitudes() const noexcept { return attitudes_; }
    HypsometryPlot* hypsometry() const noexcept { return hypsometry_; }
    /// The rows of the current result, a line each: label, tab, value.
    QString resultsText() const;
    /// Writes all measurements: as a table (csv), as features (gpkg), or the craters among them as
    /// a count (scc, diam). Why that is not possible; empty if the file is written.
    QString writeTable(const QString& path);
    /// Low: most of the window is for the map.
    QSize sizeHint() const override;

public Q_SLOTS:
    void copyResults();
    /// Asks for a file: the points of the profile as CSV, or its picture.
    void saveProfile();
    /// The same with the classes of elevation of the area.
    void saveHypsometry();
    /// Asks for a file: all measurements with their results as CSV.
    void saveTable();

Q_SIGNALS:
    void saved(const QString& file);
    /// The title says what was not done, the problem why.
    void failed(const QString& title, const QString& problem);

private:
    class ResultsTable;

    void makeList();
    void makeResults();
    void makeProfile();
    void makeHypsometry();
    void showItems();
    void showResult();
    static QString firstStepText(MeasurementKind kind);
    static QString nextStepText(const MeasureItem& item);
    bool isOneOfSeveralProfiles(const MeasureItem& item) const;
    void addPoints(std::vector<MeasureRow>& rows,
                   const MeasureItem& item,
                   const MeasurementResult& result) const;
    // With the other profiles that are selected in the list.
    void showProfile();
    void showHypsometry();
    // An empty problem: the file is written.
    void endSaving(const QString& failure, const QString& path, const QString& problem);
    bool writeProfile(const QString& path);
    bool writeHypsometry(const QString& path);
    QString tableCsv() const;

    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
    CoordinateFormat format_;
    MeasureList* list_ = nullptr;
    QWidget* results_side_ = nullptr;
    QLabel* title_ = nullptr;
    ResultsTable* results_ = nullptr;
    QLabel* note_ = nullptr;
    QLabel* hint_ = nullptr; // below everything: what can be done next
    QPushButton* copy_ = nullptr;
    QPushButton* remove_ = nullptr;
    AttitudesView* attitudes_ = nullptr;
    QWidget* profile_side_ = nullptr;
    ProfilePlot* plot_ = nullptr;
    QComboBox* scale_ = nullptr;
    QToolButton* slope_ = nullptr;
    QLabel* stretch_note_ = nullptr;
    QWidget* hypsometry_side_ = nullptr;
    HypsometryPlot* hypsometry_ = nullptr;
    QString folder_ = QDir::homePath(); // of the file that was saved or read last
};

} // namespace marsview
