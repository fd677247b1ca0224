#include "core/session/open_map.h"
#include "core/session/project.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/types.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;

using test::Random;
using test::TempFolder;
using testing::HasSubstr;
using testing::Not;

// Letters of several alphabets, and what JSON must escape.
std::string randomText(Random& random)
{
    static const std::array<std::string, 12> kParts{"a",  "B7", " ", "\"", "\\", "é",
                                                    "火", "🌋",  "&", "\n", "-",  "x.tif"};
    std::string text;
    for (std::size_t left = random.below(8) + 1; left > 0; --left) {
        text += kParts[random.below(kParts.size())];
    }
    return text;
}

double randomNumber(Random& random)
{
    switch (random.below(5)) {
    case 0:
        return 0.0;
    case 1:
        return std::floor(random.uniform(-1e6, 1e6));
    case 2:
        return random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-300.0, 300.0));
    case 3:
        return -0.0;
    default:
        return random.uniform(-1e7, 1e7);
    }
}

// The program makes angles from degrees.
Angle randomAngle(Random& random, double low, double high)
{
    const double degrees = random.uniform(low, high);
    return Angle::degrees(random.chance(0.5) ? std::round(degrees * 10.0) / 10.0 : degrees);
}

std::string randomPath(Random& random)
{
    static const std::vector<std::string> kNames{
        "https://example.org/a.tif", "s3://bucket/b.tif", "NETCDF:\"/data/x.nc\":z",
        "/vsizip//data/x.zip/a.tif", "vrt://a?bands=1",
    };
    static const std::vector<std::string> kFolders{"/home/anna/mars/",
                                                   "/home/anna/mars/dems/deep/",
                                                   "/home/anna/dems/",
                                                   "/srv/archive/",
                                                   "/home/anna/marsfield/",
                                                   "/bundle/samples/",
                                                   "/"};
    if (random.chance(0.2)) {
        return kNames[random.below(kNames.size())];
    }
    std::string name = randomText(random);
    std::replace(name.begin(), name.end(), '\n', '_');
    return kFolders[random.below(kFolders.size())] + name + ".tif";
}

LayerRecord randomLayer(Random& random)
{
    LayerRecord layer;
    layer.spec.path = randomPath(random);
    layer.spec.band = static_cast<int>(random.below(5)) + 1;
    layer.name = randomText(random);
    layer.is_visible = random.chance(0.5);
    layer.ramp = random.chance(0.5) ? "" : randomText(random);
    layer.exaggeration = random.uniform(1e-6, 1e3);
    layer.stretch.kind = static_cast<StretchKind>(random.below(4));
    layer.stretch.cut_percent = random.uniform(0.0, kStretchCutMax);
    if (layer.stretch.kind == StretchKind::Fixed || random.chance(0.3)) {
        layer.stretch.low = random.uniform(-9000.0, 0.0);
        layer.stretch.high = random.uniform(1.0, 22000.0);
    }
    if (random.chance(0.4)) {
        layer.feather_cells = 1 + random.below(kFeatherCellsMax);
        layer.slope_range = SlopeRange{.minimum = randomAngle(random, 0.0, 20.0),
                                       .maximum = randomAngle(random, 21.0, 90.0)};
    }
    RasterOverrides& overrides = layer.spec.overrides;
    const auto maybe_number = [&random](std::optional<double>& value) {
        if (random.chance(0.3)) {
            value =
                random.chance(0.1) ? std::numeric_limits<double>::infinity() : randomNumber(random);
        }
    };
    const auto maybe_text = [&random](std::optional<std::string>& value) {
        if (random.chance(0.3)) {
            value = randomText(random);
        }
    };
    maybe_text(overrides.crs);
    maybe_text(overrides.body);
    maybe_text(overrides.vertical_unit);
    maybe_text(overrides.vertical_datum);
    maybe_number(overrides.scale);
    maybe_number(overrides.offset);
    maybe_number(overrides.nodata);
    if (random.chance(0.3)) {
        overrides.ellipsoid = Ellipsoid{random.uniform(1e5, 1e8), random.uniform(1e5, 1e8)};
    }
    if (random.chance(0.3)) {
        GeoTransform::Terms terms{};
        for (double& term : terms) {
            term = randomNumber(random);
        }
        overrides.transform = terms;
    }
    return layer;
}

