// The attitudes of a session together: stereonet or rose diagram, statistics, and saving.
#pragma once

#include <QDir>
#include <QString>
#include <QWidget>

class QLabel;

namespace marsview {

class MeasureController;
class StereonetPlot;

/// Shows all measured attitudes; the current one is highlighted.
class AttitudesView final : public QWidget {
    Q_OBJECT

public:
    explicit AttitudesView(MeasureController& controller, QWidget* parent = nullptr);

    StereonetPlot* plot() const noexcept { return plot_; }
    /// The mean plane and its spread, in words; empty without attitudes.
    QString statisticsText() const;
    /// Writes a table (csv) or the diagram (png, svg, pdf). False where the file cannot be written.
    bool save(const QString& path) const;

public Q_SLOTS:
    /// To be called when measurements or their results changed.
    void showItems();
    /// Asks for a file.
    void askFile();

Q_SIGNALS:
    void saved(const QString& file);
    /// The title says what was not done, the problem why.
    void failed(const QString& title, const QString& problem);

private:
    MeasureController& controller_;
    StereonetPlot* plot_ = nullptr;
    QLabel* statistics_ = nullptr;
    QString folder_ = QDir::homePath(); // of the file that was saved or read last
};

} // namespace marsview
