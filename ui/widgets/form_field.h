// A field of a form, with its name above it and an error about its value below it.
#pragma once

#include <QString>
#include <QWidget>

class QLabel;

namespace marsview {

/// Takes the editor over and gives it its accessible name. A problem is red text below the editor
/// and the editor's accessible description.
class FormField final : public QWidget {
    Q_OBJECT

public:
    /// `name` may have a mnemonic.
    FormField(const QString& name, QWidget* editor, QWidget* parent = nullptr);

    /// Empty for none.
    void setProblem(const QString& problem);
    const QString& problem() const noexcept { return problem_; }
    /// What the value means, or how to enter one; hidden while there is a problem. Empty for none.
    void setHint(const QString& hint);
    /// Moves the focus to the editor, in sight.
    void focusEditor();

    QWidget* editor() const noexcept { return editor_; }

protected:
    void changeEvent(QEvent* event) override;

private:
    void showNote();

    QWidget* editor_ = nullptr;
    QLabel* note_ = nullptr;
    QString problem_;
    QString hint_;
};

/// Red that is readable on the window color of a palette: a contrast of at least 4.5.
QColor problemColor(const QPalette& palette);

} // namespace marsview