ProjectMeasurement randomMeasurement(Random& random, std::size_t layer_count)
{
    ProjectMeasurement measurement;
    measurement.kind = static_cast<MeasurementKind>(random.below(6));
    measurement.name = randomText(random);
    if (layer_count > 0 && random.chance(0.9)) {
        measurement.layer = random.below(layer_count);
    }
    // Between the years 1970 and 2100.
    measurement.time = DrawnTime(std::chrono::milliseconds(random.below(4'102'444'800'000)));
    if (random.chance(0.5)) {
        measurement.note = randomText(random);
        measurement.color = Rgb8{static_cast<std::uint8_t>(random.below(256)), 0, 255};
    }
    const bool is_on_body = random.chance(0.7);
    for (std::size_t left = random.below(6); left > 0; --left) {
        if (is_on_body) {
            measurement.vertices.emplace_back(
                GeographicPoint{.longitude = randomAngle(random, -400.0, 400.0),
                                .latitude = randomAngle(random, -90.0, 90.0)});
        } else {
            measurement.vertices.emplace_back(MapPoint{randomNumber(random), randomNumber(random)});
        }
    }
    return measurement;
}

ProjectAnnotation randomAnnotation(Random& random, std::size_t layer_count)
{
    const ProjectMeasurement like = randomMeasurement(random, layer_count);
    ProjectAnnotation drawn{.annotation = {.shape = static_cast<FeatureShape>(random.below(3)),
                                           .name = like.name,
                                           .note = like.note,
                                           .color = like.color,
                                           .time = like.time},
                            .layer = like.layer};
    Annotation& annotation = drawn.annotation;
    const std::size_t needed = verticesNeeded(annotation.shape);
    const bool is_point = annotation.shape == FeatureShape::Point;
    if (is_point) {
        annotation.symbol = kMarkSymbols.at(random.below(kMarkSymbols.size()));
    }
    const bool is_on_body = random.chance(0.7);
    for (std::size_t left = is_point ? 1 : needed + random.below(4); left > 0; --left) {
        annotation.vertices.emplace_back(
            is_on_body
                ? DrawnVertex(GeographicPoint{.longitude = randomAngle(random, -400.0, 400.0),
                                              .latitude = randomAngle(random, -90.0, 90.0)})
                : DrawnVertex(MapPoint{randomNumber(random), randomNumber(random)}));
    }
    if (is_on_body) {
        annotation.body = {.name = random.chance(0.7) ? "Mars" : randomText(random),
                           .ellipsoid =
                               Ellipsoid{random.uniform(1.0, 1e8), random.uniform(1.0, 1e8)}};
    }
    return drawn;
}

ProjectView randomView(Random& random, std::size_t layer_count)
{
    ProjectView view;
    view.name = randomText(random);
    if (layer_count > 0 && random.chance(0.9)) {
        view.layer = random.below(layer_count);
    }
    if (random.chance(0.7)) {
        view.body = randomText(random);
        view.camera.target = GeographicPoint{.longitude = randomAngle(random, -400.0, 400.0),
                                             .latitude = randomAngle(random, -90.0, 90.0)};
    } else {
        view.camera.target = MapPoint{randomNumber(random), randomNumber(random)};
    }
    view.camera.elevation_m = randomNumber(random);
    view.camera.distance_m = random.uniform(1e-3, 1e9);
    view.camera.azimuth = randomAngle(random, -180.0, 180.0);
    view.camera.tilt = randomAngle(random, 0.0, 89.0);
    view.camera.field_of_view = randomAngle(random, 10.0, 80.0);
    view.exaggeration = random.uniform(1e-3, 1e3);
    view.is_on_globe = random.chance(0.3);
    return view;
}

