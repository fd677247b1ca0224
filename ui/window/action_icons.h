// The icons of the window's actions.
#pragma once

namespace marsview {

class WindowDocks;
struct WindowActions;

/// Gives every action and menu that has one its icon.
void setIcons(const WindowActions& actions);
/// The same for the panels. Their menu entries keep their check boxes.
void setIcons(const WindowDocks& docks);

} // namespace marsview
