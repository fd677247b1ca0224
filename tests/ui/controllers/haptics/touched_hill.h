// A device in a window with a hill, and files for it to replay.
#pragma once

#include "tests/ui/hand_window.h"

#include <QByteArray>
#include <QFile>
#include <QString>

#include <gtest/gtest.h>

namespace marsview {

/// Writes lines with the same goal and the given columns of a recording.
inline void
writeGoals(const QString& file, int count, const QByteArray& goal, const QByteArray& columns = {})
{
    QFile text(file);
    ASSERT_TRUE(text.open(QIODevice::WriteOnly | QIODevice::Truncate));
    text.write("x,y,z" + columns + '\n');
    for (int i = 0; i < count; ++i) {
        text.write(goal + '\n');
    }
}

/// Base of tests in a window with TestMaps::hill(). At their end no device is open or forced.
class TouchedHillTest : public HandWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kSmall);
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    }
    void TearDown() override
    {
        hand_->is_held_up = false;
        window_.reset();
        EXPECT_EQ(hand_->open_count, 0);
        EXPECT_EQ(hand_->force_n, 0.0);
    }

    // Down until there is a force.
    bool pressDown()
    {
        hand_->moveTo({0.0, 0.0, -0.055});
        return waitFor([&] { return hand_->force_n > 0.5; });
    }
};

} // namespace marsview
