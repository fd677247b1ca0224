#include "ui/widgets/form_field.h"

#include "ui/widgets/caption.h"

#include <QEvent>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>

namespace marsview {
namespace {

QScrollArea* scrollAreaAround(QWidget* widget)
{
    for (QWidget* parent = widget->parentWidget(); parent != nullptr;
         parent = parent->parentWidget()) {
        if (auto* area = qobject_cast<QScrollArea*>(parent)) {
            return area;
        }
    }
    return nullptr;
}

} // namespace

QColor problemColor(const QPalette& palette)
{
    const bool is_dark = palette.color(QPalette::Window).lightness() < 128;
    return is_dark ? QColor(255, 138, 122) : QColor(176, 28, 20);
}

FormField::FormField(const QString& name, QWidget* editor, QWidget* parent)
    : QWidget(parent)
    , editor_(editor)
    , note_(new QLabel(this))
{
    auto* label = new QLabel(name, this);
    label->setWordWrap(true);
    label->setBuddy(editor);
    QString plain = name;
    editor->setAccessibleName(plain.remove(QLatin1Char('&')));
    note_->setWordWrap(true);
    note_->setTextFormat(Qt::PlainText);
    note_->setFont(captionFont(note_->font()));
    note_->setObjectName(editor->objectName() + QStringLiteral("Note"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    layout->addWidget(label);
    layout->addWidget(editor);
    layout->addWidget(note_);
    showNote();
}

void FormField::setProblem(const QString& problem)
{
    if (problem != problem_) {
        problem_ = problem;
        editor_->setAccessibleDescription(problem_);
        showNote();
    }
}

void FormField::setHint(const QString& hint)
{
    if (hint != hint_) {
        hint_ = hint;
        showNote();
    }
}

void FormField::focusEditor()
{
    editor_->setFocus(Qt::OtherFocusReason);
    if (QScrollArea* area = scrollAreaAround(this)) {
        area->ensureWidgetVisible(this);
    }
}

void FormField::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) {
        showNote();
    }
}

void FormField::showNote()
{
    const bool is_problem = !problem_.isEmpty();
    const QString text = is_problem ? problem_ : hint_;
    QPalette colors = note_->palette();
    const QColor color =
        is_problem ? problemColor(palette()) : palette().color(QPalette::PlaceholderText);
    if (colors.color(QPalette::WindowText) != color) {
        colors.setColor(QPalette::WindowText, color);
        note_->setPalette(colors);
    }
    note_->setText(text);
    note_->setVisible(!text.isEmpty());
}

} // namespace marsview
