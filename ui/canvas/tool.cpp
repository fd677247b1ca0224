#include "ui/canvas/tool.h"

#include <QCoreApplication>
#include <QKeySequence>

#include <array>

namespace marsview {
namespace {

constexpr std::array kTools{
    ToolInfo{Tool::Pan, Qt::Key_P, "pan"},           ToolInfo{Tool::Touch, Qt::Key_T, "touch"},
    ToolInfo{Tool::Orbit, Qt::Key_O, "orbit"},       ToolInfo{Tool::Measure, Qt::Key_M, "measure"},
    ToolInfo{Tool::Annotate, Qt::Key_A, "annotate"},
};

QString toolText(const char* text)
{
    return QCoreApplication::translate("Tool", text);
}

} // namespace

std::span<const ToolInfo> toolInfos()
{
    return kTools;
}

QString ToolInfo::text() const
{
    switch (tool) {
    case Tool::Pan:
        //: A tool: drag moves the map
        return toolText(QT_TRANSLATE_NOOP("Tool", "&Pan"));
    case Tool::Touch:
        //: A tool: drag presses the stylus into the terrain
        return toolText(QT_TRANSLATE_NOOP("Tool", "&Touch"));
    case Tool::Orbit:
        //: A tool: drag turns and tilts the view
        return toolText(QT_TRANSLATE_NOOP("Tool", "&Orbit"));
    case Tool::Measure:
        //: A tool: clicks place the points of a measurement
        return toolText(QT_TRANSLATE_NOOP("Tool", "&Measure"));
    case Tool::Annotate:
        //: A tool: clicks place the points of an annotation
        return toolText(QT_TRANSLATE_NOOP("Tool", "&Annotate"));
    }
    return {};
}

QString ToolInfo::tip() const
{
    const QString shortcut = QKeySequence(key).toString(QKeySequence::NativeText);
    switch (tool) {
    case Tool::Pan:
        //: %1 is a key
        return toolText(QT_TRANSLATE_NOOP("Tool", "Drag to move the terrain (%1)")).arg(shortcut);
    case Tool::Touch:
        //: %1 is a key
        return toolText(QT_TRANSLATE_NOOP(
                            "Tool", "Drag to feel the terrain; the wheel presses deeper (%1)"))
            .arg(shortcut);
    case Tool::Orbit:
        //: %1 is a key
        return toolText(QT_TRANSLATE_NOOP("Tool", "Drag to turn and tilt the view (%1)"))
            .arg(shortcut);
    case Tool::Measure:
        //: %1 is a key
        return toolText(
                   QT_TRANSLATE_NOOP("Tool", "Click to place the points of a measurement (%1)"))
            .arg(shortcut);
    case Tool::Annotate:
        //: %1 is a key
        return toolText(QT_TRANSLATE_NOOP("Tool", "Click to draw points, lines and polygons (%1)"))
            .arg(shortcut);
    }
    return {};
}

QString ToolInfo::whatsThis() const
{
    switch (tool) {
    case Tool::Pan:
        return toolText(QT_TRANSLATE_NOOP(
            "Tool",
            "A drag with the left button moves the terrain with the pointer. With every "
            "tool, a drag with the right button turns and tilts the view, Shift and a drag "
            "pan, and the wheel zooms to the pointer."));
    case Tool::Touch:
        return toolText(QT_TRANSLATE_NOOP(
            "Tool",
            "A drag with the left button presses the stylus, a red cone, into the terrain; "
            "the wheel presses deeper. The meter shows the force. A connected haptic "
            "device touches whatever the tool is."));
    case Tool::Orbit:
        return toolText(QT_TRANSLATE_NOOP(
            "Tool",
            "A drag with the left button turns and tilts the view about the terrain in the "
            "middle of the picture."));
    case Tool::Measure:
        return toolText(QT_TRANSLATE_NOOP(
            "Tool",
            "A click, or Enter, places a point of the measurement; a double click, or Enter again "
            "in the same place, finishes it. Drag a point to move it, drag a line to insert one; "
            "Backspace removes the last one, or the one under the pointer. Choose what to measure "
            "in the Measure menu."));
    case Tool::Annotate:
        return toolText(QT_TRANSLATE_NOOP(
            "Tool",
            "A click, or Enter, places a point of the annotation; a double click, or Enter again "
            "in the same place, finishes a line or polygon. Drag a point to move it, drag a line "
            "to insert one; Backspace removes the last one, or the one under the pointer. Choose "
            "what to draw in the Annotate menu."));
    }
    return {};
}

} // namespace marsview
