// Decides which notices are on the bar.
#pragma once

#include "ui/widgets/notice.h"

#include <QObject>
#include <QSet>

#include <array>
#include <cstddef>

namespace marsview {

class NoticeBar;

/// What a notice is about, the most urgent first.
enum class NoticeSource {
    Device,
    Failure, // of what was just asked for
    Picture,
    Project,
    VectorFile, // that was just asked for
    Correction, // of how the active layer is read
    Sample,
    Scene, // layers that the picture leaves out
    Layer,
    Storage,
};

/// Keeps the notices of every source and which of them were closed. A closed notice about the
/// device, the picture or a vector file returns when its condition ends and occurs again; every
/// other stays closed as long as the window lives, because undo and other active layers make its
/// condition come and go. GUI thread. Must not outlive the bar.
class NoticeCenter final : public QObject {
    Q_OBJECT

public:
    explicit NoticeCenter(NoticeBar& bar, QObject* parent = nullptr);

    /// Replaces the notices of one source, the most important first.
    void setNotices(NoticeSource source, const QList<Notice>& notices);
    /// Those that are not closed, the most important first.
    QList<Notice> open() const;

private:
    static constexpr std::size_t kSourceCount = static_cast<std::size_t>(NoticeSource::Storage) + 1;

    void dismiss(const QString& id);
    void runAction(const QString& id, int action);
    void showDetails(const QString& id);
    void update();

    NoticeBar& bar_;
    std::array<QList<Notice>, kSourceCount> notices_;
    std::array<QSet<QString>, kSourceCount> dismissed_;
};

} // namespace marsview
