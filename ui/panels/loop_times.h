// The timing of the servo loop.
#pragma once

#include "haptics/loop/loop_statistics.h"
#include "haptics/loop/real_time_thread.h"

#include <QElapsedTimer>
#include <QWidget>

class QBoxLayout;
class QLabel;

namespace marsview {

class TimePlot;

/// How long updates take and how late they begin: in figures since the loop began, and over the
/// last half minute as lines; how many came too late; and whether the loop runs in real time.
class LoopTimes final : public QWidget {
    Q_OBJECT

public:
    explicit LoopTimes(QWidget* parent = nullptr);

    /// Whether it is time for an update. Copying the statistics has a cost, so updates are limited
    /// to a rate that the eye can follow.
    bool isDue() const;
    /// Of the loop that runs, with what its thread has been granted. Nothing changes before its
    /// first update.
    void showLoop(const LoopStatistics& now, const RealTimeGrants& grants);
    /// No loop runs.
    void clear();

private:
    struct Line {
        QLabel* text = nullptr;
        TimePlot* plot = nullptr;
    };
    Line makeLine(QBoxLayout& layout, const QString& name);

    Line update_;
    Line lateness_;
    QLabel* missed_ = nullptr;
    QLabel* real_time_ = nullptr;
    QElapsedTimer since_shown_;
    LoopStatistics last_; // when the plots got their last moment
};

} // namespace marsview
