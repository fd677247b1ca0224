#include "ui/panels/annotation_panel.h"

#include "ui/controllers/annotation_controller.h"
#include "ui/panels/annotation_list.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr int kPanelHeight = 205; // to begin with

} // namespace

AnnotationPanel::AnnotationPanel(AnnotationController& controller,
                                 QAction& import_file,
                                 QAction& export_file,
                                 QWidget* parent)
    : QWidget(parent)
    , controller_(controller)
    , list_(new AnnotationList(controller, this))
    , hint_(new QLabel(
          tr("Choose Point, Line or Polygon in the Annotate menu and click on the map."), this))
{
    hint_->setForegroundRole(QPalette::PlaceholderText);
    hint_->setWordWrap(true);
    auto* line = new QHBoxLayout;
    for (QAction* action : {&import_file, &export_file}) {
        auto* button = new QPushButton(action->text(), this);
        button->setToolTip(action->statusTip());
        button->setEnabled(action->isEnabled());
        connect(button, &QPushButton::clicked, action, &QAction::trigger);
        connect(action, &QAction::enabledChanged, button, &QPushButton::setEnabled);
        line->addWidget(button);
    }
    line->addWidget(hint_, 1);
    line->addStretch(); // without the hint, the buttons keep their width
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(6, 4, 6, 6);
    layout->addWidget(list_, 1);
    layout->addLayout(line);
    connect(&controller_, &AnnotationController::changed, this, &AnnotationPanel::showState);
    showState();
}

QSize AnnotationPanel::sizeHint() const
{
    return {QWidget::sizeHint().width(), kPanelHeight};
}

void AnnotationPanel::showState()
{
    hint_->setVisible(controller_.state().items.empty());
}

} // namespace marsview
