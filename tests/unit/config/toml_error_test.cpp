#include "config/toml_error.hpp"

#include <gtest/gtest.h>

#include <string>

#include "config/device_settings.hpp"
#include "config/fit_settings.hpp"
#include "config/session_settings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

struct SyntaxRow {
  std::string text;
  std::string told;  ///< after the name of the file
};

const std::string kLong(4000, 'q');

const SyntaxRow kSyntaxRows[] = {
    {"# c\n[fit]\ntolerance = 0,5\n", ":3: 'tolerance = 0,5' cannot be read; write the number with a decimal point"},
    {"a = -0,5 # mm\n", ":1: 'a = -0,5 # mm' cannot be read; write the number with a decimal point"},
    {"[fit]\ntolerance 0.5\n", ":2: 'tolerance 0.5' cannot be read; write key = value"},
    {"tolerance\n", ":1: 'tolerance' cannot be read; write key = value"},
    {"a =\n", ":1: 'a =' cannot be read; write a value after the '='"},
    {"a = # of the blade\n", ":1: 'a = # of the blade' cannot be read; write a value after the '='"},
    {"= 3\n", ":1: '= 3' cannot be read; write a key before the '='"},
    {"design = blade.igs\n",
     ":1: 'design = blade.igs' cannot be read; write a text in quotes, true and false in small letters"},
    {"a = True\n", ":1: 'a = True' cannot be read; write a text in quotes, true and false in small letters"},
    {"a = \"b\n", ":1: 'a = \"b' cannot be read; close the text with the quote that it began with"},
    {"a = \"C:\\points\"\n",
     ":1: 'a = \"C:\\points\"' cannot be read; write the text in '...', where a backslash is itself"},
    {"a = \"C:\\users\"\n",
     ":1: 'a = \"C:\\users\"' cannot be read; write the text in '...', where a backslash is itself"},
    {"a = \"C:\\\"\n", ":1: 'a = \"C:\\\"' cannot be read; write the text in '...', where a backslash is itself"},
    {"a = \"b\" c\n", ":1: 'a = \"b\" c' cannot be read; write one text in quotes and nothing after it"},
    {"a = 007\n", ":1: 'a = 007' cannot be read; write the number without leading zeros"},
    {"a = 1 mm\n", ":1: 'a = 1 mm' cannot be read; write one number, a text in quotes, true, false or a [list]"},
    {"[fit\na = 1\n", ":1: '[fit' cannot be read; write the name of a table as [name], alone on its line"},
    {"a = 1\na = 2\n", ":2: 'a = 2' is given a second time; keep one of them"},
    {"[fit]\n[fit]\n", ":2: '[fit]' is given a second time; keep one of them"},
    {"a = [1 2]\n", ":1: 'a = [1 2]' cannot be read; write the list as [a, b], closed by ']'"},
    {"a = \"\xFF\"\n", ":1: a byte that is not UTF-8 text; save the file as UTF-8"},
    {"a = \"\x01\"\n", ":1: a control character; save the file as plain text and delete the character"},
    {"a = " + kLong + "\n", ":1: 'a = " + kLong.substr(0, 56) +
                                "...' cannot be read; write a text in quotes, true and false in small letters"},
    {"a = " + std::string(4000, '['), ":1: lists or tables nested too deep; no value here is so deep, correct it"},
};

TEST(TomlError, SaysWhatStandsThereAndWhatToDoInEveryKindOfFile) {
  const bladefit::testing::ScratchFolder folder;
  for (const SyntaxRow& row : kSyntaxRows) {
    const std::string path = folder.write("a.toml", row.text);
    FitSettings fit;
    SessionSettings session;
    SourceSettings device;
    EXPECT_EQ(load_fit(path, fit).message, path + row.told);
    EXPECT_EQ(load_session(path, session).message, path + row.told);
    EXPECT_EQ(load_device(path, device).message, path + row.told);
  }
}

TEST(TomlError, TellsOfAFileThatEndsWithinAList) {
  const bladefit::testing::ScratchFolder folder;
  FitSettings fit;
  const std::string path = folder.write("a.toml", "a = [1,\n2,\n");
  const std::string told = load_fit(path, fit).message;
  EXPECT_NE(told.find("the file ends within a list or a text; close it with ']' or its quotes"), std::string::npos)
      << told;
}

TEST(TomlError, NothingLongInAFileMakesALongMessage) {
  const bladefit::testing::ScratchFolder folder;
  for (const std::string& text : {kLong + " = 1\n", kLong + "\n", "kind = \"" + kLong + "\"\n", "[" + kLong + "]\n",
                                  "a = \"" + kLong + "\n", "[fit]\n" + kLong + " = 1\n"}) {
    const std::string path = folder.write("a.toml", text);
    FitSettings fit;
    SourceSettings device;
    for (const std::string& told : {load_fit(path, fit).message, load_device(path, device).message}) {
      EXPECT_NE(told, "");
      EXPECT_LT(told.size() - path.size(), 300U) << told;
    }
  }
}

TEST(Excerpt, IsCutBetweenCharacters) {
  EXPECT_EQ(excerpt("a\tb"), "a b");
  EXPECT_EQ(excerpt(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(excerpt(std::string(59, 'x') + "\xC3\xA4y"), std::string(59, 'x') + "...");
}

}  // namespace
}  // namespace bladefit
