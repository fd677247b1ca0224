// Progress of loading and of building overviews, in the status bar.
#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;

namespace marsview {

struct LoadReport;
struct PrepareProgress;

/// The file that is read, or else the map whose overviews are built, with progress and a button
/// that stops it. Hidden otherwise.
class LoadStatus final : public QWidget {
    Q_OBJECT

public:
    explicit LoadStatus(QWidget* parent = nullptr);

    void showReport(const LoadReport& report);
    void endLoading();
    /// Shown while nothing loads.
    void showPreparing(const PrepareProgress& progress);
    void endPreparing();

Q_SIGNALS:
    void cancelRequested();
    void stopPreparingRequested();

private:
    void showWhatGoesOn();

    bool is_loading_ = false;
    bool is_preparing_ = false;
    QString preparing_text_;
    QString preparing_tip_;
    double preparing_fraction_ = 0.0;
    QLabel* label_ = nullptr;
    QProgressBar* bar_ = nullptr;
    QToolButton* cancel_ = nullptr;
};

} // namespace marsview
