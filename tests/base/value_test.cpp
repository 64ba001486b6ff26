#include "dashpot/value.h"

#include <chrono>
#include <limits>

#include <sys/resource.h>

#include "support.h"

using namespace dashpot;

TEST_CASE("JSON round trip keeps order, kinds and every digit") {
  const std::string text = R"({"z":1,"a":[0.1,-0.0,1e+300,"\u00e9\"",true,null],"o":{}})";
  const Value value = parse_json(text, "test");
  CHECK(value.members()[0].first == "z");
  CHECK(value.find("a")->items()[0].as_number() == 0.1);
  CHECK(parse_json(format_json(value), "again").find("a")->items()[3].as_string() == "\u00e9\"");
  CHECK(format_json(parse_json(format_json(value, false), ""), false) == format_json(value, false));
}

TEST_CASE("damaged JSON says where") {
  CHECK(message_of([] {
          parse_json("{\n\"a\": 1,\n}", "m.json");
        }).find("m.json:3: is not valid JSON") == 0);
  CHECK(message_of([] { parse_json(std::string(100000, '['), "deep.json"); }) ==
        "deep.json: is nested more than 200 levels deep");
  CHECK(!message_of([] { format_json(Value(std::numeric_limits<double>::quiet_NaN())); }).empty());
}

TEST_CASE("a wrong kind names the place") {
  const Value value = parse_json(R"({"a":{"b":"x"}})", "m.json");
  CHECK(message_of([&] { value.find("a")->find("b")->as_number(); }) ==
        "m.json, a.b: is text, not a number");
}

TEST_CASE("unknown, missing and present keys") {
  const Value value = parse_yaml("name: x\nrate: 5\nvelocty: 3\n", "d.yaml");
  ObjectReader reader(value, "a dataset file");
  CHECK(reader.string("name") == "x");
  CHECK(reader.number("rate", 1) == 5);
  CHECK(reader.number("velocity", 7) == 7);
  CHECK(message_of([&] { reader.finish(); }) ==
        "d.yaml:3: a dataset file has an unknown key 'velocty'; did you mean 'velocity'? known: "
        "name, rate, "
        "velocity");
  CHECK(message_of([&] { reader.required("files"); }) == "d.yaml:1: a dataset file needs 'files'");
  CHECK(message_of([&] { ObjectReader(value, "a motion").required("velocity"); }) ==
        "d.yaml:1: a motion needs 'velocity'; did you mean it by 'velocty'?");
}

TEST_CASE("YAML scalars by the core schema, with their lines") {
  const Value value = parse_yaml("a: 1.5\nb: '1.5'\nc: true\nd: text\ne:\nf: [1, 2]\n", "d.yaml");
  CHECK(value.find("a")->as_number() == 1.5);
  CHECK(value.find("b")->as_string() == "1.5");
  CHECK(value.find("c")->as_bool());
  CHECK(value.find("d")->as_string() == "text");
  CHECK(value.find("e")->is_null());
  CHECK(value.find("f")->as_numbers() == std::vector<double>{1, 2});
  CHECK(value.find("d")->where() == "d.yaml:4");
  CHECK(message_of([] { parse_yaml("a: 1\na: 2\n", "d.yaml"); }) ==
        "d.yaml:2: the key 'a' stands twice");
  CHECK(message_of([] { parse_yaml("a: [1, 2\n", "d.yaml"); }).find("is not valid YAML") !=
        std::string::npos);
}

TEST_CASE("YAML aliases cannot fill the memory") {
  std::string bomb = "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n";
  for (int k = 1; k < 9; ++k) {
    const std::string last = "*a" + std::to_string(k - 1);
    bomb += "a" + std::to_string(k) + ": &a" + std::to_string(k) + " [" + last;
    for (int j = 0; j < 9; ++j) bomb += "," + last;
    bomb += "]\n";
  }
  CHECK(message_of([&] { parse_yaml(bomb, "bomb.yaml"); }) ==
        "bomb.yaml: has more than 100000 entries");
}

namespace {

/// What `code` throws, which must not take longer than a second.
template <class Code>
std::string soon(Code code) {
  const auto begin = std::chrono::steady_clock::now();
  std::string message = message_of(code);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));
  return message;
}

/// MiB, the most that this process has had.
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

}  // namespace

TEST_CASE("objects of very many keys are read in linear time" * doctest::test_suite("long")) {
  std::string json = "{", yaml;
  for (int k = 0; k < 200000; ++k)
    json += (k > 0 ? ",\"key" : "\"key") + std::to_string(k) + "\":1";
  for (int k = 0; k < 90000; ++k) yaml += "key" + std::to_string(k) + ": 1\n";
  CHECK(soon([&] { CHECK(parse_json(json + "}", "a").members().size() == 200000); }).empty());
  CHECK(soon([&] { CHECK(parse_yaml(yaml, "a").members().size() == 90000); }).empty());
}

TEST_CASE("a long key over many values is kept once, and stands in their places") {
  const std::string key(1'000'000, 'k');
  std::string json = "{\"" + key + "\":[";
  for (int k = 0; k < 20000; ++k) json += k > 0 ? ",1" : "1";
  const long before = peak_memory();
  const Value value = parse_json(json + "]}", "long.json");
  CHECK(peak_memory() - before < 100);
  CHECK(value.members()[0].second.items()[19999].where() == "long.json, " + key + "[19999]");
}

TEST_CASE("a key that stands twice, and more values than any file has, are refused") {
  CHECK(message_of([] { parse_json(R"({"a":{"b":1,"c":2,"b":3}})", "m.json"); }) ==
        "m.json, a: the key 'b' stands twice");
  std::string many = "[1";
  for (int k = 0; k < 2'100'000; ++k) many += ",1";
  CHECK(contains(soon([&] { parse_json(many + "]", "many.json"); }),
                 "many.json: has more than 2000000 values"));
  CHECK(contains(soon([&] { parse_yaml(many + "]", "many.yaml"); }),
                 "many.yaml: has more than 100000 entries"));
}
