#include "core/formats/odl_label.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace marsview {
namespace {

using testing::ElementsAre;

TEST(OdlLabel, ReadsNestedObjectsAndEveryKindOfValue)
{
    const auto root = parseOdl(
        "PDS_VERSION_ID = PDS3\r\n"
        "/* a comment\n = OBJECT */ ^IMAGE = (\"A.IMG\", 3)\n"
        "note = \"several\n lines = of text\" # and a comment\n"
        "OBJECT = FILE\n Object=IMAGE\n  OFFSET=1737400. <m>\n"
        "  TYPES = { 'a, b', \"c\" , d <km> }\n END_OBJECT\n"
        " AFTER = 5\nEnd_Object = FILE\nGroup = Map\n x = -1e-3\nEnd_Group\n"
        "LAST = yes\nEND\nHIDDEN = 1\n");
    ASSERT_TRUE(root);
    EXPECT_EQ(statementIn(*root, "PDS_VERSION_ID")->value, "PDS3");
    EXPECT_THAT(odlItems(statementIn(*root, "^IMAGE")->value), ElementsAre("A.IMG", "3"));
    EXPECT_EQ(statementIn(*root, "NOTE")->value, "several\n lines = of text");
    const OdlStatement* const image = groupNamed(*root, "IMAGE");
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(statementIn(*image, "OFFSET")->value, "1737400.");
    EXPECT_EQ(statementIn(*image, "OFFSET")->unit, "m");
    EXPECT_THAT(odlItems(statementIn(*image, "TYPES")->value), ElementsAre("a, b", "c", "d"));
    EXPECT_EQ(statementIn(*groupNamed(*root, "FILE"), "AFTER")->value, "5");
    EXPECT_EQ(statementIn(*groupNamed(*root, "MAP"), "X")->value, "-1e-3");
    EXPECT_EQ(statementIn(*root, "LAST")->value, "yes");
    EXPECT_EQ(statementIn(*root, "HIDDEN"), nullptr);
}

TEST(OdlLabel, ParsingEndsForEveryDamagedText)
{
    const std::string whole = "A = (1, 2\nOBJECT = X\n B = \"text\nEND_OBJECT\nC = 1 <m\nEND";
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        parseOdl(whole.substr(0, length)); // returns
    }
    std::string deep;
    for (int i = 0; i < 100000; ++i) {
        deep += "GROUP = A\n";
    }
    EXPECT_TRUE(parseOdl(deep));
    EXPECT_FALSE(parseOdl(std::string("\0\1\2 no statement", 15)));
    EXPECT_FALSE(parseOdl(""));
    EXPECT_TRUE(parseOdl("=======\n;;; = = \nA = 1"));
}

} // namespace
} // namespace marsview
