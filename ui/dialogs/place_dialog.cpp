#include "ui/dialogs/place_dialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

// How often it is looked whether finer samples have arrived.
constexpr int kReadInterval = 100; // ms

// Longer texts are wrapped, and more facts scrolled.
constexpr int kLineCharactersMax = 60;
constexpr double kScreenShareMax = 0.5; // of its height

} // namespace

PlaceDialog::PlaceDialog(std::function<PlaceFacts()> read, Focus focus, QWidget* parent)
    : QDialog(parent,
              // Some window managers, such as openbox, give a tool window no focus.
              (focus == Focus::Card ? Qt::Dialog : Qt::Tool) | Qt::WindowTitleHint |
                  Qt::WindowCloseButtonHint | Qt::CustomizeWindowHint)
    , read_(std::move(read))
    , scroll_(new QScrollArea(this))
{
    auto* facts = new QWidget;
    form_ = new QFormLayout(facts);
    form_->setContentsMargins({});
    scroll_->setWidget(facts);
    scroll_->setWidgetResizable(true);
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    // The card's own ground; that of a list differs.
    scroll_->viewport()->setAutoFillBackground(false);
    facts->setAutoFillBackground(false);
    setAttribute(Qt::WA_ShowWithoutActivating, focus == Focus::Map);
    setWindowTitle(tr("What Is Here"));
    setObjectName(QStringLiteral("placeDialog"));
    form_->setHorizontalSpacing(16);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    QPushButton* copy = buttons->addButton(tr("&Copy All"), QDialogButtonBox::ActionRole);
    copy->setObjectName(QStringLiteral("copyAll"));
    connect(copy, &QPushButton::clicked, this,
            [this] { QGuiApplication::clipboard()->setText(text()); });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(scroll_);
    layout->addSpacing(6);
    layout->addWidget(buttons);
    layout->setSizeConstraint(QLayout::SetFixedSize);
    timer_.setInterval(kReadInterval);
    connect(&timer_, &QTimer::timeout, this, [this] { show(read_()); });
    show(read_());
}

void PlaceDialog::show(const PlaceFacts& place)
{
    place.is_rough ? timer_.start() : timer_.stop();
    facts_ = place.facts;
    while (form_->rowCount() > static_cast<int>(facts_.size())) {
        form_->removeRow(form_->rowCount() - 1);
    }
    for (int row = 0; row < static_cast<int>(facts_.size()); ++row) {
        const auto& [name, value] = facts_[static_cast<std::size_t>(row)];
        if (row == form_->rowCount()) {
            auto* label = new QLabel(this);
            label->setTextFormat(Qt::PlainText);
            label->setTextInteractionFlags(Qt::TextSelectableByMouse |
                                           Qt::TextSelectableByKeyboard);
            form_->addRow(new QLabel(this), label);
        }
        auto* name_label =
            qobject_cast<QLabel*>(form_->itemAt(row, QFormLayout::LabelRole)->widget());
        auto* value_label =
            qobject_cast<QLabel*>(form_->itemAt(row, QFormLayout::FieldRole)->widget());
        name_label->setText(name);
        value_label->setText(value);
        value_label->setAccessibleName(name);
        const bool is_long = value.size() > kLineCharactersMax;
        value_label->setWordWrap(is_long);
        value_label->setMinimumWidth(
            is_long ? kLineCharactersMax * value_label->fontMetrics().averageCharWidth() : 0);
    }
    fitFacts();
}

void PlaceDialog::fitFacts()
{
    const QWidget* facts = scroll_->widget();
    form_->activate();
    const QSize wanted = facts->sizeHint();
    const int height =
        facts->hasHeightForWidth() ? facts->heightForWidth(wanted.width()) : wanted.height();
    const int height_max =
        static_cast<int>(kScreenShareMax * screen()->availableGeometry().height());
    const bool is_scrolled = height > height_max;
    scroll_->setVerticalScrollBarPolicy(is_scrolled ? Qt::ScrollBarAsNeeded
                                                    : Qt::ScrollBarAlwaysOff);
    const int bar = is_scrolled ? scroll_->verticalScrollBar()->sizeHint().width() : 0;
    scroll_->setFixedSize(wanted.width() + bar, std::min(height, height_max));
}

void PlaceDialog::showAt(QPoint place)
{
    QWidget::show();
    const QScreen* at = QGuiApplication::screenAt(place);
    const QRect screen = (at != nullptr ? at : this->screen())->availableGeometry();
    // To the right or left of the place, or above or below it where there is no room.
    constexpr int kGap = 12;
    QRect card(place + QPoint(kGap, kGap), frameGeometry().size());
    if (card.right() > screen.right()) {
        card.moveRight(place.x() - kGap);
    }
    if (card.left() < screen.left()) {
        card.moveLeft(std::max(screen.left(), screen.right() - card.width()));
        if (card.bottom() > screen.bottom()) {
            card.moveBottom(place.y() - kGap);
        }
    }
    card.moveBottom(std::min(card.bottom(), screen.bottom()));
    card.moveTop(std::max(card.top(), screen.top()));
    move(card.topLeft());
    if (!testAttribute(Qt::WA_ShowWithoutActivating)) {
        activateWindow(); // not every window manager does it for new windows
    }
}

void PlaceDialog::setReader(std::function<PlaceFacts()> read)
{
    read_ = std::move(read);
    show(read_());
}

QString PlaceDialog::text() const
{
    QStringList lines;
    for (const auto& [name, value] : facts_) {
        //: A line of text that is copied: %1 is a name, %2 its value
        lines.append(tr("%1: %2").arg(name, value));
    }
    return lines.join(QLatin1Char('\n'));
}

} // namespace marsview
