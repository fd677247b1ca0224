#include "app/gui/window_arguments.h"

#include <gtest/gtest.h>

namespace marsview {
namespace {

using Words = std::vector<std::string>;

Result<WindowArguments> parsed(const Words& words)
{
    return parseWindowArguments(words, "1.2.3");
}

TEST(WindowArguments, SeparatesMapsOursAndQts)
{
    const auto arguments =
        parsed({"a.tif", "-style", "fusion", "--platform=xcb", "file:///x/b%20c.tif", "-reverse",
                "--screenshot", "p.png", "--size", "800x600", "--", "-odd.tif"});
    ASSERT_TRUE(arguments) << arguments.error().message;
    EXPECT_EQ(arguments->maps, (Words{"a.tif", "/x/b c.tif", "-odd.tif"}));
    EXPECT_EQ(arguments->for_qt, (Words{"--platform=xcb", "-reverse"}));
    EXPECT_EQ(arguments->style, "fusion");
    EXPECT_EQ(arguments->screenshot, "p.png");
    ASSERT_TRUE(arguments->geometry.extent);
    EXPECT_EQ(arguments->geometry.extent->width, 800);
    EXPECT_EQ(arguments->geometry.extent->height, 600);
    EXPECT_FALSE(arguments->geometry.place);
}

TEST(WindowArguments, ReadsGeometriesAsX11WritesThem)
{
    const auto all = parsed({"-geometry", "900x700+10-20"});
    ASSERT_TRUE(all) << all.error().message;
    EXPECT_EQ(all->geometry.extent->height, 700);
    EXPECT_EQ(all->geometry.place->x, 10);
    EXPECT_EQ(all->geometry.place->y, -20);
    const auto place = parsed({"--geometry=+5+6"});
    ASSERT_TRUE(place) << place.error().message;
    EXPECT_FALSE(place->geometry.extent);
    EXPECT_EQ(place->geometry.place->y, 6);
}

TEST(WindowArguments, AnswersHelpAndVersion)
{
    EXPECT_EQ(*parsed({"--version"})->answer, "marsview 1.2.3\n");
    EXPECT_NE(parsed({"a.tif", "--help"})->answer->find("--screenshot FILE"), std::string::npos);
    EXPECT_FALSE(parsed({})->answer);
    // The program draws with OpenGL, which this platform of Qt does not have.
    EXPECT_EQ(parsed({"--help"})->answer->find("-platform offscreen"), std::string::npos);
}

TEST(WindowArguments, AreRefusedWithTheOptionAndTheReason)
{
    struct Case {
        Words words;
        std::string start;
    };
    for (const Case& c :
         {Case{{"--sise", "1x1"}, "--sise: unknown option. Did you mean \"--size\"?"},
          Case{{"-stlye", "fusion"}, "-stlye: unknown option. Did you mean \"-style\"?"},
          Case{{"--stile", "fusion"}, "--stile: unknown option. Did you mean \"-style\"?"},
          Case{{"-sise", "1x1"}, "-sise: unknown option. Did you mean \"--size\"?"},
          Case{{"--stylesheet", "/no/such/file.qss"},
               "--stylesheet: /no/such/file.qss is not a file that can be read"},
          Case{{"-stylesheet=/"}, "-stylesheet: / is not a file that can be read"},
          Case{{"--size", "big"}, "--size: \"big\" is not a size"},
          Case{{"--size", "100x100"}, "--size: "}, Case{{"--size", "800x600+1+1"}, "--size: "},
          Case{{"--size"}, "--size: a value is missing"},
          Case{{"-style"}, "-style: a value is missing"},
          Case{{"--geometry", "800x"}, "--geometry: "},
          Case{{"--screenshot", ""}, "--screenshot: "},
          Case{{"--screenshot", "a.gif"},
               "--screenshot: \"a.gif\" does not end in .png or .jpg; other formats are not "
               "written"},
          Case{{""}, "DEM: "},
          Case{{"file://server/a.tif"}, "file://server/a.tif: names the computer"}}) {
        const auto arguments = parsed(c.words);
        ASSERT_FALSE(arguments) << c.start;
        EXPECT_TRUE(arguments.error().message.starts_with(c.start)) << arguments.error().message;
    }
}

} // namespace
} // namespace marsview
