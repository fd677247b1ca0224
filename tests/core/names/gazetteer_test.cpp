#include "core/names/gazetteer.h"
#include "core/names/names_file.h"
#include "core/names/search_text.h"
#include "tests/support/nomenclature.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

std::shared_ptr<const Gazetteer> bundled(const char* body)
{
    return bundledGazetteer(*bodyNamed(body));
}

std::vector<std::string> found(const Gazetteer& gazetteer, const char* text, std::size_t count)
{
    std::vector<std::string> names;
    for (const std::size_t index : gazetteer.find(text, count)) {
        names.push_back(gazetteer.names()[index].name);
    }
    return names;
}

std::shared_ptr<const Gazetteer> read(const std::string& path, const Body* body)
{
    JobMonitor monitor;
    auto gazetteer = readGazetteer(path, body, monitor);
    EXPECT_TRUE(gazetteer) << (gazetteer ? "" : gazetteer.error().message);
    return gazetteer ? *gazetteer : nullptr;
}

std::string refusal(const std::string& path, const Body* body)
{
    JobMonitor monitor;
    const auto gazetteer = readGazetteer(path, body, monitor);
    return gazetteer ? std::string() : gazetteer.error().message;
}

using Names = std::vector<std::string>;

} // namespace

TEST(SearchText, IgnoresCaseDiacriticsAndHyphens)
{
    for (const auto& [text, expected] :
         std::vector<std::pair<const char*, const char*>>{{"Olympus Mons", "olympus mons"},
                                                          {"Bečvář D", "becvar d"},
                                                          {"Cerberus Rupēs", "cerberus rupes"},
                                                          {"Østrem", "ostrem"},
                                                          {"Łódź", "lodz"},
                                                          {"Weiß", "weiss"},
                                                          {"Hess-Apollo", "hess apollo"},
                                                          {"  D'Alembert  ", "d alembert"},
                                                          {"ÅNGSTRÖM", "angstrom"},
                                                          {"Гагарин", "gagarin"},
                                                          {"", ""}}) {
        EXPECT_EQ(searchText(text), expected) << text;
    }
}

TEST(Gazetteer, HasEveryApprovedNameOfMarsAtItsPlace)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto mars = bundled("Mars");
    ASSERT_TRUE(mars);
    EXPECT_EQ(mars->names().size(), 1791U);
    for (const char* name : {"Olympus Mons", "Gale", "Valles Marineris", "Hellas Planitia"}) {
        const NamedFeature feature = marsFeature(name);
        const auto match = mars->find(name, 1);
        ASSERT_EQ(match.size(), 1U) << name;
        const PlaceName& place = mars->names()[match.front()];
        EXPECT_EQ(place.name, name);
        EXPECT_DOUBLE_EQ(place.position.latitude.degrees(), feature.latitude_deg);
        EXPECT_DOUBLE_EQ(place.position.longitude.degrees(), feature.east_longitude_deg);
        EXPECT_DOUBLE_EQ(place.diameter_m, 1000.0 * feature.diameter_km);
    }
}

TEST(Gazetteer, FindsNamesWithoutDiacriticsAndByTheirBeginning)
{
    const auto mars = bundled("Mars");
    const auto moon = bundled("Moon");
    ASSERT_TRUE(mars && moon);
    EXPECT_EQ(moon->names().size(), 9007U);
    EXPECT_EQ(found(*moon, "becvar", 2), (Names{"Bečvář", "Bečvář J"}));
    EXPECT_EQ(found(*moon, "ANGSTROM", 1), (Names{"Angström"}));
    EXPECT_EQ(found(*mars, "olymp", 3), (Names{"Olympia Planum", "Olympus Mons", "Olympus Rupes"}));
    // The whole name comes before larger features that begin with it.
    EXPECT_EQ(found(*mars, "gale", 1), (Names{"Gale"}));
    EXPECT_EQ(found(*moon, "tycho", 2).front(), "Tycho");
    EXPECT_EQ(found(*mars, "arineri", 1), (Names{"Valles Marineris"}));
    EXPECT_TRUE(found(*mars, "xyzzy", 5).empty());
    EXPECT_TRUE(found(*mars, " - ", 5).empty());
    EXPECT_EQ(mars->nearest("olimpus mons"), "Olympus Mons");
    EXPECT_FALSE(bundled("Venus"));
}