Project randomProject(Random& random)
{
    Project project;
    for (std::size_t left = random.below(7); left > 0; --left) {
        project.layers.push_back(randomLayer(random));
    }
    if (!project.layers.empty() && random.chance(0.9)) {
        project.active = random.below(project.layers.size());
    }
    project.look.mode = static_cast<ShadingMode>(random.below(3));
    project.look.has_contours = random.chance(0.5);
    project.look.contour_interval_m = random.chance(0.5) ? 0.0 : random.uniform(0.1, 1e4);
    project.look.light_azimuth = randomAngle(random, -360.0, 720.0);
    project.look.light_altitude = randomAngle(random, 0.0, 90.0);
    project.look.light_frame = static_cast<LightFrame>(random.below(2));
    if (random.chance(0.5)) {
        project.look.subsolar = GeographicPoint{.longitude = randomAngle(random, -400.0, 400.0),
                                                .latitude = randomAngle(random, -90.0, 90.0)};
    }
    if (random.chance(0.7)) {
        project.camera = ProjectCamera{.x = randomNumber(random),
                                       .y = randomNumber(random),
                                       .elevation_m = randomNumber(random),
                                       .distance_m = random.uniform(1e-3, 1e9),
                                       .azimuth = randomAngle(random, -180.0, 180.0),
                                       .tilt = randomAngle(random, 0.0, 89.0),
                                       .field_of_view = randomAngle(random, 10.0, 80.0)};
    }
    project.scene = static_cast<SceneChoice>(random.below(3));
    project.order = static_cast<LayerOrder>(random.below(2));
    if (random.chance(0.5)) {
        project.globe_camera = randomView(random, 0).camera;
    }
    for (std::size_t left = random.below(3); left > 0; --left) {
        project.overlays.push_back({.path = randomPath(random),
                                    .color = {static_cast<std::uint8_t>(random.below(256)),
                                              static_cast<std::uint8_t>(random.below(256)),
                                              static_cast<std::uint8_t>(random.below(256))},
                                    .is_visible = random.chance(0.5),
                                    .crs = random.chance(0.5) ? randomText(random) : ""});
    }
    for (std::size_t left = random.below(5); left > 0; --left) {
        project.views.push_back(randomView(random, project.layers.size()));
    }
    for (std::size_t left = random.below(5); left > 0; --left) {
        project.measurements.push_back(randomMeasurement(random, project.layers.size()));
    }
    for (std::size_t left = random.below(5); left > 0; --left) {
        project.annotations.push_back(randomAnnotation(random, project.layers.size()));
    }
    if (random.chance(0.3)) {
        project.others["future"] = R"([{"name":"Tharsis"},3.25])";
    }
    return project;
}

const ProjectFolders kFolders{.project = "/home/anna/mars", .bundled = "/bundle/samples"};

Project smallProject(const std::string& dem)
{
    Project project;
    project.layers.push_back({.spec = {.path = dem}, .name = "Dem", .exaggeration = 2.0});
    return project;
}

std::string text(const Project& project, const ProjectFolders& folders = kFolders)
{
    const auto text = projectText(project, folders);
    EXPECT_TRUE(text) << (text ? "" : text.error().message);
    return text ? *text : "";
}

} // namespace

