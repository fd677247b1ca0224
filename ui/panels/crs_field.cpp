#include "ui/panels/crs_field.h"

#include "ui/text/body_text.h"
#include "ui/text/core_text.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QFocusEvent>
#include <QKeyEvent>
#include <QScrollBar>
#include <QStandardItemModel>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kTypingPause{150};
constexpr std::size_t kMatchesMax = 30;
constexpr int kPopupWidthMax = 620; // pixels

} // namespace

CrsField::CrsField(QWidget* parent)
    : QLineEdit(parent)
    , model_(new QStandardItemModel(this))
    , completer_(new QCompleter(model_, this))
{
    setClearButtonEnabled(true);
    pool_.setMaxThreadCount(1);
    timer_.setSingleShot(true);
    timer_.setInterval(kTypingPause);
    connect(&timer_, &QTimer::timeout, this, &CrsField::search);
    connect(this, &QLineEdit::textEdited, this, [this] { timer_.start(); });
    // Not setCompleter(): that would filter by the text itself.
    completer_->setWidget(this);
    completer_->setCompletionMode(QCompleter::UnfilteredPopupCompletion);
    completer_->setCompletionRole(Qt::UserRole);
    completer_->popup()->setAccessibleName(tr("Matching coordinate reference systems"));
    connect(completer_, qOverload<const QString&>(&QCompleter::activated), this,
            [this](const QString& code) {
                timer_.stop();
                setText(code);
                model_->clear();
                Q_EMIT settled();
            });
}

CrsField::~CrsField()
{
    pool_.waitForDone(); // the job posts to this object
}

void CrsField::loadCatalogue()
{
    if (catalogue_ || is_loading_) {
        return;
    }
    is_loading_ = true;
    pool_.start([this] {
        std::shared_ptr<const CrsCatalog> catalogue;
        try {
            catalogue = std::make_shared<const CrsCatalog>(CrsCatalog::fromDatabase());
        } catch (const std::exception&) {
            catalogue = std::make_shared<const CrsCatalog>(std::vector<CrsEntry>{});
        }
        QMetaObject::invokeMethod(
            this,
            [this, catalogue = std::move(catalogue)] {
                catalogue_ = catalogue;
                if (hasFocus() && !text().isEmpty() && isModified()) {
                    search();
                }
            },
            Qt::QueuedConnection);
    });
}

QStringList CrsField::matches() const
{
    QStringList codes;
    for (int row = 0; row < model_->rowCount(); ++row) {
        codes.append(model_->item(row)->data(Qt::UserRole).toString());
    }
    return codes;
}

QAbstractItemView* CrsField::matchList() const
{
    return completer_->popup();
}

void CrsField::search()
{
    listMatches();
    if (model_->rowCount() == 0 || !hasFocus()) {
        completer_->popup()->hide();
    } else {
        QAbstractItemView* popup = completer_->popup();
        const int content =
            popup->sizeHintForColumn(0) + popup->verticalScrollBar()->sizeHint().width() + 16;
        completer_->complete(
            QRect(0, 0, std::clamp(content, width(), std::max(width(), kPopupWidthMax)), height()));
        popup->setCurrentIndex(completer_->completionModel()->index(0, 0));
    }
    Q_EMIT settled();
}

void CrsField::listMatches()
{
    model_->clear();
    if (!catalogue_) {
        return;
    }
    const std::vector<const CrsEntry*> hits =
        catalogue_->search(text().toStdString(), kMatchesMax, body_);
    if (hits.size() == 1 && textFrom(hits[0]->code) == text().trimmed()) {
        return; // it is entered already
    }
    for (const CrsEntry* hit : hits) {
        //: A coordinate reference system in a list: %1 is its name, %2 its code
        auto* item = new QStandardItem(tr("%1 (%2)").arg(textFrom(hit->name), textFrom(hit->code)));
        item->setData(textFrom(hit->code), Qt::UserRole);
        QStringList tip{hit->body != nullptr ? bodyName(*hit->body) : QString()};
        tip.append(QString::fromStdString(hit->area));
        tip.removeAll(QString());
        item->setToolTip(tip.join(QLatin1Char('\n')));
        model_->appendRow(item);
    }
}

void CrsField::focusInEvent(QFocusEvent* event)
{
    QLineEdit::focusInEvent(event);
    loadCatalogue();
}

void CrsField::keyPressEvent(QKeyEvent* event)
{
    const bool is_return = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (is_return && completer_->popup()->isVisible()) {
        if (completer_->popup()->currentIndex().isValid()) {
            event->ignore(); // it chooses from the list
            return;
        }
        completer_->popup()->hide(); // without a choice there, the typed text counts
    }
    if (event->key() == Qt::Key_Down && !completer_->popup()->isVisible() && !text().isEmpty()) {
        search();
        return;
    }
    QLineEdit::keyPressEvent(event);
}

} // namespace marsview
