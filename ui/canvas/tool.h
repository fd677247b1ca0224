// The tools: what a drag with the left button does on the map.
#pragma once

#include <QString>
#include <Qt>

#include <span>

namespace marsview {

/// Exactly one is chosen. The order is that of menu and toolbar.
enum class Tool {
    Pan,      ///< the terrain stays under the pointer
    Touch,    ///< the stylus presses into the terrain
    Orbit,    ///< turns and tilts the view
    Measure,  ///< clicks place points, drags move them or pan
    Annotate, ///< the same for annotations
};

/// How a tool is offered. Texts are translated when they are asked for.
struct ToolInfo {
    Tool tool;
    Qt::Key key;      // alone, while the map has the focus
    const char* icon; // see ui/widgets/icons.h

    QString text() const; // of the menu entry, with its mnemonic
    QString tip() const;
    QString whatsThis() const;
};

std::span<const ToolInfo> toolInfos();

} // namespace marsview
