#include "ui/canvas/gestures.h"

#include <QCoreApplication>
#include <QKeySequence>

#include <algorithm>
#include <array>

namespace marsview {
namespace {

constexpr std::array kBindings{
    // Shift pans with every tool and every button.
    GestureBinding{Gesture::Drag, Qt::LeftButton, Qt::ShiftModifier, std::nullopt, MapAction::Pan},
    GestureBinding{Gesture::Drag, Qt::MiddleButton, Qt::ShiftModifier, std::nullopt,
                   MapAction::Pan},
    GestureBinding{Gesture::Drag, Qt::RightButton, Qt::ShiftModifier, std::nullopt, MapAction::Pan},
    // The left button uses the selected tool.
    GestureBinding{Gesture::Drag, Qt::LeftButton, Qt::NoModifier, Tool::Pan, MapAction::Pan},
    GestureBinding{Gesture::Drag, Qt::LeftButton, Qt::NoModifier, Tool::Touch, MapAction::Touch},
    GestureBinding{Gesture::Drag, Qt::LeftButton, Qt::NoModifier, Tool::Orbit, MapAction::Orbit},
    GestureBinding{Gesture::Drag, Qt::LeftButton, Qt::NoModifier, Tool::Measure, MapAction::Pan},
    GestureBinding{Gesture::Click, Qt::LeftButton, Qt::NoModifier, Tool::Measure,
                   MapAction::AddPoint},
    GestureBinding{Gesture::DoubleClick, Qt::LeftButton, Qt::NoModifier, Tool::Measure,
                   MapAction::FinishDrawing},
    GestureBinding{Gesture::Drag, Qt::LeftButton, Qt::NoModifier, Tool::Annotate, MapAction::Pan},
    GestureBinding{Gesture::Click, Qt::LeftButton, Qt::NoModifier, Tool::Annotate,
                   MapAction::AddPoint},
    GestureBinding{Gesture::DoubleClick, Qt::LeftButton, Qt::NoModifier, Tool::Annotate,
                   MapAction::FinishDrawing},
    GestureBinding{Gesture::Drag, Qt::RightButton, Qt::NoModifier, std::nullopt, MapAction::Orbit},
    GestureBinding{Gesture::Drag, Qt::MiddleButton, Qt::NoModifier, std::nullopt, MapAction::Orbit},
    GestureBinding{Gesture::WheelWhilePressing, Qt::NoButton, Qt::NoModifier, Tool::Touch,
                   MapAction::PressDeeper},
    GestureBinding{Gesture::Wheel, Qt::NoButton, Qt::ControlModifier, std::nullopt,
                   MapAction::ZoomFinely},
    GestureBinding{Gesture::Wheel, Qt::NoButton, Qt::NoModifier, std::nullopt, MapAction::Zoom},
    GestureBinding{Gesture::DoubleClick, Qt::LeftButton, Qt::NoModifier, std::nullopt,
                   MapAction::FlyThere},
    GestureBinding{Gesture::Click, Qt::LeftButton, Qt::NoModifier, std::nullopt,
                   MapAction::SelectFeature},
    GestureBinding{Gesture::Click, Qt::RightButton, Qt::NoModifier, std::nullopt,
                   MapAction::OpenMenu},
};

QString gestureTr(const char* text)
{
    return QCoreApplication::translate("Gestures", text);
}

QString dragText(Qt::MouseButtons buttons)
{
    if (buttons == Qt::LeftButton) {
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Left drag"));
    }
    if (buttons == (Qt::RightButton | Qt::MiddleButton)) {
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Right or middle drag"));
    }
    if (buttons == Qt::RightButton) {
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Right drag"));
    }
    if (buttons == Qt::MiddleButton) {
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Middle drag"));
    }
    //: With any button
    return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Drag"));
}

QString plainText(Gesture gesture, Qt::MouseButtons buttons)
{
    switch (gesture) {
    case Gesture::Drag:
        return dragText(buttons);
    case Gesture::Click:
        return buttons == Qt::LeftButton ? gestureTr(QT_TRANSLATE_NOOP("Gestures", "Click"))
                                         : gestureTr(QT_TRANSLATE_NOOP("Gestures", "Right click"));
    case Gesture::DoubleClick:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Double click"));
    case Gesture::Wheel:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Wheel"));
    case Gesture::WheelWhilePressing:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Wheel while pressing"));
    }
    return {};
}

QString gestureText(const GestureBinding& binding, Qt::MouseButtons buttons)
{
    QString text = plainText(binding.gesture, buttons);
    if (binding.modifiers != Qt::NoModifier) {
        // "Shift+", as the platform writes it
        text.prepend(QKeySequence(static_cast<int>(binding.modifiers.toInt()))
                         .toString(QKeySequence::NativeText));
    }
    if (!binding.tool || binding.gesture == Gesture::WheelWhilePressing) {
        return text;
    }
    const auto tools = toolInfos();
    const auto info = std::find_if(tools.begin(), tools.end(), [&](const ToolInfo& known) {
        return known.tool == *binding.tool;
    });
    //: %1 is a gesture of the mouse, %2 the tool that has to be chosen for it
    return gestureTr(QT_TRANSLATE_NOOP("Gestures", "%1 (%2)"))
        .arg(text, info->text().remove(QLatin1Char('&')));
}

QString actionText(MapAction action)
{
    switch (action) {
    case MapAction::None:
        break;
    case MapAction::Pan:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Pan: the terrain follows the pointer"));
    case MapAction::Orbit:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Turn and tilt"));
    case MapAction::Touch:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Press into the terrain"));
    case MapAction::Zoom:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Zoom to the pointer"));
    case MapAction::ZoomFinely:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Zoom finely"));
    case MapAction::PressDeeper:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Press deeper or less deep"));
    case MapAction::FlyThere:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Fly there"));
    case MapAction::AddPoint:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Add a point"));
    case MapAction::MovePoint:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Move a point"));
    case MapAction::FinishDrawing:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Finish the measurement or annotation"));
    case MapAction::SelectFeature:
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Select a feature and show its attributes"));
    case MapAction::OpenMenu:
        //: Of the place on the map that is clicked
        return gestureTr(QT_TRANSLATE_NOOP("Gestures", "Context menu"));
    }
    return {};
}

} // namespace

std::span<const GestureBinding> gestureBindings()
{
    return kBindings;
}

MapAction
actionOf(Gesture gesture, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, Tool tool)
{
    const auto* hit =
        std::find_if(kBindings.begin(), kBindings.end(), [&](const GestureBinding& binding) {
            return binding.gesture == gesture && binding.button == button &&
                   (modifiers & binding.modifiers) == binding.modifiers &&
                   (!binding.tool || *binding.tool == tool);
        });
    return hit != kBindings.end() ? hit->action : MapAction::None;
}

std::vector<GestureLine> gestureLines()
{
    std::vector<GestureLine> lines;
    const auto is_same_but_button = [](const GestureBinding& a, const GestureBinding& b) {
        return a.gesture == b.gesture && a.modifiers == b.modifiers && a.tool == b.tool &&
               a.action == b.action;
    };
    for (const GestureBinding* binding = kBindings.begin(); binding != kBindings.end(); ++binding) {
        const bool is_listed =
            std::any_of(kBindings.begin(), binding, [&](const GestureBinding& other) {
                return is_same_but_button(other, *binding);
            });
        if (is_listed) {
            continue;
        }
        Qt::MouseButtons buttons;
        for (const GestureBinding& other : kBindings) {
            buttons.setFlag(other.button,
                            is_same_but_button(other, *binding) || buttons.testFlag(other.button));
        }
        lines.push_back({gestureText(*binding, buttons), actionText(binding->action)});
    }
    return lines;
}

} // namespace marsview
