#include "core/vector/vector_file.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
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
    EXPECT_NE(other.error().message.find("is on the Moon, but the map is on Mars"),
              std::string::npos);
    EXPECT_TRUE(checkSameBody(path, file.content, std::nullopt, nullptr));
    EXPECT_TRUE(checkSameBody(path, FeatureCollection{}, mars, mars.body()));
}

// Points with a name, a height and a count, in a projected CRS.
FeatureCollection marks(const char* crs_text, FeatureShape shape)
{
    FeatureCollection content;
    content.crs = *Crs::fromText(crs_text);
    content.body = content.crs->body();
    FeatureLayer layer{.name = "marks",
                       .fields = {{"name", FieldType::Text},
                                  {"height", FieldType::Real},
                                  {"count", FieldType::Integer}},
                       .features = {}};
    const auto at = [&](double lon, double lat) {
        return *content.crs->toMap({Angle::degrees(lon), Angle::degrees(lat)});
    };
    for (int i = 0; i < 3; ++i) {
        const double lon = 77.25 + i;
        Feature feature{
            .shape = shape,
            .parts = {{.points = {at(lon, 18.5)}}},
            .values = {std::string("Jezero é ") + std::to_string(i), 0.1 * i, std::int64_t{7} - i}};
        if (shape != FeatureShape::Point) {
            feature.parts.front().points.push_back(at(lon + 0.5, 19.0));
            feature.parts.front().points.push_back(at(lon + 0.25, 20.0));
        }
        if (shape == FeatureShape::Polygon) {
            feature.parts.front().points.push_back(feature.parts.front().points.front());
            feature.parts.push_back({.points = {at(lon + 0.2, 18.9), at(lon + 0.3, 19.0),
                                                at(lon + 0.25, 19.2), at(lon + 0.2, 18.9)},
                                     .is_hole = true});
        }
        layer.features.push_back(feature);
    }
    content.layers.push_back(layer);
    return content;
}

void expectSamePlaces(const FeatureCollection& a, const FeatureCollection& b)
{
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t l = 0; l < a.layers.size(); ++l) {
        ASSERT_EQ(a.layers[l].features.size(), b.layers[l].features.size());
        for (std::size_t f = 0; f < a.layers[l].features.size(); ++f) {
            const Feature& x = a.layers[l].features[f];
            const Feature& y = b.layers[l].features[f];
            ASSERT_EQ(x.shape, y.shape);
            ASSERT_EQ(x.parts.size(), y.parts.size());
            for (std::size_t p = 0; p < x.parts.size(); ++p) {
                EXPECT_EQ(x.parts[p].is_hole, y.parts[p].is_hole);
                ASSERT_EQ(x.parts[p].points.size(), y.parts[p].points.size());
                // Formats turn rings the other way around.
                std::vector<MapPoint> points = y.parts[p].points;
                const auto distance = [&](const MapPoint& from, const MapPoint& to) {
                    const auto g = a.crs->toGeographic(from);
                    const auto h = b.crs->toGeographic(to);
                    return std::hypot(g->longitude.degrees() - h->longitude.degrees(),
                                      g->latitude.degrees() - h->latitude.degrees());
                };
                if (distance(x.parts[p].points[1 % points.size()], points[1 % points.size()]) >
                    1e-3) {
                    std::reverse(points.begin(), points.end());
                }
                for (std::size_t i = 0; i < points.size(); ++i) {
                    EXPECT_LT(distance(x.parts[p].points[i], points[i]), 1e-9);
                }
            }
        }
    }
}