TEST(Project, ThousandRandomSessionsSavedAndOpenedAreEqual)
{
    Random random;
    const TempFolder folder;
    int layer_count = 0;
    int measurement_count = 0;
    int view_count = 0;
    int annotation_count = 0;
    for (int i = 0; i < 1000; ++i) {
        const Project project = randomProject(random);
        layer_count += static_cast<int>(project.layers.size());
        const auto again = projectFrom(text(project), kFolders, "a.mvproj");
        if (i % 20 == 0) { // the layout of the document as a whole
            EXPECT_EQ(nlohmann::ordered_json::parse(text(project)).dump(2) + "\n", text(project));
        }
        ASSERT_TRUE(again) << again.error().message;
        ASSERT_EQ(*again, project) << text(project) << "\n" << text(*again);
        measurement_count += static_cast<int>(project.measurements.size());
        view_count += static_cast<int>(project.views.size());
        annotation_count += static_cast<int>(project.annotations.size());
        const fs::path file = folder.path() / "a.mvproj";
        ASSERT_TRUE(writeProject(project, file, kFolders.bundled));
        const auto read = readProject(file, kFolders.bundled);
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ(*read, project);
    }
    EXPECT_GT(layer_count, 2000);
    EXPECT_GT(measurement_count, 1500);
    EXPECT_GT(view_count, 1500);
    EXPECT_GT(annotation_count, 1500);
}

TEST(Project, AnglesOfAnyRadiansKeepAllButTheLastPlace)
{
    Random random;
    double worst = 0.0;
    for (int i = 0; i < 10000; ++i) {
        Project project;
        project.look.light_azimuth = Angle::radians(random.uniform(-7.0, 7.0));
        const auto again = projectFrom(text(project), kFolders, "a.mvproj");
        ASSERT_TRUE(again);
        const double radians = project.look.light_azimuth.radians();
        const double step = std::nextafter(std::abs(radians), 10.0) - std::abs(radians);
        worst = std::max(worst, std::abs(again->look.light_azimuth.radians() - radians) / step);
        // What was read once does not change any more.
        ASSERT_EQ(text(*again), text(project));
    }
    EXPECT_LE(worst, 1.0);
}

TEST(Project, NodataThatIsNotANumberIsKept)
{
    Project project = smallProject("/home/anna/mars/a.tif");
    project.layers.front().spec.overrides.nodata = std::numeric_limits<double>::quiet_NaN();
    const auto again = projectFrom(text(project), kFolders, "a.mvproj");
    ASSERT_TRUE(again);
    ASSERT_TRUE(again->layers.front().spec.overrides.nodata);
    EXPECT_TRUE(std::isnan(*again->layers.front().spec.overrides.nodata));
}

TEST(Project, PathsAreRelativeBelowAndBesideTheProjectOnly)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"/home/anna/mars/a.tif", R"("file": "a.tif")"},
        {"/home/anna/mars/dems/a.tif", R"("file": "dems/a.tif")"},
        {"/home/anna/dems/a.tif", R"("file": "../dems/a.tif")"},
        {"/home/anna/marsfield/a.tif", R"("file": "../marsfield/a.tif")"},
        {"/home/bert/a.tif", R"("file": "/home/bert/a.tif")"},
        {"/bundle/samples/mars.tif", R"("bundled": "mars.tif")"},
        {"https://example.org/a.tif", R"("dataset": "https://example.org/a.tif")"},
    };
    for (const auto& [path, line] : cases) {
        EXPECT_THAT(text(smallProject(path)), HasSubstr(line));
    }
    const ProjectFolders top{.project = "/mars", .bundled = {}};
    EXPECT_THAT(text(smallProject("/srv/a.tif"), top), HasSubstr(R"("file": "/srv/a.tif")"));
}

TEST(Project, OpensAfterItMovedWithItsData)
{
    const TempFolder folder;
    fs::create_directories(folder.path() / "here/dems");
    const std::string dem = folder.file("here/dems/a.tif");
    ASSERT_TRUE(writeProject(smallProject(dem), folder.path() / "here/p.mvproj", {}));
    fs::rename(folder.path() / "here", folder.path() / "there");
    const auto project = readProject(folder.path() / "there/p.mvproj", {});
    ASSERT_TRUE(project) << project.error().message;
    EXPECT_EQ(project->layers.front().spec.path, folder.file("there/dems/a.tif"));
}

