#include "dashpot/base/settings.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("words are a name and its settings, each of which is stated once") {
  CHECK(split_words("iso8608, class=C,speed = 90km/h", "--road") ==
        std::vector<std::string>{"iso8608", "class=C", "speed = 90km/h"});
  CHECK(message_of([] { split_words("iso8608,class=A, class =E", "--road"); }) ==
        "--road: class is stated twice in 'iso8608,class=A, class =E'; one value of each name");
  CHECK(split_words("skyhook,skyhook", "").size() == 2);
}

TEST_CASE("the name that a list states twice is told") {
  const std::vector<std::string> once = {"a=1", "b=1", "c", "c"}, twice = {"a=1", "b=1", "a =1"};
  CHECK(!stated_twice(once));
  CHECK(stated_twice(twice) == "a");
}

TEST_CASE("a setting takes the place of what the words state of it") {
  CHECK(with_setting("iso8608,class=C,speed=20", "class", "B") == "iso8608,speed=20,class=B");
  CHECK(with_setting("iso8608, speed =20", "speed", "30") == "iso8608,speed=30");
  CHECK(without_setting("viscous,damping=3", "damping") == "viscous");
  CHECK(without_setting("viscous,damping=3", "viscous") == "viscous,damping=3");
}
