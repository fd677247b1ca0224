// What is loading, in the status bar.
#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;

namespace marsview {

struct LoadReport;

/// Stage, progress and a way to stop it. Hidden while nothing loads.
class LoadStatus final : public QWidget {
    Q_OBJECT

public:
    explicit LoadStatus(QWidget* parent = nullptr);

    void showReport(const LoadReport& report);

Q_SIGNALS:
    void cancelRequested();

private:
    QLabel* label_ = nullptr;
    QProgressBar* bar_ = nullptr;
};

} // namespace marsview