TEST(Project, OneChangeIsOneChangedLine)
{
    Random random;
    Project project = randomProject(random);
    while (project.layers.size() < 2) {
        project = randomProject(random);
    }
    const auto lines = [](const std::string& text) {
        std::vector<std::string> found(1);
        for (const char c : text) {
            c == '\n' ? found.emplace_back() : found.back().append(1, c);
        }
        return found;
    };
    const auto before = lines(text(project));
    project.layers[1].exaggeration += 1.0;
    const auto after = lines(text(project));
    ASSERT_EQ(before.size(), after.size());
    int changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        changed += before[i] != after[i] ? 1 : 0;
    }
    EXPECT_EQ(changed, 1);
}

TEST(Project, LightIsThatOfTheViewUnlessItIsFixedOnTheBody)
{
    const auto look = [](const std::string& members) {
        return projectFrom(R"({"format":"MarsView project","version":1,"layers":[],"look":{)" +
                               members + "}}",
                           kFolders, "a.mvproj")
            ->look;
    };
    EXPECT_EQ(look(R"("light_azimuth_deg":315.0,"light_altitude_deg":45.0)"), TerrainLook{});
    TerrainLook lit;
    lit.light_frame = LightFrame::Body;
    lit.subsolar =
        GeographicPoint{.longitude = Angle::degrees(226.2), .latitude = Angle::degrees(18.65)};
    EXPECT_EQ(look(R"("light":"fixed on the body","subsolar_longitude_deg":226.2,)"
                   R"("subsolar_latitude_deg":18.65)"),
              lit);
    // Files of the light of the view stay as they were.
    EXPECT_EQ(text(Project{}).find("subsolar"), std::string::npos);
    EXPECT_EQ(text(Project{}).find("\"light\""), std::string::npos);
}

TEST(Project, NewerVersionIsRefusedInOneSentence)
{
    auto json = nlohmann::ordered_json::parse(text(smallProject("/a.tif")));
    json["version"] = kProjectVersion + 1;
    json["layers"] = "of another kind";
    const auto project = projectFrom(json.dump(), kFolders, "a.mvproj");
    ASSERT_FALSE(project);
    EXPECT_EQ(project.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(project.error().message,
              "a.mvproj: saved by a newer version of MarsView: the project has format version 2, "
              "this program reads up to 1; update MarsView");
}

TEST(Project, EveryTruncationIsRefusedInOneSentence)
{
    const std::string whole = text(smallProject("/a.tif"));
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
        const auto project = projectFrom(whole.substr(0, length), kFolders, "a.mvproj");
        ASSERT_FALSE(project) << length;
        EXPECT_THAT(project.error().message, testing::StartsWith("a.mvproj: "));
        EXPECT_THAT(project.error().message, Not(HasSubstr("\n")));
    }
}

TEST(Project, EveryChangedByteIsReadOrRefused)
{
    Random random;
    const std::string whole = text(randomProject(random));
    int refused_count = 0;
    for (int i = 0; i < 5000; ++i) {
        std::string damaged = whole;
        damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
        const auto project = projectFrom(damaged, kFolders, "a.mvproj");
        if (!project) {
            ++refused_count;
            ASSERT_THAT(project.error().message, testing::StartsWith("a.mvproj: "));
        } else {
            ASSERT_TRUE(projectText(*project, kFolders));
        }
    }
    EXPECT_GT(refused_count, 500);
}

