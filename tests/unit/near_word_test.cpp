#include "suffuse/common/near_word.h"

#include <catch2/catch.hpp>

#include "suffuse/common/error.h"
#include "user_error_message.h"

using namespace suffuse;

TEST_CASE("the distance of two words counts letters changed, added, left out and swapped") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("float", "float") == 0);
  CHECK(edit_distance("Float", "fLOAT") == 0);
  CHECK(edit_distance("float", "flaot") == 1);
  CHECK(edit_distance("lattice", "latice") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("ca", "abc") == 3);  // no place is edited twice
  CHECK(edit_distance("", "abc") == 3);
}

TEST_CASE("the word that was meant is the nearest, and none where nothing is near") {
  const std::vector<std::string> words{"fluid", "force", "plan", "run", "restart"};
  CHECK(near_word("fluit", words) == "fluid");
  CHECK(near_word("forse", words) == "force");
  CHECK(near_word("rest", words) == "restart");  // the only one that it begins
  CHECK(near_word("rn", words) == "run");
  CHECK(near_word("x", words).empty());
  CHECK(near_word("gravity", words).empty());
  CHECK(near_word("run", words).empty());
  CHECK(near_word("", words).empty());
  CHECK(did_you_mean("pln", words) == "did you mean plan?");
}

TEST_CASE("an error that lists the words it knows asks for the one that was meant") {
  const auto message = [](const char* value, const char* rule, const char* remedy) {
    return message_of([&] { throw_user_error({"who", "what", value, rule, remedy}); });
  };
  CHECK(message("doubel", "be one of: double, float", "") ==
        "who: what = doubel, must be one of: double, float; did you mean double?");
  CHECK(message("doubel", "be one of double or float", "mend it") ==
        "who: what = doubel, must be one of double or float; did you mean double? mend it");
  CHECK(message("half", "be one of: double, float", "mend it") ==
        "who: what = half, must be one of: double, float; mend it");
  CHECK(message("doubel", "be a number, not double", "") ==
        "who: what = doubel, must be a number, not double");
}