TEST(Gazetteer, ListsTheLargestFirstAndLetteredCratersAsSuch)
{
    const auto moon = bundled("Moon");
    ASSERT_TRUE(moon);
    EXPECT_EQ(moon->names().front().name, "Oceanus Procellarum");
    EXPECT_TRUE(std::is_sorted(
        moon->names().begin(), moon->names().end(),
        [](const PlaceName& a, const PlaceName& b) { return a.diameter_m > b.diameter_m; }));
    EXPECT_EQ(std::count_if(moon->names().begin(), moon->names().end(),
                            [](const PlaceName& n) { return n.kind == PlaceKind::LetteredCrater; }),
              7055);
    EXPECT_EQ(kindOfName("Olympus Mons"), PlaceKind::Mountain);
    EXPECT_EQ(kindOfName("Mare Imbrium"), PlaceKind::Sea);
    EXPECT_EQ(kindOfName("Abbe H"), PlaceKind::LetteredCrater);
    EXPECT_EQ(kindOfName("Abbe"), PlaceKind::Other);
    EXPECT_EQ(kindOfName("X"), PlaceKind::Other);
    EXPECT_EQ(kindOfName(""), PlaceKind::Other);
}

TEST(NamesFile, ReadsTheGazetteersOwnColumnsAndPlainCsv)
{
    const TempFolder folder;
    const Body* const earth = bodyNamed("Earth");
    const auto plain = read(folder.write("peaks.csv",
                                         "name,lon,lat,diameter\n"
                                         "Säntis,9.3433,47.2494,\n"
                                         "Mont Blanc,6.8652,45.8326,2.5\n"),
                            earth);
    ASSERT_TRUE(plain);
    ASSERT_EQ(plain->names().size(), 2U);
    EXPECT_EQ(plain->body(), earth);
    EXPECT_EQ(plain->names()[0].name, "Mont Blanc");
    EXPECT_DOUBLE_EQ(plain->names()[0].diameter_m, 2500.0);
    EXPECT_EQ(found(*plain, "santis", 1), (Names{"Säntis"}));
    // Latitudes of a file on the Earth are geodetic.
    EXPECT_NEAR(earth->ellipsoid.planetographic(plain->names()[1].position.latitude).degrees(),
                47.2494, 1e-12);

    const auto exported = read(folder.write("moon.csv",
                                            "Feature_Name,Target,Diameter,Latitude,Longitude\n"
                                            "\"Abbe\",\"Moon\",63.98,-57.58,174.77\n"),
                               bodyNamed("Moon"));
    ASSERT_TRUE(exported);
    EXPECT_EQ(exported->names()[0].name, "Abbe");
    EXPECT_DOUBLE_EQ(exported->names()[0].diameter_m, 63980.0);
    EXPECT_DOUBLE_EQ(exported->names()[0].position.latitude.degrees(), -57.58);
}

TEST(NamesFile, RefusesFilesWithoutNamesOrPlaces)
{
    const TempFolder folder;
    const Body* const mars = bodyNamed("Mars");
    EXPECT_NE(refusal(folder.write("a.csv", "name,lon,lat\n,1,2\n"), mars).find("has no names"),
              std::string::npos);
    EXPECT_NE(
        refusal(folder.write("b.csv", "name,kind\nGale,crater\n"), mars).find("has no points"),
        std::string::npos);
    EXPECT_NE(refusal(folder.write("c.csv", "name,x,y\nGale,562000,5117000\n"), mars)
                  .find("is not a longitude and latitude"),
              std::string::npos);
    EXPECT_NE(refusal(folder.file("none.csv"), mars).find("does not exist"), std::string::npos);
}

} // namespace marsview::test