TEST(Project, FaultsAreNamed)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"("version":1,"layers":[{"file":"a","exaggeration":"x"}])",
         "layers[0].exaggeration is not a factor"},
        {R"("version":1,"layers":[{"file":"a"},{}])", "layers[1].file is not the path of a file"},
        {R"("version":1,"layers":[7])", "layers[0] is not an object"},
        {R"("version":1,"layers":[],"active":0)", "active is not the index of a layer"},
        {R"("version":1,"layers":[{"file":"a","band":0}])",
         "layers[0].band is not a whole number from 1 up"},
        {R"("version":1,"layers":[{"file":"a","feather_cells":201}])",
         "layers[0].feather_cells is not a whole number up to 200"},
        {R"("version":1,"layers":[],"camera":{"distance_m":0})",
         "camera.distance_m is not a length above 0"},
        {R"("version":1,"layers":[],"look":{"light":"lamp"})", "look.light is not a known choice"},
        {R"("version":1,"layers":[],"look":{"subsolar_latitude_deg":91})",
         "look.subsolar_latitude_deg is not a latitude from -90 to 90"},
        {R"("version":1,"layers":[{"file":"a","stretch":{"kind":"best"}}])",
         "layers[0].stretch.kind is not a known choice"},
        {R"("version":1,"layers":[{"file":"a","overrides":{"geotransform":[1,2]}}])",
         "layers[0].overrides.geotransform is not a list of six numbers"},
        {R"("version":1,"layers":[],"measurements":[{"layer":0}])",
         "measurements[0].layer is not the index of a layer"},
        {R"("version":1,"layers":[],"views":[{"distance_m":-1}])",
         "views[0].distance_m is not a length above 0"},
        {R"("version":1,"layers":[],"views":[{"latitude_deg":91}])",
         "views[0].latitude_deg is not an angle from -90 to 90"},
        {R"("version":1,"layers":[],"views":[{"layer":0}])",
         "views[0].layer is not the index of a layer"},
        {R"("version":1,"layers":[],"overlays":[{"file":"a","color":"red"}])",
         "overlays[0].color is not a color such as #ffdd40"},
        {R"("version":1,"layers":[],"overlays":[{"color":"#ffffff"}])",
         "overlays[0].file is not the path of a file"},
        {R"("version":1,"layers":[],"measurements":[{"color":"#12345"}])",
         "measurements[0].color is not a color such as #ffdd40"},
        {R"("version":1,"layers":[],"measurements":[{"kind":"weight"}])",
         "measurements[0].kind is not a known choice"},
        {R"("version":1,"layers":[],"measurements":[{"time":"noon"}])",
         "measurements[0].time is not a time such as 2026-05-17T09:30:00Z"},
        {R"("version":1,"layers":[],"measurements":[{"time":"2026-02-30T09:30:00Z"}])",
         "measurements[0].time is not a time"},
        {R"("version":1,"layers":[],"measurements":[{"longitudes_latitudes_deg":[[0,91]]}])",
         "measurements[0].longitudes_latitudes_deg is not a list of longitudes and latitudes"},
        {R"("version":1,"layers":[],"measurements":[{"map_points":[[0,"a"]]}])",
         "measurements[0].map_points is not a list of pairs of numbers"},
        {R"("version":1,"layers":[],"annotations":[{"shape":"line","map_points":[[0,0]]}])",
         "annotations[0].shape is not possible with so few or so many positions"},
        {R"("version":1,"layers":[],"annotations":[{"map_points":[[0,0]],"symbol":"rose"}])",
         "annotations[0].symbol is not a known symbol"},
        {R"("version":1,"layers":[],"annotations":[{"longitudes_latitudes_deg":[[0,0]]}])",
         "annotations[0].body is not a known body, and its radii are not stated"},
        {R"("version":1,"layers":[],"annotations":[{"map_points":[[0,0]],"layer":0}])",
         "annotations[0].layer is not the index of a layer"},
        {R"("version":0,"layers":[])", "version is not a whole number from 1 up"},
        {R"("version":1)", "the list of layers is missing"},
    };
    for (const auto& [members, fault] : cases) {
        const auto project =
            projectFrom(R"({"format":"MarsView project",)" + members + "}", kFolders, "a.mvproj");
        ASSERT_FALSE(project) << members;
        EXPECT_EQ(project.error().code, ErrorCode::Damaged);
        EXPECT_THAT(project.error().message, HasSubstr("damaged project: " + fault));
    }
}

