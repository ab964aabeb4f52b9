#include <doctest/doctest.h>

#include "engine/error.h"
#include "engine/scene/scene_differences.h"

using namespace clatter;

TEST_CASE("Scene differences: values that changed, came or went are named by their dotted keys") {
  const auto found = differences(
      "title = 'a'\n[box]\nsize = [1.0, 2.0]\n[walls.left]\nkind = 'static'\n",
      "title = 'a'\n[box]\nsize = [1.0, 3.0]\n[gravity]\nacceleration = [0.0, 0.1]\n", "f");
  REQUIRE(found.size() == 3);
  CHECK(found[0].key == "box.size");
  CHECK(found[0].before != found[0].now);
  CHECK(found[1].key == "gravity.acceleration");
  CHECK(found[1].before.empty());
  CHECK(found[2].key == "walls.left.kind");
  CHECK(found[2].now.empty());
}

TEST_CASE("Scene differences: the last bit of a number counts, the order of keys does not") {
  CHECK(differences("a = 0.1\nb = 2", "b = 2\na = 0.1", "f").empty());
  CHECK(differences("a = 0.1", "a = 0.10000000000000002", "f").size() == 1);
  CHECK_THROWS_AS(differences("a = ", "a = 1", "f"), UserError);
}

TEST_CASE("Scene differences: species and pairs are named as in overrides") {
  const std::string species = "[[species]]\nname = 'a'\nmass = 2\n[[species]]\nname = 'b'\n";
  const auto found = differences(species + "[[pair]]\nspecies = ['b', 'a']\nrestitution = 0.5\n",
                                 "[[species]]\nname = 'a'\nmass = 3\n[[species]]\nname = 'c'\n"
                                 "[[pair]]\nspecies = ['b', 'a']\nrestitution = 0.6\n",
                                 "f");
  std::vector<std::string> keys;
  for (const KeyDifference& key : found) keys.push_back(key.key);
  const std::vector<std::string> wanted = {"pair.a.b.restitution", "species.a.mass",
                                           "species.b.name", "species.c.name"};
  CHECK(keys == wanted);
}
