#include "ui/widgets/notice_center.h"

#include "ui/widgets/notice_bar.h"

#include <algorithm>

namespace marsview {
namespace {

bool isForgottenWithItsCondition(NoticeSource source)
{
    return source == NoticeSource::Device || source == NoticeSource::Picture ||
           source == NoticeSource::VectorFile;
}

} // namespace

NoticeCenter::NoticeCenter(NoticeBar& bar, QObject* parent)
    : QObject(parent)
    , bar_(bar)
{
    connect(&bar_, &NoticeBar::closeRequested, this, &NoticeCenter::dismiss);
    connect(&bar_, &NoticeBar::actionRequested, this, &NoticeCenter::runAction);
    connect(&bar_, &NoticeBar::detailsRequested, this, &NoticeCenter::showDetails);
}

void NoticeCenter::setNotices(NoticeSource source, const QList<Notice>& notices)
{
    const auto index = static_cast<std::size_t>(source);
    notices_[index] = notices;
    if (isForgottenWithItsCondition(source)) {
        QSet<QString>& dismissed = dismissed_[index];
        dismissed.removeIf([&notices](const QString& id) {
            return std::none_of(notices.begin(), notices.end(),
                                [&id](const Notice& notice) { return notice.id == id; });
        });
    }
    update();
}

void NoticeCenter::dismiss(const QString& id)
{
    for (std::size_t i = 0; i < kSourceCount; ++i) {
        for (const Notice& notice : notices_[i]) {
            if (notice.id == id) {
                dismissed_[i].insert(id);
            }
        }
    }
    update();
}

QList<Notice> NoticeCenter::open() const
{
    QList<Notice> open;
    for (std::size_t i = 0; i < kSourceCount; ++i) {
        for (const Notice& notice : notices_[i]) {
            if (!dismissed_[i].contains(notice.id)) {
                open.append(notice);
            }
        }
    }
    return open;
}

// What runs may change the notices: it is called on a copy.
void NoticeCenter::runAction(const QString& id, int action)
{
    for (const Notice& notice : open()) {
        if (notice.id == id && action < notice.actions.size()) {
            notice.actions[action].run();
            return;
        }
    }
}

void NoticeCenter::showDetails(const QString& id)
{
    for (const Notice& notice : open()) {
        if (notice.id == id && notice.show_details) {
            notice.show_details();
            return;
        }
    }
}

void NoticeCenter::update()
{
    bar_.setNotices(open());
}

} // namespace marsview
