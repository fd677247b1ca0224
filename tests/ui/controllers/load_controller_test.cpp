#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/controllers/load_controller.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace marsview {
namespace {

LoadRequest requestFor(const QString& file)
{
    LoadRequest request;
    request.spec.path = file.toStdString();
    return request;
}

struct Outcomes {
    std::vector<std::string> succeeded;
    std::vector<std::string> failed;
    int canceled = 0;

    explicit Outcomes(LoadController& controller)
    {
        QObject::connect(&controller, &LoadController::succeeded, &controller,
                         [this](const std::shared_ptr<const Map>& map) {
                             succeeded.push_back(map->spec().path);
                         });
        QObject::connect(
            &controller, &LoadController::failed, &controller,
            [this](const LoadFailure& failure) { failed.push_back(failure.error.message); });
        QObject::connect(&controller, &LoadController::canceled, &controller,
                         [this](const RasterSpec&) { ++canceled; });
    }
    std::size_t count() const
    {
        return succeeded.size() + failed.size() + static_cast<std::size_t>(canceled);
    }
};

TEST(LoadController, DeliversAMapWithAllItsParts)
{
    const TestMaps maps;
    LoadController controller;
    std::shared_ptr<const Map> loaded;
    QObject::connect(&controller, &LoadController::succeeded, &controller,
                     [&](const std::shared_ptr<const Map>& map) { loaded = map; });
    controller.start(requestFor(maps.hill()));
    EXPECT_TRUE(controller.isLoading());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !controller.isLoading(); }, kTimeout));
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(loaded->analysis());
    EXPECT_TRUE(loaded->relief());
}

TEST(LoadController, ReportsWhyAFileCannotBeOpened)
{
    LoadController controller;
    Outcomes outcomes(controller);
    controller.start(requestFor(QStringLiteral("/no/such/map.tif")));
    ASSERT_TRUE(QTest::qWaitFor([&] { return outcomes.count() > 0; }, kTimeout));
    ASSERT_EQ(outcomes.failed.size(), 1U);
    EXPECT_EQ(outcomes.failed[0].find("/no/such/map.tif: "), 0U);
}

TEST(LoadController, DropsAResultThatArrivesAfterCancel)
{
    const TestMaps maps;
    const QString file = maps.hill();
    LoadController controller;
    Outcomes outcomes(controller);
    for (int i = 0; i < 30; ++i) {
        controller.start(requestFor(file));
        // Does not process events, so that a result may already be waiting for delivery.
        QTest::qSleep(i % 10);
        controller.cancel();
        EXPECT_FALSE(controller.isLoading());
        EXPECT_EQ(outcomes.canceled, i + 1);
    }
    QTest::qWait(50);
    EXPECT_TRUE(outcomes.succeeded.empty());
    EXPECT_TRUE(outcomes.failed.empty());
}

TEST(LoadController, DeliversOnlyTheLastOfSeveralLoads)
{
    const TestMaps maps;
    const QString first = maps.hill(QStringLiteral("first.asc"));
    const QString last = maps.hill(QStringLiteral("last.asc"));
    LoadController controller;
    Outcomes outcomes(controller);
    for (int i = 0; i < 20; ++i) {
        controller.start(requestFor(first));
    }
    controller.start(requestFor(last));
    ASSERT_TRUE(QTest::qWaitFor([&] { return outcomes.count() > 0; }, kTimeout));
    QTest::qWait(50);
    ASSERT_EQ(outcomes.count(), 1U);
    EXPECT_EQ(outcomes.succeeded[0], last.toStdString());
}

TEST(LoadController, MayBeDestroyedWhileLoading)
{
    const TestMaps maps;
    const QString file = maps.hill();
    for (int i = 0; i < 20; ++i) {
        LoadController controller;
        controller.start(requestFor(file));
    }
    QCoreApplication::processEvents();
}

} // namespace
} // namespace marsview
