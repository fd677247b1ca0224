#include "core/session/map.h"
#include "core/session/session.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace marsview {
namespace {

using testing::ElementsAre;

using test::RasterRecipe;
using test::recipeFor;
using test::TempFolder;
using test::writeVrt;

using Terms = std::array<double, 6>;

constexpr Terms kUtm{500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0};
constexpr Terms kDegrees{10.0, 0.01, 0.0, 20.0, 0.0, -0.01};

// Datasets of a few samples at the given position.
class Maps {
public:
    std::shared_ptr<const Map>
    at(const std::string& srs, const Terms& terms, const RasterOverrides& overrides = {})
    {
        RasterRecipe recipe = recipeFor(12, std::vector<float>(120, 1.0F));
        recipe.srs = srs;
        recipe.transform = terms;
        const std::string path = writeVrt(folder_, "map" + std::to_string(count_++), recipe);
        JobMonitor monitor;
        auto dataset = readMap(RasterSpec{path, 1, overrides}, monitor, std::size_t{1} << 20);
        EXPECT_TRUE(dataset) << dataset.error().message;
        return dataset ? *dataset : nullptr;
    }
    std::shared_ptr<const Map> any() { return at("EPSG:32611", kUtm); }

private:
    TempFolder folder_;
    int count_ = 0;
};

std::vector<std::string> namesOf(const Session& session)
{
    std::vector<std::string> names;
    for (const Layer& layer : session.layers) {
        names.push_back(layer.name);
    }
    return names;
}

Session with(const std::vector<std::shared_ptr<const Map>>& bottom_first)
{
    Session session;
    for (std::size_t i = 0; i < bottom_first.size(); ++i) {
        session = added(session, {.map = bottom_first[i], .name = std::string(1, "abcdef"[i])});
    }
    return session;
}

TEST(Session, AddsLayersOnTopAndMakesThemActive)
{
    Maps maps;
    const Session session = with({maps.any(), maps.any(), maps.any()});
    EXPECT_THAT(namesOf(session), ElementsAre("c", "b", "a"));
    EXPECT_EQ(activeLayer(session)->name, "c");
}

TEST(Session, NamesALayerAfterItsFile)
{
    Maps maps;
    const Session session = added({}, {.map = maps.any()});
    EXPECT_EQ(session.layers[0].name, "map0.vrt");
}

TEST(Session, NamesLayersApartThatHaveTheSameFileName)
{
    Maps maps;
    const std::shared_ptr<const Map> map = maps.any();
    const std::string folder =
        std::filesystem::path(map->spec().path).parent_path().filename().string();
    Session session;
    for (int i = 0; i < 4; ++i) {
        session = added(session, {.map = map});
    }
    EXPECT_THAT(namesOf(session), ElementsAre("map0.vrt (3)", "map0.vrt (2)",
                                              "map0.vrt (" + folder + ")", "map0.vrt"));
    // A sample that makes way takes its name along.
    session = added({}, {.map = map, .is_sample = true});
    session = added(session, {.map = map});
    EXPECT_THAT(namesOf(session), ElementsAre("map0.vrt"));
}

TEST(Session, ReplacesTheSampleByAnOpenedMap)
{
    Maps maps;
    const Session sample = added({}, {.map = maps.any(), .name = "s", .is_sample = true});
    const Session session = added(sample, {.map = maps.any(), .name = "a"});
    EXPECT_THAT(namesOf(session), ElementsAre("a"));
    EXPECT_THAT(namesOf(added(session, {.map = maps.any(), .name = "b"})), ElementsAre("b", "a"));
    EXPECT_THAT(namesOf(sample), ElementsAre("s")); // a value: the previous session is unchanged
}

TEST(Session, KeepsItsInvariantsThroughAnySequenceOfChanges)
{
    Maps maps;
    const auto dataset = maps.any();
    const auto other = maps.any();
    test::Random random;
    Session session;
    std::set<std::uint64_t> ids_ever;
    for (int i = 0; i < 5000; ++i) {
        const Session before = session;
        const LayerId id = before.layers.empty() || random.chance(0.1)
                               ? LayerId{static_cast<std::uint32_t>(random.below(50))}
                               : before.layers[random.below(before.layers.size())].id;
        const std::size_t index = indexOf(before, id);
        const bool is_there = index < before.layers.size();
        const auto is_only_changed_at = [&](auto field) {
            Session undone = session;
            ASSERT_EQ(undone.layers.size(), before.layers.size());
            if (is_there) {
                undone.layers[index].*field = before.layers[index].*field;
            }
            EXPECT_EQ(undone, before);
        };
        switch (random.below(8)) {
        case 0: {
            session = added(before, {.map = dataset, .is_sample = random.chance(0.2)});
            const Layer& layer = session.layers.front();
            EXPECT_TRUE(ids_ever.insert(static_cast<std::uint64_t>(layer.id)).second);
            EXPECT_EQ(session.active, layer.id);
            break;
        }
        case 1:
            session = removed(before, id);
            EXPECT_EQ(session.layers.size(), before.layers.size() - (is_there ? 1 : 0));
            EXPECT_EQ(layerOf(session, id), nullptr);
            if (before.active != id) {
                EXPECT_EQ(session.active, before.active);
            } else if (is_there && !session.layers.empty()) {
                EXPECT_EQ(indexOf(session, session.active),
                          std::min(index, session.layers.size() - 1));
            }
            break;
        case 2: {
            const std::size_t to = random.below(before.layers.size() + 2);
            session = moved(before, id, to);
            if (is_there) {
                EXPECT_EQ(indexOf(session, id), std::min(to, before.layers.size() - 1));
                // The other layers keep their order, and the reverse move restores the session.
                EXPECT_EQ(removed(session, id).layers, removed(before, id).layers);
                EXPECT_EQ(moved(session, id, index), before);
            }
            break;
        }
        case 3:
            session = withVisibility(before, id, random.chance(0.5));
            is_only_changed_at(&Layer::is_visible);
            break;
        case 4:
            session = withRamp(before, id, random.chance(0.5) ? "grey" : "");
            is_only_changed_at(&Layer::ramp);
            break;
        case 5:
            session = withName(before, id, std::to_string(i));
            is_only_changed_at(&Layer::name);
            break;
        case 6:
            session = withMap(before, id, random.chance(0.5) ? dataset : other);
            is_only_changed_at(&Layer::map);
            break;
        default:
            session = activated(before, id);
            EXPECT_EQ(session.active, is_there ? id : before.active);
            break;
        }
        EXPECT_EQ(session.layers.empty(), session.active == LayerId::None);
        EXPECT_EQ(session.layers.empty(), activeLayer(session) == nullptr);
        EXPECT_EQ(placement(session).size(), session.layers.size());
    }
}

TEST(SessionExaggeration, SuitsTheFirstLayer)
{
    Maps maps;
    EXPECT_EQ(exaggerationOf({}), 1.0);
    const auto map = maps.any();
    EXPECT_EQ(exaggerationOf(with({map})), suitableExaggeration(*map));
}

TEST(SessionExaggeration, StaysWithThePictureWhenLayersComeAndGo)
{
    Maps maps;
    Session session = withExaggeration(with({maps.any()}), 4.0);
    EXPECT_EQ(exaggerationOf(session), 4.0);
    const LayerId lower = session.active;
    session = added(session, {.map = maps.any(), .exaggeration = 9.0});
    EXPECT_EQ(exaggerationOf(session), 4.0) << "a layer on top of the existing ones";
    const LayerId upper = session.active;
    session = withVisibility(session, lower, false);
    session = withExaggeration(session, 6.0);
    EXPECT_EQ(layerOf(session, lower)->exaggeration, 4.0) << "it was not in the view";
    session = moved(withVisibility(session, lower, true), lower, 0);
    EXPECT_EQ(exaggerationOf(session), 6.0);
    session = removed(session, upper);
    EXPECT_EQ(exaggerationOf(session), 6.0);
}

TEST(SessionExaggeration, IsSeparateForEachBody)
{
    Maps maps;
    Session session = withExaggeration(with({maps.at("IAU_2015:49900", kDegrees)}), 3.0);
    const LayerId mars = session.active;
    session = added(session, {.map = maps.at("IAU_2015:30100", kDegrees)});
    const LayerId moon = session.active;
    EXPECT_EQ(exaggerationOf(session), suitableExaggeration(*layerOf(session, moon)->map));
    session = withExaggeration(session, 7.0);
    EXPECT_EQ(layerOf(session, mars)->exaggeration, 3.0);
    session = withVisibility(session, moon, false);
    EXPECT_EQ(exaggerationOf(session), 3.0);
}

TEST(SessionStretch, IsSeparateForEachLayer)
{
    Maps maps;
    const Session before = with({maps.any(), maps.any()});
    const LayerId id = before.layers[1].id;
    Session session = withStretch(before, id, fixedStretch(1.0, 2.0));
    EXPECT_EQ(layerOf(session, id)->stretch, fixedStretch(1.0, 2.0));
    EXPECT_EQ(session.layers[0].stretch, ColorStretch{});
    session = withSlopeRange(session, id, SlopeRange{.maximum = Angle::degrees(5.0)});
    EXPECT_EQ(layerOf(session, id)->slope_range->maximum, Angle::degrees(5.0));
    session = withFeather(session, id, 40);
    EXPECT_EQ(layerOf(session, id)->feather_cells, 40U);
    EXPECT_EQ(recordOf(*layerOf(session, id)).feather_cells, 40U);
    EXPECT_NE(session, before);
    session = withFeather(session, id, 0);
    session = withSlopeRange(withStretch(session, id, {}), id, std::nullopt);
    EXPECT_EQ(session, before);
}

TEST(Placement, ShowsTheTopmostVisibleLayerAndOthersInItsCrs)
{
    Maps maps;
    const auto utm = maps.at("EPSG:32611", kUtm);
    const auto utm_elsewhere = maps.at("EPSG:32611", {600000.0, 10.0, 3.0, 4100000.0, 3.0, -10.0});
    const auto other_zone = maps.at("EPSG:32612", kUtm);
    const auto mars = maps.at("IAU_2015:49900", kDegrees);
    const auto moon = maps.at("IAU_2015:30100", kDegrees);
    const auto nowhere = maps.at("", kUtm);
    using S = LayerState;
    Session session = with({nowhere, moon, mars, other_zone, utm_elsewhere, utm});
    EXPECT_THAT(placement(session), ElementsAre(S::Shown, S::Shown, S::OtherCrs, S::OtherBody,
                                                S::OtherBody, S::UnknownPlace));
    EXPECT_EQ(shownLayers(session).size(), 2U);

    const LayerId top = session.layers[0].id;
    session = withVisibility(session, session.layers[1].id, false);
    session = withVisibility(session, top, false);
    EXPECT_THAT(placement(session), ElementsAre(S::Hidden, S::Hidden, S::Shown, S::OtherBody,
                                                S::OtherBody, S::UnknownPlace));
    session = moved(session, session.layers[5].id, 0); // the one without a CRS on top
    EXPECT_THAT(placement(session), ElementsAre(S::Shown, S::Hidden, S::Hidden, S::UnknownPlace,
                                                S::UnknownPlace, S::UnknownPlace));
    for (const Layer& layer : Session(session).layers) {
        session = withVisibility(session, layer.id, false);
    }
    EXPECT_TRUE(shownLayers(session).empty());
}

TEST(LayerOrder, PutsTheLayerWithTheSmallestPixelsOverTheOthers)
{
    Maps maps;
    const auto coarse = maps.at("EPSG:32611", {500000.0, 90.0, 0.0, 4000000.0, 0.0, -90.0});
    const auto fine = maps.at("EPSG:32611", kUtm);
    const auto also_fine = maps.at("EPSG:32611", kUtm);
    const auto other_zone = maps.at("EPSG:32612", {500000.0, 1.0, 0.0, 4000000.0, 0.0, -1.0});
    const auto names = [](const std::vector<const Layer*>& layers) {
        std::string text;
        for (const Layer* layer : layers) {
            text += layer->name;
        }
        return text;
    };
    Session session = with({other_zone, fine, also_fine, coarse}); // a, b, c, d
    EXPECT_EQ(names(shownLayers(session)), "dcb");
    EXPECT_EQ(names(layersOnBody(session)), "dcba");
    session = withOrder(session, LayerOrder::FinestFirst);
    EXPECT_EQ(names(shownLayers(session)), "cbd"); // the topmost one still decides on the CRS
    EXPECT_EQ(names(layersOnBody(session)), "acbd");
    session = withVisibility(session, session.layers[3].id, false);
    EXPECT_EQ(names(layersOnBody(session)), "cbd");
}

TEST(Placement, NeverDependsOnHiddenLayers)
{
    Maps maps;
    const std::vector datasets{maps.at("EPSG:32611", kUtm), maps.at("EPSG:32612", kUtm),
                               maps.at("IAU_2015:49900", kDegrees), maps.at("", kUtm)};
    test::Random random;
    for (int i = 0; i < 200; ++i) {
        Session session;
        for (int k = 0; k < 6; ++k) {
            session = added(session, {.map = datasets[random.below(datasets.size())]});
            if (random.chance(0.4)) {
                session = withVisibility(session, session.active, false);
            }
        }
        Session visible_only = session;
        for (const Layer& layer : session.layers) {
            if (!layer.is_visible) {
                visible_only = removed(visible_only, layer.id);
            }
        }
        std::vector<LayerId> all;
        for (const Layer* layer : shownLayers(session)) {
            all.push_back(layer->id);
        }
        std::vector<LayerId> few;
        for (const Layer* layer : shownLayers(visible_only)) {
            few.push_back(layer->id);
        }
        EXPECT_EQ(all, few);
    }
}

TEST(SameCrs, ComparesPositionsNotNames)
{
    Maps maps;
    const auto crs_of = [](const std::string& text) { return *Crs::fromText(text); };
    struct Pair {
        const char* a;
        const char* b;
        Terms terms;
        bool is_same;
    };
    const Terms meters{100000.0, 500.0, 0.0, 200000.0, 0.0, -500.0};
    for (const Pair& pair : std::vector<Pair>{
             {"EPSG:32611", "+proj=utm +zone=11 +datum=WGS84", kUtm, true},
             {"EPSG:32611", "EPSG:32612", kUtm, false},
             {"EPSG:32611", "+proj=utm +zone=11 +datum=WGS84 +units=ft", kUtm, false},
             {"+proj=eqc +R=3396190", "+proj=eqc +R=3396190 +lat_ts=0 +lon_0=0", meters, true},
             {"+proj=eqc +R=3396190", "+proj=eqc +R=3396000", meters, false},
             {"+proj=eqc +R=3396190", "+proj=eqc +R=3396190 +lon_0=180", meters, false},
             {"+proj=eqc +R=3396190", "+proj=sinu +R=3396190", meters, false},
             {"+proj=longlat +R=3396190", "+proj=longlat +R=3396000", kDegrees, true},
             // Planetocentric against planetographic: 10 km apart.
             {"IAU_2015:49901", "IAU_2015:49902", kDegrees, false},
             {"EPSG:4326", "+proj=utm +zone=33 +datum=WGS84", kDegrees, false},
         }) {
        const Georeference sample(100, 100, *GeoTransform::fromTerms(pair.terms), crs_of(pair.b));
        EXPECT_EQ(isSameCrs(crs_of(pair.a), crs_of(pair.b), sample), pair.is_same)
            << pair.a << " and " << pair.b;
    }
}

} // namespace
} // namespace marsview
