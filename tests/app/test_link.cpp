#include <doctest/doctest.h>

#include "app/view/link.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"

using namespace clatter;

// The message of the error of a link.
static std::string mistake_in(const std::string& fragment) {
  try {
    read_link(fragment);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST_CASE("Link: a fragment names a scene of the gallery, keys with their values, and a seed") {
  const LinkedScene linked =
      read_link("vibrated&particles.restitution=0.6&view.field=temperature&seed=7");
  CHECK(linked.scene.title == "Vibrated box");
  CHECK(linked.scene.particles.restitution == 0.6);
  CHECK(linked.scene.view.field == Quantity::Temperature);
  CHECK(linked.seed == 7);
  CHECK(read_link("").scene.title == "Vibrated box");
  CHECK(read_link("").seed == 1);
}

TEST_CASE("Link: escapes of browsers stand for their characters") {
  CHECK(read_link("vibrated&box.size=%5B30%2C%2020%5D").scene.box == Vec2(30.0, 20.0));
  CHECK(read_link("vibrated&view.field%3Ddensity&seed%3D4").scene.view.field == Quantity::Density);
  CHECK(read_link("vibrated&caption=%22a%3Db%22").scene.caption == "a=b");
}

TEST_CASE("Link: a copied link has the scene with its changes") {
  const LinkedScene first = read_link("conduction&particles.restitution=0.75&seed=3");
  const std::string fragment = link_of(first.scene, first.seed);
  const LinkedScene second = read_link(fragment);
  CHECK(scene_to_toml(second.scene) == scene_to_toml(first.scene));
  CHECK(second.seed == 3);
  // Only letters that no browser, chat or mail program escapes.
  CHECK(
      fragment.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
                                 "=&") == std::string::npos);
}

TEST_CASE("Link: a mistake is reported with a suggestion") {
  CHECK(mistake_in("vibrate").find("try \"vibrated\"") != std::string::npos);
  CHECK(mistake_in("vibrated&particles.restitutoin=1").find("restitution") != std::string::npos);
  CHECK(testing::says(mistake_in("vibrated&seed=x"),
                      "the seed is no whole number; write, say, &seed=3"));
  CHECK(mistake_in("vibrated&view.field").find("has no value") != std::string::npos);
}

TEST_CASE("Link: scenes that a page cannot open are refused") {
  CHECK(mistake_in("vibrated&box.size=[9e4,9e4]&particles.count=100001").find("at most 100000") !=
        std::string::npos);
  CHECK(mistake_in("vibrated&box.size=[9e4,9e4]&particles.count=100000") == "none");
  CHECK(mistake_in("vibrated&box.size=[9e4,9e4]&particles.count=99999&change=[{time=1,"
                   "puff={count=2,centre=[1,1],radius=9}}]")
            .find("at most 100000") != std::string::npos);
  const std::string damaged = "the scene in this link is damaged; copy the whole link again";
  CHECK(testing::says(mistake_in("scene=AAAA"), damaged));
  CHECK(testing::says(mistake_in("scene=*"), damaged));
  CHECK(testing::says(testing::refusal_of([] { link_of(load_scene("cradle"), 1); }),
                      "a link cannot hold a start state; save the scene instead"));
  // The compressed text: particles.start={layout='file',file='a.csv'}
  CHECK(testing::says(
      mistake_in("scene=eNorSCwqyUzOSS3WKy4BMm2rcxIr80tLbNXTMnNS1XVApK16ol5ycZl6LRcAkO0QXg"),
      "a link cannot name a file with a start state; give the scene another start"));
  // A file of the machine is never read.
  CHECK(mistake_in("vibrated&particles.start.file=/dev/zero") != "none");
}
