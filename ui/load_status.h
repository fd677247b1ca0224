// What is loading, in the status bar.
#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;

namespace marsview {

struct LoadReport;
struct PrepareProgress;

/// What is read, or else what is prepared, how far it is and a way to stop it. Hidden while there
/// is neither.
class LoadStatus final : public QWidget {
    Q_OBJECT

public:
    explicit LoadStatus(QWidget* parent = nullptr);

    void showReport(const LoadReport& report);
    void endLoading();
    /// To be seen while nothing loads.
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