TEST(VectorFile, KeepsPlacesBodyAndAttributesInEveryFormat)
{
    const TempFolder folder;
    JobMonitor monitor;
    for (const char* crs : {"IAU_2015:49910", "IAU_2015:30100", "EPSG:32643",
                            "+proj=stere +lat_0=90 +lon_0=20 +a=3396190 +b=3376200"}) {
        for (const FeatureShape shape :
             {FeatureShape::Point, FeatureShape::Line, FeatureShape::Polygon}) {
            const FeatureCollection content = marks(crs, shape);
            for (const char* name : {"m.gpkg", "m.geojson", "m.kml", "m.shp", "m.csv"}) {
                SCOPED_TRACE(std::string(crs) + " " + name);
                const std::string path = folder.file(name);
                const auto written = writeVectorFile(path, content, monitor);
                ASSERT_TRUE(written) << written.error().message;
                const VectorFile file = read(path);
                ASSERT_TRUE(file.content.crs);
                ASSERT_NE(file.content.body, nullptr);
                EXPECT_EQ(file.content.body->name, content.body->name);
                expectSamePlaces(content, file.content);
                ASSERT_EQ(file.content.layers.size(), 1U);
                const FeatureLayer& layer = file.content.layers.front();
                for (std::size_t i = 0; i < layer.fields.size(); ++i) {
                    if (layer.fields[i].name == "name" || layer.fields[i].name == "Name") {
                        EXPECT_EQ(std::get<std::string>(layer.features[1].values[i]), "Jezero é 1");
                    } else if (layer.fields[i].name == "height" &&
                               layer.fields[i].type == FieldType::Real) {
                        EXPECT_EQ(std::get<double>(layer.features[1].values[i]), 0.1);
                    } else if (layer.fields[i].name == "count" &&
                               layer.fields[i].type == FieldType::Integer) {
                        EXPECT_EQ(std::get<std::int64_t>(layer.features[1].values[i]), 6);
                    }
                }
                if (std::string(name) == "m.gpkg") {
                    EXPECT_EQ(layer.features, content.layers.front().features); // to the bit
                    EXPECT_EQ(file.content.crs->kind(), content.crs->kind());
                }
            }
        }
    }
    // Nothing is left of writing.
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().filename().string().substr(0, 2), "m.");
    }
}

TEST(VectorFile, KeepsTheOldFileWhenWritingFails)
{
    const TempFolder folder;
    JobMonitor monitor;
    const std::string path = folder.file("m.gpkg");
    ASSERT_TRUE(writeVectorFile(path, marks("IAU_2015:49900", FeatureShape::Point), monitor));
    const std::string before = readFile(path);
    JobMonitor canceled;
    canceled.cancel();
    const auto stopped =
        writeVectorFile(path, marks("IAU_2015:49900", FeatureShape::Line), canceled);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Canceled);
    EXPECT_EQ(readFile(path), before);
    EXPECT_FALSE(writeVectorFile("/no/such/folder/m.gpkg",
                                 marks("IAU_2015:49900", FeatureShape::Point), monitor));
}

TEST(VectorFile, RefusesWhatAFormatCannotHold)
{
    const TempFolder folder;
    JobMonitor monitor;
    const auto why = [&](const char* name, const FeatureCollection& content) {
        const auto written = writeVectorFile(folder.file(name), content, monitor);
        EXPECT_FALSE(std::filesystem::exists(folder.file(name)));
        return written ? std::string()
                       : written.error().message.substr(folder.file(name).size() + 2);
    };
    FeatureCollection mixed = marks("IAU_2015:49900", FeatureShape::Point);
    mixed.layers.front().features.push_back(
        marks("IAU_2015:49900", FeatureShape::Line).layers.front().features.front());
    EXPECT_EQ(
        why("a.shp", mixed),
        "a Shapefile holds points, lines or polygons, not several of them; choose GeoPackage");
    FeatureCollection two = marks("IAU_2015:49900", FeatureShape::Point);
    two.layers.push_back(two.layers.front());
    EXPECT_EQ(why("a.csv", two), "the format holds one layer, but there are 2; choose GeoPackage");
    EXPECT_EQ(why("a.kml", marks("IAU_2015:19900", FeatureShape::Point)),
              "KML cannot state the body Mercury; choose GeoPackage");
    FeatureCollection unknown;
    unknown.layers = marks("IAU_2015:49900", FeatureShape::Point).layers;
    EXPECT_EQ(why("a.geojson", unknown),
              "GeoJSON needs longitude and latitude, but the CRS is unknown; choose GeoPackage");
    EXPECT_EQ(why("a.dxf", unknown),
              "the name ends in none of .gpkg, .geojson, .kml, .shp and .csv; choose one of them");
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

TEST(VectorFile, IsToldApartFromAMap)
{
    const TempFolder folder;
    const std::string source = folder.write("s.csv", kShapes);
    for (const char* name : {"s.gpkg", "s.geojson"}) {
        const std::string path = folder.file(name);
        runTool({"ogr2ogr", "-nlt", "GEOMETRY", path, source});
        EXPECT_TRUE(isVectorFile(path)) << name;
    }
    EXPECT_FALSE(isVectorFile(source)) << "a CSV file may be a table of anything";
    const std::string raster = folder.file("r.gpkg");
    runTool({"gdal_translate", "-q", "-of", "GPKG", bundledMars(), raster});
    EXPECT_FALSE(isVectorFile(raster));
    EXPECT_FALSE(isVectorFile(bundledMars()));
    EXPECT_FALSE(isVectorFile(folder.file("none.shp")));
}

} // namespace marsview::test
