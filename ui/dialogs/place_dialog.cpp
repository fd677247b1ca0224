#include "ui/dialogs/place_dialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <utility>

namespace marsview {
namespace {

// How often it is looked whether finer samples have arrived.
constexpr int kReadInterval = 100; // ms

} // namespace

PlaceDialog::PlaceDialog(std::function<PlaceFacts()> read, QWidget* parent)
    : QDialog(parent)
    , read_(std::move(read))
    , form_(new QFormLayout)
{
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
    layout->addLayout(form_);
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
    }
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
