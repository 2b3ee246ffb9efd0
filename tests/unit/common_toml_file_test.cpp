#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "suffuse/common/toml_file.h"
#include "user_error_message.h"

using namespace suffuse;

namespace {

struct TomlText {
  std::string path =
      (std::filesystem::temp_directory_path() / ("suffuse-toml-" + std::to_string(getpid()))).string();
  explicit TomlText(const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  ~TomlText() { std::filesystem::remove(path); }
};

std::string refusal_of(const std::string& text) {
  const TomlText file(text);
  return suffuse::message_of([&] { read_toml(file.path, "suffuse-study"); });
}

}  // namespace

TEST_CASE("Letters outside of ASCII are read in quotes and comments") {
  const TomlText file(
      "# Körnung\ntitle = \"Säule \\\" ü\"  # ß\npath = 'größe\\'\ntext = \"\"\"\nzwölf \"\" ä\n\"\"\"\nn = "
      "3\n");
  const toml::table table = read_toml(file.path, "suffuse-study");
  CHECK(table["title"].value<std::string>() == "Säule \" ü");
  CHECK(table["path"].value<std::string>() == "größe\\");
  CHECK(table["text"].value<std::string>() == "zwölf \"\" ä\n");
  CHECK(table["n"].value<int>() == 3);
  // Up to two marks may stand before the three that end a long quote.
  const TomlText marks("a = '''''ä'''''  # ä\nb = \"\"\"ä\"\"\"\"\nc = ''''''\n");
  const toml::table quotes = read_toml(marks.path, "suffuse-study");
  CHECK(quotes["a"].value<std::string>() == "''ä''");
  CHECK(quotes["b"].value<std::string>() == "ä\"");
  CHECK(quotes["c"].value<std::string>() == "");
  const TomlText signs(
      "title = \"50 % of %C3 in ä\"\n[\"Größe %25\"]\nlist = ['ü', [{ \"ß\" = '%' }]]\n\"%\" = 1\n\"%25\" = "
      "2\n");
  const toml::table table_of_signs = read_toml(signs.path, "suffuse-study");
  CHECK(table_of_signs["title"].value<std::string>() == "50 % of %C3 in ä");
  const auto group = table_of_signs["Größe %25"];
  CHECK(group["list"][0].value<std::string>() == "ü");
  CHECK(group["list"][1][0]["ß"].value<std::string>() == "%");
  CHECK((group["%"].value<int>() == 1 && group["%25"].value<int>() == 2));
}

TEST_CASE("Elsewhere they are refused with their line") {
  CHECK_THAT(refusal_of("n = 1\nlänge = 2\n"), Catch::Contains("line 2: letters outside of ASCII"));
  CHECK_THAT(refusal_of("text = \"\"\"\n\"\"\"\nʋ = 1\n"), Catch::Contains("line 3: letters"));
  CHECK_THAT(refusal_of("a = \"ends never\nä = 1\n"), Catch::Contains("line 2: letters"));
  CHECK_THAT(refusal_of("a = '''''b''''ä'''''\n"), Catch::Contains("line 1: letters"));
}

TEST_CASE("What is no TOML is told with its line") {
  CHECK_THAT(refusal_of("n = 1\nn 2\n"), Catch::Contains("line 2: "));
  CHECK_THAT(refusal_of("n = 1\ntext = 'ä'\nm = '\xE4'\n"),
             Catch::Contains("line 3: letters must be written in UTF-8"));
  CHECK_THAT(refusal_of("n = 1[\"\"\"E\u017aE\"\n"),
             Catch::Contains("line 1: "));  // a quote where toml++ sees none
  CHECK_THAT(suffuse::message_of([] { read_toml(".", "suffuse-study"); }),
             Catch::Contains("suffuse-study: file = ., must be a file"));
  CHECK_THAT(suffuse::message_of([] { read_toml(std::string(300, 'x'), "suffuse-study"); }),
             Catch::Contains("be a file that can be read"));
  const TomlText marked("\xEF\xBB\xBFn = 1\n");
  CHECK(read_toml(marked.path, "x").contains("n"));
}
