#include "ui/text/annotation_text.h"

#include <QCoreApplication>

namespace marsview {
namespace {

QString annotationText(const char* text)
{
    return QCoreApplication::translate("Annotation", text);
}

} // namespace

QString shapeText(FeatureShape shape)
{
    switch (shape) {
    case FeatureShape::Point:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Point"));
    case FeatureShape::Line:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Line"));
    case FeatureShape::Polygon:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Polygon"));
    }
    return {};
}

QString symbolText(MarkSymbol symbol)
{
    switch (symbol) {
    case MarkSymbol::Circle:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Circle"));
    case MarkSymbol::Square:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Square"));
    case MarkSymbol::Triangle:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Triangle"));
    case MarkSymbol::Diamond:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Diamond"));
    case MarkSymbol::Star:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Star"));
    case MarkSymbol::Cross:
        return annotationText(QT_TRANSLATE_NOOP("Annotation", "Cross"));
    }
    return {};
}

} // namespace marsview
