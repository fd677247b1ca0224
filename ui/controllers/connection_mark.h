// Whether the program ended in the middle of a touch.
#pragma once

namespace marsview {

/// A mark in the settings that a haptic device is connected. It is found at the next start where
/// the program crashed or was killed meanwhile: a driver that ends the program shall not do so at
/// every start. GUI thread.
class ConnectionMark {
public:
    /// The mark of a program that runs no more; takes it away.
    static bool takeLeft();

    /// Written at once.
    void set(bool is_connected);

private:
    bool is_set_ = false;
};

} // namespace marsview
