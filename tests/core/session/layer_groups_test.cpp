#include "core/session/layer_groups.h"
#include "tests/support/make_raster.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace marsview {
namespace {

using testing::ElementsAre;

// A session of small rasters, named by letters, topmost first: 'm' on Mars, 'e' on the Earth, '?'
// on an unknown body.
class LayerGroupsTest : public testing::Test {
protected:
    Session sessionOf(const std::string& bodies)
    {
        Session session;
        for (auto kind = bodies.rbegin(); kind != bodies.rend(); ++kind) {
            const auto place = static_cast<std::size_t>(bodies.rend() - kind) - 1;
            session = added(session, {.map = on(*kind), .name = std::string(1, "abcdefgh"[place])});
        }
        return session;
    }
    static std::string namesIn(const Session& session)
    {
        std::string names;
        for (const Layer& layer : session.layers) {
            names += layer.name;
        }
        return names;
    }
    static LayerId idOf(const Session& session, const std::string& name)
    {
        for (const Layer& layer : session.layers) {
            if (layer.name == name) {
                return layer.id;
            }
        }
        return LayerId::None;
    }

private:
    std::shared_ptr<const Map> on(char kind)
    {
        test::RasterRecipe recipe = test::recipeFor(4, std::vector<float>(16, 1.0F));
        recipe.srs = kind == 'm' ? "IAU_2015:49900" : kind == 'e' ? "EPSG:4326" : "";
        recipe.transform = {10.0, 0.01, 0.0, 20.0, 0.0, -0.01};
        const std::string path =
            test::writeVrt(folder_, "group" + std::to_string(count_++), recipe);
        JobMonitor monitor;
        auto map = readMap(RasterSpec{path, 1, {}}, monitor, std::size_t{1} << 20);
        EXPECT_TRUE(map) << map.error().message;
        return map ? *map : nullptr;
    }

    test::TempFolder folder_;
    int count_ = 0;
};

TEST_F(LayerGroupsTest, AreInTheOrderOfTheirTopmostLayers)
{
    const std::vector<LayerGroup> groups = layerGroups(sessionOf("emm?e"));
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].body, bodyNamed("Earth"));
    EXPECT_THAT(groups[0].layers, ElementsAre(0, 4));
    EXPECT_EQ(groups[1].body, bodyNamed("Mars"));
    EXPECT_THAT(groups[1].layers, ElementsAre(1, 2));
    EXPECT_EQ(groups[2].body, nullptr);
    EXPECT_THAT(groups[2].layers, ElementsAre(3));
    EXPECT_TRUE(layerGroups({}).empty());
}

// Whatever the order of bodies, every position in the group can be reached, and other groups keep
// their order.
TEST_F(LayerGroupsTest, MovesALayerToEveryPlaceOfItsGroup)
{
    for (const char* bodies : {"mmm", "memem", "emmem", "eemmm", "mmeem"}) {
        const Session session = sessionOf(bodies);
        const auto marsLayers = [](const Session& s) {
            std::string names;
            std::string others;
            for (const Layer& layer : s.layers) {
                (layer.map->info().body == bodyNamed("Mars") ? names : others) += layer.name;
            }
            return std::pair(names, others);
        };
        const auto [names, others] = marsLayers(session);
        ASSERT_EQ(names.size(), 3U);
        for (std::size_t from = 0; from < 3; ++from) {
            for (std::size_t place = 0; place < 3; ++place) {
                const LayerId id = idOf(session, names.substr(from, 1));
                const auto index = indexForPlace(session, id, place);
                ASSERT_TRUE(index);
                std::string expected = names;
                expected.erase(from, 1);
                expected.insert(place, names.substr(from, 1));
                const auto [now, others_now] = marsLayers(moved(session, id, *index));
                EXPECT_EQ(now, expected) << bodies << ": " << from << " to " << place;
                EXPECT_EQ(others_now, others);
            }
        }
    }
}

TEST_F(LayerGroupsTest, SwapsNeighborsWithinAGroup)
{
    const Session session = sessionOf("memem"); // a b c d e
    const auto step = [&session](const std::string& name, GroupStep to) {
        const LayerId id = idOf(session, name);
        const auto index = indexBeside(session, id, to);
        return index ? namesIn(moved(session, id, *index)) : std::string("stays");
    };
    EXPECT_EQ(step("a", GroupStep::Up), "stays");
    EXPECT_EQ(step("e", GroupStep::Down), "stays");
    EXPECT_EQ(step("c", GroupStep::Up), "cabde");
    EXPECT_EQ(step("c", GroupStep::Down), "abdec");
    EXPECT_EQ(step("d", GroupStep::Up), "adbce");
    EXPECT_EQ(step("d", GroupStep::Down), "stays");
    EXPECT_FALSE(indexBeside(session, LayerId::None, GroupStep::Up));
    const Session alone = sessionOf("me");
    EXPECT_FALSE(indexForPlace(alone, idOf(alone, "a"), 0));
}

} // namespace
} // namespace marsview
