#include "core/vector/vector_file.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace marsview::test {
namespace {

VectorFile read(const std::string& path)
{
    JobMonitor monitor;
    Result<VectorFile> file = readVectorFile(path, monitor);
    EXPECT_TRUE(file) << (file ? "" : file.error().message);
    return file ? std::move(*file) : VectorFile{};
}

std::string refusal(const std::string& path)
{
    JobMonitor monitor;
    const Result<VectorFile> file = readVectorFile(path, monitor);
    return file ? std::string() : file.error().message;
}

constexpr const char* kShapes =
    "wkt,name,height,count\n"
    "\"POINT(10 20)\",Gale,1.5,3\n"
    "\"LINESTRING(10 20,11 21,12 20)\",Ares,,4\n"
    "\"POLYGON((0 0,10 0,10 10,0 0),(2 1,8 1,8 6,2 1))\",Hellas,-7.25,\n"
    "\"MULTIPOINT(1 2,3 4)\",Two,2,5\n";

} // namespace

TEST(VectorFile, ReadsWhatOgrWritesInEveryFormat)
{
    const TempFolder folder;
    const std::string source = folder.write("shapes.csv", kShapes);
    for (const char* name : {"shapes.gpkg", "shapes.geojson"}) {
        SCOPED_TRACE(name);
        const std::string path = folder.file(name);
        runTool({"ogr2ogr", "-a_srs", "IAU_2015:49900", "-oo", "AUTODETECT_TYPE=YES", "-oo",
                 "KEEP_GEOM_COLUMNS=NO", "-nlt", "GEOMETRY", path, source});
        const VectorFile file = read(path);
        ASSERT_NE(file.content.body, nullptr);
        EXPECT_EQ(file.content.body->name, "Mars");
        ASSERT_EQ(file.content.layers.size(), 1U);
        const FeatureLayer& layer = file.content.layers.front();
        ASSERT_EQ(layer.features.size(), 4U);
        ASSERT_EQ(layer.fields.size(), 3U);
        EXPECT_EQ(layer.fields[0].name, "name");
        EXPECT_EQ(layer.fields[1].type, FieldType::Real);
        EXPECT_EQ(layer.fields[2].type, FieldType::Integer);
        EXPECT_EQ(std::get<std::string>(layer.features[0].values[0]), "Gale");
        EXPECT_EQ(std::get<double>(layer.features[2].values[1]), -7.25);
        EXPECT_EQ(std::get<std::int64_t>(layer.features[3].values[2]), 5);
        EXPECT_TRUE(std::holds_alternative<std::monostate>(layer.features[1].values[1]));
        EXPECT_EQ(layer.features[0].shape, FeatureShape::Point);
        EXPECT_EQ(layer.features[1].parts[0].points,
                  (std::vector<MapPoint>{{10, 20}, {11, 21}, {12, 20}}));
        ASSERT_EQ(layer.features[2].parts.size(), 2U);
        EXPECT_FALSE(layer.features[2].parts[0].is_hole);
        EXPECT_TRUE(layer.features[2].parts[1].is_hole);
        EXPECT_EQ(layer.features[2].parts[1].points.size(), 4U);
        EXPECT_EQ(layer.features[3].parts[0].points, (std::vector<MapPoint>{{1, 2}, {3, 4}}));
    }
}

TEST(VectorFile, ReadsTablesOfPositions)
{
    const TempFolder folder;
    for (const char* header : {"lon,lat,name", "Longitude,Latitude,name", "x,y,name"}) {
        const VectorFile file =
            read(folder.write("p.csv", std::string(header) + "\n226.2,18.65,Olympus\n"));
        ASSERT_EQ(file.content.layers.size(), 1U);
        ASSERT_EQ(file.content.layers[0].features.size(), 1U) << header;
        EXPECT_EQ(file.content.layers[0].features[0].parts[0].points,
                  (std::vector<MapPoint>{{226.2, 18.65}}));
        EXPECT_FALSE(file.content.crs);
        EXPECT_EQ(file.content.body, nullptr);
    }
}

TEST(VectorFile, ReadsTheBodyOfKmlFromItsHint)
{
    const TempFolder folder;
    const auto kml = [&](const std::string& attributes) {
        return folder.write(
            "p.kml", "<?xml version=\"1.0\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\"" +
                         attributes +
                         "><Document><Placemark><name>a</name><Point><coordinates>137.4,-4.6,0</"
                         "coordinates></Point></Placemark></Document></kml>\n");
    };
    EXPECT_EQ(read(kml("")).content.body->name, "Earth");
    EXPECT_EQ(read(kml(" hint=\"target=moon\"")).content.body->name, "Moon");
    const VectorFile mars = read(kml(" hint=\"target=mars\""));
    EXPECT_EQ(mars.content.body->name, "Mars");
    EXPECT_EQ(mars.content.layers[0].features[0].parts[0].points,
              (std::vector<MapPoint>{{137.4, -4.6}}));
    EXPECT_NE(refusal(kml(" hint=\"target=sky\"")), "");
}

TEST(VectorFile, IsRefusedOnAnotherBody)
{
    const TempFolder folder;
    const std::string path = folder.file("moon.gpkg");
    runTool({"ogr2ogr", "-a_srs", "IAU_2015:30100", "-nlt", "GEOMETRY", path,
             folder.write("s.csv", kShapes)});
    const VectorFile file = read(path);
    const Crs moon = *Crs::fromText("IAU_2015:30100");
    const Crs mars = *Crs::fromText("IAU_2015:49910");
    EXPECT_TRUE(checkSameBody(path, file.content, moon, moon.body()));
    const Status other = checkSameBody(path, file.content, mars, mars.body());
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().message.find("is on Moon, but the map is on Mars"), std::string::npos);
    EXPECT_TRUE(checkSameBody(path, file.content, std::nullopt, nullptr));
    EXPECT_TRUE(checkSameBody(path, FeatureCollection{}, mars, mars.body()));
}

TEST(VectorFile, RefusesWhatIsNotAVectorFile)
{
    const TempFolder folder;
    EXPECT_EQ(refusal("/no/such.gpkg"), "/no/such.gpkg: does not exist");
    EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is not a regular file; choose a vector file");
    EXPECT_NE(refusal(folder.write("a.txt", "hello\n")).find("choose a GeoPackage"),
              std::string::npos);
    const std::string whole = folder.file("s.geojson");
    runTool({"ogr2ogr", "-nlt", "GEOMETRY", whole, folder.write("s.csv", kShapes)});
    const std::string text = readFile(whole);
    EXPECT_NE(refusal(folder.write("cut.geojson", text.substr(0, text.size() / 2))), "");
}

} // namespace marsview::test