TEST(Project, OtherFilesAreNotProjects)
{
    const TempFolder folder;
    for (const std::string content : {"", "{}", "[1,2]", "II*", R"({"format":"QGIS"})"}) {
        const auto project = readProject(folder.write("a.mvproj", content), {});
        ASSERT_FALSE(project) << content;
        EXPECT_THAT(project.error().message, HasSubstr("not a MarsView project"));
    }
    EXPECT_EQ(readProject(folder.file("none.mvproj"), {}).error().code, ErrorCode::NotFound);
}

// The writer reports each save that has returned; after the kill the file holds that save or a
// later one.
TEST(Project, TwoHundredKillsDuringSaveLoseNothing)
{
    Random random;
    const TempFolder folder;
    const fs::path file = folder.path() / "a.mvproj";
    Project project;
    for (int i = 0; i < 40; ++i) {
        project.layers.push_back(randomLayer(random));
    }
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_TRUE(writeProject(project, file, {}));
    const auto save = std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::steady_clock::now() - begin);
    const auto delay_max = static_cast<std::size_t>(std::max<long>(4000, 2 * save.count()));
    double last_saved = 0.0;
    int kills_within_save = 0;
    for (int kill_count = 0; kill_count < 200; ++kill_count) {
        std::array<int, 2> ends{};
        ASSERT_EQ(pipe(ends.data()), 0);
        const auto delay = std::chrono::microseconds(random.below(delay_max));
        const pid_t writer = fork();
        ASSERT_GE(writer, 0);
        if (writer == 0) {
            close(ends[0]);
            for (double serial = last_saved + 1.0;; serial += 1.0) {
                project.look.contour_interval_m = serial;
                if (!writeProject(project, file, {}) ||
                    write(ends[1], &serial, sizeof(serial)) != sizeof(serial)) {
                    _exit(1);
                }
            }
        }
        close(ends[1]);
        double saved = 0.0;
        ASSERT_EQ(read(ends[0], &saved, sizeof(saved)), ssize_t{sizeof(saved)});
        std::this_thread::sleep_for(delay); // until a random moment of a save
        ASSERT_EQ(kill(writer, SIGKILL), 0);
        int status = 0;
        ASSERT_EQ(waitpid(writer, &status, 0), writer);
        ASSERT_TRUE(WIFSIGNALED(status));
        while (read(ends[0], &saved, sizeof(saved)) == ssize_t{sizeof(saved)}) {
        }
        close(ends[0]);
        const auto found = readProject(file, {});
        ASSERT_TRUE(found) << found.error().message;
        ASSERT_GE(found->look.contour_interval_m, saved);
        ASSERT_LE(found->look.contour_interval_m, saved + 1.0);
        last_saved = found->look.contour_interval_m;
        project.look.contour_interval_m = last_saved;
        ASSERT_EQ(*found, project);
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            if (entry.path() != file) {
                ++kills_within_save;
                fs::remove(entry.path());
            }
        }
    }
    EXPECT_GT(kills_within_save, 0);
    RecordProperty("kills_with_a_draft_left", kills_within_save);
}

TEST(Project, SavingKeepsPermissionsAndFollowsLinks)
{
    const TempFolder folder;
    const fs::path file = folder.write("a.mvproj", "old");
    const fs::path link = folder.path() / "link.mvproj";
    fs::create_symlink(file, link);
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    ASSERT_TRUE(writeProject({}, link, {}));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_TRUE(readProject(file, {}));
}

TEST(Project, FailedSaveLeavesTheOldFile)
{
    const TempFolder folder;
    const fs::path file = folder.write("a.mvproj", "old");
    const Project unwritable = smallProject("/a\xff.tif");
    const auto status = writeProject(unwritable, file, {});
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("not UTF-8"));
    EXPECT_EQ(test::readFile(file), "old");
    EXPECT_FALSE(writeProject({}, folder.path() / "no/such/folder.mvproj", {}));
}

TEST(Project, MissingLayersKeepTheirPlaceAndEverythingElse)
{
    test::MapMaker maker;
    const auto map =
        maker.make({}, [](std::size_t c, std::size_t r) { return static_cast<double>(c * r); });
    Random random;
    Session session;
    std::vector<LayerRecord> records;
    for (std::uint32_t id = 1; id <= 6; ++id) {
        records.push_back(randomLayer(random));
        if (id % 2 == 0) {
            records.back().spec = map->spec();
            session =
                withProjectLayer(std::move(session), layerFrom(records.back(), map), LayerId{id});
        } else {
            session = withMissing(
                std::move(session),
                {.id = LayerId{id}, .record = records.back(), .index = id - 1, .problem = "gone"});
        }
    }
    EXPECT_EQ(projectOf(session).layers, records);
    EXPECT_EQ(projectOf(session).active, 1U);

    // Located: the layer takes the place of the missing one.
    records[2].spec = map->spec();
    session = withProjectLayer(std::move(session), layerFrom(records[2], map), LayerId{3});
    EXPECT_EQ(session.missing.size(), 2U);
    EXPECT_EQ(projectOf(session).layers, records);
    EXPECT_EQ(session.next_id, 7U);
}

TEST(Project, ViewsKeepTheirLayersThroughIds)
{
    Session session;
    for (std::uint32_t id = 3; id <= 5; ++id) {
        session = withMissing(std::move(session), {.id = LayerId{id}, .index = id - 3});
    }
    session = withView(session, {.name = "upper", .layer = LayerId{4}});
    session = withView(session, {.name = "of a removed layer", .layer = LayerId{99}});
    const Project project = projectOf(session);
    ASSERT_EQ(project.views.size(), 2U);
    EXPECT_EQ(project.views[0].layer, 1U);
    EXPECT_FALSE(project.views[1].layer);
    const auto views = savedViews(project.views, {LayerId{7}, LayerId{8}, LayerId{9}}, 20);
    EXPECT_EQ(views[0].layer, LayerId{8});
    EXPECT_EQ(views[1].layer, LayerId::None);
    EXPECT_EQ(views[1].id, ViewId{21});
    EXPECT_EQ(views[1].name, "of a removed layer");
}

TEST(Project, LayersThatArriveInAnyOrderHaveTheOrderOfTheProject)
{
    test::MapMaker maker;
    const auto map = maker.make({}, [](std::size_t, std::size_t) { return 1.0; });
    Session session;
    for (const std::uint32_t id : {3U, 1U, 4U, 2U}) {
        session =
            withProjectLayer(std::move(session),
                             layerFrom({.spec = {}, .name = std::to_string(id)}, map), LayerId{id});
    }
    std::string order;
    for (const Layer& layer : session.layers) {
        order += layer.name;
    }
    EXPECT_EQ(order, "1234");
}

TEST(Project, CanceledReadingAndWritingChangeNothing)
{
    const TempFolder folder;
    const fs::path file = folder.file("a.mvproj");
    constexpr std::size_t kMany = 1000; // more than is read between two looks at the monitor
    Project project;
    project.annotations.assign(
        kMany, {.annotation = {.name = std::string(100, 'a'), .vertices = {MapPoint{1.0, 2.0}}}});
    ASSERT_TRUE(writeProject(project, file, {}));
    JobMonitor monitor;
    monitor.cancel();
    EXPECT_EQ(readProject(file, {}, monitor).error().code, ErrorCode::Canceled);
    EXPECT_EQ(writeProject({}, file, {}, monitor).error().code, ErrorCode::Canceled);
    const auto read = readProject(file, {});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->annotations.size(), kMany);
}

} // namespace marsview
